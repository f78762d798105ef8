#include "apps/rig/rig_sensor_truth.h"

#include "apps/rig/yaml_field.h"

namespace scattermeter::apps {
namespace {

std::vector<double> radial_terms(const YamlField& field) {
  std::vector<double> out;
  double corner = 1.0;
  for (const YamlField& term : field.items()) {
    out.push_back(term.number(-2.0, 2.0));
    corner += out.back();
  }
  if (out.size() > 4 || !(corner > 0.05)) {
    field.fail("expected at most four terms of r^2, r^4 ... that leave light in the corners");
  }
  return out;
}

}  // namespace

capture::SensorTruth read_sensor_truth(const YamlField& field) {
  field.only({"vignetting", "veiling_glare", "hot_pixels", "dark_current_counts_per_s",
              "black_drift_counts", "non_linearity", "shutter", "exposures"});
  capture::SensorTruth truth;
  if (const auto f = field.find("vignetting")) {
    if (f->is_map()) {
      f->only({"R", "G", "B"});
      truth.vignetting_radial = {radial_terms(f->at("R")), radial_terms(f->at("G")),
                                 radial_terms(f->at("B"))};
    } else {
      truth.vignetting_radial.fill(radial_terms(*f));
    }
  }
  if (const auto f = field.find("veiling_glare")) truth.veiling_glare = f->number(0.0, 0.5);
  if (const auto f = field.find("hot_pixels")) {
    f->only({"share", "counts_per_s", "seed"});
    truth.hot_pixel_share = f->at("share").number(0.0, 0.1);
    truth.hot_pixel_counts_per_s = f->at("counts_per_s").positive();
    if (const auto seed = f->find("seed")) {
      truth.hot_pixel_seed = static_cast<std::uint64_t>(seed->integer(0, 1'000'000'000));
    }
  }
  if (const auto f = field.find("dark_current_counts_per_s")) {
    truth.dark_current_counts_per_s = f->number(0.0, 1e6);
  }
  if (const auto f = field.find("black_drift_counts")) {
    truth.black_drift_counts = f->number(0.0, 1000.0);
  }
  if (const auto f = field.find("non_linearity")) truth.non_linearity = f->number(-0.3, 0.3);
  if (const auto f = field.find("shutter")) {
    const std::string name = f->text();
    if (name != "stated" && name != "thirds") f->fail("expected stated or thirds");
    truth.shutter_in_thirds = name == "thirds";
  }
  if (const auto f = field.find("exposures")) {
    for (const YamlField& item : f->items()) {
      item.only({"stated_s", "true_s"});
      truth.exposures.push_back({item.at("stated_s").positive(), item.at("true_s").positive()});
    }
  }
  return truth;
}

}  // namespace scattermeter::apps
