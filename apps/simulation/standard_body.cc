#include "apps/simulation/standard_body.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/diffusion/dipole_image.h"
#include "core/diffusion/distance_weights.h"
#include "core/diffusion/shade_map.h"
#include "core/material/dipole.h"
#include "core/mesh/bodies.h"
#include "core/view/camera_view.h"

namespace scattermeter::apps {
namespace {

constexpr int kFrame_px = 96;
constexpr double kPatch_mm = 1.0;     // four pixels; the field is quadratic on it
constexpr double kCamera_mm = 400.0;  // from the cube, so far that its edges look parallel
// Of the light, from the cube: its irradiance varies by 0.4 % over it.
constexpr double kLight_mm = 1e4;

CameraView standard_view() {
  CameraView view;
  CameraIntrinsics& k = view.intrinsics;
  k.width_px = k.height_px = kFrame_px;
  k.fx_px = k.fy_px = kFrame_px * kCamera_mm / (1.7 * kStandardCube_mm);
  k.cx_px = k.cy_px = 0.5 * (kFrame_px - 1);
  const Eigen::Vector3d center_mm(0, 0, 0.5 * kStandardCube_mm);
  const Eigen::Vector3d toward = Eigen::Vector3d(0.7, -1.0, 0.8).normalized();
  view.camera_from_world =
      look_at(center_mm + kCamera_mm * toward, center_mm, Eigen::Vector3d::UnitZ());
  return view;
}

// Its irradiance at the cube is pi W/mm^2, so that a white matt surface has unit radiance.
Led standard_light() {
  const Eigen::Vector3d toward = Eigen::Vector3d(-0.3, -0.6, 0.7).normalized();
  Led led;
  led.position_mm = kLight_mm * toward;
  led.axis = -toward;
  led.exponent = 0.0;
  return led;
}
constexpr double kIntensity_W_per_sr = kLight_mm * kLight_mm * std::numbers::pi;

// R on the knots: three columns for each material.
Eigen::MatrixXd reflectances(const std::vector<std::array<Medium, 3>>& materials,
                             const DistanceKnots& knots) {
  Eigen::MatrixXd r(knots.size(), 3 * static_cast<Eigen::Index>(materials.size()));
  Eigen::Index column = 0;
  for (const std::array<Medium, 3>& media : materials) {
    for (const Medium& medium : media) {
      const Dipole dipole(medium);
      for (int i = 0; i < knots.size(); ++i) {
        r(i, column) = dipole.reflectance_per_mm2(knots.knots_mm()[static_cast<std::size_t>(i)]);
      }
      ++column;
    }
  }
  return r;
}

StandardBody shaded(const ShadeMap& pixels, const SurfaceField& field) {
  StandardBody body;
  ColourRadiance& out = body.picture;
  out = {pixels.x0(), pixels.y0(), pixels.width(), pixels.height(), {}};
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      for (int c = 0; c < 3; ++c) {
        out.rgb.push_back(static_cast<float>(pixels.radiance(x, y, field, c)));
      }
    }
  }
  return body;
}

}  // namespace

Eigen::Array3d StandardBody::at(StandardPlace place) const {
  const double half_mm = 0.5 * kStandardCube_mm;
  const Eigen::Vector3d place_mm =
      place == StandardPlace::kLit ? Eigen::Vector3d(0, 0, kStandardCube_mm)
                                   : Eigen::Vector3d(half_mm, kBehindEdge_mm - half_mm, half_mm);
  const CameraView view = standard_view();
  const Eigen::Vector2d px = project(view.intrinsics, view.camera_from_world, {place_mm}).front();
  const long x = std::lround(px.x()) - picture.x0;
  const long y = std::lround(px.y()) - picture.y0;
  const auto i = 3U * static_cast<std::size_t>(y * picture.width + x);
  return Eigen::Map<const Eigen::Array3f>(&picture.rgb.at(i)).cast<double>();
}

std::vector<StandardBody> standard_bodies(const std::vector<std::array<Medium, 3>>& materials) {
  if (materials.empty()) return {};
  const double eta = materials.front().front().eta_int_over_ext;
  const RayScene scene(cube_mesh());
  const PatchMesh patches(scene.mesh(), kPatch_mm);
  const ShadeMap pixels(rays_around(standard_view(), scene.mesh(), 2), scene, patches, eta);
  const std::vector<bool> needed = pixels.needed_patches(patches.size());
  const SurfaceField unlit(patches, needed);
  std::vector<ExitSite> sites;
  for (const Eigen::Vector3d& node_mm : unlit.nodes_mm()) sites.push_back(exit_point(node_mm));

  double finest_mm = 0.1 * kStandardCube_mm;
  for (const std::array<Medium, 3>& media : materials) {
    for (const Medium& m : media) finest_mm = std::min(finest_mm, 0.5 / m.sigma_t_prime_per_mm());
  }
  const DistanceKnots knots(finest_mm, 1.001 * bounds(scene.mesh()).size_mm().norm());
  PairSumOptions options;
  options.floor_mm = 0.25 * finest_mm;
  const SourceCloud sources(illuminate(patches, scene, standard_light(), eta),
                            bounds(scene.mesh()).center_mm());
  const Eigen::MatrixXd l = kIntensity_W_per_sr * smooth_images(sites, sources, knots, options,
                                                                reflectances(materials, knots));
  std::vector<StandardBody> out;
  for (Eigen::Index m = 0; m < static_cast<Eigen::Index>(materials.size()); ++m) {
    std::vector<Eigen::Array3d> values;
    for (Eigen::Index i = 0; i < l.rows(); ++i) {
      values.emplace_back(l.row(i).segment<3>(3 * m).transpose());
    }
    SurfaceField field = unlit;
    field.add(values);
    out.push_back(shaded(pixels, field));
  }
  return out;
}

}  // namespace scattermeter::apps
