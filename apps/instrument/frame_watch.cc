#include "apps/instrument/frame_watch.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/core.h>

#include "calib/pose/edge_points.h"
#include "calib/pose/silhouette_check.h"
#include "core/mesh/creases.h"

namespace scattermeter::apps {
namespace {

constexpr double kGreensDiffer = 0.05;
// Of (blur / mean free path)^2, the relative error of sigma_s' by blur: 0.2 to 1.7 for cube and
// pyramid, faint to dense (`bench deviations`, "out of focus"). That of sigma_a, which is too large
// where sigma_s' is too small, is as many deviations.
constexpr double kErrorByBlur = 2.0;
constexpr double kMostError = 0.03;

// Light of the green sites in even rows over that in odd rows, where neither is dark or clipped; 1
// without any.
double green_ratio(const capture::RawFrame& frame) {
  constexpr double kDark = 0.05, kBright = 0.95;
  std::array<std::size_t, 2> green{};
  for (std::size_t row = 0; row < 2; ++row) {
    green[row] = 2 * row + (frame.cfa.phase[2 * row] == Channel::kGreen ? 0 : 1);
    if (frame.cfa.phase[green[row]] != Channel::kGreen) return 1.0;
  }
  std::array<double, 2> sum{};
  for (int y = 0; y + 1 < frame.height_px; y += 2) {
    for (int x = 0; x + 1 < frame.width_px; x += 2) {
      std::array<double, 2> light{};
      bool is_used = true;
      for (std::size_t row = 0; row < 2; ++row) {
        const double black = frame.black_counts[green[row]];
        const double range = frame.white_counts - black;
        light[row] =
            frame.at(x + static_cast<int>(green[row] % 2), y + static_cast<int>(row)) - black;
        is_used = is_used && light[row] < kBright * range;
      }
      const double range = frame.white_counts - frame.black_counts[green[0]];
      if (!is_used || !(light[0] + light[1] > 2.0 * kDark * range)) continue;
      sum[0] += light[0];
      sum[1] += light[1];
    }
  }
  return sum[1] > 0.0 ? sum[0] / sum[1] : 1.0;
}

}  // namespace

FrameWatch::FrameWatch(const Rig& rig, const ObjectScenes& objects, const PoseResult& pose)
    : rig_(rig), objects_(objects), pose_(pose) {
  for (std::size_t i = 0; i < rig.scene.shots.size(); ++i) {
    const std::string& name = rig.scene.shots[i].object;
    const auto scene = objects.find(name);
    if (scene == objects.end() || is_round(scene->second.mesh())) continue;
    judged_.try_emplace(name, i);
  }
}

void FrameWatch::look(std::size_t shot_idx, const capture::RawFrame& frame) {
  const SceneShot& shot = rig_.scene.shots.at(shot_idx);
  const double ratio = green_ratio(frame);
  double blur = 0.0;
  const auto judged = judged_.find(shot.object);
  if (judged != judged_.end() && judged->second == shot_idx) {
    const CameraIntrinsics& lens = rig_.scene.camera.intrinsics;
    const calib::EdgeShot edges =
        calib::edge_shot(rig_.scene, rig_.pose, objects_, shot, frame, pose_.camera_from_world, {});
    const Eigen::Vector3d center_mm =
        pose_.camera_from_world * objects_.at(shot.object).box.center_mm();
    blur = calib::edge_blur(edges, lens, pose_.camera_from_world).px * center_mm.z() / lens.fx_px;
  }
  const std::lock_guard lock(mutex_);
  green_ratio_[shot_idx] = ratio;
  if (blur > 0.0) blur_mm_[shot.object] = blur;
}

std::vector<Finding> FrameWatch::findings() const {
  Finding finding;
  double worst = 0.0;
  for (const auto& [shot_idx, ratio] : green_ratio_) {
    const double off = std::abs(ratio - 1.0);
    if (!(off > kGreensDiffer)) continue;
    worst = std::max(worst, off);
    finding.shots.push_back(shot_idx);
  }
  if (finding.shots.empty()) return {};
  finding.cause = "colour filters";
  finding.text =
      fmt::format("colour filters exchanged: the two green sites of {} differ by {:.0f} %",
                  rig_.scene.shots[finding.shots.front()].file, 100.0 * worst);
  finding.advice =
      "the pattern that the file states is not that of the sensor; use raw files as "
      "the camera wrote them";
  return {finding};
}

std::map<std::string, double> FrameWatch::blur_mm() const { return blur_mm_; }

bool widen_by_blur(const Scene& scene, const std::map<std::string, double>& blur_mm,
                   std::vector<ChannelResult>& results) {
  bool any = false;
  for (ChannelResult& r : results) {
    if (r.refused()) continue;
    double blur = 0.0;
    for (const SceneShot& shot : scene.shots) {
      const auto of = blur_mm.find(shot.object);
      if (shot.material == r.material && of != blur_mm.end()) blur = std::max(blur, of->second);
    }
    Quantity& s = r.estimate.sigma_s_prime_per_mm;
    const double mfp_mm = 1.0 / (s.value + r.estimate.sigma_a_per_mm.value);
    const double relative = kErrorByBlur * blur * blur / (mfp_mm * mfp_mm);
    if (!(relative > 0.0) || !(s.std > 0.0)) continue;
    const double by_s = relative * s.value;
    const double by_a = by_s / s.std * r.estimate.sigma_a_per_mm.std;
    widen({"focus", by_s, by_a}, -by_s * by_a, r.estimate);
    if (!(relative > kMostError)) continue;
    r.estimate.reasons.push_back(fmt::format(
        "out of focus, or moved during the exposure: edges are blurred by {:.2g} mm (standard "
        "deviation), not small against the mean free path, {:.2g} mm; focus on the object, or move "
        "the camera closer",
        blur, mfp_mm));
    any = true;
  }
  return any;
}

}  // namespace scattermeter::apps
