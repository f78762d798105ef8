// The command's files and statuses (0: tests/apps/checking/check_test.cc).
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/fixtures/apps/small_rig.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

TEST(CheckCommand, StatusesAndFiles) {
  SmallRig rig;
  rig.keep_shots("PE_cube_1");
  rig.simulate();
  const std::vector<std::string> words = {"check",   rig.shots(), "--rig",
                                          rig.rig(), "--out",     rig.out()};
  // The rig now states less than half of the noise's variance: the check fails, and its files are
  // written.
  rig.write(replaced(rig.text(), "gain_e_per_count: 6.0", "gain_e_per_count: 14.0"));
  const Answer failed = run(words);
  EXPECT_EQ(failed.status, 1) << failed.out << failed.err;
  EXPECT_THAT(failed.out, HasSubstr("FAIL noise"));
  const nlohmann::json json = nlohmann::json::parse(slurp(rig.out() + "/check.json"));
  EXPECT_EQ(json["passed"], false);
  EXPECT_THAT(json["command"].get<std::string>(), HasSubstr("scattermeter check"));
  EXPECT_GT(std::filesystem::file_size(rig.out() + "/check.html"), 10000U);
  std::filesystem::remove_all(rig.shots());
  std::filesystem::remove_all(rig.out());
  EXPECT_EQ(run(words).status, 2);
  EXPECT_FALSE(std::filesystem::exists(rig.out()));
}

}  // namespace
}  // namespace scattermeter::apps
