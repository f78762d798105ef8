#include "apps/results/result_reader.h"

#include <cmath>
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
  EXPECT_THAT(exported.run_format("csv").err,
              HasSubstr("is not JSON (line 1); give the result.json that `measure` has written"));
  write_file(exported.result(), std::string("{\"version\": 1e999}"));
  EXPECT_THAT(exported.run_format("csv").err,
              HasSubstr("holds a number beyond 1.8e+308; give the result.json"));
  write_file(exported.result(), "{\"version\": " + std::string(1000000, '[') +
                                    std::string(1000000, ']') + ", \"results\": []}");
  EXPECT_THAT(exported.run_format("csv").err, HasSubstr("version: expected text, got a list"));
  write_file(exported.result(), std::string("{\"format\": 1}"));
  EXPECT_THAT(exported.run_format("csv").err, HasSubstr("has no results; give the result.json"));
}

TEST(ResultReader, ReadsWhatWasMeasured) {
  nlohmann::json json = made_result(kExported);
  json["results"][4]["verdict"] = "refused";
  json["results"][4]["reasons"] = {"dark", "and wrong"};
  json["results"][4]["sigma_a_per_mm"] = {
      {"value", nullptr}, {"std", nullptr}, {"interval95", {nullptr, nullptr}}};
  const Exported exported(json);
  const ReadResult result = read_result(exported.result());
  EXPECT_EQ(result.path, exported.result());
  EXPECT_EQ(result.version, "0.1.0");
  EXPECT_EQ(result.command, "scattermeter measure -- shots");
  ASSERT_EQ(result.channels.size(), 6U);
  const ReadChannel& blue = result.channels[5];
  EXPECT_EQ(blue.material, "POM");
  EXPECT_EQ(blue.channel, 'B');
  EXPECT_EQ(blue.model, "dipole");
  EXPECT_EQ(blue.eta_int_over_ext, 1.4);
  EXPECT_EQ(blue.sigma_s_prime_per_mm.value, 1.75);
  EXPECT_EQ(blue.sigma_s_prime_per_mm.std, 1.75 / 4);
  EXPECT_EQ(blue.sigma_a_per_mm.low95, 0.004);
  EXPECT_EQ(blue.sigma_a_per_mm.high95, 0.016);
  EXPECT_EQ(blue.correlation, 0.5);
  EXPECT_FALSE(blue.refused);
  EXPECT_EQ(blue.medium().sigma_a_per_mm, 0.008);
  EXPECT_TRUE(result.channels[4].refused);
  EXPECT_TRUE(std::isnan(result.channels[4].sigma_a_per_mm.value));
  EXPECT_EQ(result.channels[4].reasons, (std::vector<std::string>{"dark", "and wrong"}));

  const std::vector<MeasuredMaterial> all = materials_of(result);
  EXPECT_EQ(names_of(all), (std::vector<std::string>{kNasty, "POM"}));
  EXPECT_FALSE(all[0].refused());
  EXPECT_TRUE(all[1].refused());
  EXPECT_EQ(all[1].rgb[0].sigma_s_prime_per_mm.value, 1.4);
  EXPECT_EQ(refusals(all), std::vector<std::string>{"POM G is refused: dark"});
  EXPECT_EQ(names_of(materials_of(result, {"POM"})), std::vector<std::string>{"POM"});
}

}  // namespace
}  // namespace scattermeter::apps
