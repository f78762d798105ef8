#include "apps/looks/moved_piece.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/core.h>

#include "apps/rig/open_objects.h"
#include "calib/pose/piece_pose.h"
#include "core/base/symmetric_eigen.h"

namespace scattermeter::apps {
namespace {

double lowest_mm(const TriangleMesh& mesh, const Rigid3d& by) {
  double out = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& v : mesh.vertices_mm) out = std::min(out, (by * v).z());
  return out;
}

}  // namespace

MovedPiece moved_piece(const Scene& scene, const ObjectScene& object, const PiecePlace& place) {
  MovedPiece out;
  out.by = calib::followed_by({}, place.off, object.box.center_mm());
  if (const auto& plane = scene.surroundings.plane) {
    out.by.translation_mm.z() += std::max(0.0, plane->z_mm - lowest_mm(object.mesh(), out.by));
  }
  const auto largest = [&](Eigen::Index first) {
    return std::sqrt(symmetric_eigen(place.covariance.block<3, 3>(first, first)).values[2]);
  };
  out.position_std_mm = std::max(largest(0), object.size_mm() * largest(3));
  out.note = fmt::format(
      "{} was found by its outline [{:.2f}, {:.2f}, {:.2f}] mm from where the rig states it, "
      "turned by {:.2f} degrees; its position is known to {:.2g} mm",
      object.stated->name, place.off[0], place.off[1], place.off[2],
      180.0 / std::numbers::pi * place.off.tail<3>().norm(), out.position_std_mm);
  return out;
}

bool may_move(const Scene& scene, const SceneObject& piece) {
  const auto& plane = scene.surroundings.plane;
  return !piece.to_be_found && (!plane || plane->contact == PlaneContact::kAir);
}

void move_pieces(const MovedPieces& pieces, Scene& scene) {
  for (SceneObject& object : scene.objects) {
    const auto at = pieces.find(object.name);
    if (at == pieces.end()) continue;
    object.world_from_mesh = at->second.by * object.world_from_mesh;
    object.position_std_mm = at->second.position_std_mm;
  }
}

std::unique_ptr<const MovedRig> moved_rig(const Rig& rig, const ObjectScenes& objects,
                                          const MovedPieces& pieces) {
  auto out = std::make_unique<MovedRig>();
  out->rig = rig;
  move_pieces(pieces, out->rig.scene);
  out->objects = open_objects(out->rig, [&](const SceneObject& object) {
    TriangleMesh mesh = objects.at(object.name).mesh();
    const Rigid3d mesh_from_world = inverse(rig.scene.object(object.name).world_from_mesh);
    for (Eigen::Vector3d& v : mesh.vertices_mm) v = mesh_from_world * v;
    return mesh;
  });
  return out;
}

}  // namespace scattermeter::apps
