#include <algorithm>
#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/small_rig.h"
#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

TEST(BenchModelsCommand, WritesItsTableAndPlots) {
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
