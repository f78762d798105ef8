// Monte Carlo tracing of light paths in a scattering body.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "core/base/random_stream.h"
#include "core/light/entry_source.h"
#include "core/material/eta_change.h"
#include "core/material/fresnel.h"
#include "core/material/phase_function.h"
#include "core/material/rough_boundary.h"
#include "core/material/smooth_boundary.h"
#include "core/transport/deep_scattering.h"
#include "core/transport/light_path.h"
#include "core/transport/path_plane.h"
#include "core/transport/path_score.h"
#include "core/transport/path_world.h"
#include "core/transport/sideways_growth.h"

namespace scattermeter {

// Traces one block of paths, with the same digits wherever and whenever. Weights are such that the
// scores of one block add up to an estimate of the whole; blocks are independent.
//
// A path enters refracted, flies exponential lengths, is scattered, and reflected or let out at the
// surface by a draw with Fresnel's reflectance, or by a rough boundary (RoughBoundary::meet()).
// Absorption lowers its weight (albedo at each scattering) and ends it by roulette only. Light that
// leaves a non-convex body may enter it again, and light that meets the plane is reflected
// diffusely, with its albedo as a factor; otherwise it is an escape.
//
// Deep inside (isotropic_beyond) a path may take the few steps of an isotropic medium in place of
// the many of a phase function of forward peak: light that comes back to the surface from there has
// forgotten by which function it was turned. The scatterings of such a path's score count those
// steps as one each, so that it cannot be weighted for another sigma_s.
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
    if (!phase_.is_isotropic() && std::isfinite(options.isotropic_beyond)) {
      deep_.emplace(world.medium, options.isotropic_beyond);
    }
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
    LightPath path{entry.position_mm, entry.direction, entry.power / options_.paths_per_block};
    path.enter(eta_, -entry.direction.dot(entry.normal));
    path.per_eta = entry_growth(eta_, path.cos_entered);
    audit_.entered += path.weight;
    const double roulette_below = options_.roulette_weight * path.weight;
    double clearance_mm = 0.0;
    Crossing crossing;
    for (;;) {
      if (deep_ && clearance_mm > deep_->enters_mm &&
          !walks_deep(roulette_below, random, path, clearance_mm)) {
        return;
      }
      double step_mm = -std::log(random.uniform()) * mean_free_path_mm_;
      path.length_mm += step_mm;
      while (step_mm > 0.0) {
        const PathBoundary::Flight flight =
            world_.boundary.fly(path.x, path.direction, step_mm, clearance_mm, crossing);
        if (flight == PathBoundary::Flight::kInside) break;
        if (flight == PathBoundary::Flight::kLost) return lose(path);
        if (leaves(crossing, step_mm, random, path)) {
          path.length_mm -= step_mm;
          if (!enters_again(crossing, random, path)) return;
          path.per_eta += std::exchange(path.per_eta_outside, 0.0);
          clearance_mm = 0.0;
          path.length_mm += step_mm;
        }
      }
      if (path.cos_entered > 0.0 && path.flown_from_mm == 0.0) {
        path.per_eta += entry_sideways_growth(world_.boundary, entry, eta_, path.length_mm);
      }
      if (!scatters(albedo_, path)) return;
      if (world_.camera != nullptr) {
        world_.camera->connect(
            {path.x, path.direction, path.weight, path.scatterings, path.length_mm, path.per_eta},
            random, scores_);
        audit_.connections += static_cast<std::int64_t>(scores_.size());
        for (const PathScore& score : scores_) sink_.camera(score);
      }
      if (!turns(phase_, roulette_below, random, path)) return;
    }
  }

  // Until it comes near the surface (true) or its power is gone.
  bool walks_deep(double roulette_below, RandomStream& random, LightPath& path,
                  double& clearance_mm) {
    for (;;) {
      clearance_mm = world_.boundary.clearance_mm(path.x);
      if (clearance_mm < deep_->enters_mm) return true;
      const double step_mm = -std::log(random.uniform()) * deep_->mean_free_path_mm;
      const double within_mm = std::min(step_mm, clearance_mm - deep_->least_mm);
      path.x += within_mm * path.direction;
      path.length_mm += within_mm;
      clearance_mm -= within_mm;
      if (within_mm < step_mm) return true;
      if (!scatters(deep_->albedo, path)) return false;
      if (!turns(PhaseFunction(), roulette_below, random, path)) return false;
    }
  }

  // Counts a scattering and its absorption; false: one too many.
  bool scatters(double albedo, LightPath& path) {
    path.end_flight(eta_, mean_free_path_mm_);
    if (++path.scatterings > options_.max_scatterings) {
      lose(path);
      return false;
    }
    ++audit_.scatterings;
    audit_.absorbed += (1.0 - albedo) * path.weight;
    path.weight *= albedo;
    return true;
  }

  // Takes a new direction; false: ended by roulette.
  bool turns(const PhaseFunction& phase, double roulette_below, RandomStream& random,
             LightPath& path) {
    path.direction = phase.sample(path.direction, random);
    path.straight = true;
    path.by_plane = false;
    if (path.weight >= roulette_below) return true;
    constexpr double kSurvives = 0.1;
    if (random.uniform() >= kSurvives) {
      audit_.roulette += path.weight;
      return false;
    }
    audit_.roulette -= path.weight * (1.0 / kSurvives - 1.0);
    path.weight /= kSurvives;
    return true;
  }

  // At the surface from inside, so far before the step's end: reflects (false) or refracts out
  // (true).
  bool leaves(const Crossing& at, double before_end_mm, RandomStream& random,
              LightPath& path) const {
    if (plane_ && plane_->without_gap(at)) return true;
    if (rough_) return passes_rough(at, random, path);
    const double cosine = path.direction.dot(at.normal);
    if (random.uniform() < fresnel_transmittance(1.0 / eta_, cosine)) {
      path.direction = refracted(path.direction, -at.normal, 1.0 / eta_);
      path.leave(eta_, cosine, path.direction.dot(at.normal), before_end_mm, mean_free_path_mm_);
      return true;
    }
    path.per_eta += fresnel_growth(eta_, false, cosine, false);
    path.direction = reflected(path.direction, at.normal);
    path.straight = false;
    return false;
  }

  // At the surface from outside: refracts in (true) or reflects.
  bool enters(const Crossing& at, RandomStream& random, LightPath& path) const {
    path.straight = false;
    if (rough_) {
      const bool in = passes_rough(at, random, path);
      if (in) path.x = at.point_mm;
      return in;
    }
    const double cosine = -path.direction.dot(at.normal);
    const bool passes = random.uniform() < fresnel_transmittance(eta_, cosine);
    path.per_eta_outside += fresnel_growth(eta_, true, cosine, passes);
    if (passes) {
      path.direction = refracted(path.direction, at.normal, eta_);
      path.enter(eta_, -path.direction.dot(at.normal));
      path.x = at.point_mm;
      return true;
    }
    path.direction = reflected(path.direction, at.normal);
    return false;
  }

  // From either side.
  bool passes_rough(const Crossing& at, RandomStream& random, LightPath& path) const {
    const double cosine = path.direction.dot(at.normal);
    const RoughBoundary::Meeting met = rough_->meet(path.direction, at.normal, random);
    path.direction = met.direction;
    (cosine > 0.0 && !met.passed ? path.per_eta : path.per_eta_outside) +=
        rough_growth(eta_, -cosine, met.passed);
    path.by_several = met.facets > 1;
    path.straight = path.straight && met.passed && !path.by_several;
    return met.passed;
  }

  // Outside, where it left the body: continues, with any number of reflections by the body and the
  // plane, until it enters the body (true) or its power is gone.
  bool enters_again(const Crossing& left, RandomStream& random, LightPath& path) {
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
          const auto seen = world_.camera->not_connected(path.score_at(left_at, facet));
          if (seen) sink_.camera(*seen);
        }
      }
      if (!plane_ || !plane_->below(path.direction)) {
        audit_.escaped += path.weight;
        sink_.escape(by_plane ? path.score_at(x, -1) : path.score_at(left_at, facet));
        return false;
      }
      x = plane_->point_from(x, path.direction);
      if (!reflects(random, path)) return false;
      by_plane = on_plane = true;
    }
  }

  // In the gap between a face and the plane, which is too thin to move sideways.
  bool returns_at_contact(const Crossing& left, RandomStream& random, LightPath& path) {
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
  bool reflects(RandomStream& random, LightPath& path) {
    const double albedo = world_.plane->albedo;
    audit_.in_plane += (1.0 - albedo) * path.weight;
    path.weight *= albedo;
    if (!(path.weight > 0.0)) return false;
    path.direction = diffuse_upwards(random);
    path.straight = false;
    path.by_plane = true;
    return true;
  }

  void lose(const LightPath& path) {
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
  std::optional<DeepScattering> deep_;
  PathAudit audit_;
  std::vector<PathScore> scores_;
};

}  // namespace scattermeter
