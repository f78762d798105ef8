#include "core/sums/dipole_sums.h"

#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "core/material/fresnel.h"

namespace scattermeter {
namespace {

using L = long double;
using Points = std::vector<Eigen::Vector3d>;

// The three sums of one medium in long double, and their parts' sizes.
struct LongSums {
  L value = 0, d_s = 0, d_a = 0;
  L size = 0, size_s = 0, size_a = 0;
};

LongSums long_sums(const Medium& m, const Points& points, const std::vector<double>& weights,
                   const Eigen::Vector3d& row) {
  const L s = m.sigma_s_prime_per_mm, a = m.sigma_a_per_mm, t = s + a;
  const L zr = 1 / t, zv = zr * (1 + 4.0L / 3 * L(boundary_mismatch(m.eta_int_over_ext)));
  const L kappa2 = 3 * a * t, kappa = std::sqrt(kappa2);
  L g = 0, near = 0, far = 0, decay = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    L d2 = 0;
    for (int i = 0; i < 3; ++i) {
      const L d = L(points[k][i]) - L(row[i]);
      d2 += d * d;
    }
    for (const L z : {zr, zv}) {
      const L rho2 = d2 + z * z, rho = std::sqrt(rho2), y = kappa * rho;
      const L e = L(weights[k]) * z * std::exp(-y) / rho;
      g += e * (1 + y) / rho2;
      far += e * (1 + y) / rho2;
      near += e * z * z / (rho2 * rho2) * (3 + 3 * y + y * y);
      decay += e / 2;
    }
  }
  const L scale = 1 / (4 * std::acos(L(-1)));
  const L z_d_z = far - near;
  LongSums out;
  out.value = scale * s / t * g;
  out.d_s = scale * (a / (t * t) * g + s / t * (-z_d_z / t - 3 * a * decay));
  out.d_a = scale * (-s / (t * t) * g + s / t * (-z_d_z / t - 3 * (t + a) * decay));
  out.size = out.value;
  out.size_s = scale * (a / (t * t) * g + s / t * ((far + near) / t + 3 * a * decay));
  out.size_a = scale * (s / (t * t) * g + s / t * ((far + near) / t + 3 * (t + a) * decay));
  return out;
}

struct CloudAndSites {
  std::string name;
  Points points;
  std::vector<double> weights;
  Points rows;
};

// Largest errors relative to the parts' sizes; fails where one is over what is certified.
void expect_certified(const CloudAndSites& scene, const std::vector<Medium>& media,
                      double tolerance, std::size_t direct_up_to = 0) {
  const SourceClusters sources(scene.points, scene.weights);
  const RowBlocks rows(scene.rows);
  std::vector<std::vector<DipoleSum>> out(media.size(), std::vector<DipoleSum>(scene.rows.size()));
  const DipoleSumsCount count = sum_dipoles(sources, rows, media, out,
                                            {.tolerance = tolerance, .direct_up_to = direct_up_to});
  EXPECT_LE(count.certified_error, tolerance + kDipoleSumsRounding) << scene.name;
  for (std::size_t m = 0; m < media.size(); ++m) {
    L all = 0;
    for (const double w : scene.weights) all += w;
    // Were all the light at the row.
    const LongSums here =
        long_sums(media[m], {Eigen::Vector3d::Zero()}, {double(all)}, Eigen::Vector3d::Zero());
    for (std::size_t j = 0; j < scene.rows.size(); ++j) {
      const LongSums truth = long_sums(media[m], scene.points, scene.weights, scene.rows[j]);
      const DipoleSum& got = out[m][j];
      const double e = count.certified_error;
      EXPECT_LE(std::abs(L(got.value) - truth.value), e * truth.size + 1e-29L * here.size)
          << scene.name << " row " << j << " medium " << m << " " << got.value;
      EXPECT_LE(std::abs(L(got.per_sigma_s_prime) - truth.d_s),
                e * truth.size_s + 1e-29L * here.size_s)
          << scene.name << " row " << j << " medium " << m;
      EXPECT_LE(std::abs(L(got.per_sigma_a) - truth.d_a), e * truth.size_a + 1e-29L * here.size_a)
          << scene.name << " row " << j << " medium " << m;
    }
  }
}

const std::vector<Medium> kMedia = {{2.19, 0.002, 1.3}, {0.5, 0.01, 1.49}, {20.0, 0.0, 1.3}};

// Half lit, every hundredth point is a row.
CloudAndSites surface(const std::string& name, std::size_t n, double size,
                      const std::function<Eigen::Vector3d(std::mt19937&)>& on) {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> uniform(0.0, 2.0);
  CloudAndSites s{name, {}, {}, {}};
  const Eigen::Vector3d away(30.0 * size, -500.0 * size, 100.0 * size);
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector3d p = on(random);
    s.points.push_back(away + size * p);
    s.weights.push_back(p.x() + p.z() > 0.0 ? uniform(random) : 0.0);
    if (i % (n / 40) == 0) s.rows.push_back(s.points.back());
  }
  return s;
}

Eigen::Vector3d on_sphere(std::mt19937& random) {
  std::normal_distribution<double> normal;
  const double z = normal(random), y = normal(random), x = normal(random);
  return Eigen::Vector3d(x, y, z).normalized();
}

Eigen::Vector3d on_cube(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const double z = uniform(random), y = uniform(random), x = uniform(random);
  Eigen::Vector3d p(x, y, z);
  const double side = random() % 2 == 0 ? -1.0 : 1.0;
  p[static_cast<int>(random() % 3)] = side;
  return p;
}

TEST(DipoleSums, CertifiedOnBodies) {
  for (const double tolerance : {1e-5, 1e-4, 1e-2, 0.3}) {
    expect_certified(surface("cube", 4000, 10.0, on_cube), kMedia, tolerance);
    expect_certified(surface("sphere", 4000, 10.0, on_sphere), kMedia, tolerance);
  }
}

// The scene as large or as small as may be, in metres or micrometres.
TEST(DipoleSums, CertifiedAtAnyScale) {
  for (const double size : {1e-3, 0.1, 1e3, 1e6}) {
    expect_certified(surface("sphere", 2000, size, on_sphere), kMedia, 1e-4);
  }
}

TEST(DipoleSums, CertifiedForAdversaries) {
  std::mt19937 random(23);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto vector = [&] {
    const double x = uniform(random), y = uniform(random), z = uniform(random);
    return Eigen::Vector3d(x, y, z);
  };
  std::vector<CloudAndSites> scenes;
  {
    CloudAndSites s{"coincident points", {}, {}, {}};
    for (int i = 0; i < 1000; ++i)
      s.points.push_back(i < 600 ? Eigen::Vector3d(1, 1, 1) : vector());
    s.rows = {{1, 1, 1}, {1, 1, 1.0001}, {0, 0, 0}, {5, 5, 5}};
    scenes.push_back(s);
  }
  {
    CloudAndSites s{"needles", {}, {}, {}};
    for (int i = 0; i < 1500; ++i) {
      s.points.emplace_back(20.0 * uniform(random), 1e-5 * uniform(random), 1e-9 * uniform(random));
    }
    s.rows = {{0, 0, 0}, {19, 0.1, 0}, {21, 0, 0}, {0, 5, 0}, s.points[7]};
    scenes.push_back(s);
  }
  {
    CloudAndSites s{"clusters 10^6 apart in scale", {}, {}, {}};
    for (int i = 0; i < 2000; ++i) {
      const double scale = i % 2 == 0 ? 1e-3 : 1e3;
      s.points.push_back(Eigen::Vector3d(7, 0, 0) + scale * vector());
    }
    s.rows = {{7, 0, 0},    {7.001, 0, 0}, {8, 0, 0},  {100, 3, 0},
              {-900, 0, 1}, s.points[0],   s.points[1]};
    scenes.push_back(s);
  }
  {
    CloudAndSites s{"halving distances", {}, {}, {}};
    for (int i = 0; i < 900; ++i) {
      s.points.push_back(std::exp2(-0.1 * i) * 1e4 * vector());
    }
    s.rows = {{0, 0, 0}, {1e-3, 0, 0}, {1, 0, 0}, {1e3, 0, 0}};
    scenes.push_back(s);
  }
  {
    CloudAndSites s{"a few points far apart", {}, {}, {}};
    for (int i = 0; i < 20; ++i) s.points.push_back(1e5 * vector());
    s.rows = {s.points[0], s.points[1] + Eigen::Vector3d(0.1, 0, 0), {0, 0, 0}};
    scenes.push_back(s);
  }
  // About as far from a plane as tells a planar cluster from another, and less.
  for (const double off : {1e-5, 1e-7, 1e-9, 1e-12}) {
    CloudAndSites s{"off a plane by " + std::to_string(off), {}, {}, {}};
    const Eigen::Vector3d normal = Eigen::Vector3d(1, 2, 3).normalized();
    for (int i = 0; i < 1500; ++i) {
      const Eigen::Vector3d p = 10.0 * vector();
      s.points.push_back(p + (10.0 * off * uniform(random) - normal.dot(p)) * normal);
    }
    s.rows = {{0, 0, 0}, s.points[3], 0.1 * normal, 10.0 * normal, -0.3 * normal};
    scenes.push_back(s);
  }
  {
    // Blocks of rows and clusters that hold parts of both.
    CloudAndSites s{"two faces", {}, {}, {}};
    for (int i = 0; i < 2000; ++i) {
      const double u = 5.0 * std::abs(uniform(random)), v = 10.0 * uniform(random);
      s.points.emplace_back(i % 2 == 0 ? Eigen::Vector3d(u, v, 0) : Eigen::Vector3d(0, v, u));
    }
    for (int i = 0; i < 40; ++i) {
      const double u = 0.2 * std::abs(uniform(random)), v = 10.0 * uniform(random);
      s.rows.emplace_back(i % 2 == 0 ? Eigen::Vector3d(u, v, 0) : Eigen::Vector3d(0, v, u));
    }
    scenes.push_back(s);
  }
  for (CloudAndSites& s : scenes) {
    for (std::size_t i = 0; i < s.points.size(); ++i) {
      s.weights.push_back(i % 7 == 0 ? 0.0 : std::exp(4.0 * uniform(random)));
    }
    for (const double tolerance : {1e-5, 1e-4, 1e-2}) expect_certified(s, kMedia, tolerance);
  }
}

// Weights of any ratio: rows by the weak ones, out of the strong ones' light.
TEST(DipoleSums, CertifiedInTheShadowOfStrongLight) {
  CloudAndSites s = surface("strong and weak", 3000, 10.0, on_cube);
  for (std::size_t i = 0; i < s.points.size(); ++i) s.weights[i] = i % 50 == 0 ? 1e8 : 1e-3;
  expect_certified(s, kMedia, 1e-4);
}

// exp(-kappa d) down to 10^-4000 and beyond: relative above 1e-30, tiny below.
TEST(DipoleSums, CertifiedWhereLightDies) {
  const std::vector<Medium> dark = {{1.0, 1.0, 1.4}, {0.2, 10.0, 1.3}, {2.19, 0.002, 1.3}};
  expect_certified(surface("dark", 3000, 10.0, on_sphere), dark, 1e-4);
  expect_certified(surface("darker", 3000, 1e3, on_cube), dark, 1e-4);
}

// Any rows will do: few, far away, inside.
TEST(DipoleSums, CertifiedForRowsAnywhere) {
  CloudAndSites s = surface("sphere", 5000, 10.0, on_sphere);
  const Eigen::Vector3d center = Eigen::Vector3d(300.0, -5000.0, 1000.0);
  s.rows = {center, center + Eigen::Vector3d(0, 0, 50), center + Eigen::Vector3d(1e4, 0, 0)};
  expect_certified(s, kMedia, 1e-4);
}

// Few points, or a high limit: all pairs, nothing left out.
TEST(DipoleSums, DirectForFewPoints) {
  const CloudAndSites s = surface("cube", 200, 10.0, on_cube);
  const SourceClusters sources(s.points, s.weights);
  std::vector<std::vector<DipoleSum>> out(1, std::vector<DipoleSum>(s.rows.size()));
  const DipoleSumsCount count = sum_dipoles(sources, RowBlocks(s.rows), {kMedia.data(), 1}, out);
  EXPECT_EQ(count.pairs, count.rows * count.points);
  EXPECT_EQ(count.series, 0);
  EXPECT_EQ(count.certified_error, kDipoleSumsRounding);
  expect_certified(s, kMedia, 1e-4, 256);
}

TEST(DipoleSums, EmptyAndBad) {
  const Points one = {{0, 0, 0}};
  const std::vector<double> dark = {0.0}, lit = {1.0};
  std::vector<std::vector<DipoleSum>> out(1, std::vector<DipoleSum>(1, {1, 1, 1}));
  const DipoleSumsCount none =
      sum_dipoles(SourceClusters(one, dark), RowBlocks(one), {kMedia.data(), 1}, out);
  EXPECT_EQ(out[0][0].value, 0.0);
  EXPECT_EQ(none.points_left_out, 1);
  const SourceClusters sources(one, lit);
  EXPECT_THROW(sum_dipoles(sources, RowBlocks(one), kMedia, out), std::invalid_argument);
  EXPECT_THROW(sum_dipoles(sources, RowBlocks(one), {kMedia.data(), 1}, out, {.tolerance = 1e-7}),
               std::invalid_argument);
  const Medium bad{0.0, 0.0, 1.3};
  EXPECT_THROW(sum_dipoles(sources, RowBlocks(one), {&bad, 1}, out), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter
