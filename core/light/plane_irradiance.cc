#include "core/light/plane_irradiance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include <oneapi/tbb/parallel_for.h>

#include "core/light/diffuse_plane.h"
#include "core/light/lit_layer.h"
#include "core/light/transmitted_cosine.h"

namespace scattermeter {
namespace {

// A corner on the plane itself sees a single point of it: corners are lifted by this share of a
// patch.
constexpr double kLifted = 0.1;

class PlaneView {
 public:
  PlaneView(const RayScene& scene, double z_mm, double least_height_mm, const OnPlane& irradiance,
            const TransmittedCosine& transmitted, const PlaneIrradianceOptions& options)
      : scene_(scene),
        z_mm_(z_mm),
        least_height_mm_(least_height_mm),
        irradiance_(irradiance),
        transmitted_(transmitted) {
    const double step = 2.0 * std::numbers::pi / options.sectors;
    for (int i = 0; i < options.rings; ++i) {
      const double down = (i + 0.5) / options.rings;
      // Rings are turned against each other, so that no edge falls between all sectors at once.
      for (int j = 0; j < options.sectors; ++j) {
        const double around = (j + static_cast<double>(i) / options.rings) * step;
        const double across = std::sqrt(1.0 - down * down);
        directions_.emplace_back(across * std::cos(around), across * std::sin(around), -down);
      }
    }
    sr_ = 2.0 * std::numbers::pi / static_cast<double>(directions_.size());
  }

  // Transmitted irradiance. turn: 0 .. 1, of a sector.
  double at(const Eigen::Vector3d& x, const Eigen::Vector3d& normal, double turn_rad) const {
    const double height_mm = std::max(least_height_mm_, x.z() - z_mm_);
    const double c = std::cos(turn_rad);
    const double s = std::sin(turn_rad);
    double sum = 0.0;
    for (const Eigen::Vector3d& d : directions_) {
      const Eigen::Vector3d w(c * d.x() - s * d.y(), s * d.x() + c * d.y(), d.z());
      const double cosine = transmitted_(normal.dot(w));
      if (!(cosine > 0.0)) continue;
      Eigen::Vector3d on_plane = x + height_mm / -w.z() * w;
      on_plane.z() = z_mm_;
      const double e = irradiance_(on_plane);
      if (!(e > 0.0) || (!scene_.convex() && scene_.occluded(x, normal, on_plane))) continue;
      sum += cosine * e;
    }
    return sum * sr_ / std::numbers::pi;
  }

 private:
  const RayScene& scene_;
  double z_mm_;
  double least_height_mm_;
  const OnPlane& irradiance_;
  const TransmittedCosine& transmitted_;
  std::vector<Eigen::Vector3d> directions_;  // below the horizon, equal solid angles
  double sr_;
};

}  // namespace

std::vector<double> irradiance_from_plane(const std::vector<SurfacePoint>& points,
                                          const RayScene& scene, double z_mm,
                                          double least_height_mm, double eta_int_over_ext,
                                          const OnPlane& irradiance,
                                          const PlaneIrradianceOptions& options) {
  const TransmittedCosine transmitted(eta_int_over_ext);
  const PlaneView view(scene, z_mm, least_height_mm, irradiance, transmitted, options);
  std::vector<double> e(points.size());
  tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t i) {
    // Turned by multiples of the golden angle.
    constexpr double kGolden_rad = 2.399963229728653;
    e[i] = view.at(points[i].at_mm, points[i].normal, kGolden_rad * static_cast<double>(i));
  });
  return e;
}

IncidentLight light_from_plane(const PatchMesh& patches, const RayScene& scene, double z_mm,
                               double eta_int_over_ext, const OnPlane& irradiance,
                               const PlaneIrradianceOptions& options) {
  const double touching_mm = DiffusePlane::touching_mm(scene.size_mm());
  std::vector<SurfacePoint> corners;                 // of the patches of one facet each
  std::map<std::pair<int, int>, std::size_t> known;  // by facet and vertex
  std::vector<std::pair<int, std::array<std::size_t, 3>>> lit;
  for (int k = 0; k < patches.size(); ++k) {
    const Eigen::Vector3d& normal = patches.normal(k);
    const bool touches = normal.z() < -1.0 + 1e-9 && patches.center_mm(k).z() - z_mm < touching_mm;
    if (touches || normal.z() > 1.0 - 1e-9) continue;
    std::array<std::size_t, 3> at{};
    for (std::size_t i = 0; i < 3; ++i) {
      const int vertex = patches.vertex_idx(k)[i];
      const auto [it, is_new] = known.try_emplace({patches.facet_idx(k), vertex}, corners.size());
      if (is_new) {
        corners.push_back({patches.vertices_mm()[static_cast<std::size_t>(vertex)], normal});
      }
      at[i] = it->second;
    }
    lit.emplace_back(k, at);
  }
  const std::vector<double> e =
      irradiance_from_plane(corners, scene, z_mm, kLifted * patches.patch_size_mm(),
                            eta_int_over_ext, irradiance, options);
  std::vector<LitTriangleRgb> triangles;
  for (const auto& [patch, at] : lit) {
    LitTriangleRgb t{patches.corners_mm(patch), {}, patch};
    for (std::size_t i = 0; i < 3; ++i) t.irradiance[i].setConstant(e[at[i]]);
    triangles.push_back(t);
  }
  return channel_light(triangles, 0, patches.size());
}

}  // namespace scattermeter
