// Small frames, few paths.
#include "apps/bench/bench_models.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/instrument/instrument.h"
#include "apps/simulation/bodies_rig.h"
#include "apps/simulation/volume_truth.h"
#include "core/mesh/bodies.h"
#include "tests/fixtures/apps/small_rig.h"
#include "tests/fixtures/temporary_folder.h"

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
  EXPECT_EQ(why_left_out(thin, slab, 0.5), "mean free path 6.06 mm, over a third of 10 mm");
  // 0.2 mm: rendered patches are no smaller than 20 / 125 = 0.16 mm, and 40 / 125 = 0.32 mm.
  const Medium dense{4.999, 0.001, 1.3};
  EXPECT_EQ(why_left_out(dense, cube, 0.59), "");
  EXPECT_EQ(why_left_out(dense, cube, 0.75), "mean free path 0.200 mm, patches resolve 0.250 mm");
  EXPECT_EQ(why_left_out(dense, slab, 0.59), "mean free path 0.200 mm, patches resolve 0.320 mm");
  // 1 / sqrt(3 * 1.45 * 1.48) = 0.394 mm.
  const Medium dark{0.03, 1.45, 1.3};
  EXPECT_EQ(why_left_out(dark, cube, 0.52), "");
  EXPECT_EQ(why_left_out(dark, cube, 0.53),
            "light dies off within 0.39 mm, patches are of 0.53 mm");
}

// Shots that the dipole made of each body come back from the dipole: camera, lights and patches
// suit the bodies. To what bench materials takes for right.
TEST(BodiesRig, EveryBodyIsMeasured) {
  const Medium medium{0.8, 0.01, 1.0};
  for (const char* body : {"sphere", "slab", "scan"}) {
    const Rig rig = bodies_rig(968, 1.3, {{"m", {medium, medium, medium}}}, {body});
    const ObjectScenes scenes = bodies_scenes(rig);
    const VirtualShots shots(rig, scenes, {.noise = true});
    MeasureOptions options;

    Instrument instrument(rig, scenes, options);
    const Measurement m = instrument.measure(capture::shots_from(
        rig.scene, capture::all_shots(rig.scene),
        capture::SampleSource([&](std::size_t i, const SampleMap& where) {
          return shots.ideal_samples(i, where.x0, where.y0, where.width, where.height);
        })));
    for (const ChannelResult& r : m.results) {
      EXPECT_FALSE(r.refused()) << body << ": " << r.estimate.reasons.front();
      EXPECT_NEAR(r.estimate.sigma_s_prime_per_mm.value, 0.8, 0.01 * 0.8) << body;
      EXPECT_NEAR(r.estimate.sigma_a_per_mm.value, 0.01, 0.05 * 0.01) << body;
    }
  }
}

// The noise that is put on the dipole's image is that of the mean of the batches.
TEST(VolumeTruth, DisturbsByTheNoiseOfTheMean) {
  const Medium medium{0.7, 0.1, 1.0};
  const Rig rig = bodies_rig(240, 1.3, {{"m", {medium, medium, medium}}}, {"cube"});
  const ObjectScenes scenes = bodies_scenes(rig);
  const VolumeTruth truth(rig, scenes, {.paths = 4 * 6400, .batches = 4, .seed = 3});
  SampleMap where;  // the frame's middle
  where.x0 = 90;
  where.y0 = 50;
  where.width = where.height = 60;
  const CfaSamples mean = truth.shots()(0, where);
  std::vector<CfaSamples> disturbed;
  for (int b = 0; b < truth.batches(); ++b) disturbed.push_back(truth.disturbed(b)(0, where));
  double change = 0.0, signal = 0.0;
  for (std::size_t i = 0; i < mean.signal_counts.size(); ++i) {
    double dipole = 0.0, square = 0.0;
    for (const CfaSamples& d : disturbed) dipole += d.signal_counts[i] / 4.0;
    for (const CfaSamples& d : disturbed) square += std::pow(d.signal_counts[i] - dipole, 2) / 3.0;
    change += square;
    signal += std::pow(dipole, 2);
    EXPECT_EQ(mean.clipped[i], 0);
  }
  // Root mean square over the samples, weighed by brightness; the patches' median is not far.
  EXPECT_GT(std::sqrt(change / signal), 0.5 * truth.patch_std());
  EXPECT_LT(std::sqrt(change / signal), 2.0 * truth.patch_std());
  // Four times the paths: a half.
  const VolumeTruth finer(rig, scenes, {.paths = 4 * 4 * 6400, .batches = 4, .seed = 3});
  EXPECT_NEAR(finer.patch_std() / truth.patch_std(), 0.5, 0.05);
  // A seed of its own for the sensor's noise.
  const VolumeTruth noisy(rig, scenes,
                          {.paths = 4 * 6400, .batches = 4, .seed = 3, .noise_seed = 8});
  const CfaSamples n = noisy.shots()(0, where);
  double chi2 = 0.0;
  for (std::size_t i = 0; i < n.signal_counts.size(); ++i) {
    chi2 += std::pow(n.signal_counts[i] - mean.signal_counts[i], 2) / n.variance_counts2[i];
  }
  const double dof = 3600.0;  // of mean dof and standard deviation sqrt(2 dof)
  EXPECT_NEAR(chi2, dof, 4.0 * std::sqrt(2.0 * dof));
  EXPECT_THROW(VolumeTruth(rig, scenes, {.batches = 1}), std::invalid_argument);
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

TEST(BenchModels, Command) {
  const TemporaryFolder folder;
  const Answer r = run({"bench",        "--image-width", "240",        "--out",
                        folder / "out", "models",        "--bodies",   "slab",
                        "--names",      "skin1",         "--channels", "R",
                        "--models",     "dipole",        "--paths",    "20000",
                        "--scale-std",  "0.02",          "--noise",    "on"});
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.out, HasSubstr("skin1 R"));
  const std::string csv = slurp(folder / "out/models.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 1);
  for (const char* name : {"models_sigma_s_prime", "models_sigma_a"}) {
    for (const char* extension : {".png", ".svg"}) {
      EXPECT_GT(std::filesystem::file_size(folder / "out/" + name + extension), 3000U);
    }
  }
  EXPECT_EQ(run({"bench", "models", "--bodies", "torus"}).status, 2);
  EXPECT_EQ(run({"bench", "models", "--channels", "RX"}).status, 2);
  EXPECT_EQ(run({"bench", "models", "--models", "guess"}).status, 2);
  EXPECT_EQ(run({"bench", "models", "--names", "unobtainium"}).status, 2);
  EXPECT_EQ(run({"bench", "models", "--materials", "/nowhere.csv"}).status, 2);
}

}  // namespace
}  // namespace scattermeter::apps
