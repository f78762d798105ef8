// The sensor counts otherwise than its file says.
#include <algorithm>
#include <cmath>
#include <utility>

#include "apps/deviations/deviation.h"
#include "core/base/random_stream.h"

namespace scattermeter::apps {
namespace {

const std::vector<std::string> kScaleWords = {"scale",     "responsivity", "exposure",
                                              "intensity", "brightness",   "power"};

void clip_early(TrueSetup& t, const DeviationDraw& d) {
  SceneSensor& sensor = t.rig.scene.camera.sensor;
  const int black = sensor.black_counts[0];
  sensor.white_counts =
      black + static_cast<int>((1.0 - 0.01 * d.size) * (sensor.white_counts - black));
}

void bend_response(std::vector<ColourFrame>& frames, const DeviationDraw& d) {
  const double exponent = 1.0 + 0.01 * d.signed_size();
  for (ColourFrame& frame : frames) {
    for (std::vector<float>& plane : frame.counts) {
      for (float& c : plane) {
        c = static_cast<float>(frame.range_counts *
                               std::pow(static_cast<double>(c) / frame.range_counts, exponent));
      }
    }
  }
}

void darken_corners(TrueSetup& t, const DeviationDraw& d) {
  for (std::vector<double>& radial : t.rig.truth.sensor.vignetting_radial) {
    radial = {-0.01 * d.size};
  }
}

void add_noise(TrueSetup& t, const DeviationDraw& d) {
  SensorNoise& noise = t.rig.scene.camera.sensor.noise;
  noise.gain_e_per_count /= d.size * d.size;
  noise.read_noise_counts *= d.size;
}

// By columns or by rows; by both, R and B would change places, which no picture shows.
void exchange_filters(TrueSetup& t, const DeviationDraw& d) {
  std::array<Channel, 4>& phase = t.rig.scene.camera.sensor.cfa.phase;
  std::swap(phase[0], phase[d.size < 2.0 ? 1 : 2]);
  std::swap(phase[3], phase[d.size < 2.0 ? 2 : 1]);
}

// Calls use(frame, pixel) for a random share of the pixels, the same in all shots.
template <class Use>
void for_some_pixels(std::vector<ColourFrame>& frames, double share, std::uint64_t seed,
                     const Use& use) {
  constexpr std::uint64_t kStream = 0x706978656c;
  for (ColourFrame& frame : frames) {
    RandomStream random(seed, kStream);
    for (std::size_t i = 0; i < frame.counts[0].size(); ++i) {
      if (random.uniform() < share) use(frame, i);
    }
  }
}

void heat_pixels(std::vector<ColourFrame>& frames, const DeviationDraw& d) {
  for_some_pixels(frames, 0.01 * d.size, d.seed, [](ColourFrame& frame, std::size_t i) {
    for (std::vector<float>& plane : frame.counts) {
      plane[i] += static_cast<float>(0.3 * frame.range_counts);
    }
  });
}

// Eight round shadows on and about the object.
void put_dust(std::vector<ColourFrame>& frames, const DeviationDraw& d) {
  constexpr std::uint64_t kStream = 0x64757374;
  for (ColourFrame& frame : frames) {
    RandomStream random(d.seed, kStream);
    for (int k = 0; k < 8; ++k) {
      const double x = random.uniform();
      multiply_disc(frame, x, random.uniform(), 0.03 * frame.object.width, 1.0 - 0.01 * d.size);
    }
  }
}

auto times(std::size_t channel) {
  return [channel](TrueSetup& t, const DeviationDraw& d) {
    (*t.rig.scene.camera.responsivity)[channel] *= 1.0 + 0.01 * d.signed_size();
  };
}

// Nothing but what the rig states tells the scale, and sigma_s' and sigma_a follow it: the second
// size is two of the stated deviations, as the answer to three would be three of its own off.
std::vector<Deviation> scales() {
  return {
      {.name = "exposure time off",
       .words = kScaleWords,
       .unit = "%",
       .sizes = {1.4, 4, 40},
       .within = 1,
       .frames =
           [](std::vector<ColourFrame>& frames, const DeviationDraw& d) {
             for (ColourFrame& f : frames) scale_frame(f, 1.0 + 0.01 * d.signed_size());
           }},
      {.name = "exposure of one shot off",
       .words = {"exposure", "scale", "disagree", "shots", "intensity", "power"},
       .unit = "%",
       .sizes = {0.7, 6, 40},
       .within = 1,
       .needs = {.two_leds = true},
       .frames = [](std::vector<ColourFrame>& frames,
                    const DeviationDraw& d) { scale_frame(frames[0], 1.0 - 0.01 * d.size); }},
      {.name = "responsivity off",
       .words = kScaleWords,
       .unit = "%",
       .sizes = {1.4, 4, 20},
       .within = 1,
       .truth =
           [](TrueSetup& t, const DeviationDraw& d) {
             for (std::size_t c = 0; c < 3; ++c) times(c)(t, d);
           }},
      {.name = "responsivity of R off",
       .words = kScaleWords,
       .unit = "%",
       .sizes = {1.4, 4, 20},
       .within = 1,
       .truth = times(0)},
      {.name = "responsivity of G off",
       .words = kScaleWords,
       .unit = "%",
       .sizes = {1.4, 4, 20},
       .within = 1,
       .truth = times(1)},
      {.name = "responsivity of B off",
       .words = kScaleWords,
       .unit = "%",
       .sizes = {1.4, 4, 20},
       .within = 1,
       .truth = times(2)},
  };
}

}  // namespace

std::vector<Deviation> sensor_deviations() {
  std::vector<Deviation> out = scales();
  const std::vector<Deviation> others = {
      {.name = "clips early",
       .words = {"clip", "white", "saturat"},
       .unit = "% of range",
       .sizes = {20, 30, 60},
       .within = 1,
       .truth = clip_early},
      {.name = "response not linear",
       .words = {"linear", "response", "gamma", "scale"},
       .unit = "%",
       .sizes = {1, 3, 10},
       .frames = bend_response},
      {.name = "vignetting",
       .words = {"vignetting", "fall-off", "gradient", "flat"},
       .unit = "% in corners",
       .sizes = {1, 10, 40},
       .within = 2,
       .truth = darken_corners},
      {.name = "noise underestimated",
       .words = {"noise"},
       .unit = "times",
       .sizes = {1.2, 2, 5},
       .within = 1,
       .truth = add_noise},
      {.name = "hot pixels",
       .words = {"pixel", "spot", "outlier"},
       .unit = "%",
       .sizes = {0.02, 0.3, 3},
       .within = 1,
       .frames = heat_pixels},
      {.name = "dust on the sensor",
       .words = {"spot", "dust", "mark", "stain"},
       .unit = "%",
       .sizes = {2, 10, 50},
       .within = 1,
       .frames = put_dust},
      {.name = "colour filters exchanged",
       .words = {"CFA", "filter", "colour", "channel"},
       .unit = "(1 columns, 2 rows)",
       .sizes = {1, 2},
       .truth = exchange_filters},
  };
  out.insert(out.end(), others.begin(), others.end());
  return out;
}

}  // namespace scattermeter::apps
