// The estimating equation on a shot that others have simulated: MCML's radial profiles.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/fit/scattering_equation.h"
#include "core/material/dipole.h"
#include "core/transport/path_blocks.h"
#include "tests/fixtures/core/boxes.h"
#include "tests/fixtures/core/mcml.h"
#include "tests/fixtures/draws.h"

namespace scattermeter {
namespace {

using test_support::kMcmlBinMm;

// What leaves through the face at z = 0, by rings of a bin's width, and what perturbation needs.
struct Rings {
  Eigen::VectorXd weight, weight_n, weight_length;
  explicit Rings(Eigen::Index bins)
      : weight(Eigen::VectorXd::Zero(bins)), weight_n(weight), weight_length(weight) {}
  void escape(const PathScore& s) {
    const auto bin =
        static_cast<Eigen::Index>(std::hypot(s.point_mm.x(), s.point_mm.y()) / kMcmlBinMm);
    if (s.point_mm.z() < -1e-9 || bin >= weight.size()) return;
    weight[bin] += s.weight;
    weight_n[bin] += s.weight * s.scatterings;
    weight_length[bin] += s.weight * s.length_mm;
  }
  void camera(const PathScore&) {}
};

// A pencil beam on a half-space (a box far larger than the profile).
class HalfSpace {
 public:
  HalfSpace()
      : scene_(test_support::make_box({-300, -300, -300}, {300, 300, 0})),
        boundary_(scene_),
        source_(beam_entry({})) {}

  struct Image {
    ScatteringImage m;  // power per ring and unit of what the beam sends
    Eigen::MatrixXd covariance;
  };
  Image image(const ScatteringPoint& at, double eta, double entered,
              const Eigen::MatrixXd& projection, int blocks, std::uint64_t seed) const {
    const ScatteringMedium medium{at.sigma_s_per_mm, at.sigma_a_per_mm, 0.0, eta};
    PathOptions options;
    options.seed = seed;
    const Eigen::Index bins = projection.cols();
    Rings sum(bins);
    Eigen::VectorXd square = Eigen::VectorXd::Zero(bins);
    Eigen::VectorXd p = Eigen::VectorXd::Zero(projection.rows());
    Eigen::MatrixXd pp = Eigen::MatrixXd::Zero(p.size(), p.size());
    trace_blocks<Rings>(
        {boundary_, medium, *source_, nullptr}, options, 0, blocks, [&] { return Rings(bins); },
        [&](const Rings& r, const PathAudit&) {
          sum.weight += r.weight;
          sum.weight_n += r.weight_n;
          sum.weight_length += r.weight_length;
          square += r.weight.cwiseAbs2();
          const Eigen::VectorXd own = projection * r.weight;
          p += own;
          pp += own * own.transpose();
        });
    const double n = blocks;
    Image out;
    out.m.l = entered / n * sum.weight;
    out.m.per_log_sigma_s = entered / n * (sum.weight_n - at.sigma_s_per_mm * sum.weight_length);
    out.m.per_sigma_a = -entered / n * sum.weight_length;
    out.m.variance = entered * entered * (square - sum.weight.cwiseAbs2() / n) / (n * (n - 1.0));
    out.covariance = entered * entered * (pp - p * p.transpose() / n) / (n * (n - 1.0));
    return out;
  }

 private:
  RayScene scene_;
  PathBoundary boundary_;
  std::unique_ptr<EntrySource> source_;
};

// The dipole's power per ring and its derivatives.
ScatteringImage dipole_rings(const ScatteringPoint& at, double eta, double entered,
                             Eigen::Index bins) {
  const Dipole dipole(Medium{at.sigma_s_per_mm, at.sigma_a_per_mm, eta});
  ScatteringImage out;
  out.l = out.per_log_sigma_s = out.per_sigma_a = out.variance = Eigen::VectorXd::Zero(bins);
  for (Eigen::Index i = 0; i < bins; ++i) {
    const double r = (static_cast<double>(i) + 0.5) * kMcmlBinMm;
    const double area = entered * 2.0 * std::numbers::pi * r * kMcmlBinMm;
    const Dipole::Value v = dipole.with_derivatives(r);
    out.l[i] = area * v.r_per_mm2;
    out.per_log_sigma_s[i] = area * at.sigma_s_per_mm * v.d_sigma_s_prime;
    out.per_sigma_a[i] = area * v.d_sigma_a;
  }
  return out;
}

// Neither the paths nor the program are ours; MCML's own error is at most that of as many packets
// of full weight. The search starts a third off in both.
TEST(TransportShotStatistics, FindsMcmlsMedia) {
  const int blocks = test_support::draws(60, 200);
  const HalfSpace half_space;
  for (const test_support::McmlCase& c : test_support::kMcmlCases) {
    std::string path;
    const std::vector<double> power = test_support::mcml_ring_power(c, path);
    if (power.empty()) GTEST_SKIP() << path << " is not there; set SCATTERMETER_SHARED";
    ASSERT_GT(power.size(), 50U);
    const auto bins = static_cast<Eigen::Index>(power.size());
    const double entered = 1.0 - c.specular;
    const double eta = c.medium.eta_int_over_ext;
    DenseSystem system;
    system.l = Eigen::Map<const Eigen::VectorXd>(power.data(), bins);
    ScatteringPoint at{c.medium.sigma_s_per_mm / 1.33, 1.33 * c.medium.sigma_a_per_mm, 1.0};
    ScatteringEquation::Step step;
    for (int round = 0; round < 8; ++round) {
      const ScatteringImage pilot = dipole_rings(at, eta, entered, bins);
      system.std_l = (pilot.l / c.photons).cwiseSqrt();
      const ScatteringEquation equation(system, {0.0}, pilot, at);
      const HalfSpace::Image image = half_space.image(at, eta, entered, equation.projection(0),
                                                      round < 5 ? 20 : blocks, 1000u + round);
      step = equation.step({image.m, image.m}, image.covariance, at);
      at = step.to;
    }
    const double std_s = c.medium.sigma_s_per_mm * std::sqrt(step.covariance(0, 0));
    const double std_a = std::sqrt(step.covariance(1, 1));
    std::printf("%s: sigma_s %.4f +- %.4f (%.4f), sigma_a %.5f +- %.5f (%.5f) 1/mm\n", c.name,
                at.sigma_s_per_mm, std_s, c.medium.sigma_s_per_mm, at.sigma_a_per_mm, std_a,
                c.medium.sigma_a_per_mm);
    EXPECT_NEAR(at.sigma_s_per_mm, c.medium.sigma_s_per_mm, 3.5 * std_s);
    EXPECT_NEAR(at.sigma_a_per_mm, c.medium.sigma_a_per_mm, 3.5 * std_a);
    const double more = test_support::limit_at(1.0, 200, blocks);
    EXPECT_LT(std_s, more * 0.01 * c.medium.sigma_s_per_mm);
    EXPECT_LT(std_a, more * std::max(1e-4, 0.05 * c.medium.sigma_a_per_mm));
  }
}

}  // namespace
}  // namespace scattermeter
