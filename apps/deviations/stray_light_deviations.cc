// Light that no LED of the rig makes, and what looks like it.
#include <algorithm>
#include <numbers>
#include <utility>

#include <Eigen/Geometry>

#include "apps/deviations/deviation.h"
#include "core/light/environment.h"

namespace scattermeter::apps {
namespace {

const std::vector<std::string> kAddedWords = {
    "even light", "background", "pedestal", "glare",
    "halo",       "black",      "ambient",  "light from elsewhere"};

// Irradiance of the shot's LED at the object, W/mm^2.
Eigen::Array3d led_irradiance(const TrueShot& shot) {
  const Led& led = shot.lights.front().led()->led;
  const Eigen::Vector3d way_mm = Eigen::Vector3d(0, 0, 9) - led.position_mm;
  return led.intensity_W_per_sr * led.lobe(way_mm.normalized()) / way_mm.squaredNorm();
}

// Radiance 1 from half of all directions: those around `from`.
DistantLight half_sky(const Eigen::Vector3d& from) {
  return DistantLight([from] {
    Environment out;
    out.width_px = 4;
    out.height_px = 2;
    out.radiance.assign(std::size_t{3} * 4 * 2, 0.0F);
    std::fill_n(out.radiance.begin(), 3 * 4, 1.0F);
    out.world_from_probe = world_from_probe(from.unitOrthogonal(), from);
    return out;
  });
}

// Adds light of a radiance for which an open surface has `share` of the LED's irradiance.
void add_distant(TrueSetup& t, double share, const char* name, const Eigen::Vector3d& from) {
  for (TrueShot& shot : t.shots) {
    SceneLight light;
    light.name = name;
    DistantLight sky = half_sky(from);
    sky.radiance_W_per_mm2_sr = share * led_irradiance(shot) / std::numbers::pi;
    light.kind = std::move(sky);
    shot.lights.push_back(std::move(light));
  }
}

void add_even(TrueSetup& t, const DeviationDraw& d) {
  for (TrueShot& shot : t.shots) {
    SceneLight light;
    light.name = "even light";
    AmbientLight even;
    even.radiance_W_per_mm2_sr = 0.01 * d.size * led_irradiance(shot) / std::numbers::pi;
    light.kind = even;
    shot.lights.push_back(light);
  }
}

// A share of the light spreads about the object as far as a quarter of its width.
void add_halo(std::vector<ColourFrame>& frames, const DeviationDraw& d) {
  for (ColourFrame& frame : frames) {
    ColourFrame spread = frame;
    blur(spread, 0.25 * frame.object.width);
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t i = 0; i < frame.counts[c].size(); ++i) {
        frame.counts[c][i] += static_cast<float>(0.01 * d.size) * spread.counts[c][i];
      }
    }
  }
}

void tilt_black(std::vector<ColourFrame>& frames, const DeviationDraw& d) {
  for (ColourFrame& frame : frames) {
    for (std::vector<float>& plane : frame.counts) {
      for (std::size_t i = 0; i < plane.size(); ++i) {
        const auto width = static_cast<std::size_t>(frame.width_px);
        const double across = static_cast<double>(i % width) / static_cast<double>(width);
        plane[i] += static_cast<float>(d.size * (d.sign > 0.0 ? across : 1.0 - across));
      }
    }
  }
}

// Everything beside the object is a grey surface.
void add_backdrop(std::vector<ColourFrame>& frames, const DeviationDraw& d) {
  for (ColourFrame& frame : frames) {
    for (std::vector<float>& plane : frame.counts) {
      for (float& counts : plane) {
        if (counts == 0.0F) counts = static_cast<float>(0.01 * d.size * frame.range_counts);
      }
    }
  }
}

}  // namespace

std::vector<Deviation> stray_light_deviations() {
  return {
      {.name = "even light",
       .words = kAddedWords,
       .unit = "%",
       .sizes = {0.1, 1, 5},
       .within = 1,
       .truth = add_even},
      {.name = "light from below",
       .words = {"even light", "background", "pedestal", "table", "plane", "below", "stand",
                 "ambient", "light from elsewhere"},
       .unit = "%",
       .sizes = {0.2, 1, 5},
       .within = 1,
       .truth =
           [](TrueSetup& t, const DeviationDraw& d) {
             add_distant(t, 0.01 * d.size, "table", -Eigen::Vector3d::UnitZ());
           }},
      {.name = "light from a side",
       .words = kAddedWords,
       .unit = "%",
       .sizes = {0.1, 1, 5},
       .within = 1,
       .truth =
           [](TrueSetup& t, const DeviationDraw& d) {
             add_distant(t, 0.01 * d.size, d.sign > 0 ? "right" : "left",
                         d.sign * Eigen::Vector3d::UnitX());
           }},
      {.name = "veiling glare",
       .words = kAddedWords,
       .unit = "%",
       .sizes = {0.3, 1, 5},
       .within = 1,
       .truth = [](TrueSetup& t,
                   const DeviationDraw& d) { t.rig.truth.sensor.veiling_glare = 0.01 * d.size; }},
      {.name = "halo of the lens",
       .words = kAddedWords,
       .unit = "%",
       .sizes = {0.2, 1, 5},
       .within = 1,
       .frames = add_halo},
      {.name = "black level off",
       .words = kAddedWords,
       .unit = "counts",
       .sizes = {1, 6, 30},
       .within = 1,
       .truth =
           [](TrueSetup& t, const DeviationDraw& d) {
             for (int& black : t.rig.scene.camera.sensor.black_counts) {
               black += static_cast<int>(d.signed_size());
             }
           }},
      {.name = "black level off at one site",
       .words = kAddedWords,
       .unit = "counts",
       .sizes = {1, 6, 30},
       .within = 1,
       .truth =
           [](TrueSetup& t, const DeviationDraw& d) {
             t.rig.scene.camera.sensor.black_counts[d.seed % 4] +=
                 static_cast<int>(d.signed_size());
           }},
      {.name = "black level tilted",
       .words = kAddedWords,
       .unit = "counts",
       .sizes = {1, 6, 30},
       .within = 1,
       .frames = tilt_black},
      {.name = "backdrop not black",
       .words = kAddedWords,
       .unit = "%",
       .sizes = {0.2, 2, 20},
       .within = 1,
       .frames = add_backdrop},
  };
}

}  // namespace scattermeter::apps
