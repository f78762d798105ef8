// Some rows in place of all: fewer to weight and to fit where noise is not what limits a result.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "core/view/observation.h"
#include "core/view/sample_map.h"

namespace scattermeter {

struct RowChoice {
  std::vector<std::size_t> rows;            // the chosen ones, ascending
  std::vector<std::int32_t> stands_for_it;  // for every row, the index in `rows` of its cell's row
};

// At most 2^levels rows: of each cell of neighbours (core/base/position_cells.h) the one nearest to
// the cell's centre. The choice follows from the positions alone. Domain: levels >= 0
// (std::invalid_argument).
RowChoice spread_rows(const std::vector<Eigen::Vector3d>& centers_mm, int levels);

// The chosen rows. Samples of the others are those of the row that stands for them, as pictures
// show it. Without transmittances and adjacency: samples are observed with the whole map.
SampleMap with_rows(const SampleMap& map, const RowChoice& choice);
// Numbers of samples and the noise ratio stay those of all rows.
Observation with_rows(const Observation& observation, const RowChoice& choice);

}  // namespace scattermeter
