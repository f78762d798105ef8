#include "core/transport/camera_connection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include <Eigen/Geometry>

#include "core/material/eta_change.h"
#include "core/material/fresnel.h"
#include "core/mesh/facet_visibility.h"
#include "core/transport/path_plane.h"

namespace scattermeter {
namespace {

// Connections are always made down to this optical depth; below, with the probability that light
// comes up from there rather than from here.
constexpr double kSureDepth = 0.7;
// Relative to the body's size: a point this far beyond a plane still counts as on the body.
constexpr double kOnBody = 1e-9;

}  // namespace

CameraConnection::CameraConnection(const PathBoundary& boundary,
                                   const Eigen::Vector3d& camera_in_world_mm,
                                   const ScatteringMedium& medium, int most_walls)
    : boundary_(boundary),
      camera_mm_(camera_in_world_mm),
      eta_(medium.eta_int_over_ext),
      sigma_t_(medium.sigma_t_per_mm()),
      most_walls_(most_walls),
      phase_(medium.phase) {
  medium.check();
  const std::vector<BodyPlane>& planes = boundary.body().planes;
  cone_ = std::make_shared<EscapeCone>(eta_, medium.surface_alpha);
  if (medium.surface_alpha > 0.0) {
    rough_.emplace(medium.surface_alpha, eta_);
    of_more_eta_.emplace(medium.surface_alpha, eta_ + kEtaStep);
  }
  const TriangleMesh& mesh = boundary.scene().mesh();
  if (planes.empty() || rough_) {
    beams_ = std::make_shared<FacetBeams>(mesh, camera_mm_, eta_);
    return;
  }
  std::vector<bool> seen(mesh.triangles.size(), true);  // of a convex body, all that faces it
  if (!boundary.body().convex) seen = surely_seen(mesh, camera_mm_);
  for (std::size_t k = 0; k < planes.size(); ++k) {
    const double height_mm = -planes[k].depth_mm(camera_mm_);
    if (!(height_mm > 0.0)) continue;
    const bool all_seen =
        std::all_of(planes[k].facets.begin(), planes[k].facets.end(),
                    [&](int facet) { return seen[static_cast<std::size_t>(facet)]; });
    windows_.push_back(
        {static_cast<int>(k), height_mm, camera_mm_ - height_mm * planes[k].normal, all_seen});
  }
}

CameraConnection CameraConnection::with(const ScatteringMedium& medium,
                                        const std::optional<DiffusePlane>& plane) const {
  medium.check();
  if (medium.eta_int_over_ext != eta_) {
    throw std::invalid_argument(
        "CameraConnection: eta_int_over_ext = " + std::to_string(medium.eta_int_over_ext) +
        ", built for " + std::to_string(eta_));
  }
  if (medium.surface_alpha != (rough_ ? rough_->alpha() : 0.0)) {
    throw std::invalid_argument(
        "CameraConnection: surface_alpha = " + std::to_string(medium.surface_alpha) + " differs");
  }
  CameraConnection other = *this;
  other.sigma_t_ = medium.sigma_t_per_mm();
  other.phase_ = medium.phase;
  other.no_mirror_ = -1;
  if (plane && plane->contact == PlaneContact::kOptical) {
    const std::vector<BodyPlane>& planes = boundary_.body().planes;
    const PathPlane below(*plane, boundary_.size_mm());
    for (std::size_t k = 0; k < planes.size(); ++k) {
      Crossing at;
      at.normal = planes[k].normal;
      at.point_mm = planes[k].offset_mm * planes[k].normal;
      if (below.touches(at)) other.no_mirror_ = static_cast<int>(k);
    }
  }
  return other;
}

void CameraConnection::connect(const Vertex& vertex, RandomStream& random,
                               std::vector<PathScore>& scores) const {
  scores.clear();
  const std::vector<BodyPlane>& planes = boundary_.body().planes;
  // A connection whose path is at least b long is made where b < deepest: with probability
  // min(1, exp(kSureDepth - sigma_t b)).
  const double deepest_mm = (kSureDepth - std::log(random.uniform())) / sigma_t_;
  if (rough_) return through_rough_facets(vertex, deepest_mm, random, scores);
  if (beams_) return through_facets(vertex, deepest_mm, scores);
  std::array<int, PathBoundary::kFewPlanes> near{};
  int n_near = 0;
  for (std::size_t k = 0; k < planes.size(); ++k) {
    // A point of a body that is not convex may lie before some planes: those do not reflect light
    // to it.
    const double depth_mm = planes[k].depth_mm(vertex.x);
    if (depth_mm < deepest_mm && depth_mm > 0.0)
      near[static_cast<std::size_t>(n_near++)] = static_cast<int>(k);
  }
  if (n_near == 0) return;
  const auto all_windows = [&](const Image& image, double bound_mm) {
    for (const Window& w : windows_) {
      if (image.n_walls > 0 && w.plane_idx == image.walls[image.n_walls - 1]) continue;
      through(w, image, vertex, deepest_mm, bound_mm, scores);
    }
  };
  all_windows({vertex.x, vertex.x, {-1, -1}, 0}, 0.0);
  for (int i = 0; most_walls_ > 0 && i < n_near; ++i) {
    const int a = near[static_cast<std::size_t>(i)];
    if (a == no_mirror_) continue;
    const BodyPlane& wall = planes[static_cast<std::size_t>(a)];
    const double to_wall_mm = wall.depth_mm(vertex.x);
    const Eigen::Vector3d once = vertex.x + 2.0 * to_wall_mm * wall.normal;
    all_windows({once, vertex.x, {a, -1}, 1}, to_wall_mm);
    for (std::size_t b = 0; most_walls_ > 1 && b < planes.size(); ++b) {
      if (static_cast<int>(b) == a || static_cast<int>(b) == no_mirror_) continue;
      const double to_second_mm = planes[b].depth_mm(once);
      if (!(to_second_mm > 0.0 && to_second_mm < deepest_mm)) continue;
      all_windows({once + 2.0 * to_second_mm * planes[b].normal, once, {a, static_cast<int>(b)}, 2},
                  std::max(to_wall_mm, to_second_mm));
    }
  }
}

// `least_bound_mm`: a lower bound of the path's length, of the walls.
void CameraConnection::through(const Window& window, const Image& image, const Vertex& vertex,
                               double deepest_mm, double least_bound_mm,
                               std::vector<PathScore>& scores) const {
  const std::vector<BodyPlane>& planes = boundary_.body().planes;
  const BodyPlane& plane = planes[static_cast<std::size_t>(window.plane_idx)];
  const double depth_mm = plane.depth_mm(image.x);
  if (!(depth_mm > 0.0)) return;
  const double bound_mm = std::max(depth_mm, least_bound_mm);
  if (!(bound_mm < deepest_mm)) return;
  const double beyond_mm = -kOnBody * boundary_.size_mm();
  const bool convex = boundary_.body().convex;
  // Most passages are not on the body, which is told from where they may lie.
  const auto [near, far] =
      passage_between(image.x, depth_mm, plane.normal, window.foot, window.height_mm, eta_);
  if (!convex && plane.box.is_beside(near, far, -beyond_mm)) return;
  for (std::size_t k = 0; convex && k < planes.size(); ++k) {
    if (planes[k].depth_mm(near) < beyond_mm && planes[k].depth_mm(far) < beyond_mm) return;
  }
  const Passage to_camera =
      passage_to(image.x, depth_mm, plane.normal, window.foot, window.height_mm, eta_);
  const auto& [ray, passage, moved] = to_camera;
  const auto on_body = [&](const auto& p) {
    return boundary_.body().least_depth_mm(p) >= beyond_mm;
  };
  if (convex && !on_body(passage)) return;
  int facet = convex ? -1 : boundary_.facet_holding(window.plane_idx, passage);
  if (!convex && facet < 0) return;

  // Back from the passage, wall by wall, to the scattering itself.
  Eigen::Vector3d from = passage;
  Eigen::Vector3d toward = image.x;
  Way walls{1.0, depth_growth(eta_, ray.cos_inside, sigma_t_ * ray.length_mm), image.n_walls == 0};
  for (int i = image.n_walls - 1; i >= 0; --i) {
    const BodyPlane& wall = planes[static_cast<std::size_t>(image.walls[i])];
    const double before_mm = wall.depth_mm(from);
    const double behind_mm = -wall.depth_mm(toward);
    if (!(before_mm > 0.0 && behind_mm > 0.0)) return;
    const Eigen::Vector3d way = toward - from;
    const Eigen::Vector3d point = from + before_mm / (before_mm + behind_mm) * way;
    if (convex ? !on_body(point) : !boundary_.reaches_plane(from, point, image.walls[i])) return;
    const double cosine = way.dot(wall.normal) / way.norm();
    walls.share *= 1.0 - fresnel_transmittance(1.0 / eta_, cosine);
    walls.per_eta += fresnel_growth(eta_, false, cosine, false);
    toward = i > 0 ? image.before_last : vertex.x;
    from = point;
  }
  const Eigen::Vector3d outgoing = (from - toward).normalized();
  if (!convex && !boundary_.clear_inside(toward, from)) return;
  if (convex) {
    facet = boundary_.facet_of_plane(window.plane_idx, passage);
  } else if (!window.surely_seen) {
    facet = boundary_.facet_seen(camera_mm_, passage, window.plane_idx);
    if (facet < 0) return;
  }
  push(vertex, to_camera, facet, outgoing, walls, bound_mm, scores);
}

void CameraConnection::through_facets(const Vertex& vertex, double deepest_mm,
                                      std::vector<PathScore>& scores) const {
  if (boundary_.clearance_mm(vertex.x) > deepest_mm) return;
  beams_->for_candidates(vertex.x, deepest_mm, [&](const FacetBeams::Facet& facet) {
    const double depth_mm = facet.normal.dot(facet.foot - vertex.x);
    if (!(depth_mm > 0.0 && depth_mm < deepest_mm)) return;
    const auto [near, far] =
        passage_between(vertex.x, depth_mm, facet.normal, facet.foot, facet.height_mm, eta_);
    if (!facet.may_hold(near, far)) return;
    const Passage to_camera =
        passage_to(vertex.x, depth_mm, facet.normal, facet.foot, facet.height_mm, eta_);
    const auto& [ray, passage, moved] = to_camera;
    if (!(ray.length_mm < deepest_mm)) return;
    if (!may_be_seen(vertex, facet, passage)) return;
    push(vertex, to_camera, facet.facet_idx, (passage - vertex.x).normalized(),
         {1.0, depth_growth(eta_, ray.cos_inside, sigma_t_ * ray.length_mm)}, ray.length_mm,
         scores);
  });
}

void CameraConnection::through_rough_facets(const Vertex& vertex, double deepest_mm,
                                            RandomStream& random,
                                            std::vector<PathScore>& scores) const {
  if (boundary_.clearance_mm(vertex.x) > deepest_mm) return;
  const RoughBoundary::Facet tilted = rough_->draw_facet(random);
  const Eigen::Vector3d way = camera_mm_ - vertex.x;
  const double distance_mm = way.norm();
  const Eigen::Vector3d to_camera = way / distance_mm;
  // The facets' beams were made for the camera's rays to them, this one is to the point.
  const double turn_rad = std::atan(tilted.tan_tilt) + deepest_mm / distance_mm;
  const auto share = [&](const RoughBoundary& rough, const RoughBoundary::Passage& through) {
    return rough.share(to_camera, tilted, through) / rough.smooth_transmittance(through.cos_viewer);
  };
  beams_->for_turned_candidates(
      vertex.x, deepest_mm, turn_rad, [&](const FacetBeams::Facet& facet) {
        const double depth_mm = facet.normal.dot(facet.foot - vertex.x);
        if (!(depth_mm > 0.0 && depth_mm < deepest_mm)) return;
        const auto through = rough_->pass(to_camera, facet.normal, tilted);
        if (!through) return;
        const double length_mm = depth_mm / through->cos_inside;
        if (!(length_mm < deepest_mm)) return;
        const Eigen::Vector3d passage = vertex.x - length_mm * through->direction;
        if (!may_be_seen(vertex, facet, passage)) return;
        const auto density = [&](const RoughBoundary& rough, const RoughBoundary::Passage& p) {
          return share(rough, p) * std::exp(-sigma_t_ * depth_mm / p.cos_inside) / p.cos_inside;
        };
        const auto changed = of_more_eta_->pass(to_camera, facet.normal, tilted);
        const double before = density(*rough_, *through);
        const double per_eta = changed && before > 0.0
                                   ? (density(*of_more_eta_, *changed) / before - 1.0) / kEtaStep
                                   : 0.0;
        // Trace of d (direction) / dx, with d (ray) / dx = (1 - ray ray^T) / distance.
        const double cos_ray = to_camera.dot(through->facet_normal);
        const double trace_per_mm =
            (2.0 - through->stretch * (1.0 - cos_ray * cos_ray)) / (eta_ * distance_mm);
        push(vertex,
             {{0.0, length_mm, through->cos_inside, 1.0 + length_mm * trace_per_mm}, passage},
             facet.facet_idx, -through->direction, {share(*rough_, *through), per_eta}, length_mm,
             scores);
      });
}

// The passage lies on the facet, nothing is in the way from there to the camera, nor to the point.
bool CameraConnection::may_be_seen(const Vertex& vertex, const FacetBeams::Facet& facet,
                                   const Eigen::Vector3d& passage) const {
  if (!facet.holds(passage)) return false;
  if (boundary_.convex()) return true;
  return (facet.surely_seen || !boundary_.scene().occluded(passage, facet.normal, camera_mm_)) &&
         boundary_.clear_inside(vertex.x, passage);
}

std::optional<PathScore> CameraConnection::not_connected(const PathScore& escape) const {
  const bool connected = beams_ ? escape.straight : !escape.by_plane;
  if (connected || escape.scatterings == 0) return std::nullopt;
  const Eigen::Vector3d to_camera = (camera_mm_ - escape.point_mm).normalized();
  const Eigen::Vector3d& normal = boundary_.facet_normal(escape.facet_idx);
  const double cosine = to_camera.dot(normal);
  const double cos_half = escape.by_several ? EscapeCone::kCosWideHalf : EscapeCone::kCosHalf;
  if (!(cosine > 0.0) || escape.direction.dot(to_camera) < cos_half) return std::nullopt;
  if (!boundary_.convex() && boundary_.scene().occluded(escape.point_mm, normal, camera_mm_)) {
    return std::nullopt;
  }
  PathScore score = escape;
  score.direction = to_camera;
  const double axis = rough_ ? std::max(RoughBoundary::kLeastCosine, cosine) : cosine;
  score.per_eta -= 2.0 / eta_;
  score.weight =
      std::numbers::pi * escape.weight /
      (escape.by_several ? cone_->transmitting_by_several_sr(axis) : cone_->transmitting_sr(axis));
  return score;
}

// `bound_mm`: the lower bound of the path's length that decided whether it was made.
void CameraConnection::push(const Vertex& vertex, const Passage& to_camera, int facet,
                            const Eigen::Vector3d& outgoing, const Way& way, double bound_mm,
                            std::vector<PathScore>& scores) const {
  const auto& [ray, passage, moved_mm_per_eta] = to_camera;
  const double probability = std::min(1.0, std::exp(kSureDepth - sigma_t_ * bound_mm));
  scores.push_back(
      {passage, (camera_mm_ - passage).normalized(), facet,
       std::numbers::pi / (eta_ * eta_) * vertex.weight * way.share *
           phase_.per_sr(vertex.before.dot(outgoing)) * std::exp(-sigma_t_ * ray.length_mm) /
           (ray.cos_inside * ray.spread * probability),
       vertex.scatterings, vertex.length_mm + ray.length_mm,
       vertex.per_eta + way.per_eta - 2.0 / eta_, way.straight, false, false, moved_mm_per_eta});
}

}  // namespace scattermeter
