#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/fixtures/apps/exported.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

TEST(ExportCommand, RefusedIsNotWritten) {
  nlohmann::json json = made_result(kExported);
  for (nlohmann::json& entry : json["results"]) {
    if (entry["material"] != "POM" || entry["channel"] != "B") continue;
    entry["verdict"] = "refused";
    entry["reasons"] = {"The dipole does not fit."};
    entry["sigma_a_per_mm"] = {
        {"value", nullptr}, {"std", nullptr}, {"interval95", {nullptr, nullptr}}};
  }
  const Exported exported(json);
  for (const char* format : {"mitsuba", "pbrt", "blender", "openpbr", "materialx"}) {
    const Answer answer = exported.run_format(format);
    EXPECT_EQ(answer.status, 1) << format;
    EXPECT_THAT(answer.err, HasSubstr("POM B is refused: The dipole does not fit."));
    EXPECT_THAT(answer.err, HasSubstr("nothing is written"));
    EXPECT_EQ(slurp(exported.out()), "");
  }
  // The others can be had.
  EXPECT_EQ(exported.run_format("pbrt", {"--material", kNasty}).status, 0);
  EXPECT_THAT(slurp(exported.out()), ::testing::Not(HasSubstr("POM R")));
  // The table tells the verdict and keeps the numbers to itself.
  const Answer csv = exported.run_format("csv");
  EXPECT_EQ(csv.status, 1);
  EXPECT_THAT(slurp(exported.out()), HasSubstr("POM,B,refused,dipole,1.4,,,,,,,,,,The dipole"));
}

TEST(ExportCommand, ReplacesExportsOnly) {
  const Exported exported(made_result(kExported));
  for (const char* format : {"mitsuba", "pbrt", "blender", "openpbr", "materialx", "csv", "csv"}) {
    EXPECT_EQ(exported.run_format(format).status, 0) << format;
  }
  write_file(exported.out(), std::string("scattermeter_rig: 1\n"));
  const Answer answer = exported.run_format("csv");
  EXPECT_EQ(answer.status, 2);
  EXPECT_THAT(answer.err, HasSubstr("was not written by `export`"));
  EXPECT_EQ(slurp(exported.out()), "scattermeter_rig: 1\n");
}

}  // namespace
}  // namespace scattermeter::apps
