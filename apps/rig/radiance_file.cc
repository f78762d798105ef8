#include "apps/rig/radiance_file.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/core.h>

#include "apps/rig/rig_fields.h"
#include "apps/rig/yaml_field.h"

namespace scattermeter::apps {
namespace {

template <typename List>
std::string flow(const List& values) {
  std::string out = "[";
  for (const auto& v : values) out += (out.size() > 1 ? ", " : "") + fmt::format("{}", v);
  return out + "]";
}

std::string quoted_text(const std::string& text) {
  std::string out = "'";
  for (const char c : text) {
    if (c == '\'') out += '\'';
    out += static_cast<unsigned char>(c) < 0x20U ? ' ' : c;
  }
  return out + "'";
}

std::vector<double> number_list(const YamlField& field, std::size_t at_most) {
  std::vector<double> out;
  for (const YamlField& item : field.items()) out.push_back(item.number());
  if (out.size() > at_most) field.fail("expected at most " + std::to_string(at_most) + " numbers");
  return out;
}

template <std::size_t n>
std::array<double, n> number_array(const YamlField& field, double min = -1e300) {
  field.numbers(n);
  const std::vector<YamlField> items = field.items();
  std::array<double, n> out{};
  for (std::size_t i = 0; i < n; ++i) out[i] = items[i].number(min, 1e300);
  return out;
}

void read_colour(const YamlField& field, std::size_t c, capture::RadianceCalibration& out) {
  field.only({"gain_e_per_count", "gain_std_e_per_count", "read_noise_counts",
              "read_noise_std_counts", "response", "vignetting", "glare"});
  capture::RadianceCorrection& correction = out.correction;
  correction.noise[c].gain_e_per_count = field.at("gain_e_per_count").positive();
  correction.noise[c].read_noise_counts = field.at("read_noise_counts").number(0.0, 1e4);
  out.gain_std_e_per_count[c] = field.at("gain_std_e_per_count").number(0.0, 1e300);
  out.read_noise_std_counts[c] = field.at("read_noise_std_counts").number(0.0, 1e300);
  const YamlField response = field.at("response");
  response.only({"counts", "log_light_over_recorded", "covariance"});
  const std::vector<double> counts = number_list(response.at("counts"), 4);
  const std::vector<double> values = number_list(response.at("log_light_over_recorded"), 4);
  const std::vector<double> covariance = number_list(response.at("covariance"), 16);
  if (values.size() != counts.size() || covariance.size() != counts.size() * counts.size()) {
    response.fail("expected as many values as counts, and a covariance of their square");
  }
  for (const double v : values) {
    if (std::abs(v) > 0.5) response.fail("expected departures below 0.5");
  }
  try {
    correction.response[c] = ResponseCurve(counts, values);
  } catch (const std::invalid_argument& e) {
    response.fail(e.what());
  }
  out.response_covariance[c] = covariance;
  if (!covariance.empty() && !(covariance.back() >= 0.0)) {
    response.at("covariance").fail("expected variances >= 0");
  }
  const YamlField vignetting = field.at("vignetting");
  vignetting.only({"radial", "map"});
  correction.vignetting.radial[c] = number_list(vignetting.at("radial"), 8);
  correction.vignetting.map[c] = number_list(vignetting.at("map"), Vignetting::kMapTerms);
  const YamlField glare = field.at("glare");
  glare.only({"share", "std"});
  correction.glare_share[c] = glare.at("share").number(0.0, 0.9);
  correction.glare_std[c] = glare.at("std").number(0.0, 1.0);
}

void read_dark(const YamlField& dark, capture::RadianceCorrection& correction) {
  dark.only({"black_counts", "dark_counts_per_s", "black_std_counts", "defect_pixels"});
  correction.black_counts = number_array<4>(dark.at("black_counts"), 0.0);
  correction.dark_counts_per_s = number_array<4>(dark.at("dark_counts_per_s"));
  correction.black_std_counts = dark.at("black_std_counts").number(0.0, 1e5);
  const auto width = static_cast<std::size_t>(correction.width_px);
  for (const YamlField& pixel : dark.at("defect_pixels").items()) {
    pixel.numbers(2);
    const std::vector<YamlField> xy = pixel.items();
    const int x = xy[0].integer(0, correction.width_px - 1);
    const int y = xy[1].integer(0, correction.height_px - 1);
    correction.defect_pixels.push_back(static_cast<std::size_t>(y) * width +
                                       static_cast<std::size_t>(x));
  }
  std::sort(correction.defect_pixels.begin(), correction.defect_pixels.end());
}

std::vector<capture::RadiancePoint> read_points(const YamlField& field) {
  std::vector<capture::RadiancePoint> out;
  for (const YamlField& item : field.items()) {
    const std::array<double, 3> v = number_array<3>(item);
    out.push_back({v[0], v[1], v[2]});
  }
  return out;
}

std::string flow_points(const std::vector<capture::RadiancePoint>& points) {
  std::string out = "[";
  for (const capture::RadiancePoint& p : points) {
    out += (out.size() > 1 ? ", " : "") + flow(std::array{p.counts, p.value, p.std});
  }
  return out + "]";
}

// Requires a plausible share of light all over the frame.
void check_vignetting(const YamlField& top, const capture::RadianceCorrection& correction) {
  for (std::size_t c = 0; c < kRgb; ++c) {
    for (int i = 0; i <= 16; ++i) {
      for (int k = 0; k <= 16; ++k) {
        const double share = correction.vignetting.share((correction.width_px - 1) * i / 16.0,
                                                         (correction.height_px - 1) * k / 16.0, c);
        if (!(share > 0.02 && share < 20.0)) {
          top.at("colours").fail("vignetting: a share of " + std::to_string(share));
        }
      }
    }
  }
}

}  // namespace

std::string radiance_file_text(const capture::RadianceCalibration& calibration) {
  const capture::RadianceCorrection& c = calibration.correction;
  std::string out = "scattermeter_radiance: 1\n";
  out += fmt::format("image_size_px: [{}, {}]\niso: {}\nf_number: {}\n", c.width_px, c.height_px,
                     c.iso, c.f_number);
  out += fmt::format(
      "dark:\n  black_counts: {}  # per phase of the 2 x 2 filter pattern\n  dark_counts_per_s: "
      "{}\n  black_std_counts: {}\n  defect_pixels: [",
      flow(c.black_counts), flow(c.dark_counts_per_s), c.black_std_counts);
  for (std::size_t i = 0; i < c.defect_pixels.size(); ++i) {
    const auto width = static_cast<std::size_t>(c.width_px);
    out += fmt::format("{}[{}, {}]", i == 0 ? "" : ", ", c.defect_pixels[i] % width,
                       c.defect_pixels[i] / width);
  }
  out += "]\ncolours:\n";
  for (std::size_t k = 0; k < kRgb; ++k) {
    out += fmt::format(
        "  {}:\n    gain_e_per_count: {}\n    gain_std_e_per_count: {}\n    read_noise_counts: {}\n"
        "    read_noise_std_counts: {}\n",
        kRgbName[k], c.noise[k].gain_e_per_count, calibration.gain_std_e_per_count[k],
        c.noise[k].read_noise_counts, calibration.read_noise_std_counts[k]);
    out +=
        fmt::format("    response: {{counts: {}, log_light_over_recorded: {}, covariance: {}}}\n",
                    flow(c.response[k].knot_counts()), flow(c.response[k].log_ratio()),
                    flow(calibration.response_covariance[k]));
    out += fmt::format("    vignetting: {{radial: {}, map: {}}}\n", flow(c.vignetting.radial[k]),
                       flow(c.vignetting.map[k]));
    out += fmt::format("    glare: {{share: {}, std: {}}}\n", c.glare_share[k], c.glare_std[k]);
  }
  out += fmt::format("vignetting_std: {}\nshutter:\n  relative_std_elsewhere: {}\n  settings: [",
                     c.vignetting_std, c.shutter_relative_std);
  for (std::size_t i = 0; i < c.shutter.size(); ++i) {
    const capture::ShutterSetting& s = c.shutter[i];
    out += fmt::format("{}{{stated_s: {}, true_over_stated: {}, relative_std: {}}}",
                       i == 0 ? "" : ",\n             ", s.stated_s, s.true_over_stated,
                       s.relative_std);
  }
  out += "]\n";
  if (calibration.responsivity) {
    out += fmt::format(
        "responsivity_counts_mm2_sr_per_W_s: {}\nresponsivity_relative_std: {}  # LED included\n",
        flow(*calibration.responsivity), calibration.responsivity_relative_std);
  }
  if (!calibration.linearity.empty()) {
    out += "curves:  # [counts, value, std of it]\n  linearity: " +
           flow_points(calibration.linearity) + "\n";
    for (std::size_t k = 0; k < kRgb; ++k) {
      out += fmt::format("  noise_{}: {}\n", kRgbName[k], flow_points(calibration.noise[k]));
    }
  }
  out += "residuals: [";
  for (std::size_t i = 0; i < calibration.residuals.size(); ++i) {
    const capture::RadianceResidual& r = calibration.residuals[i];
    out += fmt::format("{}{{what: {}, rms: {}, worst: {}, limit: {}, unit: {}}}",
                       i == 0 ? "" : ",\n            ", quoted_text(r.what), r.rms, r.worst,
                       r.limit, quoted_text(r.unit));
  }
  out += "]\nnotes: [";
  for (std::size_t i = 0; i < calibration.notes.size(); ++i) {
    out += (i == 0 ? "" : ", ") + quoted_text(calibration.notes[i]);
  }
  return out + "]\n";
}

capture::RadianceCalibration read_radiance_file(const std::string& path) {
  const YamlField top = YamlField::load(path);
  top.only({"scattermeter_radiance", "image_size_px", "iso", "f_number", "dark", "colours",
            "vignetting_std", "shutter", "responsivity_counts_mm2_sr_per_W_s",
            "responsivity_relative_std", "curves", "residuals", "notes"});
  require_version(top, "scattermeter_radiance", "calibrations");
  capture::RadianceCalibration out;
  capture::RadianceCorrection& correction = out.correction;
  const YamlField size = top.at("image_size_px");
  size.numbers(2);
  correction.width_px = size.items()[0].integer(2, 100'000);
  correction.height_px = size.items()[1].integer(2, 100'000);
  correction.iso = top.at("iso").number(0.0, 1e9);
  correction.f_number = top.at("f_number").number(0.0, 1e9);
  read_dark(top.at("dark"), correction);
  correction.vignetting = vignetting_of_frame(correction.width_px, correction.height_px);
  const YamlField colours = top.at("colours");
  colours.only({"R", "G", "B"});
  for (std::size_t c = 0; c < kRgb; ++c) {
    read_colour(colours.at(std::string(1, kRgbName[c])), c, out);
  }
  check_vignetting(top, correction);
  correction.vignetting_std = top.at("vignetting_std").number(0.0, 1.0);
  const YamlField shutter = top.at("shutter");
  shutter.only({"relative_std_elsewhere", "settings"});
  correction.shutter_relative_std = shutter.at("relative_std_elsewhere").number(0.0, 1.0);
  for (const YamlField& item : shutter.at("settings").items()) {
    item.only({"stated_s", "true_over_stated", "relative_std"});
    correction.shutter.push_back({item.at("stated_s").positive(),
                                  item.at("true_over_stated").number(0.5, 2.0),
                                  item.at("relative_std").number(0.0, 1.0)});
  }
  if (const auto f = top.find("responsivity_counts_mm2_sr_per_W_s")) {
    out.responsivity = positive_rgb(*f);
    out.responsivity_relative_std = top.at("responsivity_relative_std").number(0.0, 10.0);
  }
  if (const auto curves = top.find("curves")) {
    curves->only({"linearity", "noise_R", "noise_G", "noise_B"});
    out.linearity = read_points(curves->at("linearity"));
    for (std::size_t c = 0; c < kRgb; ++c) {
      out.noise[c] = read_points(curves->at(std::string("noise_") + kRgbName[c]));
    }
  }
  for (const YamlField& item : top.at("residuals").items()) {
    item.only({"what", "rms", "worst", "limit", "unit"});
    out.residuals.push_back({item.at("what").text(), item.at("rms").number(),
                             item.at("worst").number(), item.at("limit").number(),
                             item.at("unit").text()});
  }
  for (const YamlField& item : top.at("notes").items()) out.notes.push_back(item.text());
  return out;
}

}  // namespace scattermeter::apps
