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
// Share of the tolerance that a single cluster may use up at first; about 200 do.
constexpr double kShare = 1.0 / 64.0;

using Three = std::array<double, 3>;

// Where rows are.
struct Place {
  Eigen::Vector3d center_mm;
  double radius_mm;
};

// A cluster that is summed by its series, and what that leaves out: own times KernelBounds::rest.
struct Accepted {
  std::int32_t node;
  std::size_t series;
  std::size_t cell;
  double own;
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
    std::vector<std::vector<Three>> light(blocks.size(), std::vector<Three>(media_.size()));
    if (!direct_) {
      for (std::size_t b = 0; b < blocks.size(); ++b) {
        guess(s, {blocks[b].center_mm, blocks[b].radius_mm}, light[b]);
      }
    }
    Shared shared;
    double share = kShare;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      if (!direct_ && shared.share != share) {
        // What remains.
        shared = find_shared(s, blocks.subspan(b), std::span(light).subspan(b), share);
      }
      sum_block(s, blocks[b], order.subspan(blocks[b].first, blocks[b].count), light[b], shared,
                share, out);
    }
    return s.count;
  }

 private:
  // What blocks that stand together have in common.
  struct Shared {
    double share = 0;  // of the tolerance
    std::vector<Accepted> accepted;
    std::vector<std::int32_t> open;
    std::vector<Three> error;
  };
  struct State {
    std::vector<LaneSums> sums;
    std::vector<Three> error, limits;
    // Of a cell of distances, the largest over media and quantities: of a series' rest over its
    // limit, by degree; of all the light over its limit.
    std::array<std::array<float, kSeries>, KernelBounds::kCells> need;
    std::array<float, KernelBounds::kCells> all;
    std::array<bool, KernelBounds::kCells> known;
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

  // What the middle receives, by centres alone, halved for rows in less light.
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
        for (std::size_t q = 0; q < 3; ++q) light[m][q] += 0.5 * node.weight * double(least[q]);
      }
    }
    for (std::size_t m = 0; m < media_.size(); ++m) {
      const Three floor = floor_of(m);
      for (std::size_t q = 0; q < 3; ++q) light[m][q] = std::max(light[m][q], floor[q]);
    }
  }

  void set_limits(State& s, const std::vector<Three>& light, double share) const {
    s.limits.resize(media_.size());
    for (std::size_t m = 0; m < media_.size(); ++m) {
      for (std::size_t q = 0; q < 3; ++q) {
        s.limits[m][q] = share * options_.tolerance * light[m][q];
      }
    }
    s.known.fill(false);
  }

  void know(State& s, std::size_t cell) const {
    if (s.known[cell]) return;
    s.known[cell] = true;
    s.need[cell].fill(0.0F);
    s.all[cell] = 0.0F;
    for (std::size_t m = 0; m < media_.size(); ++m) {
      for (std::size_t q = 0; q < 3; ++q) {
        const double per_limit = 1.0 / s.limits[m][q];
        for (std::size_t i = 0; i < kSeries; ++i) {
          const double rest = double(bounds_.rest(m, i, cell)[q]);
          s.need[cell][i] = std::max(s.need[cell][i], static_cast<float>(rest * per_limit));
        }
        const double all = double(bounds_.largest(m, cell)[q]);
        s.all[cell] = std::max(s.all[cell], static_cast<float>(all * per_limit));
      }
    }
  }

  // Whether the cluster as a whole will do for rows at that place, and how.
  bool accept(State& s, std::int32_t at, double center, const Place& place, Accepted& as) const {
    const auto& node = sources_.nodes()[static_cast<std::size_t>(at)];
    const double pole = bounds_.nearest_pole_mm();
    const double d = std::max(0.0, center - place.radius_mm);
    const double u2 = node.radius_mm * node.radius_mm / (d * d + pole * pole);
    if (!(u2 < KernelBounds::kLargestRatio * KernelBounds::kLargestRatio)) return false;
    const double u = std::sqrt(u2);
    const std::size_t cell = bounds_.cell(d);
    const auto ratio = static_cast<std::size_t>(32.0 * u);
    know(s, cell);
    const double u4 = u2 * u2;
    const std::array<double, kSeries> power = {u2, u2 * u, u4 * u, u4 * u2 * u, u4 * u4 * u};
    const auto own = [&](std::size_t i) {
      return node.weight * double(node.spread[i]) * power[i] * double(bounds_.tail(i, cell, ratio));
    };
    const auto& worth = node.planar ? kWorthPlanar : kWorth;
    const std::int32_t points = node.last - node.first;
    std::size_t last = kSeries;
    while (last > 0 &&
           (kDegrees[last - 1] > sources_.largest_degree() || points < worth[last - 1])) {
      --last;
    }
    if (last == 0) return false;
    // Most clusters fail at the highest degree, or never.
    if (own(last - 1) * double(s.need[cell][last - 1]) > 1.0) return false;
    std::size_t i = 0;
    while (own(i) * double(s.need[cell][i]) > 1.0) ++i;
    // Powers of the place in units of the radius are to be floats. (Degree 1 has another unit.)
    const double reach = (center + place.radius_mm + farthest_pole_mm_) / node.radius_mm;
    if (i > 0 && reach > 1e3 && (reach > 1e10 || std::pow(reach, kDegrees[i]) > 1e30)) return false;
    as = {at, i, cell, own(i)};
    return true;
  }

  void add_error(const Accepted& as, std::vector<Three>& error) const {
    for (std::size_t m = 0; m < media_.size(); ++m) {
      const ThreeBounds& rest = bounds_.rest(m, as.series, as.cell);
      for (std::size_t q = 0; q < 3; ++q) error[m][q] += as.own * double(rest[q]);
    }
  }

  // Leaves the cluster out where it gives too little.
  bool drop(State& s, const SourceClusters::Node& node, double center, const Place& place,
            std::vector<Three>& error) const {
    const double nearest = center - place.radius_mm - node.radius_mm;
    if (nearest <= 0.0) return false;
    const std::size_t cell = bounds_.cell(nearest);
    know(s, cell);
    if (node.weight * double(s.all[cell]) > 1.0) return false;
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
    shared.share = share;
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
    set_limits(s, least, share);
    shared.error.assign(media_.size(), {});
    s.stack.assign(1, 0);
    Accepted as;
    while (!s.stack.empty()) {
      const std::int32_t at = s.stack.back();
      s.stack.pop_back();
      const auto& node = sources_.nodes()[static_cast<std::size_t>(at)];
      ++s.count.tests;
      const double center = distance(node, place);
      if (drop(s, node, center, place, shared.error)) continue;
      if (node.series >= 0 && accept(s, at, center, place, as)) {
        add_error(as, shared.error);
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
    for (int attempt = 0;; ++attempt) {
      s.sums.assign(media_.size(), {});
      s.error.assign(media_.size(), {});
      if (direct_ || attempt > 4) {
        s.stack.assign(1, 0);
        visit(s, block, true);
      } else {
        set_limits(s, light, share);
        if (attempt == 0) {
          s.error = shared.error;
          for (const Accepted& as : shared.accepted) add_series(s, block, as);
          s.stack.assign(shared.open.begin(), shared.open.end());
        } else {
          s.stack.assign(1, 0);
        }
        visit(s, block, false);
      }
      worst = worst_error(s, block, light);
      if (worst <= options_.tolerance) break;
      ++s.count.repeated_blocks;
      // So that the neighbours need no second attempt.
      share *= std::min(0.7, 0.7 * options_.tolerance / worst);
    }
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

  // The largest error relative to what the rows received; `light` is then that.
  double worst_error(const State& s, const RowBlocks::Block& block,
                     std::vector<Three>& light) const {
    double worst = 0.0;
    for (std::size_t m = 0; m < media_.size(); ++m) {
      const Three floor = floor_of(m);
      Three least;
      least.fill(std::numeric_limits<double>::infinity());
      for (std::size_t i = 0; i < block.count; ++i) {
        const double value = s.sums[m].value[i];
        least[0] = std::min(least[0], value);
        // z psi_1 + z^3 psi_2 where z_d_z sums z psi_1 - z^3 psi_2.
        least[1] = std::min(least[1], 2.0 * value - s.sums[m].z_d_z[i]);
        least[2] = std::min(least[2], s.sums[m].decay[i]);
      }
      for (std::size_t q = 0; q < 3; ++q) {
        // Of the sums only their errors are known.
        const double error = s.error[m][q] + (q == 1 ? 2.0 * s.error[m][0] : 0.0);
        light[m][q] = std::max(least[q] - error, floor[q]);
        worst = std::max(worst, s.error[m][q] / light[m][q]);
      }
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

  // Points of one bucket that follow each other.
  struct Run {
    std::int32_t bucket = -1, first = 0, last = 0;
  };

  void add_points(State& s, const RowBlocks::Block& block, const Run& run) const {
    if (run.bucket < 0) return;
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

  // All that the stack holds.
  void visit(State& s, const RowBlocks::Block& block, bool all_pairs) const {
    const Place place{block.center_mm, block.radius_mm};
    Accepted as;
    Run run;
    while (!s.stack.empty()) {
      const std::int32_t at = s.stack.back();
      s.stack.pop_back();
      const auto& node = sources_.nodes()[static_cast<std::size_t>(at)];
      if (!all_pairs) {
        ++s.count.tests;
        const double center = distance(node, place);
        if (drop(s, node, center, place, s.error)) continue;
        if (node.series >= 0 && accept(s, at, center, place, as)) {
          add_error(as, s.error);
          add_series(s, block, as);
          continue;
        }
      }
      if (node.left < 0) {
        if (run.bucket == node.bucket && run.last == node.first) {
          run.last = node.last;
        } else {
          add_points(s, block, run);
          run = {node.bucket, node.first, node.last};
        }
      } else {
        s.stack.push_back(node.right);
        s.stack.push_back(node.left);
      }
    }
    add_points(s, block, run);
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
    std::vector<DipoleSumsCount> counts((blocks.size() + kTogether - 1) / kTogether);
    oneapi::tbb::parallel_for(
        oneapi::tbb::blocked_range<std::size_t>(0, counts.size(), 1), [&](const auto& range) {
          for (std::size_t i = range.begin(); i != range.end(); ++i) {
            const std::size_t first = i * kTogether;
            counts[i] = sums.sum(blocks.subspan(first, std::min(kTogether, blocks.size() - first)),
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
