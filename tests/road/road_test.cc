// The whole road: simulate -> files on disk -> measure -> truth, through every foreign library.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/light/sky_probe.h"
#include "tests/fixtures/apps/small_rig.h"

namespace scattermeter::apps {
namespace {

using Json = nlohmann::json;

struct Truth {
  std::array<double, 3> s, a;
};
const std::map<std::string, Truth> kTruth = {{"PP", {{0.50, 0.62, 0.70}, {0.003, 0.002, 0.004}}},
                                             {"PE", {{0.90, 1.05, 1.20}, {0.002, 0.003, 0.006}}},
                                             {"POM", {{1.40, 1.60, 1.75}, {0.002, 0.004, 0.008}}}};

// A Radiance picture without run lengths.
std::string flat_hdr(const Environment& probe) {
  std::string out = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(probe.height_px) +
                    " +X " + std::to_string(probe.width_px) + "\n";
  for (std::size_t i = 0; i < probe.radiance.size(); i += 3) {
    const float* rgb = &probe.radiance[i];
    int exponent = 0;
    const float top = std::max({rgb[0], rgb[1], rgb[2]});
    const float scale = std::frexp(top, &exponent) * 256.0F / top;
    for (std::size_t c = 0; c < 3; ++c) out += static_cast<char>(static_cast<int>(rgb[c] * scale));
    out += static_cast<char>(exponent + 128);
  }
  return out;
}

// Largest relative errors of sigma_s' and sigma_a over all results.
std::pair<double, double> worst_errors(const Json& result) {
  std::pair<double, double> worst;
  for (const Json& r : result["results"]) {
    const std::size_t c = std::string("RGB").find(r["channel"].get<std::string>());
    const Truth& truth = kTruth.at(r["material"]);
    const double s = r["sigma_s_prime_per_mm"]["value"];
    const double a = r["sigma_a_per_mm"]["value"];
    worst.first = std::max(worst.first, std::abs(s / truth.s[c] - 1.0));
    worst.second = std::max(worst.second, std::abs(a / truth.a[c] - 1.0));
  }
  return worst;
}

// The largest error, in stated deviations.
double worst_deviation(const Json& result) {
  double worst = 0.0;
  for (const Json& r : result["results"]) {
    const std::size_t c = std::string("RGB").find(r["channel"].get<std::string>());
    const Truth& truth = kTruth.at(r["material"]);
    const auto off = [&](const char* key, double true_value) {
      return std::abs(r[key]["value"].get<double>() - true_value) / r[key]["std"].get<double>();
    };
    worst = std::max(
        {worst, off("sigma_s_prime_per_mm", truth.s[c]), off("sigma_a_per_mm", truth.a[c])});
  }
  return worst;
}

// The results alone, without times and counts.
Json answers(const SmallRig& rig) { return Json::parse(rig.result())["results"]; }

std::size_t decoded_before(const SmallRig& rig) {
  return Json::parse(rig.result())["skipped"]["shots_decoded_before"];
}

// Measuring again decodes nothing twice, and what is not asked for is left undone; the answers are
// the same, digit by digit.
TEST(Road, SkipsWhatIsNotNeeded) {
  SmallRig rig;
  rig.keep_shots("_cube_");
  rig.simulate();
  const std::vector<std::string> dipole = {"--model", "dipole"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.end(), dipole.begin(), dipole.end());
    return rig.measure(more);
  };
  ASSERT_EQ(rig.measure(dipole).status, 0);
  const Json first = answers(rig);
  const Json skipped = Json::parse(rig.result())["skipped"];
  EXPECT_EQ(skipped["shots_decoded_before"], 0);
  EXPECT_EQ(skipped["shots_not_asked_for"], 0);
  EXPECT_GT(skipped["samples_beside_the_objects"], 0);
  EXPECT_GT(skipped["patches_not_seen"], 0);
  EXPECT_GT(skipped["patches_not_lit"], 0);
  EXPECT_GT(skipped["shadow_rays_on_convex_objects"], 0);  // of the cube
  ASSERT_EQ(rig.measure(dipole).status, 0);
  EXPECT_EQ(decoded_before(rig), 6U);
  EXPECT_EQ(answers(rig), first);
  ASSERT_EQ(with({"--no-cache"}).status, 0);
  EXPECT_EQ(decoded_before(rig), 0U);
  EXPECT_EQ(answers(rig), first);

  // Lights may change, what shots are made from may not.
  const std::string text = rig.text();
  rig.write(replaced(text, "position_mm: [30, -60, 80]", "position_mm: [30, -60, 80.01]"));
  ASSERT_EQ(rig.measure(dipole).status, 0);
  EXPECT_EQ(decoded_before(rig), 6U);
  EXPECT_NE(answers(rig), first);
  rig.write(replaced(text, "read_noise_counts: 1.2", "read_noise_counts: 1.3"));
  ASSERT_EQ(rig.measure(dipole).status, 0);
  EXPECT_EQ(decoded_before(rig), 0U);
  rig.write(text);
  ASSERT_EQ(rig.measure(dipole).status, 0);
  EXPECT_EQ(answers(rig), first);
  std::filesystem::copy_file(rig / "shots/PE_cube_1.dng", rig / "shots/PP_cube_1.dng",
                             std::filesystem::copy_options::overwrite_existing);
  rig.measure(dipole);
  EXPECT_EQ(decoded_before(rig), 5U);
  EXPECT_NE(answers(rig), first);

  ASSERT_EQ(with({"--material", "POM", "--channels", "G"}).status, 0);
  const Json some = Json::parse(rig.result());
  ASSERT_EQ(some["results"].size(), 1U);
  EXPECT_EQ(some["results"][0]["material"], "POM");
  EXPECT_EQ(some["results"][0]["channel"], "G");
  // The other channels only add to what is known about the rig's geometry.
  for (const char* name : {"sigma_s_prime_per_mm", "sigma_a_per_mm"}) {
    for (const char* part : {"value", "std"}) {
      const double whole = first[7][name][part];
      const double std = first[7][name]["std"];
      EXPECT_NEAR(some["results"][0][name][part], whole, 0.1 * std) << name << " " << part;
    }
  }
  EXPECT_EQ(some["skipped"]["shots_not_asked_for"], 4);
  EXPECT_EQ(some["skipped"]["channels_not_asked_for"], 2);
  EXPECT_EQ(some["notes"].size(), 0U) << some["notes"];
  const Answer unknown = with({"--material", "PVC"});
  EXPECT_EQ(unknown.status, 2);
  EXPECT_THAT(unknown.err, ::testing::HasSubstr("no shot is of material PVC"));
}

TEST(Road, TwelveSmallShotsWithNoise) {
  SmallRig rig;
  rig.simulate();
  const Answer r = rig.measure();
  EXPECT_EQ(r.status, 0) << r.out << r.err;
  const Json result = Json::parse(rig.result());
  ASSERT_EQ(result["results"].size(), 9U);
  const auto [s, a] = worst_errors(result);
  // At this resolution a patch has some 12 samples of a colour; the pose is known to 0.02 px. One
  // of 18 quantities is 3.6 deviations off in one of 200 runs.
  EXPECT_LT(s, 0.03) << r.out;
  EXPECT_LT(a, 0.1) << r.out;
  EXPECT_LT(worst_deviation(result), 3.6) << r.out;
  for (const Json& x : result["results"]) {
    EXPECT_EQ(x["verdict"], "ok");
    EXPECT_EQ(x["shots"].size(), 4U);
    EXPECT_EQ(x["model"], "dipole");
    EXPECT_GT(x["sigma_s_prime_per_mm"]["std"], 0.0);
    EXPECT_LT(x["residual"]["rms_relative"], 0.05);
    const double value = x["sigma_a_per_mm"]["value"];
    EXPECT_LE(x["sigma_a_per_mm"]["interval95"][0], value);
    EXPECT_GE(x["sigma_a_per_mm"]["interval95"][1], value);
  }
  EXPECT_EQ(result["inputs"].size(), 15U);  // rig, two meshes, twelve shots
  EXPECT_EQ(result["inputs"][0]["sha256"].get<std::string>().size(), 64U);
  EXPECT_GT(result["timing_s"]["total"], 0.0);
  EXPECT_THAT(r.out, ::testing::HasSubstr("POM"));
  EXPECT_EQ(r.err, "");
}

// A light probe and an LED at once: sky and sun of the probe differ by channel, and its power is a
// nuisance of its own.
TEST(Road, ProbeAndLedInOneShot) {
  SmallRig rig;
  rig.keep_shots("PE_pyramid_1");
  SkyProbe sky;
  sky.width_px = 256;
  const Environment probe = make_sky_probe(sky);
  write_file(rig / "sky.hdr", flat_hdr(probe));
  rig.write(
      replaced(replaced(rig.text(), "lights: [led1]}", "lights: [led1, sky], exposure_s: 0.02}"),
               "lights:\n",
               "lights:\n  sky: {type: environment, image: sky.hdr, projection: "
               "equirectangular, forward: [1, 0, 0], radiance_W_per_mm2_sr: [2e-7, 2e-7, "
               "2e-7], radiance_relative_std: 0.01}\n"));
  rig.simulate();
  const Answer r = rig.measure();
  EXPECT_EQ(r.status, 0) << r.out << r.err;
  const Json result = Json::parse(rig.result());
  const auto [s, a] = worst_errors(result);
  EXPECT_LT(s, 0.02) << r.out;
  EXPECT_LT(a, 0.15) << r.out;
  EXPECT_THAT(result["inputs"].dump(), ::testing::HasSubstr("sky.hdr"));
  bool named = false;
  for (const Json& line : result["results"][0]["budget"]) {
    named = named || line["cause"] == "environment power";
  }
  EXPECT_TRUE(named);
  // Without the probe in the rig, the answer would be another.
  rig.write(replaced(rig.text(), "[led1, sky]", "[led1]"));
  rig.measure({"--model", "dipole"});
  EXPECT_GT(worst_errors(Json::parse(rig.result())).second, 0.15);
}

TEST(Road, DiscLed) {
  SmallRig rig;
  rig.keep_shots("PE_pyramid_1");
  rig.write(replaced(rig.text(), "axis: [-30, 60, -70]", "radius_mm: 8, axis: [-30, 60, -70]"));
  rig.simulate();
  const Answer r = rig.measure();
  EXPECT_EQ(r.status, 0) << r.out << r.err;
  EXPECT_LT(worst_errors(Json::parse(rig.result())).first, 0.02) << r.out;
}

// Without a responsivity the scale is free; a shadow edge still tells sigma_s'.
TEST(Road, FreeScale) {
  SmallRig rig;
  rig.keep_shots("PE_");
  rig.simulate();
  rig.write(replaced(replaced(rig.text(), "  responsivity_relative_std: 0.01\n", ""),
                     "  responsivity_counts_mm2_sr_per_W_s: [2.4e10, 2.9e10, 2.1e10]\n", ""));
  const Answer r = rig.measure();
  EXPECT_EQ(r.status, 0) << r.out << r.err;
  const Json result = Json::parse(rig.result());
  const auto [s, a] = worst_errors(result);
  EXPECT_LT(s, 0.05) << r.out;
  EXPECT_LT(a, 0.15) << r.out;
  // It settles on the responsivity that made the shots.
  EXPECT_NEAR(result["results"][0]["scale"]["value"].get<double>() / 2.4e10, 1.0, 0.05);
}

// Both LEDs on at once: their weights add, each with its own power.
TEST(Road, TwoLightsInOneShot) {
  SmallRig rig;
  rig.keep_shots("PE_cube_1");
  rig.write(replaced(rig.text(), "lights: [led1]}", "lights: [led1, led2], exposure_s: 0.03}"));
  rig.simulate();
  const Answer r = rig.measure();
  EXPECT_EQ(r.status, 0) << r.out << r.err;
  EXPECT_LT(worst_errors(Json::parse(rig.result())).first, 0.04) << r.out;
  EXPECT_LT(worst_deviation(Json::parse(rig.result())), 3.3) << r.out;
}

// The lossy tone curve of a compressed NEF and a camera whose colours start elsewhere.
TEST(Road, ToneCurveAndOtherPhase) {
  SmallRig rig;
  rig.keep_shots("PE_pyramid");
  rig.write(replaced(rig.text(), "black_counts: 64}",
                     "black_counts: 64, cfa: GBRG, tone_curve: nef_lossy}"));
  rig.simulate();
  const Answer r = rig.measure();
  EXPECT_EQ(r.status, 0) << r.out << r.err;
  EXPECT_LT(worst_errors(Json::parse(rig.result())).first, 0.02) << r.out;
}

// Files as the target camera makes them, one shot a bracket.
TEST(Road, NefsOfAD80) {
  SmallRig rig;
  rig.keep_shots("PE_pyramid");
  rig.write(replaced(replaced(rig.text(), "black_counts: 64}", "black_counts: 0}"),
                     "{file: PE_pyramid_1.dng,",
                     "{file: [short.NEF, long.NEF], exposure_s: [0.01, 0.1],"));
  rig.simulate({"--raw-format", "nef"});
  const Answer r = rig.measure();
  EXPECT_EQ(r.status, 0) << r.out << r.err;
  const Json result = Json::parse(rig.result());
  EXPECT_EQ(result["brackets"].size(), 1U);
  EXPECT_LT(worst_errors(result).first, 0.02) << r.out;
}

TEST(Road, PaperModel) {
  SmallRig rig;
  rig.keep_shots("PE_pyramid_2");
  rig.simulate({"--noise", "off"});
  const Answer r = rig.measure({"--model", "paper"});
  EXPECT_LE(r.status, 1) << r.err;
  const Json result = Json::parse(rig.result());
  ASSERT_EQ(result["results"].size(), 3U);
  for (const Json& x : result["results"]) {
    EXPECT_EQ(x["model"], "paper");
    // On its grid, and no more is promised of it.
    const double s = x["sigma_s_prime_per_mm"]["value"];
    EXPECT_NEAR(s / 0.01, std::round(s / 0.01), 1e-6);
    EXPECT_EQ(x["verdict"] == "refused", !x["reasons"].empty());
  }
}

// Same input, same seed: the same digits for any number of threads.
TEST(Road, ThreadsDoNotChangeTheDigits) {
  std::vector<Json> results;
  std::vector<std::string> shots;
  for (const char* threads : {"1", "3"}) {
    SmallRig rig;
    rig.keep_shots("POM_cube");
    rig.simulate({"--threads", threads, "--seed", "7"});
    shots.push_back(slurp(rig.shots() + "/POM_cube_1.dng"));
    EXPECT_EQ(rig.measure({"--threads", threads}).status, 0);
    results.push_back(Json::parse(rig.result())["results"]);
  }
  EXPECT_TRUE(shots[0] == shots[1]);
  EXPECT_EQ(results[0], results[1]);
}

TEST(Road, SeedsAndNoiseChangeTheShots) {
  SmallRig rig;
  rig.keep_shots("POM_cube_1");
  std::vector<std::string> shots;
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{"--seed", "1"}, {"--seed", "2"}, {"--noise", "off"}}) {
    rig.simulate(more);
    shots.push_back(slurp(rig.shots() + "/POM_cube_1.dng"));
  }
  EXPECT_FALSE(shots[0] == shots[1]);
  EXPECT_FALSE(shots[0] == shots[2]);
}

// No exposure in the rig: one is chosen, nothing clips, and the answer is the same.
TEST(Road, ExposureIsChosen) {
  SmallRig rig;
  rig.keep_shots("PP_cube");
  rig.write(replaced(rig.text(), "  exposure_s: 0.05\n", ""));
  rig.simulate();
  const Answer r = rig.measure();
  EXPECT_EQ(r.status, 0) << r.out << r.err;
  EXPECT_LT(worst_errors(Json::parse(rig.result())).first, 0.02) << r.out;
}

// The LEDs stood elsewhere than the rig says, by as much as it owns up to: the answer is still
// right within the uncertainty it states, which is wider for it; a rig that claims to be exact is
// wrong.
TEST(Road, MisplacedLedIsInTheUncertainty) {
  SmallRig rig;
  rig.keep_shots("PE_");
  const std::string nominal = rig.text();
  rig.write(replaced(replaced(nominal, "[30, -60, 80]", "[30.5, -60.6, 79.5]"), "[-70, -20, 60]",
                     "[-70.4, -19.5, 60.6]"));
  rig.simulate();
  std::string honest = nominal;
  std::string exact = nominal;
  for (const char* axis : {"axis: [-30, 60, -70]", "axis: [70, 20, -50]"}) {
    honest = replaced(honest, axis, std::string("position_std_mm: 0.5, ") + axis);
    exact = replaced(exact, axis, std::string("position_std_mm: 0, axis_std_deg: 0, ") + axis);
  }
  rig.write(exact);
  rig.measure({"--model", "dipole"});
  const Json blind = Json::parse(rig.result())["results"];
  rig.write(honest);
  EXPECT_EQ(rig.measure({"--model", "dipole"}).status, 0);
  const Json aware = Json::parse(rig.result())["results"];
  for (std::size_t c = 0; c < 3; ++c) {
    const auto off = [&](const Json& r, const char* key, double truth) {
      return std::abs(r[key]["value"].get<double>() - truth) / r[key]["std"].get<double>();
    };
    const Truth& truth = kTruth.at("PE");
    // Four deviations: two quantities, three channels, one draw of the LEDs.
    EXPECT_LT(off(aware[c], "sigma_s_prime_per_mm", truth.s[c]), 4.0) << aware[c].dump(1);
    EXPECT_LT(off(aware[c], "sigma_a_per_mm", truth.a[c]), 4.0) << aware[c].dump(1);
    // A rig that calls its LEDs exact is contradicted by the image.
    EXPECT_EQ(blind[c]["verdict"], "refused") << blind[c].dump(1);
    EXPECT_LT(aware[c]["residual"]["reduced_chi2"], 1.2);
    bool named = false;
    for (const Json& line : aware[c]["budget"]) named = named || line["cause"] == "LED position";
    EXPECT_TRUE(named);
  }
}

// No marks given: the pose comes from a board that lies around the object in the shot itself.
TEST(Road, BoardInTheShot) {
  SmallRig rig;
  rig.keep_shots("PE_pyramid");
  const std::size_t begin = rig.text().find("  points:");
  const std::size_t end = rig.text().find("objects:");
  rig.write(rig.text().substr(0, begin) +
            "  charuco: {squares: [10, 8], square_mm: 6, marker_mm: 4.5, dictionary: DICT_4X4_100, "
            "origin_mm: [-30, -22, 0]}\n" +
            rig.text().substr(end) +
            "  pose: {position_mm: [0, -100, 150], look_at_mm: [0, 0, 9]}\n");
  rig.write(replaced(replaced(rig.text(), "[484, 324]", "[968, 648]"),
                     "{fx_px: 1229.5, fy_px: 1229.5, cx_px: 241.8, cy_px: 161.2}",
                     "{fx_px: 2459, fy_px: 2459, cx_px: 483.6, cy_px: 322.4}"));
  rig.simulate();
  const Answer checked = run({"check", rig.shots(), "--rig", rig.rig()});
  EXPECT_EQ(checked.status, 0) << checked.out << checked.err;
  EXPECT_THAT(checked.out, ::testing::HasSubstr("PE_pyramid_"));
  const Answer r = rig.measure();
  EXPECT_EQ(r.status, 0) << r.out << r.err;
  const auto [s, a] = worst_errors(Json::parse(rig.result()));
  EXPECT_LT(s, 0.03) << r.out;
  EXPECT_LT(a, 0.10) << r.out;
  // Without the board in sight, the shot is named.
  rig.write(replaced(rig.text(), "DICT_4X4_100", "DICT_6X6_100"));
  const Answer blind = rig.measure();
  EXPECT_EQ(blind.status, 2);
  EXPECT_THAT(blind.err, ::testing::HasSubstr(".dng: pose.charuco: the board is not seen"));
}

TEST(Road, CheckPassesOnAGoodRig) {
  SmallRig rig;
  rig.keep_shots("POM_");
  rig.simulate();
  const Answer r = run({"check", rig.shots(), "--rig", rig.rig()});
  EXPECT_EQ(r.status, 0) << r.out << r.err;
  EXPECT_THAT(r.out, ::testing::HasSubstr("pose.points, 8 points"));
}

TEST(Road, CheckNamesAnOverexposedShot) {
  SmallRig rig;
  rig.keep_shots("POM_cube");
  rig.write(replaced(rig.text(), "lights: [led2]}", "lights: [led2], exposure_s: 0.5}"));
  rig.simulate();
  const Answer r = run({"check", rig.shots(), "--rig", rig.rig()});
  EXPECT_EQ(r.status, 1);
  EXPECT_THAT(r.out,
              ::testing::ContainsRegex("FAIL clipped: POM_cube_2.dng [RGB]: expose shorter"));
}

}  // namespace
}  // namespace scattermeter::apps
