#include "core/transport/sideways_growth.h"

namespace scattermeter {

double entry_sideways_growth(const PathBoundary& boundary, const Entry& entry, double eta,
                             double flown_mm) {
  const int plane = boundary.plane_at(entry.position_mm, entry.normal);
  if (plane < 0) return 0.0;
  const double cos_inside = -entry.direction.dot(entry.normal);
  const Eigen::Vector3d sideways = entry.direction + cos_inside * entry.normal;
  return sideways_growth(
      entry.position_mm, flown_mm / (eta * cos_inside * cos_inside) * sideways,
      [&](const Eigen::Vector3d& x) { return boundary.facet_holding(plane, x) >= 0; });
}

}  // namespace scattermeter
