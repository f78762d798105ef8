#include "apps/rig_radiance_calibration.h"

#include <cmath>
#include <set>

#include "apps/rig_fields.h"

namespace scattermeter::apps {
namespace {

RadianceShot radiance_shot(const YamlField& field, bool is_flat = false) {
  RadianceShot shot;
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
    if (const auto f = field.find("exposure_s")) shot.exposure_s = f->positive();
  }
  return shot;
}

std::vector<RadianceShot> radiance_shots(const YamlField& field, bool are_flats = false) {
  std::vector<RadianceShot> out;
  std::set<std::string> files;
  for (const YamlField& item : field.items()) {
    out.push_back(radiance_shot(item, are_flats));
    if (!files.insert(out.back().file).second) item.fail("the file is listed twice");
  }
  if (out.empty()) field.fail("expected at least one shot");
  return out;
}

// One shot, or a bracket.
std::vector<RadianceShot> own_shots(const YamlField& field) {
  const auto shots = field.find("shots");
  const auto file = field.find("file");
  if (shots.has_value() == file.has_value()) field.fail("expected either file or shots");
  if (shots) {
    if (const auto f = field.find("exposure_s")) f->fail("stands in each of shots");
    return radiance_shots(*shots);
  }
  RadianceShot shot = radiance_shot(*file);
  if (const auto f = field.find("exposure_s")) shot.exposure_s = f->positive();
  return {shot};
}

PixelRect read_rect(const YamlField& field) {
  field.numbers(4);
  const std::vector<YamlField> v = field.items();
  return {v[0].integer(0, 100'000), v[1].integer(0, 100'000), v[2].integer(2, 100'000),
          v[3].integer(2, 100'000)};
}

RigWhite read_white(const YamlField& field) {
  field.only({"file", "shots", "exposure_s", "light", "origin_mm", "x_axis", "y_axis", "size_mm",
              "albedo", "albedo_relative_std"});
  RigWhite white;
  white.line = field.line();
  white.shots = own_shots(field);
  white.light = field.at("light").text();
  if (const auto f = field.find("origin_mm")) white.origin_mm = f->vector3();
  if (const auto f = field.find("x_axis")) white.x_axis = unit_vector(*f);
  if (const auto f = field.find("y_axis")) white.y_axis = unit_vector(*f);
  if (std::abs(white.x_axis.dot(white.y_axis)) > 1e-6) {
    field.fail("x_axis and y_axis are not at right angles");
  }
  white.size_mm = {field.at("size_mm").numbers(2)[0], field.at("size_mm").numbers(2)[1]};
  if (!(white.size_mm[0] > 0.0) || !(white.size_mm[1] > 0.0)) {
    field.at("size_mm").fail("expected two positive lengths");
  }
  const YamlField albedo = field.at("albedo");
  white.albedo = positive_rgb(albedo);
  for (const double a : white.albedo) {
    if (a > 1.0) albedo.fail("expected albedos of at most 1");
  }
  if (const auto f = field.find("albedo_relative_std")) {
    white.albedo_relative_std = f->number(0.0, 1.0);
  }
  return white;
}

RigGlare read_glare(const YamlField& field) {
  field.only({"file", "shots", "exposure_s", "traps_px", "bright_px",
              "bright_radiance_W_per_mm2_sr", "relative_std"});
  RigGlare glare;
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

RigRadianceCalibration read_radiance_calibration(const YamlField& field,
                                                 const std::string& rig_path) {
  static_cast<void>(rig_path);
  field.only({"dark", "flats", "flat_radiance_W_per_mm2_sr", "white", "glare"});
  RigRadianceCalibration out;
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
