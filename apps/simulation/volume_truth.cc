#include "apps/simulation/volume_truth.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

namespace scattermeter::apps {
namespace {

// Of the exposure for the dipole's picture, as the volume may be brighter. Samples beyond the range
// are kept, with the variance at its top: to drop those that noise made bright would cause a bias.
constexpr double kHeadroom = 0.5;

CfaSamples samples(const VirtualShots& shots, std::size_t shot, const SampleMap& where) {
  return shots.ideal_samples(shot, where.x0, where.y0, where.width, where.height);
}

CfaSamples mean_samples(const std::vector<VirtualShots>& batches, std::size_t shot,
                        const SampleMap& where) {
  CfaSamples mean = samples(batches.front(), shot, where);
  const auto weight = 1.0F / static_cast<float>(batches.size());
  for (std::size_t b = 1; b < batches.size(); ++b) {
    const CfaSamples more = samples(batches[b], shot, where);
    for (std::size_t i = 0; i < mean.signal_counts.size(); ++i) {
      mean.signal_counts[i] += more.signal_counts[i];
      mean.variance_counts2[i] += more.variance_counts2[i];
    }
  }
  for (float& s : mean.signal_counts) s *= weight;
  std::fill(mean.clipped.begin(), mean.clipped.end(), std::uint8_t{0});
  for (float& v : mean.variance_counts2) v *= weight;
  return mean;
}

}  // namespace

VolumeTruth::VolumeTruth(const Rig& rig, const ObjectScenes& objects,
                         const VolumeTruthOptions& options)
    : exposed_(rig), options_(options) {
  if (options.batches < 2) {
    throw std::invalid_argument("VolumeTruth: batches " + std::to_string(options.batches));
  }
  VirtualShotOptions render{.noise = true};
  const VirtualShots trial(rig, objects, render);
  exposed_.scene.camera.exposure_s = kHeadroom * trial.exposure_s(0);
  exposed_.scene.camera.responsivity = trial.responsivity();
  dipole_.emplace_back(exposed_, objects, render);
  render.transport.volume = true;
  render.transport.paths = std::max<std::int64_t>(1, options.paths / options.batches);
  for (int b = 0; b < options.batches; ++b) {
    render.transport.seed =
        options.seed * static_cast<std::uint64_t>(options.batches) + static_cast<std::uint64_t>(b);
    batches_.emplace_back(exposed_, objects, render);
  }
}

capture::SampleSource VolumeTruth::shots() const {
  return [this](std::size_t shot, const SampleMap& where) {
    CfaSamples mean = mean_samples(batches_, shot, where);
    if (options_.noise_seed) {
      std::mt19937_64 generator(*options_.noise_seed + shot);
      std::normal_distribution<float> normal;
      for (std::size_t i = 0; i < mean.signal_counts.size(); ++i) {
        mean.signal_counts[i] += std::sqrt(mean.variance_counts2[i]) * normal(generator);
      }
    }
    return mean;
  };
}

capture::SampleSource VolumeTruth::disturbed(int batch) const {
  const VirtualShots& one = batches_.at(static_cast<std::size_t>(batch));
  return [this, &one](std::size_t shot, const SampleMap& where) {
    CfaSamples out = samples(dipole_.front(), shot, where);
    const CfaSamples drawn = samples(one, shot, where);
    const CfaSamples mean = mean_samples(batches_, shot, where);
    const float part = 1.0F / std::sqrt(static_cast<float>(batches_.size()));
    for (std::size_t i = 0; i < out.signal_counts.size(); ++i) {
      out.signal_counts[i] += part * (drawn.signal_counts[i] - mean.signal_counts[i]);
    }
    return out;
  };
}

double VolumeTruth::patch_std() const {
  double sum = 0.0;
  for (const VirtualShots& b : batches_) sum += b.monte_carlo_std();
  const auto n = static_cast<double>(batches_.size());
  return sum / n / std::sqrt(n);
}

}  // namespace scattermeter::apps
