#include "core/dipole_sums.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include "core/dipole.h"
#include "core/kernel_bounds.h"

namespace scattermeter {
namespace {

constexpr std::size_t kSeries = std::size(kDegrees);
constexpr std::size_t kBoundCells = KernelBounds::kCells, kReaches = KernelBounds::kReaches;
constexpr double kFloor = 1e-30;
// Float is good for buckets of a radius below so many distances to the pole.
constexpr double kFloatReach = 16.0;
// Blocks whose far clusters are found together.
constexpr std::size_t kTogether = 8;
// A table for limits that differ by this factor at most among quantities costs less than it saves.
constexpr double kAlike = 1.05;
// Blocks that are summed one after the other, each by what the one before has learned.
constexpr std::size_t kInTurn = 32;
// Share of the tolerance that a single cluster may use up for a typical row of a block, at first;
// then as much as fits.
constexpr double kShare = 1.0 / 16.0;
// A cluster's series is judged by a row that is nearer than the middle of its block, or of blocks
// that are looked at together, by so many of their radii.
// Rows of a block receive at least so much of what its middle does, mostly.
constexpr double kDarker = 0.8;
constexpr double kTypical = 0.9;
constexpr double kTypicalTogether = 0.9;

// Of a series, planar or not.
constexpr auto kCoefficients = [] {
  std::array<std::array<std::int64_t, kSeries>, 2> count{};
  for (std::size_t planar = 0; planar < 2; ++planar) {
    for (std::size_t i = 0; i < kSeries; ++i) {
      count[planar][i] =
          static_cast<std::int64_t>(coefficient_place(kDegrees[i] + 1, 0, planar == 1));
    }
  }
  return count;
}();

using Three = std::array<double, 3>;

// Where rows are.
struct Place {
  Eigen::Vector3d center_mm;
  double radius_mm;
};

// A cluster that is summed by its series, and what that leaves out for the nearest row there may
// be, over what it may.
struct Accepted {
  std::int32_t node;
  std::size_t series;
  double rest;
  double nearest_mm;  // of the nearest pole
};

// What is left out: of clusters as a whole; and of series, for each row, over the limits that were
// set.
struct LeftOut {
  std::vector<Three> dropped;
  std::vector<Three> limits;
  alignas(64) std::array<double, kRowLanes> series;
};

class BlockSums {
 public:
  BlockSums(const SourceClusters& sources, std::span<const Medium> media,
            std::span<const KernelDipole> dipoles, const DipoleSumsOptions& options)
      : sources_(sources),
        media_(media),
        dipoles_(dipoles),
        options_(options),
        bounds_(dipoles),
        direct_(sources.size() <= options.direct_up_to) {
    for (const KernelDipole& d : dipoles) farthest_pole_mm_ = std::max(farthest_pole_mm_, d.z_v_mm);
  }

  // Sums of neighbouring blocks of rows.
  DipoleSumsCount sum(std::span<const RowBlocks::Block> blocks,
                      std::span<const std::uint32_t> order,
                      std::span<std::vector<DipoleSum>> out) const {
    State s;
    s.sums.resize(media_.size());
    double share = kShare;
    for (std::size_t first = 0; first < blocks.size(); first += kTogether) {
      const auto together = blocks.subspan(first, std::min(kTogether, blocks.size() - first));
      std::vector<std::vector<Three>> light(together.size(), std::vector<Three>(media_.size()));
      Shared shared;
      if (!direct_) {
        for (std::size_t b = 0; b < together.size(); ++b) {
          guess(s, {together[b].center_mm, together[b].radius_mm}, light[b]);
        }
        shared = find_shared(s, together, light, share);
      }
      for (std::size_t b = 0; b < together.size(); ++b) {
        const RowBlocks::Block& block = together[b];
        sum_block(s, block, order.subspan(block.first, block.count), light[b], shared, share, out);
      }
    }
    return s.count;
  }

 private:
  // What blocks that stand together have in common.
  struct Shared {
    std::vector<Accepted> accepted;
    std::vector<std::int32_t> open;
    std::vector<Three> dropped;
    std::vector<Three> limits;
    Place place;
  };
  // Points of one bucket that follow each other.
  struct Run {
    std::int32_t bucket = -1, first = 0, last = 0;
  };
  struct State {
    std::vector<LaneSums> sums;
    // Largest error that is allowed, of each medium.
    std::vector<Three> limits;
    // What a block's sums are made of, and what they leave out.
    std::vector<Accepted> accepted;
    std::vector<Run> runs;
    LeftOut shared, own;
    // Of a cell of distances, the largest over media and quantities: of a series' rest over its
    // limit, by degree and reach; of all the light over its limit.
    std::vector<float> need, all;
    std::vector<Three> known;  // the limits they are told for
    std::vector<std::int32_t> stack, next, verdicts, open, leaves;
    std::vector<float> rests, nearest_mm;
    std::vector<LaneRest> lane_rests;
    std::vector<KernelSeries> series;
    std::vector<KernelPoints> points;
    DipoleSumsCount count;
  };

  Three floor_of(std::size_t m) const {
    const ThreeBounds& here = bounds_.largest(m, 0);
    return {kFloor * double(here[0]), kFloor * double(here[1]), kFloor * double(here[2])};
  }

  static double distance(const SourceClusters::Node& node, const Place& place) {
    const double x = node.center_mm[0] - place.center_mm.x();
    const double y = node.center_mm[1] - place.center_mm.y();
    const double z = node.center_mm[2] - place.center_mm.z();
    return std::sqrt(x * x + y * y + z * z);
  }

  // What the middle receives, by centres alone, less for rows in less light.
  void guess(State& s, const Place& place, std::vector<Three>& light) const {
    for (Three& t : light) t.fill(0.0);
    s.stack.assign(1, 0);
    const auto& nodes = sources_.nodes();
    while (!s.stack.empty()) {
      const auto& node = nodes[static_cast<std::size_t>(s.stack.back())];
      s.stack.pop_back();
      ++s.count.tests;
      const double d = distance(node, place);
      if (node.left >= 0 && node.radius_mm > d + bounds_.nearest_pole_mm()) {
        s.stack.push_back(node.right);
        s.stack.push_back(node.left);
        continue;
      }
      const std::size_t cell = bounds_.cell(d);
      for (std::size_t m = 0; m < media_.size(); ++m) {
        const ThreeBounds& least = bounds_.least(m, cell);
        for (std::size_t q = 0; q < 3; ++q) light[m][q] += kDarker * node.weight * double(least[q]);
      }
    }
    for (std::size_t m = 0; m < media_.size(); ++m) {
      const Three floor = floor_of(m);
      for (std::size_t q = 0; q < 3; ++q) light[m][q] = std::max(light[m][q], floor[q]);
    }
  }

  void set_limits(State& s, const std::vector<Three>& light) const {
    s.limits.resize(media_.size());
    for (std::size_t m = 0; m < media_.size(); ++m) {
      for (std::size_t q = 0; q < 3; ++q) s.limits[m][q] = options_.tolerance * light[m][q];
    }
  }

  // Tables for those limits, for places up to so far from the middle of all clusters.
  void know(State& s, const std::vector<Three>& limits, double farthest_mm) const {
    const std::size_t cells = bounds_.cell(farthest_mm + 1.1 * sources_.nodes()[0].radius_mm) + 2;
    const std::size_t end = std::min(cells, kBoundCells);
    s.known = limits;
    s.need.assign(kSeries * kReaches * kBoundCells, 0.0F);
    s.all.assign(kBoundCells, 0.0F);
    for (std::size_t m = 0; m < media_.size(); ++m) {
      ThreeBounds per_limit;
      for (std::size_t q = 0; q < 3; ++q) {
        per_limit[q] = static_cast<float>((1.0 + 1e-6) / limits[m][q]);
      }
      const auto raise = [&](const ThreeBounds* bounds, float* to) {
        for (std::size_t k = 0; k < end; ++k) {
          const float most = std::max({bounds[k][0] * per_limit[0], bounds[k][1] * per_limit[1],
                                       bounds[k][2] * per_limit[2]});
          to[k] = std::max(to[k], most);
        }
      };
      raise(&bounds_.largest(m, 0), s.all.data());
      for (std::size_t i = 0; i < kSeries * kReaches; ++i) {
        raise(bounds_.rests(m, i / kReaches) + i % kReaches * kBoundCells,
              &s.need[i * kBoundCells]);
      }
    }
  }

  // Whether the clusters are left out for rows at that place, for giving too little; or their
  // series will do, and of which degree: for a row that is so many radii of the place nearer than
  // its middle each is to leave out no more than that share of the limits.
  void judge(State& s, std::span<const std::int32_t> nodes, const Place& place, double typical,
             double share) const {
    VerdictPlace p;
    const double* const middle = sources_.nodes()[0].center_mm;
    double far = sources_.nodes()[0].radius_mm;
    for (int i = 0; i < 3; ++i) {
      const double at = place.center_mm[i] - middle[i];
      p.center_mm[i] = static_cast<float>(at);
      far += std::abs(at);
    }
    p.radius_mm = static_cast<float>(1.000001 * place.radius_mm);
    p.slack_mm = static_cast<float>(1e-6 * far);
    p.typical = static_cast<float>(typical);
    p.share = static_cast<float>(share);
    p.nearest_pole_mm = static_cast<float>(bounds_.nearest_pole_mm());
    p.farthest_pole_mm = static_cast<float>(farthest_pole_mm_);
    p.per_cell_unit = static_cast<float>(bounds_.cells_per_mm());
    p.need = s.need.data();
    p.all = s.all.data();
    p.tail = bounds_.tails();
    const std::size_t room = nodes.size() + kRowLanes;
    if (s.verdicts.size() < room) {
      s.verdicts.resize(room);
      s.rests.resize(room);
      s.nearest_mm.resize(room);
    }
    s.count.tests += static_cast<std::int64_t>(nodes.size());
    judge_clusters(sources_.traits(), nodes, p,
                   {s.verdicts.data(), s.rests.data(), s.nearest_mm.data()});
  }

  // The clusters in s.stack and their parts: those whose series will do are accepted, others
  // opened, unless smaller than `smallest_mm` or leaves: s.open.
  void choose(State& s, const Place& place, double typical, double share, double smallest_mm,
              std::vector<Accepted>& accepted, std::vector<Three>& dropped) const {
    const auto& nodes = sources_.nodes();
    s.open.clear();
    while (!s.stack.empty()) {
      judge(s, s.stack, place, typical, share);
      s.next.clear();
      for (std::size_t k = 0; k < s.stack.size(); ++k) {
        const std::int32_t at = s.stack[k];
        const auto& node = nodes[static_cast<std::size_t>(at)];
        if (s.verdicts[k] >= 0) {
          accepted.push_back({at, static_cast<std::size_t>(s.verdicts[k]), double(s.rests[k]),
                              double(s.nearest_mm[k])});
        } else if (s.verdicts[k] == kVerdictDrop) {
          const std::size_t cell = bounds_.cell(double(s.nearest_mm[k]));
          for (std::size_t m = 0; m < media_.size(); ++m) {
            const ThreeBounds& most = bounds_.largest(m, cell);
            for (std::size_t q = 0; q < 3; ++q) dropped[m][q] += node.weight * double(most[q]);
          }
          ++s.count.dropped;
        } else if (node.left >= 0 && node.radius_mm > smallest_mm) {
          for (const std::int32_t part : {node.left, node.right}) {
            s.next.push_back(part);
            __builtin_prefetch(sources_.traits() + part);
            __builtin_prefetch(&nodes[static_cast<std::size_t>(part)]);
            __builtin_prefetch(&nodes[static_cast<std::size_t>(part)].first);
          }
        } else {
          s.open.push_back(at);
        }
      }
      std::swap(s.stack, s.next);
    }
  }

  Shared find_shared(State& s, std::span<const RowBlocks::Block> blocks,
                     std::span<const std::vector<Three>> light, double share) const {
    Shared shared;
    Eigen::Vector3d low = blocks[0].center_mm, high = low;
    std::vector<Three> least = light[0];
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      const Eigen::Vector3d r = Eigen::Vector3d::Constant(blocks[b].radius_mm);
      low = low.cwiseMin(blocks[b].center_mm - r);
      high = high.cwiseMax(blocks[b].center_mm + r);
      for (std::size_t m = 0; m < media_.size(); ++m) {
        for (std::size_t q = 0; q < 3; ++q) least[m][q] = std::min(least[m][q], light[b][m][q]);
      }
    }
    Place place{0.5 * (low + high), 0.0};
    for (const RowBlocks::Block& b : blocks) {
      place.radius_mm =
          std::max(place.radius_mm, (b.center_mm - place.center_mm).norm() + b.radius_mm);
    }
    set_limits(s, least);
    know_at(s, s.limits, place);
    shared.place = place;
    shared.limits = s.limits;
    shared.dropped.assign(media_.size(), {});
    s.stack.assign(1, 0);
    choose(s, place, kTypicalTogether, share, 0.5 * place.radius_mm, shared.accepted,
           shared.dropped);
    shared.open = s.open;
    return shared;
  }

  void know_at(State& s, const std::vector<Three>& limits, const Place& place) const {
    const Eigen::Map<const Eigen::Vector3d> middle(sources_.nodes()[0].center_mm);
    know(s, limits, (place.center_mm - middle).norm() + place.radius_mm);
  }

  void sum_block(State& s, const RowBlocks::Block& block, std::span<const std::uint32_t> rows,
                 std::vector<Three>& light, const Shared& shared, double& share,
                 std::span<std::vector<DipoleSum>> out) const {
    s.count.rows += static_cast<std::int64_t>(block.count);
    double worst = 0.0;
    // A block of its own kind is not to rule those after it.
    const double least_share = 0.3 * share;
    for (int attempt = 0;; ++attempt) {
      s.sums.assign(media_.size(), {});
      if (direct_ || attempt > 4) {
        plan_all(s);
      } else {
        set_limits(s, light);
        if (fit_plan(s, block, attempt == 0 ? &shared : nullptr, share)) {
          add_series(s, block, shared.accepted);
        }
      }
      add_series(s, block, s.accepted);
      add_points(s, block);
      worst = worst_error(s, block, light);
      if (worst <= options_.tolerance) break;
      ++s.count.repeated_blocks;
      share *= std::min(0.7, 0.7 * options_.tolerance / worst);
    }
    share = std::max(share, least_share);
    s.count.certified_error = std::max(s.count.certified_error, worst);
    const double scale = sources_.weight();
    for (std::size_t m = 0; m < media_.size(); ++m) {
      const LaneSums& sums = s.sums[m];
      for (std::size_t i = 0; i < block.count; ++i) {
        out[m][rows[i]] = dipole_sum(media_[m], {scale * sums.value[i], scale * sums.z_d_z[i],
                                                 -0.5 * scale * sums.decay[i]});
      }
    }
  }

  // The largest error relative to what the rows received; `light` is then what they did at least.
  double worst_error(const State& s, const RowBlocks::Block& block,
                     std::vector<Three>& light) const {
    double worst = 0.0;
    for (std::size_t m = 0; m < media_.size(); ++m) {
      const Three floor = floor_of(m);
      Three least;
      least.fill(std::numeric_limits<double>::infinity());
      for (std::size_t i = 0; i < block.count; ++i) {
        const double value = s.sums[m].value[i];
        // z psi_1 + z^3 psi_2 where z_d_z sums z psi_1 - z^3 psi_2.
        const Three sum = {value, 2.0 * value - s.sums[m].z_d_z[i], s.sums[m].decay[i]};
        Three error;
        for (std::size_t q = 0; q < 3; ++q) {
          error[q] = s.shared.dropped[m][q] + s.own.dropped[m][q] +
                     s.shared.limits[m][q] * s.shared.series[i] +
                     s.own.limits[m][q] * s.own.series[i];
        }
        for (std::size_t q = 0; q < 3; ++q) {
          // Of the sums only their errors are known.
          const double received =
              std::max(sum[q] - error[q] - (q == 1 ? 2.0 * error[0] : 0.0), floor[q]);
          least[q] = std::min(least[q], received);
          worst = std::max(worst, error[q] / received);
        }
      }
      light[m] = least;
    }
    return worst;
  }

  void add_series(State& s, const RowBlocks::Block& block,
                  std::span<const Accepted> accepted) const {
    s.series.clear();
    const auto rows = static_cast<std::int64_t>(block.count);
    s.count.series += rows * static_cast<std::int64_t>(accepted.size());
    for (const Accepted& as : accepted) {
      const auto& node = sources_.nodes()[static_cast<std::size_t>(as.node)];
      const int degree = kDegrees[as.series];
      s.series.push_back({sources_.cluster(node), degree, node.weight});
      if (degree == 1) {
        s.series.back().cluster.radius_mm =
            distance(node, {block.center_mm, 0.0}) + farthest_pole_mm_;
      }
      s.count.coefficients += rows * kCoefficients[node.planar][as.series];
    }
    add_cluster_sums(dipoles_, block.lanes, s.series, s.sums);
  }

  void add_points(State& s, const RowBlocks::Block& block) const {
    const Place place{block.center_mm, block.radius_mm};
    const double reach = kFloatReach * kFloatReach;
    const double pole = bounds_.nearest_pole_mm();
    s.points.clear();
    for (const Run& run : s.runs) {
      const auto& bucket = sources_.nodes()[static_cast<std::size_t>(run.bucket)];
      const auto pairs = static_cast<std::int64_t>(block.count) * (run.last - run.first);
      s.count.pairs += pairs;
      const double d = std::max(0.0, distance(bucket, place) - block.radius_mm - bucket.radius_mm);
      if (bucket.radius_mm * bucket.radius_mm <= reach * (d * d + pole * pole)) {
        s.points.push_back(sources_.points(run.bucket, run.first, run.last));
      } else {
        s.count.exact_pairs += pairs;
        sources_.add_exact_sums(run.first, run.last, dipoles_, block.lanes, s.sums);
      }
    }
    add_point_sums(dipoles_, block.lanes, s.points, 1.0, s.sums);
  }

  void add_run(State& s, const SourceClusters::Node& leaf) const {
    if (!s.runs.empty() && s.runs.back().bucket == leaf.bucket &&
        s.runs.back().last == leaf.first) {
      s.runs.back().last = leaf.last;
    } else {
      s.runs.push_back({leaf.bucket, leaf.first, leaf.last});
    }
  }

  void clear_plan(State& s) const {
    s.accepted.clear();
    s.runs.clear();
    for (LeftOut* left : {&s.shared, &s.own}) {
      left->dropped.assign(media_.size(), {});
      left->limits.assign(media_.size(), {});
      left->series.fill(0.0);
    }
  }

  void plan_all(State& s) const {
    clear_plan(s);
    for (const auto& node : sources_.nodes()) {
      if (node.left < 0) add_run(s, node);
    }
  }

  // Bounds of what the series leave out for each row.
  void add_rests(State& s, const RowBlocks::Block& block, std::span<const Accepted> accepted,
                 LeftOut& left) const {
    s.lane_rests.clear();
    for (const Accepted& as : accepted) {
      const double* const c = sources_.nodes()[static_cast<std::size_t>(as.node)].center_mm;
      s.lane_rests.push_back({{c[0], c[1], c[2]}, as.nearest_mm, as.rest, kFalls[as.series] / 2});
    }
    add_lane_rests(block.lanes, s.lane_rests, bounds_.nearest_pole_mm(), left.series.data());
  }

  // What is summed for a block, by that share of its limits.
  void plan(State& s, const RowBlocks::Block& block, const Shared* shared, double share) const {
    clear_plan(s);
    // Tables are made for the limits that neighbours share; where a block's own are not about the
    // same multiple of each, for its own.
    double larger = 1.0;
    bool alike = shared != nullptr;
    if (shared != nullptr) {
      s.shared.dropped = shared->dropped;
      s.shared.limits = shared->limits;
      add_rests(s, block, shared->accepted, s.shared);
      s.stack.assign(shared->open.begin(), shared->open.end());
      double least = std::numeric_limits<double>::infinity(), most = 0.0;
      for (std::size_t m = 0; m < media_.size(); ++m) {
        for (std::size_t q = 0; q < 3; ++q) {
          const double ratio = s.limits[m][q] / shared->limits[m][q];
          least = std::min(least, ratio);
          most = std::max(most, ratio);
        }
      }
      alike = most <= kAlike * least;
      if (alike) larger = least;
    } else {
      s.stack.assign(1, 0);
    }
    const Place place{block.center_mm, block.radius_mm};
    s.own.limits = alike ? shared->limits : s.limits;
    if (s.known != s.own.limits) know_at(s, s.own.limits, alike ? shared->place : place);
    choose(s, place, kTypical, share * larger, 0.0, s.accepted, s.own.dropped);
    add_rests(s, block, s.accepted, s.own);
    std::sort(s.open.begin(), s.open.end());
    for (const std::int32_t at : s.open) add_run(s, sources_.nodes()[static_cast<std::size_t>(at)]);
  }

  // The largest error of a row over the tolerance, by the light that was guessed.
  double planned_error(const State& s) const {
    double worst = 0.0;
    for (std::size_t m = 0; m < media_.size(); ++m) {
      for (std::size_t q = 0; q < 3; ++q) {
        for (std::size_t i = 0; i < kRowLanes; ++i) {
          const double error = s.shared.dropped[m][q] + s.own.dropped[m][q] +
                               s.shared.limits[m][q] * s.shared.series[i] +
                               s.own.limits[m][q] * s.own.series[i];
          worst = std::max(worst, error / s.limits[m][q]);
        }
      }
    }
    return worst;
  }

  // A plan that uses most of the tolerance; whether with what is shared.
  bool fit_plan(State& s, const RowBlocks::Block& block, const Shared* shared,
                double& share) const {
    // Of the tolerance, by a light that is only guessed.
    constexpr double kWanted = 0.75, kEnough = 0.15, kMost = 0.9;
    const double before = share;
    for (int attempt = 0;; ++attempt) {
      plan(s, block, shared, share);
      const double error = planned_error(s);
      const bool last = attempt >= 3;
      if (error > kMost) {
        if (attempt == 3) {
          // What is shared may be at fault.
          shared = nullptr;
          share = before;
        }
        if (attempt > 6) return false;
        share *= std::max(0.1, kWanted / error);
      } else if (error < kEnough && !last && share < 1.0) {
        share *= std::min(4.0, kWanted / std::max(error, 1e-3));
      } else {
        // For the next block; this one is good enough.
        share *= std::clamp(kWanted / error, 0.9, 1.25);
        return shared != nullptr;
      }
    }
  }

  const SourceClusters& sources_;
  std::span<const Medium> media_;
  std::span<const KernelDipole> dipoles_;
  const DipoleSumsOptions& options_;
  KernelBounds bounds_;
  bool direct_;
  double farthest_pole_mm_ = 0;
};

void add_count(const DipoleSumsCount& c, DipoleSumsCount& total) {
  total.rows += c.rows;
  total.pairs += c.pairs;
  total.exact_pairs += c.exact_pairs;
  total.series += c.series;
  total.coefficients += c.coefficients;
  total.dropped += c.dropped;
  total.tests += c.tests;
  total.repeated_blocks += c.repeated_blocks;
  total.certified_error = std::max(total.certified_error, c.certified_error);
}

}  // namespace

DipoleSumsCount sum_dipoles(const SourceClusters& sources, const RowBlocks& rows,
                            std::span<const Medium> media, std::span<std::vector<DipoleSum>> out,
                            const DipoleSumsOptions& options) {
  if (!(options.tolerance >= 1e-5 && options.tolerance <= 0.5)) {
    std::ostringstream text;
    text << "sum_dipoles: tolerance " << options.tolerance << " not in 1e-5 .. 0.5";
    throw std::invalid_argument(text.str());
  }
  bool sized = out.size() == media.size();
  for (const auto& o : out) sized = sized && o.size() == rows.size();
  if (!sized) throw std::invalid_argument("sum_dipoles: outputs are not media times rows");
  std::vector<KernelDipole> dipoles;
  for (const Medium& m : media) {
    const Dipole dipole(m);
    dipoles.push_back({dipole.z_r_mm(), dipole.z_v_mm(), dipole.sigma_tr_per_mm()});
  }
  DipoleSumsCount total;
  if (media.empty() || rows.size() == 0 || sources.empty()) {
    for (auto& o : out) std::fill(o.begin(), o.end(), DipoleSum{});
    total.rows = static_cast<std::int64_t>(rows.size());
  } else {
    const BlockSums sums(sources, media, dipoles, options);
    const std::span<const RowBlocks::Block> blocks = rows.blocks();
    std::vector<DipoleSumsCount> counts((blocks.size() + kInTurn - 1) / kInTurn);
    oneapi::tbb::parallel_for(
        oneapi::tbb::blocked_range<std::size_t>(0, counts.size(), 1), [&](const auto& range) {
          for (std::size_t i = range.begin(); i != range.end(); ++i) {
            const std::size_t first = i * kInTurn;
            counts[i] = sums.sum(blocks.subspan(first, std::min(kInTurn, blocks.size() - first)),
                                 rows.order(), out);
          }
        });
    for (const DipoleSumsCount& c : counts) add_count(c, total);
    total.certified_error += kDipoleSumsRounding;
  }
  total.points = static_cast<std::int64_t>(sources.size());
  total.points_left_out = static_cast<std::int64_t>(sources.left_out());
  return total;
}

}  // namespace scattermeter
