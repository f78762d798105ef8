// Where an atlas keeps its nodes between programs.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "core/transport/white_rows.h"

namespace scattermeter {

// What the paths of a light in a body follow from, but sigma_s: equal numbers, equal paths.
struct LitBody {
  std::vector<double> numbers;
};

// May be shared by several programs at once. Errors of the storage are its own: what cannot be read
// is not there, and what cannot be written is not kept.
class AtlasStore {
 public:
  virtual ~AtlasStore() = default;
  // Camera centres, in mm and world coordinates, from which there are nodes.
  virtual std::vector<Eigen::Vector3d> centers_mm(const LitBody& body) = 0;
  virtual std::optional<WhiteSums> find(const LitBody& body, const Eigen::Vector3d& center_mm,
                                        int node) = 0;
  // Keeps these paths unless there are as many already.
  virtual void keep(const LitBody& body, const Eigen::Vector3d& center_mm, int node,
                    const WhiteSums& sums) = 0;
};

}  // namespace scattermeter
