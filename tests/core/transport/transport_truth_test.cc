// The path tracer against what is known from elsewhere, with long runs.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/diffusion/dipole_image.h"
#include "core/light/incident_light.h"
#include "core/material/dipole.h"
#include "core/transport/path_blocks.h"
#include "tests/fixtures/core/block_mean.h"
#include "tests/fixtures/core/boxes.h"
#include "tests/fixtures/core/escape_rings.h"
#include "tests/fixtures/core/mcml.h"

namespace scattermeter {
namespace {

using test_support::pencil;
using test_support::RingMeans;

// Adding-doubling, 48 points: slab 20 mm, n 1.3, g 0, 2.19 / 0.002: R 0.87699 with 0.01701
// specular, T 0.02301. The slab is a box 1200 mm wide.
TEST(TransportTruth, Slab) {
  const RingMeans r = pencil({1200, 1200, 20}, {2.19, 0.002, 0.0, 1.3}, {}, 200, 2000);
  const double entered = 1.0 - 0.01701;
  EXPECT_LT(std::abs(r.up.z((0.87699 - 0.01701) / entered)), test_support::kSigmas) << r.up.mean();
  EXPECT_LT(std::abs(r.rest.z(0.02301 / entered)), test_support::kSigmas) << r.rest.mean();
  EXPECT_LT(std::abs(r.absorbed.z(0.10173)), test_support::kSigmas) << r.absorbed.mean();
  EXPECT_LT(r.up.std_error(), 5e-4);
}

// Chandrasekhar's H-function, albedo 0.99, and Giovanelli with ten times the paths of the small
// tests.
TEST(TransportTruth, HalfSpaces) {
  const RingMeans h = pencil({600, 600, 300}, {0.99, 0.01, 0.0, 1.0}, {}, 200, 5000);
  EXPECT_LT(std::abs(h.up.z(0.752721)), test_support::kSigmas) << h.up.mean();
  EXPECT_LT(h.up.std_error(), 4e-4);
  const RingMeans g = pencil({600, 600, 300}, {0.9, 0.1, 0.0, 1.5}, {}, 200, 5000);
  // The literature gives four digits.
  EXPECT_LT(std::abs(g.up.mean() - 0.22 / 0.96), test_support::kSigmas * g.up.std_error() + 5e-5);
  EXPECT_LT(g.up.std_error(), 4e-4);
}

// MCML's radial profiles, added up over rings. MCML's own error: at most that of as many packets of
// full weight.
TEST(TransportTruth, MeetsMcml) {
  for (const test_support::McmlCase& c : test_support::kMcmlCases) {
    std::string path;
    const std::vector<double> power = test_support::mcml_ring_power(c, path);
    if (power.empty()) GTEST_SKIP() << path << " is not there; set SCATTERMETER_SHARED";
    const std::vector<double> edges = {0.2, 0.6, 1.0, 2.0, 4.0, 8.0};
    std::vector<double> expected(edges.size(), 0.0);
    for (std::size_t i = 0; i < power.size(); ++i) {
      const double r = (static_cast<double>(i) + 0.5) * test_support::kMcmlBinMm;
      if (r > edges.back()) break;
      expected[static_cast<std::size_t>(std::upper_bound(edges.begin(), edges.end(), r) -
                                        edges.begin())] += power[i];
    }
    const RingMeans m = pencil({800, 800, 400}, c.medium, edges, 100, 4000);
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const double mean = (1.0 - c.specular) * m.power[i].mean();
      const double error = std::hypot((1.0 - c.specular) * m.power[i].std_error(),
                                      std::sqrt(expected[i] / c.photons));
      EXPECT_LT(std::abs(mean - expected[i]), test_support::kSigmas * error)
          << c.name << " to " << edges[i] << " mm: " << mean << ", MCML " << expected[i];
      EXPECT_LT(error, 0.02 * expected[i] + 1e-4);
    }
  }
}

// The dipole's own ground: a half-space of albedo 0.9995, five mean free paths and more from a
// pencil beam: the closer, the farther it goes. What remains is the boundary: the dipole's
// extrapolated length of 2/3 against Milne's 0.71, and the fit of A.
TEST(TransportTruth, MeetsTheDipoleFarAway) {
  for (double eta : {1.0, 1.3}) {
    const std::vector<double> edges = {5.0, 8.0, 12.0, 20.0};
    const RingMeans m = pencil({2000, 2000, 1000}, {1.0, 0.0005, 0.0, eta}, edges, 200, 1000);
    const Dipole dipole(Medium{1.0, 0.0005, eta});
    for (std::size_t i = 1; i < edges.size(); ++i) {
      double expected = 0.0;
      constexpr int kSteps = 1000;
      for (int k = 0; k < kSteps; ++k) {
        const double dr = (edges[i] - edges[i - 1]) / kSteps;
        const double r = edges[i - 1] + (k + 0.5) * dr;
        expected += 2.0 * std::numbers::pi * r * dr * dipole.reflectance_per_mm2(r);
      }
      // Measured: 0.92 0.94 0.99 (eta 1), 1.01 0.97 0.98 (eta 1.3).
      const double limit = i == 3 ? 0.03 : 0.10;
      EXPECT_LT(std::abs(m.power[i].mean() - expected),
                limit * expected + test_support::kSigmas * m.power[i].std_error())
          << "eta " << eta << ", to " << edges[i] << " mm";
      EXPECT_LT(m.power[i].std_error(), 0.015 * expected);
    }
  }
}

// The 20 mm cube of the paper's kind (smooth, eta 1.3, 2.19 / 0.002). An independent Monte Carlo
// says: 95.8 % of what enters leaves again after 51 scatterings, and the dipole's light is 4.1 %
// low in front and 2.6 % low on top. That program had 200,000 paths (a standard error of 0.3 % in
// these ratios) and saw no light that is reflected inside on its way to the camera; with it the
// dipole is 4.6 % and 3.4 % low.
struct Faces {
  double front = 0, top = 0;
  void escape(const PathScore&) {}
  void camera(const PathScore& s) { (s.point_mm.z() > 20.0 - 1e-9 ? top : front) += s.weight; }
};

TEST(TransportTruth, Cube) {
  const RayScene scene(test_support::make_cube());
  const PathBoundary boundary(scene);
  const ScatteringMedium medium{2.19, 0.002, 0.0, 1.3};
  Led led;
  led.position_mm = {30, -60, 80};
  led.axis = (Eigen::Vector3d(0, 0, 10) - led.position_mm).normalized();
  // The dipole's light on the two faces.
  const PatchMesh patches(scene.mesh(), 0.5);
  const IncidentLight light = illuminate(patches, scene, led, 1.3);
  std::vector<Eigen::Vector3d> points;
  std::vector<int> patch;
  for (int k = 0; k < patches.size(); ++k) {
    if (patches.normal(k).y() > -0.5 && patches.normal(k).z() < 0.5) continue;
    points.push_back(patches.center_mm(k));
    patch.push_back(k);
  }
  const Medium reduced{2.19, 0.002, 1.3};
  const auto l = dipole_radiosity(points, light, {0, 0, 10}, 40.0, {reduced, reduced, reduced},
                                  Eigen::Array3d::Ones());
  double dipole_front = 0.0, dipole_top = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    (patches.normal(patch[i]).z() > 0.5 ? dipole_top : dipole_front) +=
        l[i][0] * patches.area_mm2(patch[i]);
  }

  const auto source = led_entry(scene, led, 1.3);
  for (const bool walls : {false, true}) {
    const CameraConnection camera(boundary, {0, -100, 150}, medium, walls ? 2 : 0);
    test_support::BlockMean leaving, scatterings, front, top;
    trace_blocks<Faces>(
        {boundary, medium, *source, &camera}, {}, 0, 300, [] { return Faces(); },
        [&](const Faces& s, const PathAudit& audit) {
          EXPECT_EQ(audit.lost_paths, 0);
          leaving.add(audit.escaped / audit.entered);
          scatterings.add(static_cast<double>(audit.scatterings) /
                          static_cast<double>(audit.paths));
          front.add(s.front);
          top.add(s.top);
        });
    EXPECT_NEAR(leaving.mean(), 0.958, 5e-4 + test_support::kSigmas * leaving.std_error());
    EXPECT_NEAR(scatterings.mean(), 51.0, 1.0);
    const auto expect_low = [&](const test_support::BlockMean& face, double dipole, double low) {
      const double error = std::hypot(0.003, face.std_error() / face.mean());
      EXPECT_LT(std::abs(dipole / face.mean() - 1.0 + low), 2.0 * error) << "walls " << walls;
      EXPECT_LT(face.std_error(), 0.002 * face.mean());
    };
    expect_low(front, dipole_front, walls ? 0.046 : 0.041);
    expect_low(top, dipole_top, walls ? 0.034 : 0.026);
  }
}

}  // namespace
}  // namespace scattermeter
