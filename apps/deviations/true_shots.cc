#include "apps/deviations/true_shots.h"

#include <algorithm>

#include "apps/simulation/chosen_exposure.h"
#include "capture/sensor/virtual_sensor.h"

namespace scattermeter::apps {
namespace {

using Picture = std::shared_ptr<const ColourRadiance>;

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

}  // namespace

std::vector<ColourFrame> expected_frames(const TrueSetup& setup, const Rig& stated, bool volume,
                                         UnitPictures& pictures, double& exposure_s) {
  const SceneCamera& camera = setup.rig.scene.camera;
  std::vector<ColourFrame> frames;
  double brightest = 0.0;
  for (const TrueShot& shot : setup.shots) {
    ColourFrame& frame = frames.emplace_back(
        black_frame(camera.intrinsics.width_px, camera.intrinsics.height_px, range_of(stated)));
    for (const SceneLight& light : shot.lights) {
      Eigen::Array3d factor = light->power();
      for (std::size_t c = 0; c < 3; ++c) {
        factor[static_cast<Eigen::Index>(c)] *= camera.responsivity.value()[c];
      }
      const auto add = [&](const std::array<Medium, 3>& media, Part part) {
        const Picture p = pictures.of(setup, light, media, volume);
        frame.object = {p->x0, p->y0, p->width, p->height};
        add_picture(frame, *p, factor, part);
      };
      add(shot.media, shot.right_half ? Part::kLeft : Part::kAll);
      if (shot.right_half) add(*shot.right_half, Part::kRight);
    }
    brightest = std::max(brightest, brightest_counts(frame));
  }
  exposure_s = rounded_exposure_s(
      brightest > 0.0 ? kExposedTo * frames.front().range_counts / brightest : kDefaultExposure_s);
  for (ColourFrame& frame : frames) scale_frame(frame, exposure_s);
  return frames;
}

std::vector<capture::RawFrame> exposed_frames(const std::vector<ColourFrame>& frames,
                                              const TrueSetup& setup, const Rig& stated,
                                              double exposure_s, std::uint64_t seed) {
  const capture::VirtualSensor sensor(setup.rig.scene, setup.rig.truth.sensor, true);
  const SceneSensor& written = stated.scene.camera.sensor;
  std::vector<capture::RawFrame> out;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    capture::RawFrame& frame =
        out.emplace_back(sensor.frame(mosaic(frames[i], setup.rig.scene.camera.sensor.cfa),
                                      exposure_s, capture::VirtualSensor::stream(seed, i)));
    frame.cfa = written.cfa;
    std::copy(written.black_counts.begin(), written.black_counts.end(), frame.black_counts.begin());
    frame.white_counts = written.white_counts;
  }
  return out;
}

}  // namespace scattermeter::apps
