// The sample without a known rig: calibrate, check, measure.
#include <array>
#include <cmath>
#include <sstream>
#include <string>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/chi_square.h"
#include "tests/fixtures/apps/html_check.h"
#include "tests/fixtures/apps/small_rig.h"
#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::apps {
namespace {

using Json = nlohmann::json;
using ::testing::HasSubstr;

// The sample's rigs in a folder of their own, with the shots of one material.
class FromScratch : public testing::Test {
 protected:
  void SetUp() override {
    const std::string samples = std::string(SCATTERMETER_SOURCE_DIR) + "/samples/";
    for (const char* mesh : {"cube.obj", "pyramid_on_pedestal.obj"}) {
      write_file(folder_ / mesh, slurp(samples + "three_plastics/" + mesh));
    }
    for (const char* rig : {"truth.yaml", "rough.yaml", "rig.yaml"}) {
      std::string kept;
      std::istringstream in(slurp(samples + "from_scratch/" + rig));
      for (std::string line; std::getline(in, line);) {
        if (line.find("material:") == std::string::npos || line.find("PE") != std::string::npos) {
          const std::size_t at = line.find("../three_plastics/");
          if (at != std::string::npos) line.erase(at, std::string("../three_plastics/").size());
          kept += line + "\n";
        }
      }
      write_file(folder_ / rig, kept);
    }
  }

  std::string operator()(const std::string& name) const { return folder_ / name; }
  void simulate() const {
    const Answer a = run({"simulate", folder_ / "truth.yaml", "--out", folder_ / "shots", "-q"});
    ASSERT_EQ(a.status, 0) << a.err;
  }
  void calibrate() const {
    for (const auto& [what, out] :
         {std::pair{"camera", "camera.yaml"}, {"radiance", "radiance.yaml"}, {"led", "leds"}}) {
      const Answer a = run({"calibrate", what, folder_ / "shots", "--rig", folder_ / "rough.yaml",
                            "--out", folder_ / out});
      ASSERT_EQ(a.status, 0) << what << a.out << a.err;
    }
  }
  Answer check() const {
    return run(
        {"check", folder_ / "shots", "--rig", folder_ / "rig.yaml", "--out", folder_ / "check"});
  }

  TemporaryFolder folder_;
};

TEST_F(FromScratch, CalibratesMeasuresAndNamesWhatChanged) {
  simulate();
  calibrate();
  const Answer checked = check();
  EXPECT_EQ(checked.status, 0) << checked.out << checked.err;
  // The page shows what the calibrations stand on.
  const std::string page = slurp((*this)("check/check.html"));
  EXPECT_EQ(html_problem(page), "");
  for (const char* text : {"White planes under the LEDs", "plane1_led1.dng under led1: rms",
                           "means of the flats in half octaves", "noise model with a gain of"}) {
    EXPECT_THAT(page, HasSubstr(text));
  }
  const Answer measured = run({"measure", (*this)("shots"), "--rig", (*this)("rig.yaml"), "--out",
                               (*this)("result"), "--model", "dipole"});
  EXPECT_EQ(measured.status, 0) << measured.out << measured.err;
  const Json result = Json::parse(slurp((*this)("result/result.json")));
  ASSERT_EQ(result["results"].size(), 3U);
  const std::array<double, 3> s_true = {0.90, 1.05, 1.20};
  const std::array<double, 3> a_true = {0.002, 0.003, 0.006};
  for (std::size_t c = 0; c < 3; ++c) {
    const Json& r = result["results"][c];
    const Json& s = r["sigma_s_prime_per_mm"];
    const Json& a = r["sigma_a_per_mm"];
    // Both together, with their correlation: one in 3000 lies beyond.
    const double ds = (s["value"].get<double>() - s_true[c]) / s["std"].get<double>();
    const double da = (a["value"].get<double>() - a_true[c]) / a["std"].get<double>();
    const double rho = r["correlation"];
    const double chi2 = (ds * ds - 2.0 * rho * ds * da + da * da) / (1.0 - rho * rho);
    EXPECT_GT(chi_square_tail(chi2, 2.0), 3e-4) << ds << " " << da << " " << rho;
    // And that is worth something.
    EXPECT_LT(s["std"].get<double>(), 0.005 * s_true[c]);
    EXPECT_LT(a["std"].get<double>(), 0.03 * a_true[c]);
    bool named = false;
    for (const Json& line : r["budget"]) named = named || line["cause"] == "LED calibration";
    EXPECT_TRUE(named);
  }
  // The calibrations are inputs, too.
  const std::string inputs = result["inputs"].dump();
  for (const char* file : {"camera.yaml", "radiance.yaml", "led1.yaml", "led2.yaml"}) {
    EXPECT_THAT(inputs, HasSubstr(file));
  }

  // What has changed since the calibration is named.
  const std::string truth = slurp((*this)("truth.yaml"));
  const auto named = [&](const std::string& what) {
    const Answer a = check();
    EXPECT_EQ(a.status, 1) << what << "\n" << a.out << a.err;
    EXPECT_THAT(a.out, ::testing::ContainsRegex(what)) << a.out;
  };
  const auto shoot_again = [&](const std::string& rig, const char* from, const char* to,
                               const std::string& folder) {
    write_file((*this)("truth.yaml"), replaced(rig, from, to));
    const Answer a = run({"simulate", (*this)("truth.yaml"), "--out", (*this)(folder), "--what",
                          "calibration", "-q"});
    ASSERT_EQ(a.status, 0) << a.err;
  };
  // Of dark frames, one with another setting.
  const std::size_t boards = truth.find("  camera:\n    board:");
  const std::size_t radiance = truth.find("  radiance:\n    dark:");
  ASSERT_LT(boards, radiance);
  const std::string darks = truth.substr(0, boards) + truth.substr(radiance);
  shoot_again(darks, "iso: 100", "iso: 400", "others");
  const std::string dark = slurp((*this)("shots/dark_1.dng"));
  write_file((*this)("shots/dark_1.dng"), slurp((*this)("others/dark_1.dng")));
  named("FAIL ISO of dark frames: dark_1.dng");
  write_file((*this)("shots/dark_1.dng"), dark);
  shoot_again(truth, "position_mm: [30.4, -60.7, 79.2]", "position_mm: [30.4, -58.7, 79.2]",
              "shots");
  named("FAIL LED places, from their shots: led1[^\n]*is (1.9|2.0|2.1)");
}

}  // namespace
}  // namespace scattermeter::apps
