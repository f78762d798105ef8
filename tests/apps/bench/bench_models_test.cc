// Small frames, few paths.
#include "apps/bench/bench_models.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/mesh/bodies.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

// Each limit from both sides.
TEST(BenchModels, SaysWhatDoesNotApply) {
  const Box3d cube = bounds(cube_mesh());
  const Box3d slab = bounds(slab_mesh());
  // 1 / 0.165 = 6.06 mm: less than 20 / 3, more than 10 / 3.
  const Medium thin{0.15, 0.015, 1.3};
  EXPECT_EQ(why_left_out(thin, cube, 0.5), "");
  EXPECT_EQ(why_left_out(thin, slab, 0.5), "mean free path 6.06 mm, more than a third of 10 mm");
  // 0.2 mm: rendered patches are no smaller than 20 / 125 = 0.16 mm, and 40 / 125 = 0.32 mm.
  const Medium dense{4.999, 0.001, 1.3};
  EXPECT_EQ(why_left_out(dense, cube, 0.59), "");
  EXPECT_EQ(why_left_out(dense, cube, 0.75), "mean free path 0.200 mm, patches resolve 0.250 mm");
  EXPECT_EQ(why_left_out(dense, slab, 0.59), "mean free path 0.200 mm, patches resolve 0.320 mm");
  // 1 / sqrt(3 * 1.45 * 1.48) = 0.394 mm.
  const Medium dark{0.03, 1.45, 1.3};
  EXPECT_EQ(why_left_out(dark, cube, 0.52), "");
  EXPECT_EQ(why_left_out(dark, cube, 0.53), "light dies off within 0.39 mm, patches are 0.53 mm");
}

// A cube: transport comes back to the truth within what it and the shots' own error allow; the
// dipole, whose half-space the cube is not, is refused or farther off. What cannot be rendered is a
// row.
TEST(BenchModels, TransportIsRight) {
  const std::vector<ListedMaterial> list = {{"easy", 'G', {0.7, 0.02, 1.3}},
                                            {"glass", 'G', {0.01, 0.001, 1.5}},
                                            {"broken", 'R', {0.7, 0.02, -1.0}}};
  ModelsBenchOptions options;
  options.bodies = {"cube"};
  options.image_width_px = 320;
  options.paths = 80'000;
  options.time_limit_s = 500;  // not what ends it

  std::size_t cases = 0;
  options.after_case = [&](const std::vector<ModelsBenchRow>&) { ++cases; };
  const std::vector<ModelsBenchRow> rows = bench_models(list, options);
  ASSERT_EQ(rows.size(), 3U + 1U + 1U);
  EXPECT_EQ(cases, 3U);
  const ModelsBenchRow& dipole = rows[1];
  const ModelsBenchRow& transport = rows[2];
  EXPECT_EQ(rows[0].model, "paper");
  EXPECT_EQ(dipole.model, "dipole");
  ASSERT_EQ(transport.model, "transport");
  ASSERT_EQ(transport.status, ModelsBenchStatus::kAnswered) << transport.reason;
  EXPECT_LT(std::abs(transport.z_sigma_s_prime), 4.0);
  EXPECT_LT(std::abs(transport.z_sigma_a), 4.0);
  // z is of an error and deviations that mean something.
  EXPECT_LT(std::abs(transport.error_sigma_s_prime), 0.06);
  EXPECT_LT(std::abs(transport.error_sigma_a), 0.2);
  EXPECT_NEAR(transport.z_sigma_a,
              0.02 * transport.error_sigma_a /
                  std::hypot(transport.sigma_a_per_mm.std, transport.truth_std_sigma_a_per_mm),
              1e-9);
  EXPECT_GT(transport.truth_patch_std, 0.0);
  EXPECT_TRUE(dipole.status == ModelsBenchStatus::kRefused ||
              std::abs(dipole.error_sigma_a) > std::abs(transport.error_sigma_a));
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_GT(rows[i].truth_std_sigma_s_prime_per_mm, 0.0);
    EXPECT_GT(rows[i].seconds, 0.0);
    EXPECT_GT(rows[i].cpu_seconds, 0.0);
  }
  EXPECT_EQ(rows[3].status, ModelsBenchStatus::kLeftOut);
  EXPECT_THAT(rows[3].reason, HasSubstr("mean free path"));
  EXPECT_EQ(rows[4].status, ModelsBenchStatus::kFailed);
  EXPECT_NE(rows[4].reason, "");
  EXPECT_TRUE(std::isnan(rows[4].error_sigma_a));

  const std::string table = models_bench_table(rows);
  EXPECT_THAT(table, HasSubstr("easy G    transport"));
  EXPECT_THAT(table, HasSubstr("failed: "));
  EXPECT_THAT(table, HasSubstr("Monte Carlo error of a patch's light"));
  EXPECT_THAT(table, HasSubstr("Left out: 1\n  cube, glass G: mean free path"));
  const std::string csv = models_bench_csv(rows);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 5);
  EXPECT_THAT(csv, HasSubstr("cube,easy,G,1.3,0.7,0.02,transport,ok,"));
  EXPECT_THAT(csv, HasSubstr("cube,glass,G,1.5,0.01,0.001,,left out,,"));
  // Each answer once, filled where it stands.
  const Plot plot = models_bench_plot_sigma_a(rows);
  std::size_t points = 0;
  for (const PlotSeries& s : plot.series) {
    if (s.style == PlotSeries::Style::kPoints || s.style == PlotSeries::Style::kOpenPoints) {
      points += s.x.size();
    }
    if (s.name == "transport") {
      ASSERT_EQ(s.y.size(), 1U);
      EXPECT_DOUBLE_EQ(s.y[0], 100.0 * std::abs(transport.error_sigma_a));
    }
  }
  EXPECT_EQ(points, 3U);
  for (const PlotSeries& s : models_bench_plot_sigma_a({rows[3], rows[4]}).series) {
    EXPECT_TRUE(s.x.empty());
  }

  options.scale_std = -1.0;
  EXPECT_THROW(bench_models(list, options), std::invalid_argument);
  options.scale_std = 0.0;
  options.bodies = {"torus"};
  EXPECT_THROW(bench_models(list, options), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter::apps
