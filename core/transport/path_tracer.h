// Monte Carlo tracing of light paths in a scattering body.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "core/base/random_stream.h"
#include "core/light/entry_source.h"
#include "core/material/fresnel.h"
#include "core/material/henyey_greenstein.h"
#include "core/material/scattering_medium.h"
#include "core/material/smooth_boundary.h"
#include "core/transport/camera_connection.h"
#include "core/transport/path_boundary.h"
#include "core/transport/path_peers.h"
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

// The body, medium, source and camera of the paths. Pointers and references must outlive it.
struct PathWorld {
  const PathBoundary& boundary;
  ScatteringMedium medium;
  const EntrySource& source;
  const CameraConnection* camera = nullptr;  // null: no connections
};

// Traces one block of paths, with the same digits wherever and whenever. Weights are such that the
// scores of one block add up to an estimate of the whole; blocks are independent.
//
// A path enters refracted, flies exponential lengths, is scattered after Henyey and Greenstein and
// reflected or let out at the surface by a draw with Fresnel's reflectance. Absorption lowers its
// weight (albedo at each scattering) and ends it by roulette only. Light that leaves a non-convex
// body may enter it again; otherwise it is an escape.
//
// Sink has escape(const PathScore&): power that leaves for good; and camera(const PathScore&): see
// CameraConnection.
template <class Sink>
class PathTracer {
 public:
  PathTracer(const PathWorld& world, const PathOptions& options, Sink& sink)
      : world_(world),
        options_(options),
        sink_(sink),
        phase_(world.medium.g),
        eta_(world.medium.eta_int_over_ext),
        albedo_(world.medium.albedo()),
        mean_free_path_mm_(1.0 / world.medium.sigma_t_per_mm()) {
    world.medium.check();
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
    Path path{
        entry.position_mm, entry.direction, entry.power / options_.paths_per_block, 0, 0.0, false};
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
          const Eigen::Vector3d left_at = path.x;
          if (!enters_again(random, path)) {
            escape(crossing, left_at, path);
            return;
          }
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
  };

  // At the surface from inside: reflects (false) or refracts out (true).
  bool leaves(const Crossing& at, RandomStream& random, Path& path) const {
    const double cosine = path.direction.dot(at.normal);
    if (random.uniform() < fresnel_transmittance(1.0 / eta_, cosine)) {
      path.direction = refracted(path.direction, -at.normal, 1.0 / eta_);
      return true;
    }
    path.direction = reflected(path.direction, at.normal);
    path.straight = false;
    return false;
  }

  // Outside: continues, with any number of external reflections, until it enters the body (true) or
  // leaves for good.
  bool enters_again(RandomStream& random, Path& path) const {
    Eigen::Vector3d x = path.x;
    while (const std::optional<Crossing> at = world_.boundary.entering(x, path.direction)) {
      x = at->point_mm;
      path.straight = false;
      const double cosine = -path.direction.dot(at->normal);
      if (random.uniform() < fresnel_transmittance(eta_, cosine)) {
        path.direction = refracted(path.direction, at->normal, eta_);
        path.x = x;
        return true;
      }
      path.direction = reflected(path.direction, at->normal);
    }
    return false;
  }

  // `at`, `x`: where it left; path.direction is the final one.
  void escape(const Crossing& at, const Eigen::Vector3d& x, const Path& path) {
    audit_.escaped += path.weight;
    const PathScore score{x,
                          path.direction,
                          world_.boundary.facet_at(at, x),
                          path.weight,
                          path.scatterings,
                          path.length_mm,
                          path.straight};
    sink_.escape(score);
    if (world_.camera == nullptr) return;
    if (const auto seen = world_.camera->not_connected(score)) sink_.camera(*seen);
  }

  void lose(const Path& path) {
    audit_.lost += path.weight;
    ++audit_.lost_paths;
  }

  PathWorld world_;
  PathOptions options_;
  Sink& sink_;
  HenyeyGreenstein phase_;
  double eta_;
  double albedo_;
  double mean_free_path_mm_;
  PathAudit audit_;
  std::vector<PathScore> scores_;
};

}  // namespace scattermeter
