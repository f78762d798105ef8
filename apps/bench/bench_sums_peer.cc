#include "apps/bench/bench_sums_peer.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include <Eigen/LU>

#include "core/base/dense_solve.h"
#include "core/material/dipole.h"
#include "core/sums/dipole_pairs.h"
#include "core/sums/dipole_sums.h"

namespace scattermeter::apps {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Adds what one pair gives to a row of W (paper eq. 17 to 25).
void add_knots(double distance, double width_mm, double c, Eigen::Ref<Eigen::VectorXd> row) {
  const double x = distance / width_mm;
  const auto i = std::min(static_cast<Eigen::Index>(x), row.size() - 2);
  const double beta = static_cast<double>(i + 1) - x;
  row[i] += beta * c;
  row[i + 1] += (1.0 - beta) * c;
}

Eigen::Index knots_for(const PeerProblem& problem, double width_mm) {
  Eigen::Vector3d low = problem.points_mm.front(), high = low;
  for (const Eigen::Vector3d& p : problem.points_mm) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return static_cast<Eigen::Index>((high - low).norm() / width_mm) + 2;
}

// Paper eq. 29 and 30.
PeerResult grid_search(const PeerProblem& problem, const Eigen::VectorXd& r, double width_mm) {
  double best = std::numeric_limits<double>::infinity();
  Medium answer;
  for (int i = 1; i <= 300; ++i) {
    for (int k = 0; k <= 10; ++k) {
      const Medium medium{0.01 * i, 0.001 * k, problem.truth.eta_int_over_ext};
      const Dipole dipole(medium);
      double sum = 0.0;
      for (Eigen::Index n = 0; n < r.size(); ++n) {
        const double rest = r[n] - dipole.reflectance_per_mm2(static_cast<double>(n) * width_mm);
        sum += rest * rest;
      }
      if (sum < best) {
        best = sum;
        answer = medium;
      }
    }
  }
  return {"", 0.0, answer.sigma_s_prime_per_mm / problem.truth.sigma_s_prime_per_mm - 1.0,
          answer.sigma_a_per_mm / problem.truth.sigma_a_per_mm - 1.0};
}

}  // namespace

PeerProblem peer_problem(const std::vector<Eigen::Vector3d>& points_mm,
                         const std::vector<double>& c) {
  PeerProblem problem{
      points_mm, c, Eigen::VectorXd(static_cast<Eigen::Index>(c.size())), {2.19, 0.002, 1.3}};
  std::vector<DipoleSum> sums(points_mm.size());
  DipolePairs(problem.truth).sum(PairSources(points_mm, c), points_mm, sums);
  for (std::size_t j = 0; j < sums.size(); ++j) {
    problem.l[static_cast<Eigen::Index>(j)] = sums[j].value;
  }
  return problem;
}

PeerResult fit_dense(const PeerProblem& problem, double width_mm) {
  const auto start = Clock::now();
  const auto m = static_cast<Eigen::Index>(problem.points_mm.size());
  Eigen::MatrixXd distance(m, m);
  for (Eigen::Index k = 0; k < m; ++k) {
    for (Eigen::Index j = 0; j < m; ++j) {
      distance(j, k) = (problem.points_mm[static_cast<std::size_t>(j)] -
                        problem.points_mm[static_cast<std::size_t>(k)])
                           .norm();
    }
  }
  // Rows of W as columns, so that they are contiguous.
  Eigen::MatrixXd w = Eigen::MatrixXd::Zero(knots_for(problem, width_mm), m);
  for (Eigen::Index j = 0; j < m; ++j) {
    for (Eigen::Index k = 0; k < m; ++k) {
      add_knots(distance(k, j), width_mm, problem.c[static_cast<std::size_t>(k)], w.col(j));
    }
  }
  const Eigen::VectorXd r = pseudo_inverse(w.transpose()) * problem.l;
  PeerResult result = grid_search(problem, r, width_mm);
  result.method = "paper, dense";
  result.seconds = seconds_since(start);
  return result;
}

PeerResult fit_chunked(const PeerProblem& problem, double width_mm) {
  const auto start = Clock::now();
  const auto m = static_cast<Eigen::Index>(problem.points_mm.size());
  const Eigen::Index n = knots_for(problem, width_mm);
  constexpr Eigen::Index kChunk = 256;
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(n);
  Eigen::MatrixXd w(n, kChunk);
  for (Eigen::Index first = 0; first < m; first += kChunk) {
    const Eigen::Index count = std::min(kChunk, m - first);
    w.setZero();
    for (Eigen::Index j = 0; j < count; ++j) {
      const Eigen::Vector3d& p = problem.points_mm[static_cast<std::size_t>(first + j)];
      for (std::size_t k = 0; k < problem.c.size(); ++k) {
        if (problem.c[k] == 0.0) continue;
        add_knots((problem.points_mm[k] - p).norm(), width_mm, problem.c[k], w.col(j));
      }
    }
    normal.selfadjointView<Eigen::Lower>().rankUpdate(w.leftCols(count));
    right += w.leftCols(count) * problem.l.segment(first, count);
  }
  const Eigen::MatrixXd full = normal.selfadjointView<Eigen::Lower>();
  const Eigen::VectorXd r = solve_min_norm(full, right);
  PeerResult result = grid_search(problem, r, width_mm);
  result.method = "paper, chunked";
  result.seconds = seconds_since(start);
  return result;
}

PeerResult fit_sums(const PeerProblem& problem) {
  const auto start = Clock::now();
  // Errors of the sums are then 1e-5 (bench sums), and the estimates far better than the peers'.
  constexpr double kTolerance = 1e-2;
  const SourceClusters sources(problem.points_mm, problem.c, 6);
  const RowBlocks rows(problem.points_mm);
  std::vector<std::vector<DipoleSum>> out(1, std::vector<DipoleSum>(problem.points_mm.size()));
  // Parameters ln sigma_s' and sigma_a, relative residuals; steps out of the domain are halved.
  Medium medium{1.0, 0.01, problem.truth.eta_int_over_ext};
  for (int i = 0; i < 30; ++i) {
    sum_dipoles(sources, rows, {&medium, 1}, out, {.tolerance = kTolerance});
    Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
    Eigen::Vector2d right = Eigen::Vector2d::Zero();
    for (std::size_t j = 0; j < out[0].size(); ++j) {
      const DipoleSum& s = out[0][j];
      const double weight = 1.0 / s.value;
      const Eigen::Vector2d d(weight * s.per_sigma_s_prime * medium.sigma_s_prime_per_mm,
                              weight * s.per_sigma_a);
      normal += d * d.transpose();
      right += d * std::log(problem.l[static_cast<Eigen::Index>(j)] / s.value);
    }
    Eigen::Vector2d step = normal.inverse() * right;
    while (std::abs(step[0]) > 0.7 || medium.sigma_a_per_mm + step[1] < 0.0) step *= 0.5;
    medium.sigma_s_prime_per_mm *= std::exp(step[0]);
    medium.sigma_a_per_mm += step[1];
    if (std::abs(step[0]) < 1e-6 && std::abs(step[1]) < 1e-6 * medium.sigma_a_per_mm) break;
  }
  return {"sums over clusters", seconds_since(start),
          medium.sigma_s_prime_per_mm / problem.truth.sigma_s_prime_per_mm - 1.0,
          medium.sigma_a_per_mm / problem.truth.sigma_a_per_mm - 1.0};
}

}  // namespace scattermeter::apps
