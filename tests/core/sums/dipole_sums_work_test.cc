// Operations of fixed cases: the gate against growing slower that no busy machine can close.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/sums/dipole_sums.h"

namespace scattermeter {
namespace {

// What DipoleSumsCount tells, for each row.
struct Work {
  double pairs, exact_pairs, series, coefficients, tests, repeated_blocks;
};

struct SumsCase {
  const char* body;
  std::size_t patches, rows, media;
  double tolerance;
  Work stated;
};

// The figures, in one place. None may grow by more than 5 %: a change that is worth it states the
// new ones (the test prints them) and says why. One that does much better states them as well.
const SumsCase kCases[] = {
    {"cube", 20000, 4000, 1, 1e-4, {277.7, 0, 99.75, 7186.8, 18.84, 0}},
    {"sphere", 20000, 4000, 1, 1e-4, {271.9, 0, 83.51, 17648, 16.26, 0}},
    {"cube", 20000, 4000, 3, 1e-2, {192, 0, 69.42, 3633.2, 12.4, 0.0005}},
    {"cube", 20000, 4000, 3, 0.3, {170, 0, 59.39, 2096.9, 10.96, 0.00425}},
    {"sphere", 20000, 4000, 1, 1e-5, {365.4, 0, 106.4, 25267, 22.2, 0}},
};

double even(std::mt19937& random) { return random() * 0x1p-31 - 1.0; }

Eigen::Vector3d surface_point(const std::string& body, std::mt19937& random) {
  Eigen::Vector3d p;
  do {
    for (int i = 0; i < 3; ++i) p[i] = even(random);
  } while (p.squaredNorm() > 1.0 || p.squaredNorm() < 0.01);
  return 10.0 * (body == "sphere" ? p / p.norm() : Eigen::Vector3d(p / p.cwiseAbs().maxCoeff()));
}

TEST(DipoleSumsWork, DoesNotGrow) {
  const std::vector<Medium> media = {{2.19, 0.002, 1.3}, {0.5, 0.01, 1.49}, {1.2, 0.005, 1.4}};
  for (const SumsCase& c : kCases) {
    std::mt19937 random(5);
    std::vector<Eigen::Vector3d> points, rows;
    std::vector<double> weights;
    for (std::size_t i = 0; i < c.patches; ++i) {
      points.push_back(surface_point(c.body, random));
      weights.push_back(points.back().x() + points.back().z() > 0.0 ? 1.0 + 0.5 * even(random)
                                                                    : 0.0);
    }
    for (std::size_t i = 0; i < c.rows; ++i) rows.push_back(surface_point(c.body, random));
    std::vector<std::vector<DipoleSum>> out(c.media, std::vector<DipoleSum>(c.rows));
    const DipoleSumsCount count =
        sum_dipoles(SourceClusters(points, weights), RowBlocks(rows),
                    std::span(media).first(c.media), out, {.tolerance = c.tolerance});
    const auto each = [&](std::int64_t n) {
      return static_cast<double>(n) / static_cast<double>(count.rows);
    };
    const Work now = {each(count.pairs),  each(count.exact_pairs),
                      each(count.series), each(count.coefficients),
                      each(count.tests),  each(count.repeated_blocks)};
    std::printf("    {\"%s\", %zu, %zu, %zu, %g,\n     {%.4g, %.4g, %.4g, %.5g, %.4g, %.4g}},\n",
                c.body, c.patches, c.rows, c.media, c.tolerance, now.pairs, now.exact_pairs,
                now.series, now.coefficients, now.tests, now.repeated_blocks);
    const struct {
      const char* name;
      double now, stated;
    } figures[] = {{"pairs", now.pairs, c.stated.pairs},
                   {"exact_pairs", now.exact_pairs, c.stated.exact_pairs},
                   {"series", now.series, c.stated.series},
                   {"coefficients", now.coefficients, c.stated.coefficients},
                   {"tests", now.tests, c.stated.tests},
                   {"repeated_blocks", now.repeated_blocks, c.stated.repeated_blocks}};
    for (const auto& f : figures) {
      // A hundredth of a thing for a row is none.
      EXPECT_LE(f.now, 1.05 * f.stated + 0.01)
          << f.name << " of " << c.body << ", " << c.patches << " patches, " << c.media
          << " media, tolerance " << c.tolerance;
    }
    const auto cost = [](const Work& w) { return w.pairs + 5.0 * w.series; };
    EXPECT_GE(cost(now), 0.7 * cost(c.stated)) << "long bettered: state the new figures";
    EXPECT_GT(count.points_left_out, 0);
  }
}

}  // namespace
}  // namespace scattermeter
