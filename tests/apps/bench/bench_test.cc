#include <algorithm>
#include <cmath>
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/bench/bench_noise.h"
#include "apps/bench/bench_rig.h"
#include "apps/bench/bench_transport.h"
#include "apps/bench/estimate_statistics.h"
#include "apps/bench/pull_plot.h"
#include "apps/instrument/open_objects.h"
#include "apps/simulation/bodies_rig.h"
#include "apps/simulation/plastics_rig.h"
#include "apps/simulation/virtual_shots.h"
#include "capture/files/obj_reader.h"
#include "core/mesh/bodies.h"
#include "tests/fixtures/apps/small_rig.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

TEST(EstimateStatistics, ByHand) {
  // Truth 10; answers 9 and 13, each with its deviation and interval.
  const EstimateStatistics s =
      estimate_statistics(10.0, {{{9.0, 1.0, 7.04, 10.96}, 0.5}, {{13.0, 1.0, 11.04, 14.96}, 0.5}});
  EXPECT_EQ(s.n, 2U);
  EXPECT_DOUBLE_EQ(s.mean, 11.0);
  EXPECT_DOUBLE_EQ(s.bias_relative, 0.1);
  EXPECT_DOUBLE_EQ(s.sampled_std, std::sqrt(8.0));
  EXPECT_DOUBLE_EQ(s.bias_relative_std, 0.2);  // sqrt(8) / sqrt(2) / 10
  EXPECT_DOUBLE_EQ(s.predicted_std, 1.0);
  EXPECT_DOUBLE_EQ(s.std_ratio, std::sqrt(8.0));
  EXPECT_DOUBLE_EQ(s.rmse, std::sqrt(5.0));
  EXPECT_DOUBLE_EQ(s.rmse_over_noise_std, std::sqrt(5.0) / 0.5);
  EXPECT_DOUBLE_EQ(s.coverage95, 0.5);
  EXPECT_EQ(s.pulls, (std::vector<double>{-1.0, 3.0}));
  EXPECT_TRUE(std::isnan(estimate_statistics(1.0, {}).mean));
  EXPECT_TRUE(std::isnan(coefficient_of_variation({1.0})));
  EXPECT_DOUBLE_EQ(coefficient_of_variation({1.0, 3.0}), std::sqrt(2.0) / 2.0);
}

TEST(EstimateStatistics, NoiseLineOfTheBudget) {
  Estimate e;
  EXPECT_TRUE(std::isnan(noise_std(e).sigma_a_per_mm));
  e.budget = {{"scale", 1.0, 2.0}, {"noise", 3.0, 4.0}};
  EXPECT_EQ(noise_std(e).sigma_s_prime_per_mm, 3.0);
  EXPECT_EQ(noise_std(e).sigma_a_per_mm, 4.0);
}

TEST(PullPlot, IsADensity) {
  const Plot plot = pull_plot("t", {{"a", {0.1, 0.2, -9.0, 9.0, std::nan("")}}});
  ASSERT_EQ(plot.series.size(), 2U);
  double sum = 0.0;
  for (double y : plot.series[0].y) sum += 0.5 * y;
  EXPECT_DOUBLE_EQ(sum, 1.0);
  EXPECT_DOUBLE_EQ(plot.series[0].y.front(), 0.5);  // a quarter over half a deviation
  EXPECT_DOUBLE_EQ(plot.series[0].y.back(), 0.5);
}

// The meshes in code are the sample's.
TEST(PlasticsRig, BodiesAreTheSamples) {
  const std::string samples = std::string(SCATTERMETER_SOURCE_DIR) + "/samples/three_plastics/";
  for (const auto& [mesh, file] : {std::pair{cube_mesh(), "cube.obj"},
                                   {pyramid_on_pedestal_mesh(), "pyramid_on_pedestal.obj"}}) {
    EXPECT_EQ(mesh_problem(mesh), "");
    const TriangleMesh read = capture::read_obj(samples + file);
    EXPECT_EQ(mesh.triangles.size(), read.triangles.size());
    EXPECT_NEAR(signed_volume_mm3(mesh), signed_volume_mm3(read), 1e-9);
    EXPECT_EQ(bounds(mesh).min_mm, bounds(read).min_mm);
    EXPECT_EQ(bounds(mesh).max_mm, bounds(read).max_mm);
  }
}

TEST(PlasticsRig, RefusesOtherWidths) {
  EXPECT_THROW(plastics_rig(100), std::invalid_argument);
  const Rig rig = plastics_rig(969);
  EXPECT_EQ(rig.scene.camera.intrinsics.width_px, 968);
  EXPECT_EQ(rig.scene.camera.intrinsics.height_px % 2, 0);
  EXPECT_EQ(plastics_rig(3872).scene.camera.intrinsics.height_px, 2592);
  EXPECT_EQ(rig.scene.shots.size(), 12U);
}

// Both bodies are wholly in the frame, and the brightest of the materials clips nowhere.
TEST(PlasticsRig, ShowsAll) {
  Rig rig = plastics_rig(242);
  std::erase_if(rig.scene.shots, [](const SceneShot& shot) { return shot.material != "POM"; });
  const ObjectScenes scenes = bodies_scenes(rig);
  const VirtualShots shots(rig, scenes, {.noise = false});
  ASSERT_EQ(shots.size(), 4U);
  const int top = rig.scene.camera.sensor.white_counts - rig.scene.camera.sensor.black_counts[0];
  for (std::size_t i = 0; i < shots.size(); ++i) {
    const LinearPicture& p = shots.picture(i);
    EXPECT_GT(p.x0, 0);
    EXPECT_GT(p.y0, 0);
    EXPECT_LT(p.x0 + p.width, rig.scene.camera.intrinsics.width_px);
    EXPECT_LT(p.y0 + p.height, rig.scene.camera.intrinsics.height_px);
    // Room for the noise of the brightest sample, some 60 counts.
    EXPECT_LT(*std::max_element(p.counts.begin(), p.counts.end()), top - 240)
        << rig.scene.shots[i].file;
  }
}

// One material's shots of the small rig from files; few seeds.
TEST(BenchNoise, FillsEveryColumn) {
  SmallRig files;
  files.keep_shots("PE_cube");
  const Answer r = run({"bench", "noise", "--rig", files.rig(), "--seeds", "3", "--seed", "9",
                        "--out", files.out()});
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.out, HasSubstr("RMSE/noise"));
  EXPECT_THAT(r.out, HasSubstr("0.003"));  // sigma_a of G
  const std::string csv = slurp(files.out() + "/noise.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 2 * 3);
  EXPECT_THAT(csv, HasSubstr("PE,G,sigma_s',3,1.05,"));
  EXPECT_THAT(csv, ::testing::Not(HasSubstr(",,")));  // no number is missing
  for (const char* picture : {"/noise_pulls.png", "/noise_pulls.svg"}) {
    EXPECT_GT(std::filesystem::file_size(files.out() + picture), 3000U);
  }
}

TEST(BenchNoise, SameSeedSameNumbers) {
  SmallRig files;
  files.keep_shots("PE_cube_1");
  const Rig rig = read_rig(files.rig());
  const ObjectScenes scenes = open_objects(rig);
  const auto csv = [&](std::uint64_t seed) {
    return noise_bench_csv(bench_noise(rig, scenes, {.seeds = 2, .seed = seed}));
  };
  const std::string first = csv(5);
  EXPECT_EQ(first, csv(5));
  EXPECT_NE(first, csv(6));
  EXPECT_THROW(bench_noise(rig, scenes, {.seeds = 1, .seed = 1}), std::invalid_argument);
}

TEST(BenchRig, TwoDraws) {
  RigBenchOptions options;
  options.draws = 2;
  options.image_width_px = 320;

  const RigBench bench = bench_rig(options);
  ASSERT_EQ(bench.rows.size(), 9U);
  EXPECT_EQ(bench.singles.size(), 2U * 12U * 3U);
  for (const RigBenchRow& row : bench.rows) {
    const EstimateStatistics& s = row.sigma_s_prime_per_mm.joint;
    if (s.n == 0) continue;  // refused
    EXPECT_LT(std::abs(s.bias_relative), 0.2) << row.material << row.channel;
    // The rig owns up to more than the noise.
    EXPECT_GT(s.predicted_std, 0.0);
  }
  const std::string csv = single_shot_csv(bench);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 72);
  EXPECT_THAT(rig_bench_table(bench), HasSubstr("single shots vary by"));
  options.draws = 1;
  EXPECT_THROW(bench_rig(options), std::invalid_argument);
  options.draws = 2;
  options.point_std_px = -1.0;
  EXPECT_THROW(bench_rig(options), std::invalid_argument);
}

TEST(BenchTransport, AuditsEveryRow) {
  TransportBenchOptions options;
  options.seconds = 0.01;

  const std::vector<TransportBenchRow> rows = bench_transport(options);
  ASSERT_EQ(rows.size(), 30U);
  EXPECT_EQ(rows.front().triangles, 12);
  EXPECT_EQ(rows[21].triangles, 786432);
  EXPECT_EQ(rows.back().triangles, 327680);
  for (const TransportBenchRow& row : rows) {
    EXPECT_LT(std::abs(row.audit_error), 1e-9);
    // Of round bodies one path in some ten thousand is lost to rounding.
    EXPECT_LE(row.lost_paths, row.body == "cube" ? 0 : 2);
    EXPECT_GT(row.scatterings_per_s, 0.0);
    // Between 0.952 and 0.967 with long runs.
    EXPECT_NEAR(row.escaped, 0.96, 0.03);
  }
  EXPECT_THAT(transport_bench_csv(rows), HasSubstr("cube,786432,rays,"));
}

TEST(BenchCommand, BadUsage) {
  EXPECT_EQ(run({"bench"}).status, 2);
  EXPECT_EQ(run({"bench", "nothing"}).status, 2);
  EXPECT_EQ(run({"bench", "noise", "--seeds", "1"}).status, 2);
  EXPECT_EQ(run({"bench", "rig", "--image-width", "10"}).status, 2);
  EXPECT_EQ(run({"bench", "noise", "--rig", "/nowhere/rig.yaml"}).status, 2);
}

}  // namespace
}  // namespace scattermeter::apps
