#include "apps/rig/rig_camera_reader.h"

#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <fmt/core.h>

#include "apps/rig/radiance_file.h"
#include "apps/rig/rig_fields.h"
#include "apps/rig/rig_limits.h"
#include "calib/lens/camera_calibration_file.h"
#include "calib/lens/intrinsics_file.h"
#include "core/scene/default_uncertainty.h"

namespace scattermeter::apps {
namespace {

// Least focal length, in widths of the frame: what is shorter is no pinhole camera, but a length in
// another unit.
constexpr double kShortestLens = 0.1;

CameraIntrinsics intrinsics_of(const YamlField& field, const std::string& rig_path) {
  if (field.is_scalar()) return calib::read_intrinsics(file_beside(rig_path, field));
  field.only({"fx_px", "fy_px", "cx_px", "cy_px", "distortion"});
  CameraIntrinsics k;
  k.fx_px = field.at("fx_px").positive();
  k.fy_px = field.at("fy_px").positive();
  k.cx_px = field.at("cx_px").number();
  k.cy_px = field.at("cy_px").number();
  if (const auto distortion = field.find("distortion")) {
    for (const YamlField& term : distortion->items()) k.distortion.push_back(term.number());
    const std::size_t n = k.distortion.size();
    if (n != 0 && n != 4 && n != 5 && n != 8) {
      distortion->fail("expected 0, 4, 5 or 8 terms k1, k2, p1, p2, k3 ...");
    }
  }
  return k;
}

LensDeviations lens_deviations(const YamlField& field, LensDeviations otherwise) {
  field.only({"focal_length_relative", "aspect_relative", "centre_px", "k1"});
  return {field.number_or("focal_length_relative", otherwise.focal_length_relative, 0.0, 1.0),
          field.number_or("aspect_relative", otherwise.aspect_relative, 0.0, 1.0),
          field.number_or("centre_px", otherwise.centre_px, 0.0, 1e5),
          field.number_or("k1", otherwise.k1, 0.0, 100.0)};
}

SceneSensor read_sensor(const YamlField& field) {
  field.only({"gain_e_per_count", "read_noise_counts", "cfa", "black_counts", "white_counts",
              "tone_curve"});
  SceneSensor s;
  if (const auto f = field.find("gain_e_per_count")) s.noise.gain_e_per_count = f->positive();
  if (const auto f = field.find("read_noise_counts")) {
    s.noise.read_noise_counts = f->number(0.0, 4095.0);
  }
  if (const auto f = field.find("cfa")) {
    try {
      s.cfa = cfa_pattern_from_name(f->text());
    } catch (const std::invalid_argument&) {
      f->fail("expected RGGB, GRBG, GBRG or BGGR");
    }
  }
  if (const auto f = field.find("white_counts")) s.white_counts = f->integer(1, 4095);
  if (const auto f = field.find("black_counts")) {
    if (f->is_scalar()) {
      s.black_counts.fill(f->integer(0, 4094));
    } else {
      f->numbers(4);
      for (std::size_t i = 0; i < 4; ++i) s.black_counts[i] = f->items()[i].integer(0, 4094);
    }
    for (int black : s.black_counts) {
      if (black >= s.white_counts) {
        f->fail(fmt::format("expected black below white_counts, {}", s.white_counts));
      }
    }
  }
  if (const auto f = field.find("tone_curve")) {
    const std::string name = f->text();
    if (name != "linear" && name != "nef_lossy") f->fail("expected linear or nef_lossy");
    s.nef_lossy_curve = name == "nef_lossy";
  }
  return s;
}

}  // namespace

void read_camera(const YamlField& field, bool with_radiance, Rig& rig) {
  field.only({"model", "image_size_px", "intrinsics", "intrinsics_std",
              "responsivity_counts_mm2_sr_per_W_s", "responsivity_relative_std", "radiance",
              "vignetting_std", "non_linearity_std", "sensor", "exposure_s", "iso", "f_number"});
  SceneCamera& camera = rig.scene.camera;
  if (const auto f = field.find("model")) {
    camera.model = f->text();
    if (camera.model.starts_with(" ")) f->fail("begins with a blank");
  }
  const YamlField image_size_px = field.at("image_size_px");
  const std::array<int, 2> size = integer_pair(image_size_px, 2, 100'000);
  check_image_size(image_size_px, rig.limits);
  const YamlField intrinsics = field.at("intrinsics");
  camera.intrinsics = intrinsics_of(intrinsics, rig.path);
  if (intrinsics.is_scalar()) {
    rig.intrinsics_path = file_beside(rig.path, intrinsics);
    rig.lens = std::make_shared<const calib::CameraCalibrationFile>(
        calib::read_camera_calibration_file(rig.intrinsics_path));
    camera.lens_root = lens_root(rig.lens->parameters, rig.lens->covariance);
  }
  const CameraIntrinsics& k = camera.intrinsics;
  if (k.width_px > 0 && (k.width_px != size[0] || k.height_px != size[1])) {
    intrinsics.fail(fmt::format("is of {} x {} px, but camera.image_size_px says {} x {}",
                                k.width_px, k.height_px, size[0], size[1]));
  }
  camera.intrinsics.width_px = size[0];
  camera.intrinsics.height_px = size[1];
  if (const std::string problem = intrinsics_problem(camera.intrinsics); !problem.empty()) {
    intrinsics.fail(problem);
  }
  if (const double fx = camera.intrinsics.fx_px; fx < kShortestLens * size[0]) {
    intrinsics.fail(fmt::format("fx_px {:g} sees {:.0f} degrees across the {} px of the frame", fx,
                                360.0 / std::numbers::pi * std::atan(0.5 * size[0] / fx), size[0]),
                    "; a focal length in mm becomes px when divided by the pitch of the sensor's "
                    "samples in mm");
  }
  const auto intrinsics_std = field.find("intrinsics_std");
  if (camera.lens_root.cols() == 0) {
    LensDeviations deviations = default_uncertainty::lens(camera.intrinsics);
    if (intrinsics_std) deviations = lens_deviations(*intrinsics_std, deviations);
    camera.lens_root = lens_root(camera.intrinsics, deviations);
  } else if (intrinsics_std) {
    intrinsics_std->fail("the file of camera.intrinsics contains the covariance of the lens");
  }
  if (const auto f = field.find("responsivity_counts_mm2_sr_per_W_s")) {
    camera.responsivity = positive_rgb(*f);
  }
  if (const auto f = field.find("responsivity_relative_std")) {
    if (!camera.responsivity) f->fail("is given without responsivity_counts_mm2_sr_per_W_s");
    camera.responsivity_relative_std = f->number(0.0, 10.0);
  }
  camera.vignetting_std =
      field.number_or("vignetting_std", default_uncertainty::kVignetting, 0.0, 1.0);
  camera.non_linearity_std =
      field.number_or("non_linearity_std", default_uncertainty::kNonLinearity, 0.0, 0.3);
  if (const auto f = field.find("radiance"); f && with_radiance) {
    if (const auto given = field.find("vignetting_std")) {
      given->fail("the file of camera.radiance corrects the vignetting");
    }
    if (const auto given = field.find("non_linearity_std")) {
      given->fail("the file of camera.radiance corrects the response");
    }
    const std::string file = file_beside(rig.path, *f);
    auto radiance = std::make_shared<const capture::RadianceCalibration>(read_radiance_file(file));
    const capture::RadianceCorrection& c = radiance->correction;
    if (c.width_px != camera.intrinsics.width_px || c.height_px != camera.intrinsics.height_px) {
      f->fail("the calibration is of " + std::to_string(c.width_px) + " x " +
              std::to_string(c.height_px) + " samples, not of camera.image_size_px");
    }
    if (radiance->responsivity) {
      if (camera.responsivity) {
        f->fail(
            "contains a responsivity, but camera.responsivity_counts_mm2_sr_per_W_s is given, too");
      }
      camera.responsivity = radiance->responsivity;
      camera.responsivity_relative_std = radiance->responsivity_relative_std;
    }
    use_radiance(rig, std::move(radiance), file);
  }
  if (const auto f = field.find("sensor")) camera.sensor = read_sensor(*f);
  if (const auto f = field.find("exposure_s")) camera.exposure_s = exposure_time_s(*f);
  if (const auto f = field.find("iso")) camera.iso = f->integer(1, 65534);
  if (const auto f = field.find("f_number")) camera.f_number = f->number(0.1, 1e4);
}

}  // namespace scattermeter::apps
