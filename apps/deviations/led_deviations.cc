// The LEDs are elsewhere or emit otherwise than stated.
#include <cmath>
#include <numbers>
#include <utility>

#include <Eigen/Geometry>

#include "apps/deviations/deviation.h"

namespace scattermeter::apps {
namespace {

const std::vector<std::string> kLedWords = {"LED", "lobe", "lamp"};
const std::vector<std::string> kPowerWords = {"intensity", "intensities", "power",     "scale",
                                              "exposure",  "W/sr",        "brightness"};

// Calls change(Led&) for each LED of the shots.
template <class Change>
void for_leds(TrueSetup& t, const Change& change) {
  for (TrueShot& shot : t.shots) {
    for (SceneLight& light : shot.lights) change(light.led()->led);
  }
}

// Unit vectors from the LED to the object and across, in the horizontal plane.
Eigen::Vector3d to_object(const Led& led) {
  return (Eigen::Vector3d(0, 0, 9) - led.position_mm).normalized();
}
Eigen::Vector3d sideways(const Led& led) {
  return to_object(led).cross(Eigen::Vector3d::UnitZ()).normalized();
}

void move_sideways(TrueSetup& t, const DeviationDraw& d) {
  for_leds(t, [&](Led& led) { led.position_mm += d.signed_size() * sideways(led); });
}
void move_in_depth(TrueSetup& t, const DeviationDraw& d) {
  for_leds(t, [&](Led& led) { led.position_mm += d.signed_size() * to_object(led); });
}
void turn(TrueSetup& t, const DeviationDraw& d) {
  for_leds(t, [&](Led& led) {
    led.axis =
        Eigen::AngleAxisd(d.signed_size() * std::numbers::pi / 180.0, Eigen::Vector3d::UnitZ()) *
        led.axis;
  });
}
void scale_first(TrueSetup& t, double factor) {
  t.shots.front().lights.front().led()->led.intensity_W_per_sr *= factor;
}

// Part of the light is in a narrow beam: cos^p + share cos^30.
void add_beam(TrueSetup& t, const DeviationDraw& d) {
  for (TrueShot& shot : t.shots) {
    SceneLight beam = shot.lights.front();
    beam.led()->led.exponent = 30.0;
    beam.led()->led.intensity_W_per_sr *= 0.01 * d.size;
    shot.lights.push_back(beam);
  }
}

// Two emitters of half the power, `size` to each side of the stated place.
void split(TrueSetup& t, const DeviationDraw& d) {
  for (TrueShot& shot : t.shots) {
    SceneLight other = shot.lights.front();
    Led& one = shot.lights.front().led()->led;
    Led& two = other.led()->led;
    const Eigen::Vector3d across = d.sign > 0.0 ? sideways(one) : Eigen::Vector3d::UnitZ();
    one.position_mm += d.size * across;
    two.position_mm -= d.size * across;
    one.intensity_W_per_sr *= 0.5;
    two.intensity_W_per_sr *= 0.5;
    shot.lights.push_back(other);
  }
}

void add_unlisted(TrueSetup& t, const DeviationDraw& d) {
  for (TrueShot& shot : t.shots) {
    SceneLight more = shot.lights.front();
    Led& led = more.led()->led;
    led.position_mm = {60.0 * d.sign, 40, 90};
    led.axis = to_object(led);
    led.intensity_W_per_sr *= 0.01 * d.size;
    shot.lights.push_back(more);
  }
}

void exchange_in_rig(Rig& rig, const DeviationDraw&) {
  std::swap(rig.scene.shots[0].lights, rig.scene.shots[1].lights);
}
void use_other_unit_of_length(Rig& rig, const DeviationDraw& d) {
  for (SceneLight& light : rig.scene.lights) light.led()->led.position_mm /= d.size;
}
void use_other_unit_of_intensity(Rig& rig, const DeviationDraw& d) {
  for (SceneLight& light : rig.scene.lights) light.led()->led.intensity_W_per_sr *= d.size;
}

std::vector<Deviation> places() {
  return {
      {.name = "LEDs displaced sideways",
       .words = kLedWords,
       .unit = "mm",
       .sizes = {0.14, 0.6, 2},
       .within = 1,
       .truth = move_sideways},
      {.name = "LEDs displaced in depth",
       .words = kLedWords,
       .unit = "mm",
       .sizes = {0.14, 0.6, 2},
       .within = 1,
       .truth = move_in_depth},
      {.name = "LEDs elsewhere",
       .words = kLedWords,
       .unit = "mm",
       .sizes = {5, 20, 50},
       .truth = move_sideways},
      {.name = "LEDs exchanged",
       .words = {"exchanged", "swapped", "LED"},
       .unit = "",
       .sizes = {1},
       .needs = {.two_leds = true},
       .stated = exchange_in_rig},
      {.name = "LED place in another unit of length",
       .words = {"LED", "unit", "metres", "light", "inside"},
       .unit = "mm",
       .sizes = {10, 25.4, 1000},
       .stated = use_other_unit_of_length},
      {.name = "LED axes turned",
       .words = kLedWords,
       .unit = "deg",
       .sizes = {1, 5, 20},
       .within = 1,
       .truth = turn},
      {.name = "LED exponent off",
       .words = kLedWords,
       .unit = "",
       .sizes = {0.03, 0.2, 1},
       .within = 1,
       .truth =
           [](TrueSetup& t, const DeviationDraw& d) {
             for_leds(t, [&](Led& led) { led.exponent += d.size; });
           }},
      {.name = "LED lobe with a narrow beam",
       .words = kLedWords,
       .unit = "%",
       .sizes = {1, 5, 25},
       .within = 1,
       .truth = add_beam},
      {.name = "LED of two emitters",
       .words = kLedWords,
       .unit = "mm",
       .sizes = {0.5, 2, 8},
       .within = 1,
       .truth = split},
  };
}

}  // namespace

std::vector<Deviation> led_deviations() {
  std::vector<Deviation> out = places();
  const std::vector<Deviation> powers = {
      {.name = "all LED intensities off",
       .words = kPowerWords,
       .unit = "%",
       .sizes = {1.4, 4, 20},
       .within = 1,
       .truth =
           [](TrueSetup& t, const DeviationDraw& d) {
             for_leds(t, [&](Led& led) { led.intensity_W_per_sr *= 1.0 + 0.01 * d.signed_size(); });
           }},
      {.name = "one LED's intensity off",
       .words = {"intensity", "power", "LED", "disagree", "shots"},
       .unit = "%",
       .sizes = {0.7, 5, 20},
       .within = 1,
       .needs = {.two_leds = true},
       .truth = [](TrueSetup& t,
                   const DeviationDraw& d) { scale_first(t, 1.0 + 0.01 * d.signed_size()); }},
      {.name = "LED dim in one shot",
       .words = {"intensity", "power", "LED", "disagree", "shots", "dark", "exposure"},
       .unit = "%",
       .sizes = {40, 90, 100},
       .needs = {.two_leds = true},
       .truth = [](TrueSetup& t, const DeviationDraw& d) { scale_first(t, 1.0 - 0.01 * d.size); }},
      {.name = "LED intensity in another unit",
       .words = kPowerWords,
       .unit = "times",
       .sizes = {10, 1000, 1e6},
       .stated = use_other_unit_of_intensity},
      {.name = "LED intensities of R and B exchanged",
       .words = kPowerWords,
       .unit = "",
       .sizes = {1},
       .truth =
           [](TrueSetup& t, const DeviationDraw&) {
             for_leds(t, [](Led& led) {
               std::swap(led.intensity_W_per_sr[0], led.intensity_W_per_sr[2]);
             });
           }},
      {.name = "unlisted LED",
       .words = {"light", "lamp", "LED"},
       .unit = "%",
       .sizes = {0.2, 2, 20},
       .truth = add_unlisted},
      {.name = "first shot under the other LED",
       .words = {"exchanged", "LED", "file"},
       .unit = "",
       .sizes = {1},
       .truth = [](TrueSetup& t,
                   const DeviationDraw&) { t.shots[0].lights = {t.rig.scene.lights[1]}; }},
  };
  out.insert(out.end(), powers.begin(), powers.end());
  return out;
}

}  // namespace scattermeter::apps
