#include "apps/deviations/true_shots.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "apps/simulation/chosen_exposure.h"
#include "capture/sensor/virtual_sensor.h"

namespace scattermeter::apps {
namespace {

// Share of the pixels that the noise of a rendering may have made too bright: time is not chosen
// for them.
constexpr double kOutliers = 1e-3;

// Adds columns of the picture, those left or right of its middle if there are two materials.
enum class Part { kAll, kLeft, kRight };
void add_picture(ColourFrame& frame, const ColourRadiance& picture, const Eigen::Array3d& factor,
                 Part part) {
  const int middle = picture.width / 2;
  const int from = part == Part::kRight ? middle : 0;
  const int to = part == Part::kLeft ? middle : picture.width;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = from; x < to; ++x) {
      for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t i =
            3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                 static_cast<std::size_t>(x)) +
            c;
        frame.at(c, picture.x0 + x, picture.y0 + y) +=
            static_cast<float>(factor[static_cast<Eigen::Index>(c)]) * picture.rgb[i];
      }
    }
  }
}

double range_of(const Rig& stated) {
  return capture::VirtualSensor(stated.scene, stated.truth.sensor, false).range_counts();
}

// Share of the pixels that are samples of the channel.
double samples_per_px(std::size_t channel) { return channel == 1 ? 0.5 : 0.25; }

}  // namespace

ExpectedShots expected_shots(const TrueSetup& setup, const Rig& stated, bool volume,
                             UnitPictures& pictures) {
  const SceneCamera& camera = setup.rig.scene.camera;
  ExpectedShots out;
  double brightest = 0.0;
  for (const TrueShot& shot : setup.shots) {
    ColourFrame& frame = out.frames.emplace_back(
        black_frame(camera.intrinsics.width_px, camera.intrinsics.height_px, range_of(stated)));
    std::array<double, 3>& noise = out.noise_counts2_per_count.emplace_back();
    for (const SceneLight& light : shot.lights) {
      Eigen::Array3d factor = light->power();
      for (std::size_t c = 0; c < 3; ++c) {
        factor[static_cast<Eigen::Index>(c)] *= camera.responsivity.value()[c];
      }
      const auto add = [&](const std::array<Medium, 3>& media, Part part) {
        const std::shared_ptr<const UnitPicture> p = pictures.of(setup, light, media, volume);
        const ColourRadiance& r = p->radiance;
        frame.object = {r.x0, r.y0, r.width, r.height};
        add_picture(frame, r, factor, part);
        for (std::size_t c = 0; c < 3; ++c) {
          noise[c] = std::max(noise[c], factor[static_cast<Eigen::Index>(c)] * samples_per_px(c) *
                                            p->variance_px_per_radiance[c]);
        }
      };
      add(shot.media, shot.right_half ? Part::kLeft : Part::kAll);
      if (shot.right_half) add(*shot.right_half, Part::kRight);
    }
    brightest = std::max(brightest, counts_exceeded(frame, kOutliers));
  }
  out.exposure_s =
      rounded_exposure_s(brightest > 0.0 ? kExposedTo * out.frames.front().range_counts / brightest
                                         : kDefaultExposure_s);
  for (std::size_t i = 0; i < out.frames.size(); ++i) {
    scale_frame(out.frames[i], out.exposure_s);
    for (double& noise : out.noise_counts2_per_count[i]) {
      noise *= out.exposure_s;
      out.rendering_counts2_per_count = std::max(out.rendering_counts2_per_count, noise);
    }
  }
  return out;
}

std::vector<capture::RawFrame> exposed_frames(const ExpectedShots& shots, const TrueSetup& setup,
                                              const Rig& stated, std::uint64_t seed) {
  const capture::VirtualSensor sensor(setup.rig.scene, setup.rig.truth.sensor, true);
  const SceneSensor& written = stated.scene.camera.sensor;
  std::vector<capture::RawFrame> out;
  for (std::size_t i = 0; i < shots.frames.size(); ++i) {
    capture::RawFrame& frame =
        out.emplace_back(sensor.frame(mosaic(shots.frames[i], setup.rig.scene.camera.sensor.cfa),
                                      shots.exposure_s, capture::VirtualSensor::stream(seed, i)));
    frame.cfa = written.cfa;
    std::copy(written.black_counts.begin(), written.black_counts.end(), frame.black_counts.begin());
    frame.white_counts = written.white_counts;
  }
  return out;
}

}  // namespace scattermeter::apps
