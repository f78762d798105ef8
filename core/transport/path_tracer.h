// Monte Carlo tracing of light paths in a scattering body.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "core/base/random_stream.h"
#include "core/light/diffuse_plane.h"
#include "core/light/entry_source.h"
#include "core/material/fresnel.h"
#include "core/material/phase_function.h"
#include "core/material/rough_boundary.h"
#include "core/material/scattering_medium.h"
#include "core/material/smooth_boundary.h"
#include "core/transport/camera_connection.h"
#include "core/transport/path_boundary.h"
#include "core/transport/path_peers.h"
#include "core/transport/path_plane.h"
#include "core/transport/path_score.h"

namespace scattermeter {

struct PathOptions {
  std::uint64_t seed = 1;
  int paths_per_block = 4096;        // >= 1
  double roulette_weight = 0.1;      // relative to the initial weight; below it, roulette
  int max_scatterings = 10'000'000;  // of one path; its remaining power counts as lost
  // Processes that share the blocks (in trace_blocks with a SentTally); null: all are traced here.
  PathPeers* peers = nullptr;
};

// The body, medium, source, camera and surroundings of the paths. Pointers and references must
// outlive it.
struct PathWorld {
  const PathBoundary& boundary;
  ScatteringMedium medium;
  const EntrySource& source;
  const CameraConnection* camera = nullptr;  // null: no connections
  // Below the body (precondition). Light of the source that meets the plane first belongs to the
  // source (plane_entry()).
  std::optional<DiffusePlane> plane = std::nullopt;
};

// Traces one block of paths, with the same digits wherever and whenever. Weights are such that the
// scores of one block add up to an estimate of the whole; blocks are independent.
//
// A path enters refracted, flies exponential lengths, is scattered, and reflected or let out at the
// surface by a draw with Fresnel's reflectance, or by a rough boundary (RoughBoundary::meet()).
// Absorption lowers its weight (albedo at each scattering) and ends it by roulette only. Light that
// leaves a non-convex body may enter it again, and light that meets the plane is reflected
// diffusely, with its albedo as a factor; otherwise it is an escape.
//
// Sink has escape(const PathScore&): power that leaves for good; and camera(const PathScore&): see
// CameraConnection. With a plane, the camera sees what leaves the body towards it, whether or not
// it then meets the plane; a plane of albedo 0 does not change the camera's scores in any digit.
template <class Sink>
class PathTracer {
 public:
  PathTracer(const PathWorld& world, const PathOptions& options, Sink& sink)
      : world_(world),
        options_(options),
        sink_(sink),
        phase_(world.medium.phase),
        eta_(world.medium.eta_int_over_ext),
        albedo_(world.medium.albedo()),
        mean_free_path_mm_(1.0 / world.medium.sigma_t_per_mm()) {
    world.medium.check();
    if (world.plane) plane_.emplace(*world.plane, world.boundary.size_mm());
    if (world.medium.surface_alpha > 0.0) rough_.emplace(world.medium.surface_alpha, eta_);
  }

  PathAudit trace_block(std::uint64_t block) {
    RandomStream random(options_.seed, block);
    audit_ = {};
    for (int i = 0; i < options_.paths_per_block; ++i) {
      const double stratum = (i + random.uniform()) / options_.paths_per_block;
      const std::optional<Entry> entry = world_.source.sample(stratum, random);
      ++audit_.paths;
      if (entry) trace(*entry, random);
    }
    return audit_;
  }

 private:
  void trace(const Entry& entry, RandomStream& random) {
    Path path{entry.position_mm,
              entry.direction,
              entry.power / options_.paths_per_block,
              0,
              0.0,
              false,
              false};
    audit_.entered += path.weight;
    const double roulette_below = options_.roulette_weight * path.weight;
    double clearance_mm = 0.0;
    Crossing crossing;
    for (;;) {
      double step_mm = -std::log(random.uniform()) * mean_free_path_mm_;
      path.length_mm += step_mm;
      while (step_mm > 0.0) {
        const PathBoundary::Flight flight =
            world_.boundary.fly(path.x, path.direction, step_mm, clearance_mm, crossing);
        if (flight == PathBoundary::Flight::kInside) break;
        if (flight == PathBoundary::Flight::kLost) return lose(path);
        if (leaves(crossing, random, path)) {
          path.length_mm -= step_mm;
          if (!enters_again(crossing, random, path)) return;
          clearance_mm = 0.0;
          path.length_mm += step_mm;
        }
      }
      if (++path.scatterings > options_.max_scatterings) return lose(path);
      ++audit_.scatterings;
      audit_.absorbed += (1.0 - albedo_) * path.weight;
      path.weight *= albedo_;
      if (world_.camera != nullptr) {
        world_.camera->connect(
            {path.x, path.direction, path.weight, path.scatterings, path.length_mm}, random,
            scores_);
        for (const PathScore& score : scores_) sink_.camera(score);
      }
      path.direction = phase_.sample(path.direction, random);
      path.straight = true;
      path.by_plane = false;
      if (path.weight < roulette_below) {
        constexpr double kSurvives = 0.1;
        if (random.uniform() >= kSurvives) {
          audit_.roulette += path.weight;
          return;
        }
        audit_.roulette -= path.weight * (1.0 / kSurvives - 1.0);
        path.weight /= kSurvives;
      }
    }
  }

  struct Path {
    Eigen::Vector3d x;
    Eigen::Vector3d direction;
    double weight;
    int scatterings;
    double length_mm;  // up to the end of the current step
    bool straight;     // as in PathScore
    bool by_plane;
    bool by_several = false;  // as it last met the surface
  };

  // At the surface from inside: reflects (false) or refracts out (true).
  bool leaves(const Crossing& at, RandomStream& random, Path& path) const {
    if (plane_ && plane_->without_gap(at)) return true;
    if (rough_) return passes_rough(at, random, path);
    const double cosine = path.direction.dot(at.normal);
    if (random.uniform() < fresnel_transmittance(1.0 / eta_, cosine)) {
      path.direction = refracted(path.direction, -at.normal, 1.0 / eta_);
      return true;
    }
    path.direction = reflected(path.direction, at.normal);
    path.straight = false;
    return false;
  }

  // At the surface from outside: refracts in (true) or reflects.
  bool enters(const Crossing& at, RandomStream& random, Path& path) const {
    path.straight = false;
    if (rough_) {
      const bool in = passes_rough(at, random, path);
      if (in) path.x = at.point_mm;
      return in;
    }
    const double cosine = -path.direction.dot(at.normal);
    if (random.uniform() < fresnel_transmittance(eta_, cosine)) {
      path.direction = refracted(path.direction, at.normal, eta_);
      path.x = at.point_mm;
      return true;
    }
    path.direction = reflected(path.direction, at.normal);
    return false;
  }

  // From either side.
  bool passes_rough(const Crossing& at, RandomStream& random, Path& path) const {
    const RoughBoundary::Meeting met = rough_->meet(path.direction, at.normal, random);
    path.direction = met.direction;
    path.by_several = met.facets > 1;
    path.straight = path.straight && met.passed && !path.by_several;
    return met.passed;
  }

  // Outside, where it left the body: continues, with any number of reflections by the body and the
  // plane, until it enters the body (true) or its power is gone.
  bool enters_again(const Crossing& left, RandomStream& random, Path& path) {
    if (plane_ && plane_->touches(left)) return returns_at_contact(left, random, path);
    const Eigen::Vector3d left_at = path.x;
    Eigen::Vector3d x = path.x;
    int facet = -1;
    bool by_plane = false;  // by now
    bool on_plane = false;
    for (;;) {
      const std::optional<Crossing> at = on_plane ? world_.boundary.met(x, path.direction)
                                                  : world_.boundary.entering(x, path.direction);
      if (at) {
        if (enters(*at, random, path)) return true;
        x = at->point_mm;
        on_plane = false;
        continue;
      }
      if (!by_plane) {
        facet = world_.boundary.facet_at(left, left_at);
        if (world_.camera != nullptr) {
          const auto seen = world_.camera->not_connected(score_of(path, left_at, facet));
          if (seen) sink_.camera(*seen);
        }
      }
      if (!plane_ || !plane_->below(path.direction)) {
        audit_.escaped += path.weight;
        sink_.escape(by_plane ? score_of(path, x, -1) : score_of(path, left_at, facet));
        return false;
      }
      x = plane_->point_from(x, path.direction);
      if (!reflects(random, path)) return false;
      by_plane = on_plane = true;
    }
  }

  // In the gap between a face and the plane, which is too thin to move sideways.
  bool returns_at_contact(const Crossing& left, RandomStream& random, Path& path) {
    const Crossing here{0.0, path.x, left.normal, left.plane_idx, left.facet_idx};
    if (world_.plane->contact == PlaneContact::kBlack) {
      audit_.in_plane += path.weight;
      return false;
    }
    for (;;) {
      if (!reflects(random, path)) return false;
      if (plane_->without_gap(left) || enters(here, random, path)) return true;
    }
  }

  // On the plane: takes a new direction upwards (true), or all power is absorbed.
  bool reflects(RandomStream& random, Path& path) {
    const double albedo = world_.plane->albedo;
    audit_.in_plane += (1.0 - albedo) * path.weight;
    path.weight *= albedo;
    if (!(path.weight > 0.0)) return false;
    path.direction = diffuse_upwards(random);
    path.straight = false;
    path.by_plane = true;
    return true;
  }

  PathScore score_of(const Path& path, const Eigen::Vector3d& x, int facet) const {
    return {x,
            path.direction,
            facet,
            path.weight,
            path.scatterings,
            path.length_mm,
            path.straight,
            path.by_plane,
            path.by_several};
  }

  void lose(const Path& path) {
    audit_.lost += path.weight;
    ++audit_.lost_paths;
  }

  PathWorld world_;
  PathOptions options_;
  Sink& sink_;
  PhaseFunction phase_;
  double eta_;
  double albedo_;
  double mean_free_path_mm_;
  std::optional<PathPlane> plane_;
  std::optional<RoughBoundary> rough_;
  PathAudit audit_;
  std::vector<PathScore> scores_;
};

}  // namespace scattermeter
