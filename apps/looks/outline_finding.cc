#include "apps/looks/outline_finding.h"

#include <cmath>
#include <cstddef>

#include <fmt/core.h>

namespace scattermeter::apps {
namespace {

using calib::OutlineCause;

std::string advice_for(const calib::OutlineExplanation& e, const std::string& object) {
  switch (e.cause) {
    case OutlineCause::kMeshScale:
      return advice_on_scale(object);
    case OutlineCause::kCamera:
      return "take the pose points again, or all shots";
    case OutlineCause::kShotMoved:
      return "take this shot again, or, if the piece was moved between its shots, have it found in "
             "each of them (objects.NAME.pose: {from: silhouette, per_shot: true})";
    default:
      return fmt::format(
          "put the object back or place the mesh of objects.{} where it stands; if the camera was "
          "moved, take the pose points again; another piece needs its own mesh",
          object);
  }
}

std::string class_of(OutlineCause cause) {
  switch (cause) {
    case OutlineCause::kNone:
      return "none";
    case OutlineCause::kMeshDisplaced:
      return "mesh displaced";
    case OutlineCause::kMeshTurned:
      return "mesh turned";
    case OutlineCause::kMeshScale:
      return "mesh scaled";
    case OutlineCause::kMeshMisplaced:
      return "mesh displaced and turned";
    case OutlineCause::kCamera:
      return "camera moved";
    case OutlineCause::kShotMoved:
      return "shot moved";
  }
  return "";
}

// Share of the distance by which all objects are nearer than the pose puts them, if the camera
// moved along its line of sight; 0 if it did not.
double nearer(const calib::OutlineExplanation& camera, double distance_mm) {
  constexpr double kAlong = 0.9;
  const Eigen::Vector3d moved_mm = camera.value.segment<3>(3);
  const bool is_along = std::abs(moved_mm.z()) > kAlong * moved_mm.norm();
  return is_along ? -moved_mm.z() / distance_mm : 0.0;
}

}  // namespace

std::string advice_on_scale(const std::string& object) {
  return fmt::format("measure the object and scale the mesh of objects.{}", object);
}

double board_distance_mm(const calib::PoseSource& source, const PoseResult& pose) {
  if (!source.charuco && source.board_shot.empty()) return 0.0;
  return pose.camera_from_world.translation_mm.norm();
}

std::string or_of_another_board(double nearer) {
  constexpr double kVisible = 0.005;
  if (!(std::abs(nearer) > kVisible)) return "";
  return fmt::format(
      ", or the squares of the board are {:.1f} % {} than stated (measure the print)",
      100.0 * std::abs(nearer), nearer > 0.0 ? "smaller" : "larger");
}

Finding outline_finding(const calib::OutlineDiagnosis& diagnosis, const std::string& object,
                        double distance_mm) {
  const calib::OutlineExplanation& best = diagnosis.explanations.at(1);
  Finding finding;
  finding.cause = class_of(best.cause);
  finding.text = best.text;
  for (std::size_t k = 2; k < diagnosis.explanations.size() && k <= diagnosis.likely; ++k) {
    finding.text += (k == 2 ? " (cannot be told from: " : ", ") + diagnosis.explanations[k].text;
    if (k + 1 == diagnosis.explanations.size() || k == diagnosis.likely) finding.text += ")";
  }
  if (best.cause == OutlineCause::kCamera && distance_mm > 0.0) {
    finding.text += or_of_another_board(nearer(best, distance_mm));
  }
  finding.advice = advice_for(best, object);
  return finding;
}

}  // namespace scattermeter::apps
