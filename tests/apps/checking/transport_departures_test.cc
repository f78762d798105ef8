#include "apps/checking/transport_departures.h"

#include <cmath>

#include <gtest/gtest.h>

namespace scattermeter::apps {
namespace {

// One LED, whose position along x is stated to 0.3 mm but was searched with 2 mm, and one shot.
class TransportDeparturesTest : public ::testing::Test {
 protected:
  TransportDeparturesTest() {
    LedLight led;
    led.position_std_mm = 0.3;
    stated_.lights.push_back({"led1", led, {}, 0});
    shot_.file = "a.dng";
    observed_.stated = &shot_;
    departures_.nuisances.resize(2);
    departures_.power_relative = {{0.2, 0.01}};
    departures_.even_relative = {{0.1, 0.01}};
  }
  // The image says where the LED is to `own_std_mm`, at `offset_mm`.
  void show(double offset_mm, double own_std_mm) {
    const double loose = 2.0;
    result_.evidence.nuisances = {{"LED position", loose, true, "led1.position0"},
                                  {"even light", 0.003, true, "even light a.dng"}};
    const double information = loose * loose / (own_std_mm * own_std_mm);
    result_.evidence.information = Eigen::Vector2d(information, 1e-12).asDiagonal();
    result_.evidence.score = Eigen::Vector2d(information * offset_mm / loose, 0.0);
    take_evidence(stated_, result_, {{"LED position", 2.0, true, "led1.position0"}, {"lens", 1.0}},
                  {&observed_}, departures_);
  }

  Scene stated_;
  SceneShot shot_;
  ObservedShot observed_;
  ChannelResult result_;
  ShotDepartures departures_;
};

// The image says 1.0 +- 0.4 mm, the rig 0 +- 0.3 mm: they differ by 1.0 +- 0.5 mm.
TEST_F(TransportDeparturesTest, AreThoseOfTheRigAsStated) {
  show(1.0, 0.4);
  EXPECT_NEAR(departures_.nuisances[0].value, 1.0, 1e-9);
  EXPECT_NEAR(departures_.nuisances[0].std, 0.5, 1e-9);
  // Of what transport says nothing, nothing is known.
  EXPECT_TRUE(std::isinf(departures_.nuisances[1].std));
  EXPECT_NEAR(departures_.even_relative[0].value, 0.0, 1e-9);
}

TEST_F(TransportDeparturesTest, TheLightOfAShotCountsWhereTheShotsDisagree) {
  result_.agreement.dof = 1;
  result_.agreement.p_value = 1e-5;
  show(0.0, 1.0);
  EXPECT_EQ(departures_.power_relative[0].value, 0.2);
  result_.agreement.p_value = 0.5;
  show(0.0, 1.0);
  EXPECT_TRUE(std::isinf(departures_.power_relative[0].std));
}

}  // namespace
}  // namespace scattermeter::apps
