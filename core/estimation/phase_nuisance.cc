#include "core/estimation/phase_nuisance.h"

#include <string>

#include "core/light/led.h"
#include "core/material/phase_effect.h"

namespace scattermeter {
namespace {

// Unit vectors from a point to `to`: the part along a surface.
Eigen::Vector3d along_surface(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                              const Eigen::Vector3d& normal) {
  const Eigen::Vector3d unit = (to - from).normalized();
  return unit - unit.dot(normal) * normal;
}

}  // namespace

void PhaseNuisance::set_rows(const ChannelRows& rows) {
  std::vector<double> turn;
  for_used_rows(rows, [&](std::size_t s, std::size_t j) {
    const ObservedShot& shot = *channel_.shots[s];
    const SeenObject& seen = *shot.seen;
    const Eigen::Vector3d& at_mm = seen.sites[j].center_mm;
    const Eigen::Vector3d& normal = seen.patches->normal(seen.map.patch_of_row[j]);
    const Eigen::Vector3d to_camera = along_surface(at_mm, seen.camera_center_mm, normal);
    double sum = 0.0, turned = 0.0;
    for (const std::string& name : shot.stated->lights) {
      const SceneLight& light = scene_.light(name);
      if (light.led() == nullptr) continue;
      const Led& led = light.led()->led;
      const double irradiance =
          light->power()[static_cast<Eigen::Index>(channel_.channel)] *
          led.transmitted_irradiance_per_mm2(at_mm, normal, channel_.eta_int_over_ext);
      sum += irradiance;
      turned -= irradiance * along_surface(at_mm, led.position_mm, normal).dot(to_camera);
    }
    turn.push_back(sum > 0.0 ? turned / sum : 0.0);
  });
  turn_ = Eigen::Map<const Eigen::VectorXd>(turn.data(), static_cast<Eigen::Index>(turn.size()));
}

Eigen::VectorXd PhaseNuisance::change(const WeightMatrix& weights,
                                      const ScatteringPoint& at) const {
  // Of light at an angle on a body with edges, over that at right angles on a half-space.
  constexpr double kOnBodies = 1.4;
  const Medium medium{at.sigma_s_per_mm, at.sigma_a_per_mm, channel_.eta_int_over_ext};
  Eigen::MatrixXd kernels(knots_.size(), 2);
  for (Eigen::Index i = 0; i < kernels.rows(); ++i) {
    const double d_mm = knots_.knots_mm()[static_cast<std::size_t>(i)];
    kernels(i, 0) = kOnBodies * phase_effect_per_mm2(medium, d_mm, knots_.resolution_mm());
    kernels(i, 1) = phase_turn(medium.eta_int_over_ext) *
                    near_entry_per_mm2(medium, d_mm, knots_.resolution_mm());
  }
  const Eigen::MatrixXd images = at.scale * (weights * kernels);
  return images.col(0) + turn_.cwiseProduct(images.col(1));
}

}  // namespace scattermeter
