#include "core/camera/lens_parameters.h"

#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/camera/lens.h"
#include "tests/fixtures/core/derivative_check.h"

namespace scattermeter {
namespace {

TEST(LensParameters, ShiftIsTheDerivativeOfTheLens) {
  LensParameters lens;
  lens << 700, 690, 330, 250, -0.2, 0.1, 1e-3, -2e-3, 0.05, 0.02, -0.03, 0.01;
  for (const Eigen::Vector2d& ray :
       {Eigen::Vector2d(0.4, -0.3), Eigen::Vector2d(-0.1, 0.35), Eigen::Vector2d(0.25, 0.3)}) {
    const auto pixel = [&](const Eigen::VectorXd& p) -> Eigen::VectorXd {
      return Lens(intrinsics_of(p, 640, 480)).project({ray.x(), ray.y(), 1});
    };
    test_support::expect_derivatives(pixel, lens, shift_per_lens_parameter(lens, ray));
  }
}

TEST(LensParameters, RoundTripThroughIntrinsics) {
  CameraIntrinsics k{640, 480, 700, 690, 330, 250, {-0.2, 0.1, 1e-3, -2e-3, 0.05}};
  EXPECT_EQ(intrinsics_of(lens_parameters(k), 640, 480).distortion, k.distortion);
  k.distortion = {-0.2, 0.1, 1e-3, -2e-3, 0.05, 0.01, 0.02, 0.03};
  EXPECT_EQ(intrinsics_of(lens_parameters(k), 640, 480).distortion, k.distortion);
  k.distortion = {};
  EXPECT_EQ(intrinsics_of(lens_parameters(k), 640, 480).distortion, std::vector<double>(5, 0.0));
}

TEST(LensModels, NamesMapsAndBack) {
  std::size_t before = 0;
  for (const LensModel& model : all_lens_models()) {
    const std::vector<std::string> names = parameter_names(model);
    const Eigen::MatrixXd map = parameter_map(model);
    EXPECT_EQ(map.cols(), static_cast<Eigen::Index>(names.size()));
    EXPECT_EQ(lens_model_of(names), model);
    EXPECT_GE(names.size(), before);
    before = names.size();
    // fx and fy are always there; every other row at most once.
    EXPECT_EQ(map.topRows<2>().sum(), 2);
    EXPECT_EQ(map.bottomRows<10>().sum(), map.cols() - (model.one_focal_length ? 1 : 2));
  }
  EXPECT_EQ(all_lens_models().size(), 12U);
  EXPECT_THROW(lens_model_of({"f_px"}), std::invalid_argument);
  EXPECT_EQ(lens_model_name({true, DistortionTerms::kK1K2}), "fx = fy, k1 k2");
}

TEST(LensRoot, OfIndependentDeviations) {
  const CameraIntrinsics k{640, 480, 700, 690, 330, 250, {}};
  const LensRoot root = lens_root(k, {0.01, 0.001, 2.0, 0.05});
  const Eigen::MatrixXd covariance = root * root.transpose();
  EXPECT_DOUBLE_EQ(covariance(0, 0), 49.0);
  EXPECT_DOUBLE_EQ(covariance(0, 1), 7.0 * 6.9);
  EXPECT_DOUBLE_EQ(covariance(1, 1), 6.9 * 6.9 + 0.69 * 0.69);
  EXPECT_DOUBLE_EQ(covariance(2, 2), 4.0);
  EXPECT_DOUBLE_EQ(covariance(3, 3), 4.0);
  EXPECT_DOUBLE_EQ(covariance(4, 4), 0.0025);
  EXPECT_EQ(covariance.bottomRows<7>().norm(), 0.0);
  EXPECT_EQ(lens_root(k, {}).cols(), 0);
  EXPECT_EQ(lens_root(k, {0.01, 0.0, 0.0, 0.0}).cols(), 1);
  EXPECT_THROW(lens_root(k, {0.01, -0.001, 2.0, 0.05}), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter
