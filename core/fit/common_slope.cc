#include "core/fit/common_slope.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

namespace scattermeter {

Departure common_slope(const std::vector<double>& x, const std::vector<double>& y,
                       const std::vector<int>& group) {
  if (x.size() != y.size() || x.size() != group.size()) {
    throw std::invalid_argument("common_slope: sizes do not agree");
  }
  struct Mean {
    double n = 0, x = 0, y = 0;
  };
  std::map<int, Mean> means;
  for (std::size_t i = 0; i < x.size(); ++i) {
    Mean& m = means[group[i]];
    m.n += 1.0;
    m.x += x[i];
    m.y += y[i];
  }
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Mean& m = means[group[i]];
    const double dx = x[i] - m.x / m.n;
    const double dy = y[i] - m.y / m.n;
    xx += dx * dx;
    xy += dx * dy;
    yy += dy * dy;
  }
  Departure out{0.0, std::numeric_limits<double>::infinity()};
  if (!(xx > 0.0)) return out;
  out.value = xy / xx;
  const double dof = static_cast<double>(x.size()) - static_cast<double>(means.size()) - 1.0;
  if (dof > 0.0) out.std = std::sqrt(std::max(0.0, yy - xy * xy / xx) / dof / xx);
  return out;
}

}  // namespace scattermeter
