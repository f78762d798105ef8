// The piece or its material is another than the model's.
#include <algorithm>

#include "apps/deviations/deviation.h"

namespace scattermeter::apps {
namespace {

std::array<Medium, 3> times_scattering(std::array<Medium, 3> media, double factor) {
  for (Medium& m : media) m.sigma_s_prime_per_mm *= factor;
  return media;
}

void cover(std::vector<ColourFrame>& frames, const DeviationDraw& d) {
  for (ColourFrame& frame : frames) {
    const int width = static_cast<int>(0.01 * d.size * frame.object.width);
    const int right = frame.object.x0 + frame.object.width;
    const int from = d.sign > 0.0 ? right - width : 0;
    const int to = d.sign > 0.0 ? frame.width_px : frame.object.x0 + width;
    for (std::size_t c = 0; c < 3; ++c) {
      for (int y = 0; y < frame.height_px; ++y) {
        for (int x = from; x < to; ++x) frame.at(c, x, y) = 0.0F;
      }
    }
  }
}

void scratch(std::vector<ColourFrame>& frames, const DeviationDraw& d) {
  for (ColourFrame& frame : frames) {
    for (int k = 0; k < 12; ++k) {
      multiply_disc(frame, 0.35 + 0.02 * k, 0.55 - 0.01 * k, 0.01 * frame.object.width,
                    1.0 - 0.01 * d.size);
    }
  }
}

void shine(std::vector<ColourFrame>& frames, const DeviationDraw& d) {
  for (ColourFrame& frame : frames) {
    add_disc(frame, 0.45, 0.5, 0.04 * frame.object.width, 0.01 * d.size * frame.range_counts);
  }
}

}  // namespace

std::vector<Deviation> object_deviations() {
  return {
      {.name = "eta off",
       .words = {"eta", "refractive"},
       .unit = "",
       .sizes = {0.02, 0.04, 0.09},
       .within = 2,
       .truth =
           [](TrueSetup& t, const DeviationDraw& d) {
             t.rig.scene.objects.front().eta_int_over_ext -= d.signed_size();
           }},
      {.name = "phase function",
       .words = {"phase function", "anisotropy", "scattering"},
       .unit = "g",
       .sizes = {0.3, 0.6, 0.8, 0.95},
       .within = 4,
       .needs = {.volume = true},
       .truth = [](TrueSetup& t,
                   const DeviationDraw& d) { t.rig.scene.objects.front().phase = d.size; }},
      {.name = "phase function of two lobes",
       .words = {"phase function", "anisotropy", "scattering"},
       .unit = "% with g 0.9",
       .sizes = {20, 50, 80},
       .within = 3,
       .needs = {.volume = true},
       .truth =
           [](TrueSetup& t, const DeviationDraw& d) {
             t.rig.scene.objects.front().phase = PhaseFunction::mixture(0.01 * d.size, 0.9, 0.0);
           }},
      {.name = "rough surface",
       .words = {"rough", "surface", "eta", "refractive", "phase function", "scattering"},
       .unit = "alpha",
       .sizes = {0.03, 0.15, 0.35},
       .needs = {.volume = true},
       .truth = [](TrueSetup& t,
                   const DeviationDraw& d) { t.rig.scene.objects.front().surface_alpha = d.size; }},
      {.name = "halves of different material",
       .words = {"gradient", "homogeneous", "uniform", "part", "face", "material"},
       .unit = "% in sigma_s'",
       .sizes = {1, 10, 50},
       .within = 1,
       .truth =
           [](TrueSetup& t, const DeviationDraw& d) {
             for (TrueShot& s : t.shots) {
               s.right_half = times_scattering(s.media, 1.0 + 0.01 * d.size);
             }
           }},
      {.name = "another material in one shot",
       .words = {"disagree", "shots", "material", "file"},
       .unit = "% in sigma_s'",
       .sizes = {1, 10, 100},
       .within = 1,
       .needs = {.two_leds = true},
       .truth =
           [](TrueSetup& t, const DeviationDraw& d) {
             t.shots.back().media = times_scattering(t.shots.back().media, 1.0 + 0.01 * d.size);
           }},
      {.name = "part covered",
       .words = {"outline", "mesh", "covered", "hidden", "dark", "part", "silhouette"},
       .unit = "%",
       .sizes = {3, 15, 50},
       .frames = cover},
      {.name = "scratch",
       .words = {"spot", "mark", "scratch", "stain", "part", "face"},
       .unit = "%",
       .sizes = {5, 30, 90},
       .within = 1,
       .frames = scratch},
      {.name = "highlight",
       .words = {"highlight", "spot", "specular", "reflection", "part", "face"},
       .unit = "% of range",
       .sizes = {2, 20, 100},
       .within = 1,
       .frames = shine},
  };
}

}  // namespace scattermeter::apps
