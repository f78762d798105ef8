// Pieces that are moved to where their outlines show them.
#pragma once

#include <map>
#include <memory>
#include <string>

#include <Eigen/Core>

#include "apps/rig/rig.h"
#include "core/camera/rigid3d.h"
#include "core/scene/object_scene.h"

namespace scattermeter::apps {

// (Displacement of a piece's centre, mm; turn about it, rad) from where the rig states it, in world
// axes, and the covariance of what remains of it.
struct PiecePlace {
  Eigen::Matrix<double, 6, 1> off = Eigen::Matrix<double, 6, 1>::Zero();
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
};

struct MovedPiece {
  Rigid3d by;                  // from the stated position to that found, both in the world
  double position_std_mm = 0;  // SceneObject::position_std_mm, there
  std::string note;            // for the user
};
using MovedPieces = std::map<std::string, MovedPiece>;  // by object

// The deviation is that along the least certain axis, or that of the turn at a distance of the
// piece's size if that is larger. It does not go below a plane that the rig states.
MovedPiece moved_piece(const Scene& scene, const ObjectScene& object, const PiecePlace& place);

// Not a piece in contact with a plane, nor one that was found by its outline already.
bool may_move(const Scene& scene, const SceneObject& piece);

void move_pieces(const MovedPieces& pieces, Scene& scene);

// A rig whose pieces are moved, with their geometry, which refers to it.
struct MovedRig {
  Rig rig;
  ObjectScenes objects;
};
// Throws InputError where an LED would be inside a piece.
std::unique_ptr<const MovedRig> moved_rig(const Rig& rig, const ObjectScenes& objects,
                                          const MovedPieces& pieces);

}  // namespace scattermeter::apps
