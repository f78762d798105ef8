#include "core/transport/path_boundary.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

namespace scattermeter {
namespace {

constexpr double kGrain = 2e-6;     // of the body's size: a few ulp of a float
constexpr double kOffEdges = 16.0;  // grains
constexpr std::size_t kFewFacets = 8;

}  // namespace

PathBoundary::PathBoundary(const RayScene& scene, Method method)
    : scene_(scene),
      box_(bounds(scene.mesh())),
      size_mm_(box_.size_mm().maxCoeff()),
      grain_mm_(kGrain * size_mm_),
      body_(body_planes(scene.mesh(), kFewPlanes)),
      convex_(body_.planes.empty() ? scene.convex() : body_.convex),
      by_planes_(body_.convex && method == Method::kAuto) {
  const TriangleMesh& mesh = scene.mesh();
  for (int f = 0; f < static_cast<int>(mesh.triangles.size()); ++f) {
    const Eigen::Vector3d area_mm2 = area_vector_mm2(mesh, f);
    normal_.push_back(area_mm2.normalized());
    const auto& corner = mesh.triangles[static_cast<std::size_t>(f)];
    offset_mm_.push_back(normal_.back().dot(mesh.vertices_mm[static_cast<std::size_t>(corner[0])]));
    if (body_.planes.empty()) continue;
    const double twice_area_mm2 = 2.0 * area_mm2.norm();
    FacetWeights weights;
    for (std::size_t i = 0; i < 3; ++i) {
      const Eigen::Vector3d& a = mesh.vertices_mm[static_cast<std::size_t>(corner[i])];
      const Eigen::Vector3d& b = mesh.vertices_mm[static_cast<std::size_t>(corner[(i + 1) % 3])];
      weights.per_mm[i] = normal_.back().cross(b - a) / twice_area_mm2;
      weights.at_origin[i] = -weights.per_mm[i].dot(a);
    }
    weights_.push_back(weights);
  }
  if (!by_planes_) grid_.emplace(mesh);
}

PathBoundary::Flight PathBoundary::fly_by_planes(Eigen::Vector3d& x,
                                                 const Eigen::Vector3d& direction, double& step_mm,
                                                 double& clearance_mm, Crossing& crossing) const {
  const Eigen::Vector3d end = x + step_mm * direction;
  clearance_mm = body_.least_depth_mm(end);
  if (clearance_mm > 0.0) {
    x = end;
    step_mm = 0.0;
    return Flight::kInside;
  }
  clearance_mm = 0.0;
  double nearest_mm = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < body_.planes.size(); ++k) {
    const BodyPlane& p = body_.planes[k];
    const double cosine = p.normal.dot(direction);
    if (!(cosine > 0.0)) continue;
    const double t = p.depth_mm(x) / cosine;
    if (t < nearest_mm) {
      nearest_mm = t;
      crossing.plane_idx = static_cast<int>(k);
    }
  }
  // A plane passed backwards alone: rounding, at the end of a step along it.
  if (nearest_mm >= step_mm) {
    x = end;
    step_mm = 0.0;
    return Flight::kInside;
  }
  crossing.distance_mm = std::max(0.0, nearest_mm);
  crossing.normal = body_.planes[static_cast<std::size_t>(crossing.plane_idx)].normal;
  crossing.facet_idx = -1;
  x += crossing.distance_mm * direction;
  crossing.point_mm = x;
  step_mm -= crossing.distance_mm;
  return Flight::kAtSurface;
}

PathBoundary::Flight PathBoundary::fly_by_rays(Eigen::Vector3d& x, const Eigen::Vector3d& direction,
                                               double& step_mm, double& clearance_mm,
                                               Crossing& crossing) const {
  clearance_mm = grid_->at(x);
  if (clearance_mm < 0.0) return Flight::kLost;
  if (step_mm >= clearance_mm && !in_one_cell(x, x + step_mm * direction, 0.0)) {
    bool lost = false;
    const std::optional<Crossing> met = passed(x, direction, step_mm, 1.0, lost);
    if (lost) return Flight::kLost;
    if (met) {
      crossing = *met;
      x = crossing.point_mm;
      step_mm -= crossing.distance_mm;
      clearance_mm = 0.0;
      return Flight::kAtSurface;
    }
  }
  x += step_mm * direction;
  clearance_mm = std::max(0.0, clearance_mm - step_mm);
  step_mm = 0.0;
  return Flight::kInside;
}

std::optional<Crossing> PathBoundary::passed(const Eigen::Vector3d& x,
                                             const Eigen::Vector3d& direction, double within_mm,
                                             double side, bool& lost) const {
  const Eigen::Vector3d start = x - grain_mm_ * direction;
  double from_mm = 0.0;
  lost = false;
  for (;;) {
    const RayHit hit = scene_.first_hit_between(start, direction, from_mm, within_mm + grain_mm_);
    if (hit.facet_idx < 0) return std::nullopt;
    const auto f = static_cast<std::size_t>(hit.facet_idx);
    const double cosine = normal_[f].dot(direction);
    if (cosine * side > 0.0) {
      // The distance from the plane, unless the ray grazes it.
      const double by_ray_mm = hit.distance - grain_mm_;
      const double by_plane_mm = (offset_mm_[f] - normal_[f].dot(x)) / cosine;
      const double distance_mm = std::max(
          0.0, std::abs(by_plane_mm - by_ray_mm) < 100.0 * grain_mm_ ? by_plane_mm : by_ray_mm);
      if (distance_mm > within_mm) return std::nullopt;
      return Crossing{distance_mm, off_the_edges(hit.facet_idx, x + distance_mm * direction),
                      normal_[f], -1, hit.facet_idx};
    }
    if (hit.distance > 3.0 * grain_mm_) {
      lost = true;
      return std::nullopt;
    }
    // Not by a step of the float: that is lost where the processor flushes denormal numbers.
    from_mm = hit.distance + 1e-3 * grain_mm_;
  }
}

Eigen::Vector3d PathBoundary::off_the_edges(int facet, const Eigen::Vector3d& x) const {
  const auto& t = scene_.mesh().triangles[static_cast<std::size_t>(facet)];
  const auto corner = [&](std::size_t i) -> const Eigen::Vector3d& {
    return scene_.mesh().vertices_mm[static_cast<std::size_t>(t[i % 3])];
  };
  const Eigen::Vector3d center = (corner(0) + corner(1) + corner(2)) / 3.0;
  double share = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector3d inward =
        normal_[static_cast<std::size_t>(facet)].cross(corner(i + 1) - corner(i)).normalized();
    const double from_center_mm = inward.dot(center - corner(i));
    const double wanted_mm = std::min(kOffEdges * grain_mm_, 0.1 * from_center_mm);
    const double mm = inward.dot(x - corner(i));
    if (mm < wanted_mm) share = std::max(share, (wanted_mm - mm) / (from_center_mm - mm));
  }
  return x + share * (center - x);
}

std::optional<Crossing> PathBoundary::entering(const Eigen::Vector3d& x,
                                               const Eigen::Vector3d& direction) const {
  if (convex_) return std::nullopt;
  bool lost = false;  // then the direction grazes the facet that was left
  return passed(x, direction, 4.0 * size_mm_, -1.0, lost);
}

std::optional<Crossing> PathBoundary::met(const Eigen::Vector3d& x,
                                          const Eigen::Vector3d& direction) const {
  // From the sphere around the body: rays keep their digits near it only.
  const Eigen::Vector3d to_center = box_.center_mm() - x;
  const double along_mm = to_center.dot(direction);
  const double radius_mm = 0.5 * box_.size_mm().norm() + grain_mm_;
  const double half2_mm2 = radius_mm * radius_mm - to_center.squaredNorm() + along_mm * along_mm;
  if (!(half2_mm2 > 0.0)) return std::nullopt;
  const double half_mm = std::sqrt(half2_mm2);
  if (along_mm + half_mm < 0.0) return std::nullopt;
  const Eigen::Vector3d start = x + std::max(0.0, along_mm - half_mm) * direction;
  if (!by_planes_) {
    bool lost = false;
    return passed(start, direction, 2.0 * half_mm, -1.0, lost);
  }
  double enters_mm = -std::numeric_limits<double>::infinity();
  double leaves_mm = -enters_mm;
  Crossing at;
  for (std::size_t k = 0; k < body_.planes.size(); ++k) {
    const BodyPlane& p = body_.planes[k];
    const double cosine = p.normal.dot(direction);
    const double depth_mm = p.depth_mm(start);
    if (cosine == 0.0) {
      if (depth_mm < 0.0) return std::nullopt;
      continue;
    }
    const double t = depth_mm / cosine;
    if (cosine > 0.0) {
      leaves_mm = std::min(leaves_mm, t);
    } else if (t > enters_mm) {
      enters_mm = t;
      at.plane_idx = static_cast<int>(k);
    }
  }
  if (!(enters_mm < leaves_mm && enters_mm >= 0.0)) return std::nullopt;
  at.distance_mm = enters_mm;
  at.point_mm = start + enters_mm * direction;
  at.normal = body_.planes[static_cast<std::size_t>(at.plane_idx)].normal;
  return at;
}

bool PathBoundary::clear_inside(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const {
  if (convex_) return true;
  const Eigen::Vector3d way = to - from;
  const double length_mm = way.norm();
  if (length_mm <= 3.0 * grain_mm_) return true;
  if (grid_->at(from) > length_mm || in_one_cell(from, to, grain_mm_)) return true;
  bool lost = false;
  const auto met = passed(from, way / length_mm, length_mm, 1.0, lost);
  return !lost && (!met || met->distance_mm > length_mm - 3.0 * grain_mm_);
}

bool PathBoundary::reaches_plane(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                                 int plane) const {
  if (facet_holding(plane, to) < 0) return false;
  if (in_one_cell(from, to, grain_mm_)) return true;
  const Eigen::Vector3d way = to - from;
  const double length_mm = way.norm();
  bool lost = false;
  const auto met = passed(from, way / length_mm, length_mm + 3.0 * grain_mm_, 1.0, lost);
  return met && body_.plane_of_facet[static_cast<std::size_t>(met->facet_idx)] == plane &&
         met->distance_mm > length_mm - 3.0 * grain_mm_;
}

int PathBoundary::facet_seen(const Eigen::Vector3d& from, const Eigen::Vector3d& x,
                             int plane) const {
  const Eigen::Vector3d way = x - from;
  const RayHit hit = scene_.first_hit(from, way);
  if (hit.facet_idx < 0 || body_.plane_of_facet[static_cast<std::size_t>(hit.facet_idx)] != plane ||
      std::abs(hit.distance - 1.0) * way.norm() > 1e-4 * size_mm_) {
    return -1;
  }
  return hit.facet_idx;
}

bool PathBoundary::in_one_cell(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                               double beyond_mm) const {
  for (const BodyPlane& p : body_.planes) {
    const double at_mm = p.depth_mm(from);
    const double to_mm = p.depth_mm(to);
    const bool behind =
        (at_mm > grain_mm_ && to_mm > -beyond_mm) || (at_mm > -grain_mm_ && to_mm > grain_mm_);
    if (!behind && !(at_mm < -grain_mm_ && to_mm < -grain_mm_)) return false;
  }
  return !body_.planes.empty();
}

int PathBoundary::facet_by_ray(int plane, const Eigen::Vector3d& x) const {
  const Eigen::Vector3d& normal = body_.planes[static_cast<std::size_t>(plane)].normal;
  const double back_mm = 1e-3 * size_mm_;
  const RayHit hit = scene_.first_hit_between(x + back_mm * normal, -normal, 0.0, 2.0 * back_mm);
  const bool is_it =
      hit.facet_idx >= 0 && body_.plane_of_facet[static_cast<std::size_t>(hit.facet_idx)] == plane;
  return is_it ? hit.facet_idx : -1;
}

int PathBoundary::facet_of_plane(int plane, const Eigen::Vector3d& x) const {
  if (body_.planes[static_cast<std::size_t>(plane)].facets.size() > kFewFacets) {
    if (const int facet = facet_by_ray(plane, x); facet >= 0) return facet;
  }
  return nearest_of_plane(plane, x).facet;
}

int PathBoundary::facet_holding(int plane, const Eigen::Vector3d& x) const {
  if (body_.planes[static_cast<std::size_t>(plane)].facets.size() > kFewFacets) {
    return facet_by_ray(plane, x);
  }
  const Nearest nearest = nearest_of_plane(plane, x);
  return nearest.least_weight > -kGrain ? nearest.facet : -1;
}

int PathBoundary::plane_at(const Eigen::Vector3d& x, const Eigen::Vector3d& normal) const {
  for (std::size_t k = 0; k < body_.planes.size(); ++k) {
    const BodyPlane& plane = body_.planes[k];
    if (std::abs(plane.depth_mm(x)) < grain_mm_ && plane.normal.dot(normal) > 0.9999) {
      return static_cast<int>(k);
    }
  }
  return -1;
}

PathBoundary::Nearest PathBoundary::nearest_of_plane(int plane, const Eigen::Vector3d& x) const {
  // The facet that the point is inside of, or nearest to, by its smallest barycentric weight.
  Nearest best{-1, -std::numeric_limits<double>::infinity()};
  for (const int facet : body_.planes[static_cast<std::size_t>(plane)].facets) {
    const FacetWeights& w = weights_[static_cast<std::size_t>(facet)];
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 3; ++i) {
      least = std::min(least, w.per_mm[i].dot(x) + w.at_origin[i]);
    }
    if (least > best.least_weight) best = {facet, least};
  }
  return best;
}

}  // namespace scattermeter
