// The misfit of a white plane's light, cell by cell.
#pragma once

#include <string>
#include <vector>

#include "calib/led/led_scene.h"
#include "calib/led/led_shots.h"

namespace scattermeter::calib {

struct LedPlaneMap {
  std::string file;
  int columns = 0, rows = 0;
  // Measured over predicted radiance minus one, in percent, averaged over the channels; row by row,
  // NaN where there is no cell. Then its standard deviation from the noise of the samples.
  std::vector<double> percent, std_percent;
};

// The cells of one shot. relative: for each of `cells`, of whatever shot, measured over predicted
// radiance minus one; cells where it is not finite are left out. Precondition: as many of them as
// cells.
LedPlaneMap plane_map(const LedPlaneGrid& grid, const std::vector<ShadedCell>& cells,
                      const std::vector<double>& relative);

}  // namespace scattermeter::calib
