// Where camera, lights, objects and marks of a rig stand, for pictures of it.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "apps/rig/rig.h"
#include "core/mesh/triangle_mesh.h"
#include "core/scene/object_scene.h"
#include "core/scene/observed_shot.h"

namespace scattermeter::apps {

// World frame, mm.
struct RigPlaces {
  struct Camera {
    std::string name;  // "camera", or the shot's file where each shot has a pose of its own
    Eigen::Vector3d center_mm;
    // Unit directions of the rays through the frame's corners: upper left, upper right, lower
    // right, lower left.
    std::array<Eigen::Vector3d, 4> corners;
    Eigen::Vector3d center_std_mm;
  };
  struct Led {
    std::string name;
    Eigen::Vector3d position_mm;
    Eigen::Vector3d axis;        // unit
    double position_std_mm = 0;  // of the least certain coordinate
  };
  struct Body {
    std::string name;
    TriangleMesh mesh;
  };
  std::vector<Camera> cameras;
  std::vector<Led> leds;     // lights of another kind have no place
  std::vector<Body> bodies;  // those that shots show
  std::vector<Eigen::Vector3d> marks;
  // board_corners()
  std::optional<std::array<Eigen::Vector3d, 4>> board;
  std::optional<double> plane_z_mm;  // of the plane below the objects
};

// Outer corners of a board: lower left, lower right, upper right, upper left of the print.
std::array<Eigen::Vector3d, 4> board_corners(const calib::CharucoBoard& board);

// The poses are those of the shots. Corners without a ray (a lens's model ends there) point where
// the lens without distortion would see them.
RigPlaces rig_places(const Rig& rig, const ObjectScenes& objects,
                     const std::vector<ObservedShot>& shots);

}  // namespace scattermeter::apps
