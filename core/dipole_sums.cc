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
constexpr double kFloor = 1e-30;
// A cluster is worth its series of degree kDegrees[i] from so many points on: measured costs over
// that of a pair, planar or not (tests/bench/dipole_sums_bench.cc).
constexpr std::array<std::int32_t, kSeries> kWorthPlanar = {2, 3, 4, 4, 6};
constexpr std::array<std::int32_t, kSeries> kWorth = {2, 3, 4, 6, 12};
// Float is good for buckets of a radius below so many distances to the pole.
constexpr double kFloatReach = 16.0;
// Blocks whose far clusters are found together.
constexpr std::size_t kTogether = 8;
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
    while (most_series_ > 0 && kDegrees[most_series_ - 1] > sources.largest_degree()) {
      --most_series_;
    }
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
    // limit, by degree; of all the light over its limit.
    std::array<std::array<std::array<float, kSeries>, KernelBounds::kReaches>, KernelBounds::kCells>
        need;
    std::array<float, KernelBounds::kCells> all;
    std::array<std::array<bool, KernelBounds::kReaches>, KernelBounds::kCells> known;
    std::array<bool, KernelBounds::kCells> known_all;
    std::vector<std::int32_t> stack;
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
    s.known.fill({});
    s.known_all.fill(false);
  }

  void know_all(State& s, std::size_t cell) const {
    if (s.known_all[cell]) return;
    s.known_all[cell] = true;
    s.all[cell] = 0.0F;
    for (std::size_t m = 0; m < media_.size(); ++m) {
      const ThreeBounds& most = bounds_.largest(m, cell);
      for (std::size_t q = 0; q < 3; ++q) {
        const double all = double(most[q]) / s.limits[m][q];
        s.all[cell] = std::max(s.all[cell], static_cast<float>(all));
      }
    }
  }

  void know(State& s, std::size_t cell, std::size_t reach) const {
    if (s.known[cell][reach]) return;
    s.known[cell][reach] = true;
    std::array<float, kSeries>& need = s.need[cell][reach];
    need = {};
    for (std::size_t m = 0; m < media_.size(); ++m) {
      for (std::size_t q = 0; q < 3; ++q) {
        const double per_limit = 1.0 / s.limits[m][q];
        for (std::size_t i = 0; i < most_series_; ++i) {
          const double rest = double(bounds_.rest(m, i, reach, cell)[q]);
          need[i] = std::max(need[i], static_cast<float>(rest * per_limit));
        }
      }
    }
  }

  enum class Verdict { kOpen, kSum, kDrop };

  // Whether the cluster is left out for rows at that place, for giving too little; or its series
  // will do, and of which degree: for a row that is so many radii of the place nearer than its
  // middle it is to leave out no more than that share of the limits.
  Verdict judge(State& s, std::int32_t at, const Place& place, double typical_nearer, double share,
                std::vector<Three>& dropped, Accepted& as) const {
    const auto& node = sources_.nodes()[static_cast<std::size_t>(at)];
    ++s.count.tests;
    const double pole2 = bounds_.nearest_pole_mm() * bounds_.nearest_pole_mm();
    const double center = distance(node, place);
    const double d = std::max(0.0, center - place.radius_mm);
    const double nearest2 = d * d + pole2;
    const double radius2 = node.radius_mm * node.radius_mm;
    if (!(radius2 < KernelBounds::kLargestRatio * KernelBounds::kLargestRatio * nearest2)) {
      return Verdict::kOpen;
    }
    if (drop(s, node, d - node.radius_mm, share, dropped)) return Verdict::kDrop;
    if (node.series < 0) return Verdict::kOpen;
    const auto& worth = node.planar ? kWorthPlanar : kWorth;
    const std::int32_t points = node.last - node.first;
    std::size_t last = most_series_;
    while (last > 0 && points < worth[last - 1]) --last;
    if (last == 0) return Verdict::kOpen;
    const std::size_t cell = bounds_.cell(d);
    const std::size_t reach = KernelBounds::reach(cell, bounds_.cell(center + place.radius_mm));
    know(s, cell, reach);
    const double u2 = radius2 / nearest2;
    const auto ratio = static_cast<std::size_t>(32.0 * std::sqrt(u2));
    const double typical = std::max(0.0, center - typical_nearer * place.radius_mm);
    const double v = radius2 / (typical * typical + pole2);
    const auto rest = [&](std::size_t i, double x) {
      const double all = node.weight * double(node.spread[i]) *
                         double(bounds_.tail(i, reach, cell, ratio)) *
                         double(s.need[cell][reach][i]) * x;
      // (a / rho)^(T+1) rho^-1, of degree 1 without.
      const double x2 = x * x;
      switch (i) {
        case 0:
          return all;
        case 1:
          return all * x / node.radius_mm;
        case 2:
          return all * x2 / node.radius_mm;
        case 3:
          return all * x2 * x / node.radius_mm;
        default:
          return all * x2 * x2 / node.radius_mm;
      }
    };
    // Most clusters fail at the highest degree, or never.
    if (!(rest(last - 1, v) <= share)) return Verdict::kOpen;
    std::size_t i = 0;
    while (i + 1 < last && !(rest(i, v) <= share)) ++i;
    // Powers of the place in units of the radius are to be floats. (Degree 1 has another unit.)
    const double far = (center + place.radius_mm + farthest_pole_mm_) / node.radius_mm;
    if (i > 0 && far > 1e3 && (far > 1e10 || std::pow(far, kDegrees[i]) > 1e30)) {
      return Verdict::kOpen;
    }
    as = {at, i, rest(i, u2), std::sqrt(nearest2)};
    return Verdict::kSum;
  }

  // Leaves the cluster out, at least so far from any row, where it gives too little.
  bool drop(State& s, const SourceClusters::Node& node, double nearest, double share,
            std::vector<Three>& error) const {
    if (nearest <= 0.0) return false;
    const std::size_t cell = bounds_.cell(nearest);
    know_all(s, cell);
    if (node.weight * double(s.all[cell]) > share) return false;
    for (std::size_t m = 0; m < media_.size(); ++m) {
      const ThreeBounds& most = bounds_.largest(m, cell);
      for (std::size_t q = 0; q < 3; ++q) error[m][q] += node.weight * double(most[q]);
    }
    ++s.count.dropped;
    return true;
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
    shared.limits = s.limits;
    shared.dropped.assign(media_.size(), {});
    s.stack.assign(1, 0);
    Accepted as;
    while (!s.stack.empty()) {
      const std::int32_t at = s.stack.back();
      s.stack.pop_back();
      const auto& node = sources_.nodes()[static_cast<std::size_t>(at)];
      const Verdict verdict = judge(s, at, place, kTypicalTogether, share, shared.dropped, as);
      if (verdict == Verdict::kDrop) continue;
      if (verdict == Verdict::kSum) {
        shared.accepted.push_back(as);
      } else if (node.left >= 0 && node.radius_mm > 0.5 * place.radius_mm) {
        s.stack.push_back(node.right);
        s.stack.push_back(node.left);
      } else {
        shared.open.push_back(at);
      }
    }
    return shared;
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
          for (const Accepted& as : shared.accepted) add_series(s, block, as);
        }
      }
      for (const Accepted& as : s.accepted) add_series(s, block, as);
      for (const Run& run : s.runs) add_points(s, block, run);
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

  void add_series(State& s, const RowBlocks::Block& block, const Accepted& as) const {
    const auto& node = sources_.nodes()[static_cast<std::size_t>(as.node)];
    const int degree = kDegrees[as.series];
    KernelCluster cluster = sources_.cluster(node);
    if (degree == 1) {
      cluster.radius_mm = distance(node, {block.center_mm, 0.0}) + farthest_pole_mm_;
    }
    add_cluster_sums(dipoles_, block.lanes, cluster, degree, node.weight, s.sums);
    const auto rows = static_cast<std::int64_t>(block.count);
    s.count.series += rows;
    s.count.coefficients +=
        rows * static_cast<std::int64_t>(coefficient_place(degree + 1, 0, node.planar));
  }

  void add_points(State& s, const RowBlocks::Block& block, const Run& run) const {
    const auto& bucket = sources_.nodes()[static_cast<std::size_t>(run.bucket)];
    const Place place{block.center_mm, block.radius_mm};
    const double d = std::max(0.0, distance(bucket, place) - block.radius_mm - bucket.radius_mm);
    const auto pairs = static_cast<std::int64_t>(block.count) * (run.last - run.first);
    s.count.pairs += pairs;
    const double reach = kFloatReach * kFloatReach;
    const double pole = bounds_.nearest_pole_mm();
    if (bucket.radius_mm * bucket.radius_mm <= reach * (d * d + pole * pole)) {
      add_point_sums(dipoles_, block.lanes, sources_.points(run.bucket, run.first, run.last), 1.0,
                     s.sums);
      return;
    }
    s.count.exact_pairs += pairs;
    sources_.add_exact_sums(run.first, run.last, dipoles_, block.lanes, s.sums);
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

  // Bound of what the series leaves out for each row.
  void add_rest(const RowBlocks::Block& block, const Accepted& as, LeftOut& left) const {
    const auto& node = sources_.nodes()[static_cast<std::size_t>(as.node)];
    add_lane_rests(block.lanes, node.center_mm, as.nearest_mm, bounds_.nearest_pole_mm(),
                   kFalls[as.series] / 2, as.rest, left.series.data());
  }

  // What is summed for a block, by that share.
  void plan(State& s, const RowBlocks::Block& block, const Shared* shared, double share) const {
    clear_plan(s);
    s.own.limits = s.limits;
    if (shared != nullptr) {
      s.shared.dropped = shared->dropped;
      s.shared.limits = shared->limits;
      for (const Accepted& as : shared->accepted) add_rest(block, as, s.shared);
      s.stack.assign(shared->open.begin(), shared->open.end());
    } else {
      s.stack.assign(1, 0);
    }
    const Place place{block.center_mm, block.radius_mm};
    Accepted as;
    while (!s.stack.empty()) {
      const std::int32_t at = s.stack.back();
      s.stack.pop_back();
      const auto& node = sources_.nodes()[static_cast<std::size_t>(at)];
      const Verdict verdict = judge(s, at, place, kTypical, share, s.own.dropped, as);
      if (verdict == Verdict::kDrop) continue;
      if (verdict == Verdict::kSum) {
        add_rest(block, as, s.own);
        s.accepted.push_back(as);
      } else if (node.left < 0) {
        add_run(s, node);
      } else {
        s.stack.push_back(node.right);
        s.stack.push_back(node.left);
      }
    }
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
  std::size_t most_series_ = kSeries;
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
