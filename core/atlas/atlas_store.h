// Where an atlas keeps its nodes between programs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/transport/white_rows.h"

namespace scattermeter {

// May be shared by several programs at once. Errors of the storage are its own: what cannot be read
// is not there, and what cannot be written is not kept. A body stands for a light in it, and is
// named by the numbers from which their paths follow but for sigma_s.
class AtlasStore {
 public:
  virtual ~AtlasStore() = default;
  // Equal numbers, equal names.
  virtual std::string name(const std::vector<double>& numbers) const = 0;
  // Camera centres, in mm and world coordinates, from which there are nodes.
  virtual std::vector<Eigen::Vector3d> centers_mm(const std::string& body) = 0;
  virtual std::optional<WhiteSums> find(const std::string& body, const Eigen::Vector3d& center_mm,
                                        int node) = 0;
  // Keeps these paths unless there are as many already.
  virtual void keep(const std::string& body, const Eigen::Vector3d& center_mm, int node,
                    const WhiteSums& sums) = 0;
};

}  // namespace scattermeter
