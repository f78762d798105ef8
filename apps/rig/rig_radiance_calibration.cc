#include "apps/rig/rig_radiance_calibration.h"

#include <set>

#include "apps/rig/rig_fields.h"
#include "apps/rig/rig_white_plane.h"

namespace scattermeter::apps {
namespace {

constexpr double kWhiteAlbedoStd = 0.005;  // if the rig states none

calib::RadianceShot radiance_shot(const YamlField& field, bool is_flat = false) {
  calib::RadianceShot shot;
  shot.line = field.line();
  if (field.is_scalar()) {
    shot.file = file_in_folder(field);
  } else {
    if (is_flat) {
      field.only({"file", "exposure_s", "lamp"});
      if (const auto f = field.find("lamp")) shot.lamp = f->positive();
    } else {
      field.only({"file", "exposure_s"});
    }
    shot.file = file_in_folder(field.at("file"));
    if (const auto f = field.find("exposure_s")) shot.exposure_s = exposure_time_s(*f);
  }
  return shot;
}

std::vector<calib::RadianceShot> radiance_shots(const YamlField& field, bool are_flats = false) {
  std::vector<calib::RadianceShot> out;
  std::set<std::string> files;
  for (const YamlField& item : field.items()) {
    out.push_back(radiance_shot(item, are_flats));
    if (!files.insert(out.back().file).second) item.fail("the file is listed twice");
  }
  if (out.empty()) field.fail("expected at least one shot");
  return out;
}

// Reads one shot or a bracket.
std::vector<calib::RadianceShot> own_shots(const YamlField& field) {
  const auto shots = field.find("shots");
  const auto file = field.find("file");
  if (shots.has_value() == file.has_value()) field.fail("expected either file or shots");
  if (shots) {
    if (const auto f = field.find("exposure_s")) f->fail("belongs in each entry of shots");
    return radiance_shots(*shots);
  }
  calib::RadianceShot shot = radiance_shot(*file);
  if (const auto f = field.find("exposure_s")) shot.exposure_s = exposure_time_s(*f);
  return {shot};
}

PixelRect read_rect(const YamlField& field) {
  field.numbers(4);
  const std::vector<YamlField> v = field.items();
  return {v[0].integer(0, 100'000), v[1].integer(0, 100'000), v[2].integer(2, 100'000),
          v[3].integer(2, 100'000)};
}

calib::WhiteReference read_white(const YamlField& field) {
  field.only({"file", "shots", "exposure_s", "light", "origin_mm", "x_axis", "y_axis", "size_mm",
              "albedo", "albedo_relative_std"});
  calib::WhiteReference white;
  white.line = field.line();
  white.shots = own_shots(field);
  white.light = field.at("light").text();
  white.plane = read_white_plane(field, kWhiteAlbedoStd);
  return white;
}

calib::GlareTarget read_glare(const YamlField& field) {
  field.only({"file", "shots", "exposure_s", "traps_px", "bright_px",
              "bright_radiance_W_per_mm2_sr", "relative_std"});
  calib::GlareTarget glare;
  glare.line = field.line();
  glare.shots = own_shots(field);
  const YamlField traps = field.at("traps_px");
  for (const YamlField& trap : traps.items()) glare.traps_px.push_back(read_rect(trap));
  if (glare.traps_px.empty()) traps.fail("expected at least one rectangle [x, y, width, height]");
  if (const auto f = field.find("bright_px")) glare.bright_px = read_rect(*f);
  if (const auto f = field.find("bright_radiance_W_per_mm2_sr")) {
    glare.bright_radiance_W_per_mm2_sr = positive_rgb(*f);
  }
  if (const auto f = field.find("relative_std")) glare.relative_std = f->number(0.0, 10.0);
  return glare;
}

}  // namespace

calib::RadianceCalibrationShots read_radiance_calibration(const YamlField& field,
                                                          const std::string& rig_path) {
  field.only({"dark", "flats", "flat_radiance_W_per_mm2_sr", "white", "glare"});
  calib::RadianceCalibrationShots out;
  out.path = rig_path;
  out.line = field.line();
  out.dark = radiance_shots(field.at("dark"));
  out.flats = radiance_shots(field.at("flats"), true);
  if (const auto f = field.find("flat_radiance_W_per_mm2_sr")) {
    out.flat_radiance_W_per_mm2_sr = positive_rgb(*f);
  }
  if (const auto f = field.find("white")) out.white = read_white(*f);
  if (const auto f = field.find("glare")) out.glare = read_glare(*f);
  return out;
}

}  // namespace scattermeter::apps
