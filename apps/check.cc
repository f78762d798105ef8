#include "apps/check.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/core.h>

#include "apps/shot_folder.h"
#include "apps/shot_pose.h"
#include "apps/shot_system.h"
#include "apps/text_table.h"

namespace scattermeter::apps {
namespace {

void add_at_most(CheckReport& report, const std::string& what, double value, double limit,
                 const std::string& unit, const std::string& advice) {
  report.items.push_back({what, value, limit, unit, value <= limit, advice});
}

void check_pose(const calib::PoseResult& pose, const std::string& name, const CheckOptions& options,
                CheckReport& report) {
  add_at_most(report, name + " rms", pose.rms_px, options.max_pose_rms_px, "px",
              "measure the points again, or calibrate the camera");
  const double outliers =
      static_cast<double>(std::count(pose.inlier.begin(), pose.inlier.end(), false));
  add_at_most(report, name + " outliers",
              100.0 * outliers / static_cast<double>(pose.inlier.size()),
              100.0 * options.max_pose_outlier_share, "% of points",
              "look for exchanged or mistyped points");
}

void check_shot(const OpenedShot& shot, const CheckOptions& options, CheckReport& report) {
  for (std::size_t c = 0; c < kRgb; ++c) {
    const ChannelObservation& o = shot.observation.channel[c];
    const std::string name = fmt::format("{} {}", shot.rig->file, kRgbName[c]);
    const double samples = std::max<double>(1.0, static_cast<double>(o.samples));
    add_at_most(report, name + " clipped", 100.0 * static_cast<double>(o.samples_clipped) / samples,
                options.max_clipped_percent, "% of samples", "expose shorter");
    CheckItem bright{name + " brightest patch",
                     o.brightest_snr,
                     options.min_brightest_snr,
                     "x its noise (at least)",
                     o.brightest_snr >= options.min_brightest_snr,
                     "expose longer, or look whether the LED was on"};
    // Nothing can be said of the brightness where all is clipped.
    if (o.rows_clipped == o.l.size() && !o.l.empty()) bright.passed = false;
    report.items.push_back(bright);
    add_at_most(report, name + " noise", o.noise_ratio, options.max_noise_ratio,
                "x the model's variance", "set camera.sensor gain and read noise for this ISO");
  }
}

// Aperture and ISO change the responsivity: they must be the same in all shots.
void check_settings(const std::vector<OpenedShot>& shots, CheckReport& report) {
  std::set<double> apertures, isos;
  for (const OpenedShot& shot : shots) {
    apertures.insert(shot.f_number);
    isos.insert(shot.iso);
  }
  add_at_most(report, "apertures in use", static_cast<double>(apertures.size()), 1.0, "",
              "shoot all with one aperture: the responsivity depends on it");
  add_at_most(report, "ISO settings in use", static_cast<double>(isos.size()), 1.0, "",
              "shoot all with one ISO setting: responsivity and noise depend on it");
}

}  // namespace

bool CheckReport::passed() const {
  return std::all_of(items.begin(), items.end(), [](const CheckItem& i) { return i.passed; });
}

CheckReport check_rig(const Rig& rig, const std::string& shots_folder,
                      const CheckOptions& options) {
  CheckReport report;
  const ShotFolder folder = match_shots(rig, shots_folder);
  for (const std::string& name : folder.unlisted) {
    report.notes.push_back(name + ": not in the rig's list of shots, skipped");
  }
  const ObjectScenes scenes = open_objects(rig);
  std::optional<calib::PoseResult> shared_pose;
  if (!rig.pose.charuco) {
    shared_pose = pose_from_points(rig);
    check_pose(*shared_pose, "pose", options, report);
    const Eigen::Vector3d& s = shared_pose->center_std_mm;
    report.notes.push_back(fmt::format(
        "camera centre known to {:.3f}, {:.3f}, {:.3f} mm (std in x, y, z)", s.x(), s.y(), s.z()));
  }
  const ObjectLibrary library(rig, scenes, std::nullopt, 0.0);
  std::optional<SharedView> view;
  if (shared_pose) view = see_all(rig, scenes, library, *shared_pose);
  // The pose as the rig states it: refined silhouettes would hide what a check looks for.
  Rig stated = rig;
  stated.pose.refine_by_silhouette = false;
  const std::vector<OpenedShot> shots =
      open_shots(stated, shots_in_files(rig, folder.paths), scenes, library, view, options.quiet);
  for (const OpenedShot& shot : shots) {
    if (!shared_pose) check_pose(shot.pose, "pose in " + shot.rig->file, options, report);
    check_shot(shot, options, report);
  }
  check_settings(shots, report);
  if (!rig.camera.responsivity) {
    report.notes.emplace_back(
        "no responsivity in the rig: the scale is free, sigma_a will be uncertain");
  }
  return report;
}

std::string check_table(const CheckReport& report) {
  using Align = TextTable::Align;
  TextTable table({{"check", Align::kLeft},
                   {"value"},
                   {"limit"},
                   {"unit", Align::kLeft},
                   {"verdict", Align::kLeft}});
  for (const CheckItem& item : report.items) {
    table.add_row({item.what, fmt::format("{:.4g}", item.value), fmt::format("{:.4g}", item.limit),
                   item.unit, item.passed ? "pass" : "FAIL: " + item.advice});
  }
  std::string out = table.text();
  for (const std::string& note : report.notes) out += "note: " + note + "\n";
  const auto failed = std::count_if(report.items.begin(), report.items.end(),
                                    [](const CheckItem& i) { return !i.passed; });
  out += failed == 0 ? fmt::format("all {} checks passed\n", report.items.size())
                     : fmt::format("{} of {} checks FAILED\n", failed, report.items.size());
  return out;
}

}  // namespace scattermeter::apps
