#include "capture/files/polygon_triangulation.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include <Eigen/Geometry>

namespace scattermeter::capture {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Twice the area vector (Newell's sum), relative to the first corner so that no digits cancel far
// from the origin.
Vector3d area_vector(std::span<const Vector3d> corners) {
  Vector3d sum = Vector3d::Zero();
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    sum += (corners[i] - corners[0]).cross(corners[i + 1] - corners[0]);
  }
  return sum;
}

// The polygon projected along its area vector, seen from the side on which it is counter-clockwise.
std::vector<Vector2d> project(std::span<const Vector3d> corners) {
  const Vector3d normal = area_vector(corners).normalized();
  const Vector3d u = normal.unitOrthogonal();
  const Vector3d v = normal.cross(u);
  std::vector<Vector2d> flat;
  flat.reserve(corners.size());
  for (const Vector3d& corner : corners) {
    const Vector3d from_first = corner - corners[0];
    flat.emplace_back(from_first.dot(u), from_first.dot(v));
  }
  return flat;
}

double turn(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

// Upper bound of the rounding error in turn() of three collinear corners: each coordinate is
// rounded to half a unit in the last place (most decimal numbers are not binary ones), the lever
// arm is the size of the polygon, and the projection adds an error of the same size.
double turn_error(std::span<const Vector3d> corners) {
  double largest = 0;
  double size = 0;
  for (const Vector3d& corner : corners) {
    largest = std::max(largest, corner.cwiseAbs().maxCoeff());
    size = std::max(size, (corner - corners[0]).norm());
  }
  return 16 * std::numeric_limits<double>::epsilon() * largest * size;
}

class Clipper {
 public:
  Clipper(std::vector<Vector2d> flat, double flat_turn)
      : flat_(std::move(flat)), flat_turn_(flat_turn), left_(flat_.size()) {
    std::iota(left_.begin(), left_.end(), 0);
  }

  std::vector<std::array<int, 3>> run() {
    std::vector<std::array<int, 3>> triangles;
    std::size_t at = 0;
    while (left_.size() > 3) {
      at = next_ear(at);
      triangles.push_back({corner(at, -1), corner(at, 0), corner(at, 1)});
      left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(at));
      at = at % left_.size();
    }
    if (left_.size() == 3) triangles.push_back({left_[0], left_[1], left_[2]});
    return triangles;
  }

 private:
  int corner(std::size_t at, int step) const {
    const std::size_t n = left_.size();
    return left_[(at + n + static_cast<std::size_t>(step + 1) - 1) % n];
  }
  const Vector2d& point(int idx) const { return flat_[static_cast<std::size_t>(idx)]; }

  // The first ear from `start` on. A corner on a straight line is no ear, as its triangle has no
  // area; it is clipped only after all others. Where there is no ear at all (the polygon intersects
  // itself) `start` is clipped.
  std::size_t next_ear(std::size_t start) const {
    for (std::size_t i = 0; i < left_.size(); ++i) {
      const std::size_t at = (start + i) % left_.size();
      if (is_ear(at)) return at;
    }
    return start;
  }

  bool is_ear(std::size_t at) const {
    const Vector2d& a = point(corner(at, -1));
    const Vector2d& b = point(corner(at, 0));
    const Vector2d& c = point(corner(at, 1));
    if (turn(a, b, c) <= flat_turn_) return false;
    for (const int idx : left_) {
      const Vector2d& p = point(idx);
      if (p == a || p == b || p == c) continue;  // also the doubled corners of a bridge
      const double nearest = std::min({turn(a, b, p), turn(b, c, p), turn(c, a, p)});
      if (nearest >= -flat_turn_) return false;  // inside, or on an edge
    }
    return true;
  }

  std::vector<Vector2d> flat_;
  double flat_turn_;       // turns up to this value are rounding errors
  std::vector<int> left_;  // corners not yet clipped, in order
};

}  // namespace

std::vector<std::array<int, 3>> triangulate_polygon(std::span<const Vector3d> corners_mm) {
  if (corners_mm.size() < 3) return {};
  return Clipper(project(corners_mm), turn_error(corners_mm)).run();
}

}  // namespace scattermeter::capture
