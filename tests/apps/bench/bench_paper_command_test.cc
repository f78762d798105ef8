#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/small_rig.h"
#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

TEST(BenchPaperCommand, WritesItsPlots) {
  const TemporaryFolder folder;
  const Answer r =
      run({"bench", "--image-width", "240", "paper", "--noise", "on", "--out", folder / "out"});
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.out, HasSubstr("47.93"));
  for (const char* name :
       {"paper_psnr", "paper_reflectance", "paper_reflectance_ratio", "paper_absorption"}) {
    for (const char* extension : {".png", ".svg"}) {
      EXPECT_GT(std::filesystem::file_size(folder / "out/" + name + extension), 3000U);
    }
  }
  EXPECT_EQ(run({"bench", "paper", "--probe", "/nowhere.hdr"}).status, 2);
  EXPECT_EQ(run({"bench", "paper", "--projection", "round"}).status, 2);
}

}  // namespace
}  // namespace scattermeter::apps
