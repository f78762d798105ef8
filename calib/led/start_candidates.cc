#include "calib/led/start_candidates.h"

#include <algorithm>
#include <array>

#include "calib/led/cell_model.h"
#include "core/base/median.h"

namespace scattermeter::calib {
namespace {

// Sets intensities such that the median cell of each channel is matched; false if the LED does not
// light half of the cells of a channel.
bool set_intensity(const LedScene& scene, const std::vector<bool>& use, Led& led) {
  Led unit = led;
  for (int c = 0; c < 3; ++c) {
    if (led.intensity_W_per_sr[c] > 0.0) unit.intensity_W_per_sr[c] = 1.0;
  }
  std::array<std::vector<double>, 3> ratios;
  for (std::size_t i = 0; i < scene.cells.size(); ++i) {
    if (!use[i]) continue;
    const double one = cell_radiance(scene, scene.cells[i], unit);
    ratios[static_cast<std::size_t>(scene.cells[i].channel)].push_back(
        one > 0.0 ? scene.cells[i].radiance_W_per_mm2_sr / one : 0.0);
  }
  for (std::size_t c = 0; c < 3; ++c) {
    if (ratios[c].empty()) continue;
    const double intensity = upper_median(ratios[c]);
    if (!(intensity > 0.0)) return false;
    led.intensity_W_per_sr[static_cast<Eigen::Index>(c)] = intensity;
  }
  return true;
}

}  // namespace

std::vector<Led> start_candidates(const LedScene& scene, const LedSolve& what, const Led& led,
                                  bool position_is_known) {
  const Eigen::Vector3d center = scene.data_center_mm(what.use_cell, what.use_highlight);
  std::vector<Led> all;
  for (double stretch : {1.0, 0.75, 1.35}) {
    if (position_is_known && stretch != 1.0) continue;
    for (bool towards : {false, true}) {
      Led start = led;
      start.position_mm = center + stretch * (led.position_mm - center);
      const Eigen::Vector3d down = (center - start.position_mm).normalized();
      if (towards) start.axis = down;
      if (!towards && start.axis.dot(down) < 0.3) continue;
      if (!start.table) start.exponent = std::max(start.exponent, 0.5);
      if (set_intensity(scene, what.use_cell, start)) all.push_back(start);
    }
  }
  return all;
}

}  // namespace scattermeter::calib
