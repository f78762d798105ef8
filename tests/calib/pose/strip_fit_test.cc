#include "calib/pose/strip_fit.h"

#include <cmath>

#include <Eigen/LU>
#include <gtest/gtest.h>

namespace scattermeter::calib {
namespace {

const Eigen::Vector2d kNormal(0.8, 0.6);
constexpr double kOffset = 0.3, kBlur = 0.5;

// Two channels, 0 and 2, on a grid of 13 x 9 pixels, exactly as the model has them.
std::vector<StripSample> exact(double step_counts = 500.0) {
  const EdgeShape shape(kNormal, kBlur);
  std::vector<StripSample> samples;
  for (int y = -4; y <= 4; ++y) {
    for (int x = -6; x <= 6; ++x) {
      const double s = kNormal.dot(Eigen::Vector2d(x, y));
      const auto f = shape.at(kOffset - s).s;
      const int channel = (x + y) % 2 == 0 ? 0 : 2;
      const double scale = channel == 0 ? 1.0 : 0.6;
      samples.push_back(
          {s, 10.0 + scale * (step_counts * f[0] - 20.0 * f[1] + 1.0 * f[2]), 2.0, channel});
    }
  }
  return samples;
}

TEST(StripFit, FitsItsOwnModelExactly) {
  StripFit fit(exact(), kNormal, 1.0 / 6, false);
  EXPECT_EQ(fit.unknowns(), 2 * 4 + 2);
  EXPECT_EQ(fit.samples(), 117.0);
  EXPECT_LT(fit.solve(kOffset, kBlur), 1e-15);
  Eigen::Vector2d gradient;
  fit.information(&gradient);
  EXPECT_LT(gradient.norm(), 1e-6);
  EXPECT_GT(fit.solve(kOffset + 0.05, kBlur), 1.0);
  EXPECT_GT(fit.solve(kOffset, kBlur + 0.1), 0.1);
}

// chi2 near its minimum is the square of the step in the metric of the information.
TEST(StripFit, InformationIsTheCurvature) {
  StripFit fit(exact(), kNormal, 1.0 / 6, false);
  fit.solve(kOffset, kBlur);
  Eigen::Vector2d gradient;
  const Eigen::Matrix2d info = fit.information(&gradient);
  for (const Eigen::Vector2d& d :
       {Eigen::Vector2d(1e-3, 0), Eigen::Vector2d(0, 1e-3), Eigen::Vector2d(1e-3, -1e-3)}) {
    EXPECT_NEAR(fit.solve(kOffset + d[0], kBlur + d[1]) / d.dot(info * d), 1.0, 0.02);
  }
  // And the gradient there points back.
  const Eigen::Vector2d off(2e-3, 1e-3);
  fit.solve(kOffset + off[0], kBlur + off[1]);
  const Eigen::Matrix2d there = fit.information(&gradient);
  EXPECT_LT((there.inverse() * gradient + off).norm(), 0.05 * off.norm());
}

TEST(StripFit, SignOfTheStepIsThatOfItsBrightSide) {
  double sign = 0;
  StripFit bright(exact(), kNormal, 1.0 / 6, false);
  bright.solve(kOffset, kBlur);
  const double snr = bright.snr(&sign);
  EXPECT_GT(snr, 20.0);
  EXPECT_GT(sign, 0.0);
  StripFit dark(exact(-500.0), kNormal, 0.0, false);
  dark.solve(kOffset, kBlur);
  dark.snr(&sign);
  EXPECT_LT(sign, 0.0);
}

// Weights follow the prediction: ten times the photon noise, less information.
TEST(StripFit, ReweighsByThePrediction) {
  StripFit plain(exact(), kNormal, 0.0, false);
  StripFit photons(exact(), kNormal, 10.0, false);
  Eigen::Vector2d gradient;
  for (StripFit* fit : {&plain, &photons}) {
    fit->solve(kOffset, kBlur);
    fit->reweigh();
    fit->solve(kOffset, kBlur);
  }
  EXPECT_GT(plain.information(&gradient)(0, 0), 10.0 * photons.information(&gradient)(0, 0));
}

TEST(StripFit, ASlopeOutsideIsAColumnMore) {
  std::vector<StripSample> samples = exact();
  for (StripSample& s : samples) s.signal_counts += 7.0 * s.s;
  StripFit without(samples, kNormal, 0.0, false);
  EXPECT_GT(without.solve(kOffset, kBlur), 1.0);
  StripFit with(samples, kNormal, 0.0, true);
  EXPECT_EQ(with.unknowns(), 2 * 5 + 2);
  EXPECT_LT(with.solve(kOffset, kBlur), 1e-12);
}

}  // namespace
}  // namespace scattermeter::calib
