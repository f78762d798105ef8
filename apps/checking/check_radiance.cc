#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <string>

#include "apps/checking/check.h"
#include "calib/radiance/dark_fit.h"
#include "capture/files/file_kind.h"
#include "capture/sensor/radiance_calibration.h"
#include "capture/shots/raw_shot.h"

namespace scattermeter::apps {
namespace {

// ISO of the shots; 0: not in their files.
double usual_iso(const CheckedRig& checked) {
  if (checked.rig.decoding.radiance) return checked.rig.decoding.radiance->correction.iso;
  return checked.shots.empty() ? 0.0 : checked.shots.front().iso;
}

void add_darks(const CheckedRig& checked, std::vector<CheckItem>& out) {
  std::vector<CheckDetail> isos, levels, uneven;
  const double iso = usual_iso(checked);
  for (const calib::RadianceShot& shot : checked.rig.calibration.radiance->dark) {
    const std::filesystem::path path = std::filesystem::path(checked.folder) / shot.file;
    if (!capture::is_there(path)) continue;
    const capture::RawFrame frame =
        capture::open_shot(checked.rig.scene, checked.rig.decoding, path.string());
    const auto detail = [&](double value, double std, std::vector<CheckDetail>& list) {
      CheckDetail d;
      d.where = shot.file;
      d.value = value;
      d.std = std;
      list.push_back(d);
    };
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    detail(frame.iso > 0.0 && iso > 0.0 ? 100.0 * (frame.iso / iso - 1.0) : 0.0, unknown, isos);
    std::vector<std::uint8_t> marks(frame.samples.size(), 0);
    if (checked.rig.decoding.radiance) {
      for (const std::size_t i : checked.rig.decoding.radiance->correction.defect_pixels)
        marks[i] = 1;
    }
    const calib::DarkFrame dark =
        calib::dark_frame(frame.samples, marks, frame.width_px, frame.exposure_s);
    double excess = 0.0;
    for (std::size_t p = 0; p < 4; ++p) {
      const double off = dark.mean_counts[p] - frame.black_counts[p];
      if (std::abs(off) > std::abs(excess)) excess = off;
    }
    detail(excess, dark.std_of_mean[0], levels);
    const calib::Unevenness parts = calib::unevenness(frame.samples, marks, frame.width_px);
    detail(parts.counts, parts.std, uneven);
  }
  if (isos.empty()) return;
  const CheckOptions& o = checked.options;
  out.push_back(judged("ISO of dark frames", "% off the shots'", {0.5},
                       "take the dark frames again with the ISO setting of the shots", isos));
  out.push_back(judged("level of dark frames", "counts above black", {o.max_dark_counts},
                       "take them again in the dark, with the lens cap on", levels));
  CheckLimit even{0.5};
  even.least_stds = 6.0;
  out.push_back(judged("evenness of dark frames", "counts", even,
                       "light fell on part of the frame: take them again in the dark", uneven));
}

}  // namespace

std::vector<CheckItem> check_radiance(const CheckedRig& checked) {
  std::vector<CheckItem> out;
  if (checked.rig.calibration.radiance) add_darks(checked, out);
  if (!checked.rig.decoding.radiance) return out;
  // The residuals of the calibration itself.
  for (const capture::RadianceResidual& r : checked.rig.decoding.radiance->residuals) {
    CheckDetail d;
    d.where = "camera.radiance";
    d.value = r.rms;
    CheckItem item = judged("calibration: " + r.what, r.unit + " (limit of rms)", {r.limit},
                            "calibrate the radiance again", {d});
    item.worst = r.worst;
    out.push_back(item);
  }
  return out;
}

}  // namespace scattermeter::apps
