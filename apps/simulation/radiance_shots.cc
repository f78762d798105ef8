#include "apps/simulation/radiance_shots.h"

#include <algorithm>

#include "apps/simulation/shot_renderer.h"
#include "calib/radiance/white_pixels.h"
#include "calib/radiance/white_scale.h"
#include "core/base/input_error.h"

namespace scattermeter::apps {
namespace {

std::vector<float> uniform_picture(const Rig& rig, const std::array<double, 3>& radiance) {
  const CameraIntrinsics& k = rig.scene.camera.intrinsics;
  std::vector<float> out;
  out.reserve(static_cast<std::size_t>(k.width_px) * static_cast<std::size_t>(k.height_px));
  for (int y = 0; y < k.height_px; ++y) {
    for (int x = 0; x < k.width_px; ++x) {
      out.push_back(static_cast<float>(
          radiance[static_cast<std::size_t>(rig.scene.camera.sensor.cfa.at(x, y))]));
    }
  }
  return out;
}

std::vector<float> white_picture(const Rig& rig, const calib::WhiteReference& white) {
  const CameraView view = true_view(rig);
  const Led& led = rig.scene.light(white.light).led()->led;
  std::vector<float> out = uniform_picture(rig, {0, 0, 0});
  const Eigen::Vector3d normal = white.plane.normal();
  for (const calib::WhitePixel& p : calib::white_pixels(white.plane, view, 0.0)) {
    const auto width = static_cast<std::size_t>(rig.scene.camera.intrinsics.width_px);
    const auto c = static_cast<std::size_t>(rig.scene.camera.sensor.cfa.at(
        static_cast<int>(p.pixel % width), static_cast<int>(p.pixel / width)));
    out[p.pixel] = static_cast<float>(white.plane.albedo[static_cast<Eigen::Index>(c)] *
                                      led.intensity_W_per_sr[static_cast<Eigen::Index>(c)] *
                                      calib::white_radiance_per_intensity(led, p.point_mm, normal));
  }
  return out;
}

std::vector<float> glare_picture(const Rig& rig, const calib::GlareTarget& glare) {
  const PixelRect& r = *glare.bright_px;
  const CameraIntrinsics& k = rig.scene.camera.intrinsics;
  std::vector<float> out = uniform_picture(rig, {0, 0, 0});
  for (int y = r.y0; y < std::min(r.y0 + r.height, k.height_px); ++y) {
    for (int x = r.x0; x < std::min(r.x0 + r.width, k.width_px); ++x) {
      out[static_cast<std::size_t>(y) * static_cast<std::size_t>(k.width_px) +
          static_cast<std::size_t>(x)] =
          static_cast<float>(glare.bright_radiance_W_per_mm2_sr[static_cast<std::size_t>(
              rig.scene.camera.sensor.cfa.at(x, y))]);
    }
  }
  return out;
}

}  // namespace

std::vector<calib::RadianceShot> all_radiance_shots(
    const calib::RadianceCalibrationShots& radiance) {
  std::vector<calib::RadianceShot> out = radiance.dark;
  out.insert(out.end(), radiance.flats.begin(), radiance.flats.end());
  if (radiance.white) {
    out.insert(out.end(), radiance.white->shots.begin(), radiance.white->shots.end());
  }
  if (radiance.glare) {
    out.insert(out.end(), radiance.glare->shots.begin(), radiance.glare->shots.end());
  }
  return out;
}

RadianceShots::RadianceShots(const Rig& rig, bool noise)
    : rig_(rig), sensor_(rig.scene, rig.truth.sensor, noise) {
  const calib::RadianceCalibrationShots& radiance = *rig.calibration.radiance;
  for (const calib::RadianceShot& shot : all_radiance_shots(radiance)) exposure_s(shot);
  if (!radiance.flat_radiance_W_per_mm2_sr) {
    throw InputError(rig.at(radiance.line) + ": calibration.radiance.flat_radiance_W_per_mm2_sr",
                     "is missing: simulate needs it");
  }
  for (const calib::RadianceShot& shot : radiance.flats) lamp_[shot.file] = shot.lamp;
  if (radiance.white) {
    white_ = white_picture(rig, *radiance.white);
    for (const calib::RadianceShot& shot : radiance.white->shots) picture_of_[shot.file] = &white_;
  }
  if (radiance.glare) {
    if (!radiance.glare->bright_px) {
      throw InputError(rig.at(radiance.glare->line) + ": calibration.radiance.glare.bright_px",
                       "is missing: simulate needs it");
    }
    glare_ = glare_picture(rig, *radiance.glare);
    for (const calib::RadianceShot& shot : radiance.glare->shots) picture_of_[shot.file] = &glare_;
  }
}

double RadianceShots::exposure_s(const calib::RadianceShot& shot) const {
  if (shot.exposure_s) return *shot.exposure_s;
  if (rig_.scene.camera.exposure_s) return *rig_.scene.camera.exposure_s;
  throw InputError(rig_.at(shot.line) + ": exposure_s",
                   "is missing: simulate needs it for " + shot.file);
}

std::vector<float> RadianceShots::signal_counts(const calib::RadianceShot& shot) const {
  if (const auto picture = picture_of_.find(shot.file); picture != picture_of_.end()) {
    return sensor_.signal_counts(*picture->second, exposure_s(shot));
  }
  std::array<double, 3> light{};
  if (const auto lamp = lamp_.find(shot.file); lamp != lamp_.end()) {
    for (std::size_t c = 0; c < 3; ++c) {
      light[c] = lamp->second * (*rig_.calibration.radiance->flat_radiance_W_per_mm2_sr)[c];
    }
  }
  return sensor_.signal_counts(uniform_picture(rig_, light), exposure_s(shot));
}

capture::RawFrame RadianceShots::frame(const calib::RadianceShot& shot, std::uint64_t seed) const {
  return sensor_.frame(signal_counts(shot), exposure_s(shot),
                       capture::VirtualSensor::stream(seed, shot.file));
}

void RadianceShots::write(const calib::RadianceShot& shot, std::uint64_t seed,
                          const std::string& path) const {
  sensor_.write(path, signal_counts(shot), exposure_s(shot),
                capture::VirtualSensor::stream(seed, shot.file));
}

}  // namespace scattermeter::apps
