#include "apps/looks/scaled_piece.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "apps/looks/closer_look.h"
#include "apps/looks/outline_finding.h"
#include "core/base/chi_square.h"
#include "core/camera/pose_shift.h"

namespace scattermeter::apps {
namespace {

constexpr double kVisibleGrowth = 0.35;  // cells

PoseResult loosened(const PoseResult& pose, const ObjectScene& object, double place_std_mm) {
  Eigen::Matrix<double, 6, 1> std;
  std.head<3>().setConstant(place_std_mm);
  std.tail<3>().setConstant(place_std_mm / object.size_mm());
  const Eigen::Matrix<double, 6, 6> by_place =
      pose_shift_by_place(pose.camera_from_world, object.box.center_mm()) * std.asDiagonal();
  PoseResult out = pose;
  out.covariance += by_place * by_place.transpose();
  return out;
}

const calib::EdgeExplanation* by_scale(const calib::EdgeDiagnosis& diagnosis) {
  for (const calib::EdgeExplanation& e : diagnosis.explanations) {
    if (e.cause == calib::EdgeCause::kMeshScale) return &e;
  }
  return nullptr;
}

}  // namespace

SizeLook size_look(double growth_px, double cell_px, const Rig& rig, const ObjectScene& object,
                   const PoseResult& pose) {
  const CameraIntrinsics& lens = rig.scene.camera.intrinsics;
  return {growth_px, cell_px, edge_cut_px(lens, object, pose),
          object.size_mm() * px_per_mm(lens, object, pose)};
}

double size_left_open(const SizeLook& seen) {
  if (seen.growth_px > -kVisibleGrowth * seen.cell_px || seen.edge_cut_px <= 0.0) return 0.0;
  return 0.5 * -seen.growth_px / (0.5 * seen.size_px);
}

std::string size_note(const std::string& piece, const SizeLook& seen) {
  return fmt::format(
      "outline of {} lies {:.1f} px inside that of its mesh: its edges are cut back, or it is "
      "smaller, so its size counts as known to {:.2g} %",
      piece, -seen.growth_px, 100.0 * size_left_open(seen));
}

bool seems_scaled(const SizeLook& seen) {
  constexpr double kFarCut = 2.5;  // deviations
  const double least_px = kVisibleGrowth * seen.cell_px;
  return seen.growth_px > least_px || seen.growth_px < -least_px - kFarCut * seen.edge_cut_px;
}

std::optional<Finding> scaled_piece(const Rig& rig, const ObjectScenes& objects,
                                    const SceneObject& piece, double place_std_mm,
                                    const PoseResult& pose, const capture::FrameSource& frames,
                                    const std::vector<std::size_t>& shots) {
  constexpr std::size_t kShots = 2;
  constexpr double kChance = 1e-4;
  const auto last = static_cast<std::ptrdiff_t>(std::min(kShots, shots.size()));
  const calib::SilhouetteCheck check =
      careful_search(rig, objects, loosened(pose, objects.at(piece.name), place_std_mm), frames,
                     {shots.begin(), shots.begin() + last}, rig.pose.edge_std_px);
  if (check.shots.empty() || check.shots_found < check.shots.size()) return std::nullopt;
  const calib::EdgeExplanation* scaled = by_scale(check.diagnosis);
  if (scaled == nullptr) return std::nullopt;
  const double gain = check.diagnosis.explanations.at(0).chi2 - scaled->chi2;
  if (chi_square_tail(std::max(0.0, gain), 1) >= kChance) return std::nullopt;
  const bool is_larger = scaled->value > 0.0;
  return Finding{"mesh scaled",
                 fmt::format("mesh of {} scaled: the object is {:.2f} ± {:.2f} % {}", piece.name,
                             100.0 * std::abs(scaled->value), std::max(0.01, 100.0 * scaled->std),
                             is_larger ? "larger than its mesh"
                                       : "smaller than its mesh, or its edges are cut back"),
                 advice_on_scale(piece.name), shots};
}

}  // namespace scattermeter::apps
