#include "apps/rig/rig_led_lobe.h"

#include <numbers>
#include <stdexcept>
#include <vector>

#include "apps/rig/rig_fields.h"

namespace scattermeter::apps {
namespace {

constexpr double kDegree_rad = std::numbers::pi / 180.0;

std::vector<double> list(const YamlField& field, double min, double max) {
  std::vector<double> out;
  for (const YamlField& item : field.items()) out.push_back(item.number(min, max));
  return out;
}

}  // namespace

std::shared_ptr<const LobeTable> read_lobe(const YamlField& field, const Eigen::Vector3d& axis) {
  field.only({"angle_deg", "relative", "relative_x", "relative_y", "x_axis"});
  std::vector<double> angles_rad = list(field.at("angle_deg"), -90.0, 90.0);
  for (double& a : angles_rad) a *= kDegree_rad;
  constexpr double kMost = 1e6;
  try {
    if (const auto relative = field.find("relative")) {
      for (const char* key : {"relative_x", "relative_y", "x_axis"}) {
        if (const auto f = field.find(key)) {
          f->fail("is for a lobe in two planes; relative is for one that is round about its axis");
        }
      }
      return std::make_shared<LobeTable>(std::move(angles_rad), list(*relative, 0.0, kMost));
    }
    const YamlField x_field = field.at("x_axis");
    auto lobe =
        std::make_shared<LobeTable>(std::move(angles_rad), list(field.at("relative_x"), 0.0, kMost),
                                    list(field.at("relative_y"), 0.0, kMost), unit_vector(x_field));
    if (!lobe->has_planes_about(axis)) x_field.fail("expected a direction across the LED's axis");
    return lobe;
  } catch (const std::invalid_argument& e) {
    field.fail(e.what());
  }
}

}  // namespace scattermeter::apps
