#include "apps/instrument/instrument.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "apps/results/result_json.h"
#include "apps/rig/open_objects.h"
#include "apps/simulation/virtual_shots.h"
#include "core/mesh/bodies.h"
#include "tests/fixtures/apps/small_rig.h"

namespace scattermeter::apps {
namespace {

using Json = nlohmann::json;

class InstrumentTest : public ::testing::Test {
 protected:
  InstrumentTest() {
    files_.keep_shots("PE_cube");
    rig_ = read_rig(files_.rig());
    scenes_ = open_objects(rig_);
    shots_ = std::make_unique<VirtualShots>(rig_, scenes_, VirtualShotOptions{.noise = true});
  }

  capture::FrameSource frames(std::uint64_t seed) const {
    return [this, seed](std::size_t i, std::size_t k) { return shots_->frame(i, seed, k); };
  }
  static Json results(const Measurement& m) { return Json::parse(result_json(m, ""))["results"]; }

  SmallRig files_;
  Rig rig_;
  ObjectScenes scenes_;
  MeasureOptions options_;
  std::unique_ptr<VirtualShots> shots_;
};

TEST_F(InstrumentTest, FilesAndMemoryGiveTheSameDigits) {
  files_.simulate({"--seed", "3"});
  const Measurement by_files = measure(rig_, files_.shots(), options_);
  Instrument instrument(rig_, scenes_, options_);
  // Whatever was measured before leaves no trace.
  const Measurement other = instrument.measure(
      capture::shots_from(rig_.scene, capture::all_shots(rig_.scene), frames(4)));
  const Measurement by_memory = instrument.measure(
      capture::shots_from(rig_.scene, capture::all_shots(rig_.scene), frames(3)));
  EXPECT_EQ(results(by_files), results(by_memory));
  EXPECT_NE(results(by_files), results(other));
  EXPECT_EQ(by_files.patch_size_mm, by_memory.patch_size_mm);
  EXPECT_FALSE(by_memory.any_refused());
}

TEST_F(InstrumentTest, PartOfTheShots) {
  Instrument instrument(rig_, scenes_, options_);
  const Measurement one = instrument.measure(capture::shots_from(rig_.scene, {1}, frames(3)));
  ASSERT_EQ(one.results.size(), 3U);
  EXPECT_EQ(one.results[0].shots, std::vector<std::string>{"PE_cube_2.dng"});
  // The same as a rig that has no other shot.
  Rig alone = rig_;
  alone.scene.shots = {rig_.scene.shots[1]};
  Instrument other(alone, scenes_, options_);
  EXPECT_EQ(results(other.measure(capture::shots_from(
                alone.scene, {0}, capture::FrameSource([this](std::size_t, std::size_t) {
                  return shots_->frame(1, 3);
                })))),
            results(one));
}

// Neither noise nor rounding: what is left is the method's own error.
TEST_F(InstrumentTest, IdealSamples) {
  Instrument instrument(rig_, scenes_, options_);
  const capture::SampleSource ideal = [this](std::size_t i, const SampleMap& where) {
    return shots_->ideal_samples(i, where.x0, where.y0, where.width, where.height);
  };
  const Measurement m =
      instrument.measure(capture::shots_from(rig_.scene, capture::all_shots(rig_.scene), ideal));
  ASSERT_EQ(m.results.size(), 3U);
  for (std::size_t c = 0; c < 3; ++c) {
    const Estimate& e = m.results[c].estimate;
    const Medium& truth = rig_.truth.materials.at("PE")[c];
    // A patch of 1 mm has some 12 samples of a colour, of which the estimate is a mean.
    EXPECT_NEAR(e.sigma_s_prime_per_mm.value / truth.sigma_s_prime_per_mm, 1.0, 0.01);
    EXPECT_NEAR(e.sigma_a_per_mm.value / truth.sigma_a_per_mm, 1.0, 0.05);
    // Second differences of the signal are nothing beside the noise that there could be.
    EXPECT_LT(e.reduced_chi2, 0.2);
  }
}

// The cosine of the small rig's LEDs, tabulated: shots under one measured with the other.
TEST_F(InstrumentTest, ATabulatedLobeIsTheLobe) {
  std::vector<double> angles_rad, relative;
  for (int k = 0; k <= 90; k += 5) {
    angles_rad.push_back(k * std::numbers::pi / 180.0);
    relative.push_back(k == 90 ? 0.0 : std::cos(angles_rad.back()));
  }
  Rig tabulated = rig_;
  for (SceneLight& light : tabulated.scene.lights) {
    ASSERT_EQ(light.led()->led.exponent, 1.0);
    light.led()->led.table = std::make_shared<LobeTable>(angles_rad, relative);
    light.led()->led.exponent = 0.0;
  }
  const auto measured = [&](const Rig& rig) {
    Instrument instrument(rig, scenes_, options_);
    return instrument.measure(
        capture::shots_from(rig.scene, capture::all_shots(rig.scene), frames(3)));
  };
  const Measurement power = measured(rig_);
  const Measurement table = measured(tabulated);
  for (std::size_t c = 0; c < 3; ++c) {
    const Estimate& a = power.results[c].estimate;
    const Estimate& b = table.results[c].estimate;
    ASSERT_TRUE(a.converged && b.converged);
    EXPECT_NEAR(b.sigma_s_prime_per_mm.value, a.sigma_s_prime_per_mm.value,
                2e-3 * a.sigma_s_prime_per_mm.value);
    EXPECT_NEAR(b.sigma_s_prime_per_mm.std, a.sigma_s_prime_per_mm.std,
                0.05 * a.sigma_s_prime_per_mm.std);
  }
}

// What an eta that is off changes is followed at the medium that is found, not at the first guess.
TEST_F(InstrumentTest, FollowsAnEtaThatIsOff) {
  const auto measured = [&](double eta_off) {
    Rig off = rig_;
    for (SceneObject& object : off.scene.objects) {
      object.eta_int_over_ext += eta_off;
      object.eta_std = 0.04;
    }
    const ObjectScenes scenes = open_objects(off);
    Instrument instrument(off, scenes, options_);
    return instrument.measure(
        capture::shots_from(off.scene, capture::all_shots(off.scene), frames(3)));
  };
  const Measurement stated = measured(0.0);
  const Measurement off = measured(0.06);
  for (std::size_t c = 0; c < 3; ++c) {
    const Estimate& a = stated.results[c].estimate;
    const Estimate& b = off.results[c].estimate;
    ASSERT_TRUE(a.converged && b.converged);
    EXPECT_NEAR(b.sigma_s_prime_per_mm.value / a.sigma_s_prime_per_mm.value, 1.0, 0.005) << c;
    EXPECT_NEAR(b.sigma_a_per_mm.value / a.sigma_a_per_mm.value, 1.0, 0.02) << c;
  }
}

TEST_F(InstrumentTest, IdealSamplesNeedAPose) {
  Rig board = rig_;
  board.pose.points.clear();
  board.pose.charuco = calib::CharucoBoard{};
  Instrument instrument(board, scenes_, options_);
  const capture::SampleSource none = [](std::size_t, const SampleMap&) { return CfaSamples{}; };
  EXPECT_THROW(instrument.measure(capture::shots_from(board.scene, {0}, none)),
               std::invalid_argument);
}

// Points read far worse than stated belong to another lens or to other marks: no wider error makes
// such a pose right.
TEST_F(InstrumentTest, PosePointsThatScatterAreRefused) {
  Rig rig = rig_;
  rig.pose.options.point_std_px = 0.1;
  for (std::size_t i = 0; i < rig.pose.points.size(); ++i) {
    rig.pose.points[i].image_px.x() += i % 2 == 0 ? 0.6 : -0.6;
  }
  const auto refused_with = [&](double stated_px) {
    rig.pose.options.point_std_px = stated_px;
    Instrument instrument(rig, scenes_, options_);
    const Measurement m = instrument.measure(
        capture::shots_from(rig.scene, capture::all_shots(rig.scene), frames(3)));
    const std::vector<std::string>& reasons = m.results.at(0).estimate.reasons;
    return std::any_of(reasons.begin(), reasons.end(), [](const std::string& r) {
      return r.find("pose points scatter by") != std::string::npos;
    });
  };
  EXPECT_TRUE(refused_with(0.1));
  EXPECT_FALSE(refused_with(0.6));
}

}  // namespace
}  // namespace scattermeter::apps
