#include "calib/led/led_mistakes.h"

#include <functional>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/instrument/calibration_inputs.h"
#include "apps/simulation/virtual_led_shots.h"
#include "calib/led/led_calibration.h"
#include "tests/fixtures/apps/led_rig.h"
#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

// The frames are those of one rig; the input that describes them is mistaken.
class LedMistakes : public ::testing::Test {
 protected:
  static Rig rig(const LedRigText& text) {
    const TemporaryFolder folder;
    write_file(folder / "rig.yaml", led_rig_yaml(text));
    return read_rig(folder / "rig.yaml");
  }

  calib::LedFit fit_with(const std::function<void(calib::LedCalibrationShots&)>& mistake,
                         const Rig& truth) const {
    const VirtualLedShots shots(truth, true);
    Rig stated = truth_;
    mistake(*stated.calibration.led);
    return calib::calibrate_led(led_calibration_input(stated), "led1",
                                [&](std::size_t i) { return shots.frame(i, 1); })
        .fit;
  }
  std::string told_of(const std::function<void(calib::LedCalibrationShots&)>& mistake) const {
    const calib::LedFit fit = fit_with(mistake, truth_);
    EXPECT_EQ(fit.status, calib::LedStatus::kMisfit);
    return fit.message;
  }

  const Rig truth_ = rig({});
};

TEST_F(LedMistakes, TheDiameterOfTheSpheresAsTheirRadius) {
  EXPECT_THAT(told_of([](auto& list) {
                for (calib::MirrorSphere& sphere : list.spheres) sphere.radius_mm *= 2.0;
              }),
              HasSubstr("half the radius of the spheres"));
}

TEST_F(LedMistakes, APlaneAtAnotherHeight) {
  EXPECT_THAT(told_of([](auto& list) { list.planes[1].origin_mm.z() += 5.0; }),
              HasSubstr("plane 2 about 5 mm lower"));
}

// A real lobe is no power of a cosine: that widens what is stated, and is no mistake.
TEST_F(LedMistakes, NoneWhereTheLobeDeparts) {
  LedRigText text;
  text.led =
      "{type: led, position_mm: [30, -60, 80], axis: [-25, 55, -80], radius_mm: 2, lobe: "
      "{angle_deg: [0, 10, 20, 30, 45, 60, 90], relative: [1, 0.99, 0.97, 0.7, 0.45, 0.35, 0]}, "
      "intensity_W_per_sr: [0.05, 0.06, 0.04]}";
  const calib::LedFit fit = fit_with([](auto&) {}, rig(text));
  EXPECT_EQ(fit.status, calib::LedStatus::kOk) << fit.message;
  EXPECT_GT(fit.plane_inflation, 4.0);
}

}  // namespace
}  // namespace scattermeter::apps
