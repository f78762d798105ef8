#include "apps/results/result_reader.h"

#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/fixtures/apps/exported.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

TEST(ResultReader, NamesWhatIsWrong) {
  const auto error = [](const std::function<void(nlohmann::json&)>& spoil) {
    nlohmann::json json = made_result(kExported);
    spoil(json);
    const Answer answer = Exported(json).run_format("csv");
    EXPECT_EQ(answer.status, 2);
    return answer.err;
  };
  EXPECT_THAT(error([](auto& j) { j["results"][4].erase("sigma_a_per_mm"); }),
              HasSubstr("result.json: results[4].sigma_a_per_mm: is missing"));
  EXPECT_THAT(error([](auto& j) { j["results"][0]["sigma_s_prime_per_mm"]["value"] = -2; }),
              HasSubstr("results[0].sigma_s_prime_per_mm.value: expected a number from"));
  EXPECT_THAT(error([](auto& j) { j["results"][0]["channel"] = "X"; }),
              HasSubstr("results[0].channel: expected R, G or B, got \"X\""));
  EXPECT_THAT(error([](auto& j) { j["results"][1]["channel"] = "R"; }),
              HasSubstr("has this channel twice"));
  EXPECT_THAT(error([](auto& j) { j["results"].erase(0); }), HasSubstr("has no channel R"));
  EXPECT_THAT(error([](auto& j) { j["results"][0]["eta"] = 1.5; }), HasSubstr("different eta"));
  EXPECT_THAT(error([](auto& j) { j["results"][0]["verdict"] = "maybe"; }),
              HasSubstr("verdict: expected ok or refused, got \"maybe\""));
  EXPECT_THAT(error([](auto& j) { j["results"] = nlohmann::json::array(); }),
              HasSubstr("expected at least one entry"));
  EXPECT_THAT(error([](auto& j) { j = nlohmann::json::array(); }), HasSubstr("expected an object"));
  const Exported exported;
  EXPECT_THAT(exported.run_format("csv", {"--material", "PP"}).err,
              HasSubstr("holds no material PP, only "));
  EXPECT_EQ(exported.run_format("obj").status, 2);
  EXPECT_EQ(run({"export", "/nowhere.json", "--format", "csv", "--out", exported.out()}).status, 2);
  write_file(exported.result(), std::string("{\"results\": ["));
  EXPECT_THAT(exported.run_format("csv").err, HasSubstr("is not JSON"));
}

}  // namespace
}  // namespace scattermeter::apps
