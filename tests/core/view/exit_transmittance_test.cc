#include "core/view/exit_transmittance.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/material/fresnel.h"
#include "core/mesh/round_bodies.h"
#include "core/view/pixel_points.h"
#include "tests/fixtures/core/boxes.h"
#include "tests/fixtures/core/pinhole_rays.h"

namespace scattermeter {
namespace {

constexpr double kEta = 1.49;

class Viewed {
 public:
  explicit Viewed(const TriangleMesh& mesh) : scene_(mesh), patches_(mesh, 1.0) {}

  ExitTransmittance transmittance() const { return {rays_, scene_, patches_, surface_, kEta}; }
  const RayGrid& rays() const { return rays_; }
  const SeenSurface& surface() const { return surface_; }
  const Eigen::Vector3d& normal_of(int facet) const { return patches_.facet_normal(facet); }
  double at(const Eigen::Vector3d& direction) const {
    const PixelHit hit = trace_pixel(scene_, patches_, rays_.origin_in_world_mm, direction);
    return hit.facet_idx < 0 ? 0.0 : fresnel_transmittance(kEta, hit.cos_theta);
  }

 private:
  RayScene scene_;
  PatchMesh patches_;
  RayGrid rays_ = test_support::pinhole_rays({40, -90, 120}, {0, 0, 10}, 2200.0, 400, 400);
  SeenSurface surface_{rays_, scene_, patches_, {}};
};

// Against the mean over a fine grid of rays: near the outline of a body of 80 faces, these differ
// by many per cent.
TEST(ExitTransmittance, IsTheMeanOverThePixelOfABodyOfFaces) {
  const Viewed view(sphere_mesh(1));
  const ExitTransmittance transmittance = view.transmittance();
  double of_means = 0.0, of_centers = 0.0;
  int n = 0;
  for (int y = 20; y < 380; y += 7) {
    for (int x = 20; x < 380; x += 7) {
      if (view.surface().seen(view.surface().index(x, y)).patch < 0) continue;
      if (!view.surface().inside(x, y)) continue;
      const PixelPoints pixel(view.rays(), x, y);
      double mean = 0.0;
      for (int i = 0; i < 64; ++i) mean += view.at(pixel.direction(i, 64)) / 64;
      const double center =
          view.at(view.rays().directions_in_world[view.surface().index(x, y)].cast<double>());
      of_means += std::pow(transmittance.of(x, y) / mean - 1.0, 2);
      of_centers += std::pow(center / mean - 1.0, 2);
      ++n;
    }
  }
  EXPECT_GT(n, 1000);
  EXPECT_GT(std::sqrt(of_centers / n), 1e-2);
  EXPECT_LT(std::sqrt(of_means / of_centers), 0.2);
}

// Facets of a smooth body do not show: the transmittance is that of the sphere on which their
// corners lie.
TEST(ExitTransmittance, IsThatOfTheSphereForWhichFacetsStand) {
  const Eigen::Vector3d center_mm(0, 0, 10);
  const Viewed view(sphere_mesh());
  const ExitTransmittance transmittance = view.transmittance();
  double off = 0.0, by_facets = 0.0;
  int n = 0;
  for (int y = 20; y < 380; y += 7) {
    for (int x = 20; x < 380; x += 7) {
      const std::size_t i = view.surface().index(x, y);
      if (view.surface().seen(i).patch < 0 || !view.surface().inside(x, y)) continue;
      const Eigen::Vector3d toward = -view.rays().directions_in_world[i].cast<double>();
      const auto cosine = [&](const Eigen::Vector3d& normal) {
        return normal.dot(toward) / toward.norm();
      };
      const double smooth =
          fresnel_transmittance(kEta, cosine((view.surface().point(i) - center_mm).normalized()));
      off += std::pow(transmittance.of(x, y) / smooth - 1.0, 2);
      by_facets += std::pow(
          fresnel_transmittance(kEta, cosine(view.normal_of(view.surface().seen(i).facet))) /
                  smooth -
              1.0,
          2);
      ++n;
    }
  }
  EXPECT_GT(n, 1000);
  EXPECT_GT(std::sqrt(by_facets / n), 3e-3);
  EXPECT_LT(std::sqrt(off / n), 3e-4);
}

// No further rays are needed where all of a sample's neighbours see facets of the same slant.
TEST(ExitTransmittance, IsThatOfTheCentreOnAFace) {
  const Viewed view(test_support::make_cube());
  const ExitTransmittance transmittance = view.transmittance();
  int n = 0;
  for (int y = 5; y < 395; y += 10) {
    for (int x = 5; x < 395; x += 10) {
      const std::size_t i = view.surface().index(x, y);
      if (view.surface().seen(i).patch < 0 || !view.surface().inside(x, y)) continue;
      const double center =
          fresnel_transmittance(kEta, static_cast<double>(view.surface().seen(i).cos_theta));
      EXPECT_NEAR(transmittance.of(x, y), center, 1e-5);
      ++n;
    }
  }
  EXPECT_GT(n, 100);
}

}  // namespace
}  // namespace scattermeter
