#include "core/fit/linear_shot.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace scattermeter {
namespace {

struct RowRange {
  Eigen::Index begin, size;
};

RowRange rows_of_shot(const DenseSystem& system, std::size_t shot) {
  const auto before = system.shot_rows.begin() + static_cast<std::ptrdiff_t>(shot);
  return {std::accumulate(system.shot_rows.begin(), before, Eigen::Index{0}),
          system.shot_rows.at(shot)};
}

}  // namespace

DenseSystem stack(const std::vector<LinearShot>& shots) {
  Eigen::Index rows = 0;
  Eigen::Index cols = 0;
  for (const LinearShot& shot : shots) {
    rows += static_cast<Eigen::Index>(shot.observed->rows_used);
    for (const LinearShot::Light& light : shot.lights) {
      if (cols != 0 && light.weights->cols() != cols) {
        throw std::invalid_argument("stack: the shots have different knots");
      }
      cols = light.weights->cols();
    }
  }
  // Written once: zeros that are read first would cost each page a second fault.
  DenseSystem out{
      WeightMatrix(rows, cols), Eigen::VectorXd(rows), Eigen::VectorXd(rows), {}, {}, {}};
  Eigen::Index at = 0;
  for (const LinearShot& shot : shots) {
    const ChannelObservation& o = *shot.observed;
    out.shot_rows.push_back(static_cast<Eigen::Index>(o.rows_used));
    for (std::size_t j = 0; j < o.l.size(); ++j) {
      if (o.state[j] != RowState::kUsed) continue;
      const auto part = [&](const LinearShot::Light& light) {
        return light.intensity_W_per_sr * light.weights->row(static_cast<Eigen::Index>(j));
      };
      if (shot.lights.empty()) {
        out.weights.row(at).setZero();
      } else {
        out.weights.row(at) = part(shot.lights.front());
      }
      for (std::size_t i = 1; i < shot.lights.size(); ++i) {
        out.weights.row(at) += part(shot.lights[i]);
      }
      out.l[at] = o.l[j];
      out.std_l[at] = std::hypot(std::sqrt(o.variance[j]), shot.numerical_relative_std * o.l[j]);
      ++at;
    }
  }
  return out;
}

DenseSystem selected(const DenseSystem& system, const std::vector<Eigen::Index>& rows) {
  DenseSystem out;
  out.weights = system.weights(rows, Eigen::all);
  out.l = system.l(rows);
  out.std_l = system.std_l(rows);
  out.nuisances = system.nuisances;
  if (!system.nuisances.empty()) {
    out.nuisance_columns = system.nuisance_columns(rows, Eigen::all);
  }
  if (system.beyond_column.nuisance >= 0) {
    out.beyond_column = {system.beyond_column.nuisance, system.beyond_column.l(rows)};
  }
  Eigen::Index end = 0;
  auto next = rows.begin();
  for (const Eigen::Index n : system.shot_rows) {
    end += n;
    const auto after = std::lower_bound(next, rows.end(), end);
    out.shot_rows.push_back(after - next);
    next = after;
  }
  return out;
}

std::vector<Eigen::Index> nuisances_of_shot(const DenseSystem& system, std::size_t shot) {
  const RowRange rows = rows_of_shot(system, shot);
  std::vector<Eigen::Index> out;
  for (Eigen::Index v = 0; rows.size > 0 && v < system.nuisance_columns.cols(); ++v) {
    if (!system.nuisance_columns.col(v).segment(rows.begin, rows.size).isZero(0.0)) {
      out.push_back(v);
    }
  }
  return out;
}

DenseSystem shot_of(const DenseSystem& system, std::size_t shot) {
  const RowRange rows = rows_of_shot(system, shot);
  DenseSystem out;
  out.weights = system.weights.middleRows(rows.begin, rows.size);
  out.l = system.l.segment(rows.begin, rows.size);
  out.std_l = system.std_l.segment(rows.begin, rows.size);
  out.shot_rows = {rows.size};
  const std::vector<Eigen::Index> touching = nuisances_of_shot(system, shot);
  for (const Eigen::Index v : touching) {
    out.nuisances.push_back(system.nuisances[static_cast<std::size_t>(v)]);
  }
  if (!system.nuisances.empty()) {
    out.nuisance_columns = system.nuisance_columns(Eigen::seqN(rows.begin, rows.size), touching);
  }
  return out;
}

}  // namespace scattermeter
