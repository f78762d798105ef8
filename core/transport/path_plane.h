// Paths between a body and the diffuse plane below it.
#pragma once

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

#include "core/base/random_stream.h"
#include "core/light/diffuse_plane.h"
#include "core/transport/path_boundary.h"

namespace scattermeter {

// The plane as paths meet it that come from a body above.
class PathPlane {
 public:
  PathPlane(const DiffusePlane& plane, double body_size_mm)
      : plane_(plane),
        touching_mm_(DiffusePlane::touching_mm(body_size_mm)),
        farthest_mm_(1e6 * body_size_mm) {}

  // Whether the surface lies on the plane there.
  bool touches(const Crossing& at) const {
    constexpr double kFlat = 1.0 - 1e-9;
    return at.normal.z() < -kFlat && at.point_mm.z() - plane_.z_mm < touching_mm_;
  }
  // Whether it lies on it without a gap of air.
  bool without_gap(const Crossing& at) const {
    return plane_.contact == PlaneContact::kOptical && touches(at);
  }
  bool below(const Eigen::Vector3d& direction) const { return direction.z() < 0.0; }
  // Where light from x meets the plane. Precondition: below(direction). Not farther than 10^6 sizes
  // of the body, from where nothing comes back.
  Eigen::Vector3d point_from(const Eigen::Vector3d& x, const Eigen::Vector3d& direction) const {
    const double t = std::max(0.0, (x.z() - plane_.z_mm) / -direction.z());
    Eigen::Vector3d at = x + std::min(t, farthest_mm_) * direction;
    at.z() = plane_.z_mm;
    return at;
  }

 private:
  DiffusePlane plane_;
  double touching_mm_;
  double farthest_mm_;
};

// A direction of light that a plane z = const reflects upwards after Lambert.
inline Eigen::Vector3d diffuse_upwards(RandomStream& random) {
  const RandomStream::DiscPoint p = random.disc();
  return {p.x, p.y, std::sqrt(1.0 - p.r2)};
}

}  // namespace scattermeter
