// The columns of a shot's nuisances while they are collected.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "core/nuisances/nuisances.h"

namespace scattermeter {

// Columns by the names of their nuisances; lights that share a nuisance add up.
class SceneNuisances::Columns {
 public:
  explicit Columns(const std::vector<Eigen::Index>& rows) : rows_(rows) {}
  const std::vector<Eigen::Index>& rows() const { return rows_; }
  template <class Change>
  void add(const std::string& name, const std::string& group, double std, const Change& change) {
    for (NuisanceColumn& column : list_) {
      if (column.nuisance.name != name) continue;
      column.change += change;
      return;
    }
    list_.push_back({{group, std, std > 0.0, name}, change});
  }
  // Of a quantity on all rows of the view.
  Eigen::VectorXd of(const Eigen::MatrixXd& on_view, Eigen::Index medium) const {
    return on_view(rows_, medium);
  }
  std::vector<NuisanceColumn> take() { return std::move(list_); }

 private:
  const std::vector<Eigen::Index>& rows_;
  std::vector<NuisanceColumn> list_;
};

}  // namespace scattermeter
