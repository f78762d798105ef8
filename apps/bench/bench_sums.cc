#include "apps/bench/bench_sums.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <sstream>
#include <stdexcept>
#include <utility>

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>

#include "core/base/growth_exponent.h"
#include "core/base/median.h"
#include "core/material/fresnel.h"
#include "core/sums/dipole_pairs.h"
#include "core/sums/dipole_sums.h"

namespace scattermeter::apps {
namespace {

using Points = std::vector<Eigen::Vector3d>;

struct SumsScene {
  Points points;
  std::vector<double> c;
  Points rows;
};

Eigen::Vector3d surface_point(const std::string& body, std::mt19937_64& random) {
  constexpr double kHalf_mm = 10.0;
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Eigen::Vector3d p;
  if (body == "sphere") {
    do {
      for (int i = 0; i < 3; ++i) p[i] = uniform(random);
    } while (p.squaredNorm() > 1.0 || p.squaredNorm() < 1e-4);
    return kHalf_mm * p.normalized();
  }
  for (int i = 0; i < 3; ++i) p[i] = uniform(random);
  const auto face = random() % 6;
  p[static_cast<Eigen::Index>(face % 3)] = face < 3 ? -1.0 : 1.0;
  return kHalf_mm * p;
}

// Distant light from (1, -2, 3) and some from everywhere: no patch is dark, so that none can be
// left out.
SumsScene sums_scene(const std::string& body, std::size_t patches, std::size_t rows,
                     std::uint64_t seed) {
  std::mt19937_64 random(seed);
  SumsScene scene;
  const Eigen::Vector3d light = Eigen::Vector3d(1.0, -2.0, 3.0).normalized();
  for (std::size_t i = 0; i < patches; ++i) {
    const Eigen::Vector3d p = surface_point(body, random);
    Eigen::Vector3d normal = p.normalized();
    if (body == "cube") {
      Eigen::Index axis = 0;
      p.cwiseAbs().maxCoeff(&axis);
      normal = Eigen::Vector3d::Zero();
      normal[axis] = p[axis] > 0.0 ? 1.0 : -1.0;
    }
    scene.points.push_back(p);
    scene.c.push_back((0.1 + std::max(0.0, normal.dot(light))) / static_cast<double>(patches));
  }
  for (std::size_t i = 0; i < rows; ++i) scene.rows.push_back(surface_point(body, random));
  return scene;
}

// Wall time, median over the runs.
double median_seconds(int repeats, const std::function<void()>& run) {
  std::vector<double> seconds;
  for (int i = 0; i < repeats; ++i) {
    const auto start = std::chrono::steady_clock::now();
    run();
    seconds.push_back(
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return upper_median(std::move(seconds));
}

// Value and derivatives in long double, and the sums of their absolute terms.
struct LongSum {
  long double sum[3] = {}, size[3] = {};
};

LongSum long_sum(const Medium& medium, const SumsScene& scene, const Eigen::Vector3d& row) {
  using L = long double;
  const L s = medium.sigma_s_prime_per_mm, a = medium.sigma_a_per_mm, t = s + a;
  const L z_r = 1 / t, z_v = z_r * (1 + 4.0L / 3 * L(boundary_mismatch(medium.eta_int_over_ext)));
  const L kappa2 = 3 * a * t, kappa = std::sqrt(kappa2), scale = 1 / (4 * std::acos(L(-1)));
  LongSum out;
  for (std::size_t k = 0; k < scene.points.size(); ++k) {
    if (scene.c[k] == 0.0) continue;
    const L d2 = (scene.points[k] - row).cast<L>().squaredNorm();
    L value = 0, z_d_z = 0, decay = 0;
    for (const L z : {z_r, z_v}) {
      const L rho2 = d2 + z * z, rho = std::sqrt(rho2), y = kappa * rho;
      const L e = z * std::exp(-y) / rho;
      value += e * (1 + y) / rho2;
      z_d_z += e / rho2 * (1 + y - z * z / rho2 * (3 + 3 * y + y * y));
      decay += e / 2;
    }
    const L c = scale * L(scene.c[k]);
    const L terms[3] = {c * s / t * value,
                        c * (a / (t * t) * value - s / t * (z_d_z / t + 3 * a * decay)),
                        c * (-s / (t * t) * value - s / t * (z_d_z / t + 3 * (t + a) * decay))};
    for (int q = 0; q < 3; ++q) {
      out.sum[q] += terms[q];
      out.size[q] += std::abs(terms[q]);
    }
  }
  return out;
}

// The degree with the cheapest series for a tolerance.
int degree_for(double tolerance) { return tolerance >= 1e-3 ? 6 : 8; }

double direct_nanoseconds(const SumsScene& scene, const Medium& medium, int repeats) {
  const std::size_t rows = std::min<std::size_t>(scene.rows.size(), 256);
  const std::size_t points = std::min<std::size_t>(scene.points.size(), 20000);
  const PairSources sources(std::span(scene.points).first(points),
                            std::vector<double>(points, 1.0));
  std::vector<DipoleSum> sums(rows);
  const DipolePairs pairs(medium);
  const double seconds = median_seconds(
      std::max(repeats, 3), [&] { pairs.sum(sources, std::span(scene.rows).first(rows), sums); });
  return 1e9 * seconds / static_cast<double>((rows + 15) / 16 * 16 * points);
}

struct Reference {
  std::vector<std::size_t> rows;
  std::vector<std::vector<LongSum>> sums;  // of a medium and row
};

Reference truth_of(const SumsScene& scene, const std::vector<Medium>& media) {
  Reference truth;
  const std::size_t n = std::min<std::size_t>(scene.rows.size(), 64);
  for (std::size_t i = 0; i < n; ++i) truth.rows.push_back(i * scene.rows.size() / n);
  truth.sums.assign(media.size(), std::vector<LongSum>(n));
  oneapi::tbb::parallel_for(std::size_t{0}, n, [&](std::size_t i) {
    for (std::size_t m = 0; m < media.size(); ++m) {
      truth.sums[m][i] = long_sum(media[m], scene, scene.rows[truth.rows[i]]);
    }
  });
  return truth;
}

SumsBenchRow measure_sums(const SumsScene& scene, const std::vector<Medium>& media,
                          const Reference& truth, double tolerance, int repeats) {
  SumsBenchRow row;
  row.channels = static_cast<int>(media.size());
  row.patches = static_cast<double>(scene.points.size());
  row.rows = static_cast<double>(scene.rows.size());
  row.tolerance = tolerance;
  const int degree = degree_for(tolerance);
  std::vector<std::vector<DipoleSum>> out(media.size(), std::vector<DipoleSum>(scene.rows.size()));
  const auto build = [&] {
    const SourceClusters sources(scene.points, scene.c, degree);
    const RowBlocks blocks(scene.rows);
  };
  const SourceClusters sources(scene.points, scene.c, degree);
  const RowBlocks blocks(scene.rows);
  DipoleSumsCount count;
  const auto sum = [&] {
    count = sum_dipoles(sources, blocks, media, out, {.tolerance = tolerance});
  };
  sum();  // tables that are made once
  row.tree_s = median_seconds(repeats, build);
  row.sum_s = median_seconds(repeats, sum);
  {
    const oneapi::tbb::global_control one(oneapi::tbb::global_control::max_allowed_parallelism, 1);
    row.tree_one_s = median_seconds(repeats, build);
    // Beside it, so that whatever else the machine does befalls both.
    row.direct_ns = direct_nanoseconds(scene, media[0], repeats);
    row.sum_one_s = median_seconds(repeats, sum);
  }
  row.speedup = 1e-9 * row.direct_ns * row.channels * row.patches * row.rows /
                (row.tree_one_s + row.sum_one_s);
  row.certified_error = count.certified_error;
  row.pairs_per_row = static_cast<double>(count.pairs) / row.rows;
  row.series_per_row = static_cast<double>(count.series) / row.rows;
  std::vector<double> errors;
  for (std::size_t m = 0; m < media.size(); ++m) {
    for (std::size_t i = 0; i < truth.rows.size(); ++i) {
      const LongSum& t = truth.sums[m][i];
      const DipoleSum& got = out[m][truth.rows[i]];
      const double value[3] = {got.value, got.per_sigma_s_prime, got.per_sigma_a};
      for (int q = 0; q < 3; ++q) {
        const auto error = static_cast<double>(std::abs((value[q] - t.sum[q]) / t.size[q]));
        row.worst_error[q] = std::max(row.worst_error[q], error);
        if (q == 0) errors.push_back(error);
      }
    }
  }
  row.median_error = upper_median(std::move(errors));
  return row;
}

void check(const SumsBenchOptions& o) {
  std::ostringstream text;
  for (const double p : o.patches) {
    if (!(p >= 100 && p <= 1e8)) text << "patches " << p << " not in 100 .. 10^8; ";
  }
  for (const double r : o.rows) {
    if (!(r >= 1 && r <= 1e8)) text << "rows " << r << " not in 1 .. 10^8; ";
  }
  for (const double t : o.tolerances) {
    if (!(t >= 1e-5 && t <= 0.5)) text << "tolerance " << t << " not in 1e-5 .. 0.5; ";
  }
  if (o.repeats < 1) text << "repeats " << o.repeats << " below 1; ";
  if (!text.str().empty()) throw std::invalid_argument("bench sums: " + text.str());
}

}  // namespace

SumsBench bench_sums(const SumsBenchOptions& options) {
  check(options);
  SumsBench bench;
  const std::vector<Medium> paper = {{2.19, 0.002, 1.3}};
  for (const std::string body : {"cube", "sphere"}) {
    for (const double patches : options.patches) {
      for (const double rows : options.rows) {
        const SumsScene scene = sums_scene(body, static_cast<std::size_t>(patches),
                                           static_cast<std::size_t>(rows), options.seed);
        const Reference truth = truth_of(scene, paper);
        for (const double tolerance : options.tolerances) {
          bench.rows.push_back(measure_sums(scene, paper, truth, tolerance, options.repeats));
          bench.rows.back().body = body;
        }
      }
    }
  }
  if (options.loose_tolerance > 0.0) {
    // An image: about a pixel for each patch, three channels.
    const SumsScene scene = sums_scene("cube", 125000, 130000, options.seed);
    const std::vector<Medium> channels = {{2.19, 0.002, 1.3}, {0.5, 0.01, 1.49}, {1.2, 0.005, 1.4}};
    bench.rows.push_back(measure_sums(scene, channels, truth_of(scene, channels),
                                      options.loose_tolerance, options.repeats));
    bench.rows.back().body = "cube";
  }
  if (options.peer_patches > 0) {
    const auto patches = static_cast<std::size_t>(options.peer_patches);
    const SumsScene scene = sums_scene("cube", patches, 1, options.seed);
    const PeerProblem problem = peer_problem(scene.points, scene.c);
    constexpr double kWidth_mm = 0.1;
    bench.peers = {fit_sums(problem), fit_chunked(problem, kWidth_mm),
                   fit_dense(problem, kWidth_mm)};
  }
  return bench;
}

double patches_exponent(const SumsBench& bench, const std::string& body, double rows,
                        double tolerance) {
  std::vector<double> patches, seconds;
  for (const SumsBenchRow& r : bench.rows) {
    if (r.body != body || r.rows != rows || r.tolerance != tolerance) continue;
    patches.push_back(r.patches);
    seconds.push_back(r.tree_one_s + r.sum_one_s);
  }
  return growth_exponent(patches, seconds);
}

}  // namespace scattermeter::apps
