#include "apps/bench/bench_noise.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/rig/open_objects.h"
#include "tests/fixtures/apps/small_rig.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

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

}  // namespace
}  // namespace scattermeter::apps
