#include "capture/sensor/virtual_sensor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <stdexcept>

#include <oneapi/tbb/parallel_for.h>

#include "capture/raw/decoded_frame.h"
#include "capture/raw/dng_writer.h"
#include "capture/raw/nef_writer.h"
#include "capture/raw/tone_curve.h"
#include "core/base/input_error.h"
#include "core/base/random_stream.h"
#include "core/camera/cfa_samples.h"
#include "core/camera/vignetting.h"

namespace scattermeter::capture {
namespace {

constexpr std::uint64_t kHotPixelStream = 0x686f74;
constexpr std::uint64_t kDriftStream = 0x6472696674;

std::vector<std::pair<std::size_t, float>> hot_pixels(const SensorTruth& truth,
                                                      std::size_t n_pixels) {
  std::vector<std::pair<std::size_t, float>> out;
  if (!(truth.hot_pixel_share > 0.0)) return out;
  RandomStream random(truth.hot_pixel_seed, kHotPixelStream);
  std::normal_distribution<double> normal;
  std::mt19937_64 spread(random.bits());
  // Gaps between hot pixels have a geometric distribution.
  const double log_rest = std::log1p(-truth.hot_pixel_share);
  double at = -1.0;
  for (;;) {
    at += 1.0 + std::floor(std::log(random.uniform()) / log_rest);
    if (!(at < static_cast<double>(n_pixels))) return out;
    out.emplace_back(
        static_cast<std::size_t>(at),
        static_cast<float>(truth.hot_pixel_counts_per_s * std::exp(0.5 * normal(spread))));
  }
}

}  // namespace

VirtualSensor::VirtualSensor(const Scene& scene, const SensorTruth& truth, bool noise)
    : scene_(scene),
      camera_(scene.camera),
      truth_(truth),
      noise_(noise),
      hot_(hot_pixels(truth, static_cast<std::size_t>(camera_.intrinsics.width_px) *
                                 static_cast<std::size_t>(camera_.intrinsics.height_px))) {}

// The 64-bit FNV-1a hash (Fowler, Noll, Vo) of the file name is mixed into the seed.
std::uint64_t VirtualSensor::stream(std::uint64_t seed, const std::string& file) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const char c : file) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  return hash ^ (seed * 0x9e3779b97f4a7c15ULL);
}

double VirtualSensor::true_exposure_s(double stated_s) const {
  for (const TrueExposure& e : truth_.exposures) {
    if (std::abs(e.stated_s - stated_s) < 1e-6 * stated_s) return e.true_s;
  }
  if (!truth_.shutter_in_thirds) return stated_s;
  return std::exp2(std::round(3.0 * std::log2(stated_s)) / 3.0);
}

std::vector<float> VirtualSensor::signal_counts(const std::vector<float>& radiance_W_per_mm2_sr,
                                                double stated_s) const {
  if (!camera_.responsivity) {
    throw InputError(scene_.source + ": camera.responsivity_counts_mm2_sr_per_W_s",
                     "is missing: shots of a calibration cannot be simulated without it");
  }
  std::array<float, 4> factor{};
  for (std::size_t p = 0; p < 4; ++p) {
    const auto c = static_cast<std::size_t>(camera_.sensor.cfa.phase[p]);
    factor[p] = static_cast<float>((*camera_.responsivity)[c] * stated_s);
  }
  const int width = camera_.intrinsics.width_px;
  std::vector<float> out = radiance_W_per_mm2_sr;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const auto x = static_cast<int>(i % static_cast<std::size_t>(width));
    const auto y = static_cast<int>(i / static_cast<std::size_t>(width));
    out[i] *= factor[cfa_phase(x, y)];
  }
  return out;
}

std::vector<float> VirtualSensor::on_sensor(std::vector<float> signal, double stated_s) const {
  const SensorTruth& truth = truth_;
  const CameraIntrinsics& k = camera_.intrinsics;
  const auto width = static_cast<std::size_t>(k.width_px);
  const auto height = static_cast<std::size_t>(k.height_px);
  if (signal.size() != width * height) {
    throw std::invalid_argument("VirtualSensor: " + std::to_string(width * height) +
                                " values expected, got " + std::to_string(signal.size()));
  }
  const double true_s = true_exposure_s(stated_s);
  Vignetting vignetting = vignetting_of_frame(k.width_px, k.height_px);
  vignetting.radial = truth.vignetting_radial;
  if (true_s != stated_s || !vignetting.is_identity()) {
    tbb::parallel_for(std::size_t{0}, height, [&](std::size_t y) {
      for (std::size_t x = 0; x < width; ++x) {
        const auto c = static_cast<std::size_t>(
            camera_.sensor.cfa.at(static_cast<int>(x), static_cast<int>(y)));
        signal[y * width + x] *=
            static_cast<float>(true_s / stated_s *
                               vignetting.share(static_cast<double>(x), static_cast<double>(y), c));
      }
    });
  }
  std::array<float, 4> added{};
  added.fill(static_cast<float>(truth.dark_current_counts_per_s * true_s));
  if (truth.veiling_glare > 0.0) {
    std::array<double, 4> sum{};
    std::array<double, 3> colour_sum{}, n{};
    for (std::size_t i = 0; i < signal.size(); ++i) {
      sum[cfa_phase(static_cast<int>(i % width), static_cast<int>(i / width))] +=
          static_cast<double>(signal[i]);
    }
    const double of_phase = 0.25 * static_cast<double>(signal.size());
    for (std::size_t p = 0; p < 4; ++p) {
      const auto c = static_cast<std::size_t>(camera_.sensor.cfa.phase[p]);
      colour_sum[c] += sum[p];
      n[c] += of_phase;
    }
    for (std::size_t p = 0; p < 4; ++p) {
      const auto c = static_cast<std::size_t>(camera_.sensor.cfa.phase[p]);
      added[p] += static_cast<float>(truth.veiling_glare * colour_sum[c] / n[c]);
    }
  }
  for (std::size_t i = 0; i < signal.size(); ++i) {
    signal[i] += added[cfa_phase(static_cast<int>(i % width), static_cast<int>(i / width))];
  }
  for (const auto& [pixel, rate] : hot_) signal[pixel] += rate * static_cast<float>(true_s);
  return signal;
}

std::vector<std::uint16_t> VirtualSensor::codes(const std::vector<float>& signal_counts,
                                                double stated_s, std::uint64_t stream) const {
  SensorModel sensor = model();
  if (noise_ && truth_.black_drift_counts > 0.0) {
    std::mt19937_64 generator(RandomStream(stream, kDriftStream).bits());
    sensor.black_offset_counts =
        truth_.black_drift_counts * std::normal_distribution<double>()(generator);
  }
  const CameraIntrinsics& k = camera_.intrinsics;
  return expose(on_sensor(signal_counts, stated_s), k.width_px, k.height_px, sensor, stream);
}

RawFrame VirtualSensor::frame(const std::vector<float>& signal_counts, double stated_s,
                              std::uint64_t stream) const {
  const CameraIntrinsics& k = camera_.intrinsics;
  return decoded_frame(k.width_px, k.height_px, codes(signal_counts, stated_s, stream),
                       metadata(stated_s));
}

void VirtualSensor::write(const std::string& path, const std::vector<float>& signal_counts,
                          double stated_s, std::uint64_t stream) const {
  const CameraIntrinsics& k = camera_.intrinsics;
  const auto write_raw = truth_.format == RawFormat::kNef ? write_nef : write_dng;
  write_raw(path, k.width_px, k.height_px, codes(signal_counts, stated_s, stream),
            metadata(stated_s));
}

double VirtualSensor::range_counts() const {
  const SceneSensor& sensor = camera_.sensor;
  const double top = sensor.nef_lossy_curve
                         ? std::min<double>(sensor.white_counts, nef_lossy_curve().back())
                         : sensor.white_counts;
  return top - *std::max_element(sensor.black_counts.begin(), sensor.black_counts.end());
}

SensorModel VirtualSensor::model() const {
  const SceneSensor& from = camera_.sensor;
  SensorModel sensor;
  sensor.noise = from.noise;
  sensor.black_counts = from.black_counts;
  sensor.white_counts = from.white_counts;
  if (from.nef_lossy_curve) sensor.tone_curve = nef_lossy_curve();
  sensor.noise_on = noise_;
  sensor.departure_at_white = truth_.non_linearity;
  return sensor;
}

RawMetadata VirtualSensor::metadata(double stated_s) const {
  const SceneCamera& camera = camera_;
  RawMetadata metadata;
  // Cameras repeat the name of the make in the tag of the model: "NIKON D80" is the D80 by NIKON.
  if (!camera.model.empty() && truth_.format == RawFormat::kDng) {
    metadata.model = camera.model;
    metadata.make = camera.model.substr(0, camera.model.find(' '));
  }
  metadata.cfa = camera.sensor.cfa;
  metadata.black_counts = camera.sensor.black_counts;
  metadata.white_counts = camera.sensor.white_counts;
  metadata.exposure_s = stated_s;
  metadata.iso = camera.iso;
  metadata.f_number = camera.f_number;
  if (camera.sensor.nef_lossy_curve) metadata.linearization_table = nef_lossy_curve();
  return metadata;
}

}  // namespace scattermeter::capture
