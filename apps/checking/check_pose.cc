#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "apps/checking/check.h"
#include "calib/pose/shot_pose.h"

namespace scattermeter::apps {
namespace {

void add_residuals(const PoseResult& pose, const std::string& name, std::size_t shot_idx,
                   std::vector<CheckDetail>& residuals, std::vector<CheckDetail>& outliers) {
  const double n = static_cast<double>(pose.inlier.size());
  const auto out = static_cast<double>(std::count(pose.inlier.begin(), pose.inlier.end(), false));
  CheckDetail rms;
  rms.where = fmt::format("{}, {} points", name, pose.inlier.size());
  rms.value = pose.rms_px;
  rms.shot_idx = shot_idx;
  residuals.push_back(rms);
  CheckDetail share = rms;
  share.value = 100.0 * out / n;
  outliers.push_back(share);
}

}  // namespace

std::vector<CheckItem> check_pose(const CheckedRig& checked) {
  std::vector<CheckDetail> residuals, outliers;
  double worst_px = 0.0;
  if (checked.shared_pose) {
    add_residuals(*checked.shared_pose, "pose.points", CheckDetail::npos, residuals, outliers);
    worst_px = checked.shared_pose->worst_px;
  } else {
    for (std::size_t i = 0; i < checked.shots.size(); ++i) {
      add_residuals(checked.shots[i].pose, checked.shots[i].stated->file, i, residuals, outliers);
      worst_px = std::max(worst_px, checked.shots[i].pose.worst_px);
    }
  }
  CheckItem pose = judged("pose", "px", {checked.options.max_pose_rms_px},
                          "measure the points again, or calibrate the camera", residuals);
  pose.where += fmt::format("; worst point {:.3g} px", worst_px);
  std::vector<CheckItem> out = {pose};
  if (checked.lens && !checked.lens->residuals.empty()) {
    CheckDetail d;
    d.where = checked.rig.intrinsics_path;
    d.value = checked.lens->rms_px;
    CheckItem lens = judged("lens", "px (limit of rms)", {checked.options.max_lens_rms_px},
                            "calibrate the camera again: its views do not agree", {d});
    lens.worst = checked.lens->worst_px;
    out.push_back(lens);
  }
  CheckItem& left_out = out.emplace_back(judged("pose outliers", "% of points",
                                                {checked.options.max_pose_outlier_percent},
                                                "look for exchanged or mistyped points", outliers));
  if (checked.shared_pose && checked.rig.pose.board_shot.empty()) {
    const std::string points = calib::left_out_points(*checked.shared_pose);
    if (!points.empty()) left_out.where += "; left out: " + points;
  }
  return out;
}

}  // namespace scattermeter::apps
