// Rows whose light depends on whether a face is met from inside beyond the angle of total
// reflection.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/estimation/channel_rows.h"
#include "core/estimation/material_channel.h"
#include "core/mesh/ray_scene.h"
#include "core/scene/scene.h"

namespace scattermeter {

struct UncertainIndex {
  double eta_int_over_ext, std;
};

// The ray that is refracted into an object at a point of its surface meets another face, whose
// reflectance R (Fresnel) depends on the index: how far R, within two standard deviations of the
// index, departs from the straight line that light paths have for it (kEtaStep), times the share of
// the light that gets there unscattered. Near the angle of total reflection, R falls from 1 to a
// half within 0.01 of the index. normal: outwards; to: unit, from the point outwards. 0 where `to`
// is behind the surface.
double bend_of_inner_reflection(const RayScene& object, const Eigen::Vector3d& point_mm,
                                const Eigen::Vector3d& normal, const Eigen::Vector3d& to,
                                const UncertainIndex& index, double mean_free_path_mm);

// Numbers, among the used rows, of those of which more than a hundredth of the light is uncertain
// in this way, by the camera's ray or that of an LED of the shot. No column of nuisances
// can express that. On a pyramid of 0.6 per mm whose front is seen and lit at such an angle, an
// index off by 0.02 made the rows beside its base darker by 10 %.
std::vector<Eigen::Index> near_total_reflection(const Scene& scene, const MaterialChannel& channel,
                                                const ChannelRows& rows, double mean_free_path_mm);

}  // namespace scattermeter
