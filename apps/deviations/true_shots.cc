#include "apps/deviations/true_shots.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "apps/simulation/chosen_exposure.h"
#include "apps/simulation/synthetic_camera.h"
#include "capture/sensor/virtual_sensor.h"

namespace scattermeter::apps {
namespace {

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

// Of the pixels that the object fills.
double mean_signal_counts(const ColourFrame& frame, std::size_t channel) {
  double sum = 0.0;
  int n = 0;
  for (float c : frame.counts[channel]) {
    if (!(c > 0.0F)) continue;
    sum += static_cast<double>(c);
    ++n;
  }
  return n > 0 ? sum / n : 0.0;
}

}  // namespace

ExpectedShots expected_shots(const TrueSetup& setup, const Rig& stated, bool volume,
                             UnitPictures& pictures) {
  const SceneCamera& camera = setup.rig.scene.camera;
  ExpectedShots out;
  double brightest = 0.0;
  double relative_variance_mm2 = 0.0;
  for (const TrueShot& shot : setup.shots) {
    ColourFrame& frame = out.frames.emplace_back(
        black_frame(camera.intrinsics.width_px, camera.intrinsics.height_px, range_of(stated)));
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
        relative_variance_mm2 = std::max(relative_variance_mm2, p->relative_variance_mm2);
      };
      add(shot.media, shot.right_half ? Part::kLeft : Part::kAll);
      if (shot.right_half) add(*shot.right_half, Part::kRight);
    }
    brightest = std::max(brightest, brightest_counts(frame));
  }
  out.exposure_s =
      rounded_exposure_s(brightest > 0.0 ? kExposedTo * out.frames.front().range_counts / brightest
                                         : kDefaultExposure_s);
  for (ColourFrame& frame : out.frames) {
    scale_frame(frame, out.exposure_s);
    for (std::size_t c = 0; c < 3; ++c) {
      // Of the four pixels of a cell, one (of G two) is a sample of the channel.
      const double sample_mm2 = (c == 1 ? 2.0 : 4.0) * std::pow(pixel_mm(stated), 2);
      out.rendering_counts2_per_count =
          std::max(out.rendering_counts2_per_count,
                   relative_variance_mm2 * mean_signal_counts(frame, c) / sample_mm2);
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
