#include "apps/simulation/virtual_shots.h"

#include <algorithm>

#include <oneapi/tbb/parallel_for.h>

#include "apps/simulation/chosen_exposure.h"
#include "capture/sensor/ideal_samples.h"
#include "core/base/input_error.h"
#include "core/base/progress.h"

namespace scattermeter::apps {

VirtualShots::VirtualShots(const Rig& rig, const ObjectScenes& objects,
                           const VirtualShotOptions& options)
    : rig_(rig), options_(options), sensor_(rig.scene, rig.truth.sensor, options.noise) {
  for (const SceneShot& shot : rig.scene.shots) {
    if (shot.more_exposures_s.size() == shot.more_files.size()) continue;
    throw InputError(rig.at(shot.line) + ": shots.exposure_s",
                     "is missing: a time is needed for each file of the bracket " + shot.file);
  }
  ShotRenderer renderer(rig, objects, options.transport);
  std::vector<Eigen::Array3d> brightest;  // W/(mm^2 sr), of each shot
  Eigen::Array3d of_all = Eigen::Array3d::Zero();
  ProgressStage stage(options.progress, "rendering", rig.scene.shots.size());
  for (const SceneShot& shot : rig.scene.shots) {
    RadiancePicture p = renderer.render(shot);
    brightest.push_back(p.brightest);
    of_all = of_all.max(p.brightest);
    pictures_.push_back({p.x0, p.y0, p.width, p.height, std::move(p.radiance)});
    stage.step();
  }
  monte_carlo_std_ = renderer.monte_carlo_std();
  choose_exposure(of_all);
  for (std::size_t i = 0; i < size(); ++i) {
    LinearPicture& p = pictures_[i];
    exposure_s_.push_back(rig.scene.shots[i].exposure_s.value_or(
        rig.scene.camera.exposure_s.value_or(default_exposure_s_)));
    brightest_share_.push_back(
        (brightest[i] * Eigen::Map<const Eigen::Array3d>(responsivity_.data())).maxCoeff() *
        exposure_s_[i] / sensor_.range_counts());
    tbb::parallel_for(0, p.height, [&](int y) {
      for (int x = 0; x < p.width; ++x) {
        const auto c = static_cast<std::size_t>(renderer.channel(p.x0 + x, p.y0 + y));
        p.counts[static_cast<std::size_t>(y) * static_cast<std::size_t>(p.width) +
                 static_cast<std::size_t>(x)] *=
            static_cast<float>(responsivity_[c] * exposure_s_[i]);
      }
    });
  }
}

// Fills responsivity_ and default_exposure_s_ where the rig leaves them open.
void VirtualShots::choose_exposure(const Eigen::Array3d& brightest) {
  const double range = kExposedTo * sensor_.range_counts();
  if (rig_.scene.camera.responsivity) {
    responsivity_ = *rig_.scene.camera.responsivity;
    double peak = 0.0;
    for (std::size_t c = 0; c < 3; ++c) {
      peak = std::max(peak, responsivity_[c] * brightest[static_cast<Eigen::Index>(c)]);
    }
    default_exposure_s_ = peak > 0.0 ? full_exposure_s(rig_.path, range / peak) : 1.0;
  } else {
    default_exposure_s_ = rig_.scene.camera.exposure_s.value_or(kDefaultExposure_s);
    const double peak = brightest.maxCoeff();
    responsivity_.fill(peak > 0.0 ? range / (peak * default_exposure_s_) : 1.0);
  }
}

double VirtualShots::exposure_s(std::size_t shot, std::size_t exposure) const {
  return exposure == 0 ? exposure_s_.at(shot)
                       : rig_.scene.shots.at(shot).more_exposures_s.at(exposure - 1);
}

double VirtualShots::brightest_share(std::size_t shot, std::size_t exposure) const {
  return brightest_share_.at(shot) * exposure_s(shot, exposure) / exposure_s(shot);
}

std::vector<float> VirtualShots::whole_signal_counts(std::size_t shot, std::size_t exposure) const {
  const LinearPicture& p = picture(shot);
  const auto width = static_cast<std::ptrdiff_t>(rig_.scene.camera.intrinsics.width_px);
  std::vector<float> whole(static_cast<std::size_t>(width * rig_.scene.camera.intrinsics.height_px),
                           0.0F);
  for (std::ptrdiff_t y = 0; y < p.height; ++y) {
    std::copy_n(p.counts.begin() + y * p.width, p.width, whole.begin() + (p.y0 + y) * width + p.x0);
  }
  if (exposure > 0) {
    const auto longer = static_cast<float>(exposure_s(shot, exposure) / exposure_s(shot));
    for (float& counts : whole) counts *= longer;
  }
  return whole;
}

std::uint64_t VirtualShots::stream(std::size_t shot, std::uint64_t seed,
                                   std::size_t exposure) const {
  return exposure == 0 ? capture::VirtualSensor::stream(seed, shot)
                       : capture::VirtualSensor::stream(
                             seed, rig_.scene.shots.at(shot).more_files.at(exposure - 1));
}

std::vector<std::uint16_t> VirtualShots::codes(std::size_t shot, std::uint64_t seed,
                                               std::size_t exposure) const {
  return sensor_.codes(whole_signal_counts(shot, exposure), exposure_s(shot, exposure),
                       stream(shot, seed, exposure));
}

capture::RawFrame VirtualShots::frame(std::size_t shot, std::uint64_t seed,
                                      std::size_t exposure) const {
  return sensor_.frame(whole_signal_counts(shot, exposure), exposure_s(shot, exposure),
                       stream(shot, seed, exposure));
}

capture::RawFrame VirtualShots::expected_frame(std::size_t shot, std::size_t exposure) const {
  return capture::VirtualSensor(rig_.scene, rig_.truth.sensor, false)
      .frame(whole_signal_counts(shot, exposure), exposure_s(shot, exposure), 0);
}

void VirtualShots::write(std::size_t shot, std::uint64_t seed, const std::string& path,
                         std::size_t exposure) const {
  sensor_.write(path, whole_signal_counts(shot, exposure), exposure_s(shot, exposure),
                stream(shot, seed, exposure));
}

capture::ShotSource VirtualShots::source(std::uint64_t seed) const {
  return capture::shots_from(rig_.scene, capture::all_shots(rig_.scene),
                             capture::FrameSource([this, seed](std::size_t i, std::size_t k) {
                               return frame(i, seed, k);
                             }));
}

capture::ShotSource VirtualShots::expected_source() const {
  return capture::shots_from(
      rig_.scene, capture::all_shots(rig_.scene),
      capture::FrameSource([this](std::size_t i, std::size_t k) { return expected_frame(i, k); }));
}

capture::ShotSource VirtualShots::ideal_source() const {
  return capture::shots_from(rig_.scene, capture::all_shots(rig_.scene),
                             capture::SampleSource([this](std::size_t i, const SampleMap& where) {
                               return ideal_samples(i, where.x0, where.y0, where.width,
                                                    where.height);
                             }));
}

CfaSamples VirtualShots::ideal_samples(std::size_t shot, int x0, int y0, int width,
                                       int height) const {
  const LinearPicture& p = picture(shot);
  std::vector<float> part(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0.0F);
  // Where the two rectangles meet.
  const int from_x = std::max(x0, p.x0);
  const int to_x = std::min(x0 + width, p.x0 + p.width);
  for (int y = std::max(y0, p.y0); y < std::min(y0 + height, p.y0 + p.height); ++y) {
    if (from_x >= to_x) break;
    const auto from = static_cast<std::ptrdiff_t>(y - p.y0) * p.width + (from_x - p.x0);
    const auto to = static_cast<std::ptrdiff_t>(y - y0) * width + (from_x - x0);
    std::copy_n(p.counts.begin() + from, to_x - from_x, part.begin() + to);
  }
  return capture::ideal_samples(part, x0, y0, width, height, sensor_.model(),
                                rig_.scene.camera.sensor.cfa, exposure_s(shot));
}

}  // namespace scattermeter::apps
