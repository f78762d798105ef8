#include "apps/deviations/unit_pictures.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "apps/rig/open_objects.h"
#include "capture/sensor/virtual_sensor.h"

namespace scattermeter::apps {
namespace {

// The bytes of all that a picture depends on.
class Key {
 public:
  template <class T>
  void add(const T& value) {
    static_assert(std::is_arithmetic_v<T>);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void add(const Eigen::Vector3d& v) {
    for (int k = 0; k < 3; ++k) add(v[k]);
  }
  void add(const Medium& m) {
    add(m.sigma_s_prime_per_mm);
    add(m.sigma_a_per_mm);
  }
  void add(const CameraIntrinsics& k) {
    for (double v : {k.fx_px, k.fy_px, k.cx_px, k.cy_px}) add(v);
    add(k.width_px);
    add(k.height_px);
    for (double v : k.distortion) add(v);
  }
  void add(const TriangleMesh& mesh) {
    for (const Eigen::Vector3d& v : mesh.vertices_mm) add(v);
    for (const auto& t : mesh.triangles) {
      for (int v : t) add(v);
    }
  }
  void add(const LobeTable& lobe) {
    for (const auto* values : {&lobe.angles_rad(), &lobe.in_x(), &lobe.in_y()}) {
      for (double v : *values) add(v);
    }
    add(lobe.x_axis());
  }
  void add(const SceneLight& light) {
    add(light.kind.index());
    const LedLight* led = light.led();
    if (led == nullptr) {
      bytes_ += light.name;
      return;
    }
    add(led->led.position_mm);
    add(led->led.axis);
    add(led->led.exponent);
    add(led->led.radius_mm);
    if (led->led.table) add(*led->led.table);
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

std::string key_of(const TrueSetup& setup, const SceneLight& light,
                   const std::array<Medium, 3>& media, bool volume) {
  Key key;
  const SceneObject& object = setup.rig.scene.objects.front();
  key.add(volume);
  if (volume) {
    for (const double v : object.phase.numbers()) key.add(v);
  }
  for (const Medium& m : media) key.add(m);
  key.add(object.eta_int_over_ext);
  key.add(object.surface_alpha);
  key.add(setup.rig.scene.camera.intrinsics);
  key.add(setup.rig.truth.pose->position_mm);
  key.add(setup.rig.truth.pose->look_at_mm);
  key.add(setup.rig.truth.pose->up);
  if (const auto& plane = setup.rig.scene.surroundings.plane) {
    key.add(plane->z_mm);
    for (const double v : plane->albedo) key.add(v);
    key.add(static_cast<int>(plane->contact));
  }
  key.add(setup.mesh);
  key.add(light);
  return key.bytes();
}

SceneLight of_unit_power(SceneLight light) {
  const Eigen::Array3d one = Eigen::Array3d::Ones();
  if (LedLight* led = light.led()) led->led.intensity_W_per_sr = one;
  if (auto* even = std::get_if<AmbientLight>(&light.kind)) even->radiance_W_per_mm2_sr = one;
  if (auto* far = std::get_if<DistantLight>(&light.kind)) far->radiance_W_per_mm2_sr = one;
  light.name = "light";
  return light;
}

// Edge of a patch of the fit: a fiftieth of the object's size.
constexpr double kPatchesAcross = 50.0;

// The mean of two renderings, and its noise.
UnitPicture mean_of(const ColourRadiance& one, const ColourRadiance& two) {
  UnitPicture out;
  out.radiance = one;
  for (std::size_t i = 0; i < one.rgb.size(); ++i) {
    out.radiance.rgb[i] = 0.5F * (one.rgb[i] + two.rgb[i]);
  }
  const int side = std::max(1, static_cast<int>(std::lround(one.width / kPatchesAcross)));
  for (std::size_t c = 0; c < 3; ++c) {
    double squares = 0.0;
    double sum = 0.0;
    for (int y0 = 0; y0 + side <= one.height; y0 += side) {
      for (int x0 = 0; x0 + side <= one.width; x0 += side) {
        double difference = 0.0;
        for (int k = 0; k < side * side; ++k) {
          const int pixel = (y0 + k / side) * one.width + x0 + k % side;
          const std::size_t i = 3 * static_cast<std::size_t>(pixel) + c;
          difference += static_cast<double>(one.rgb[i]) - static_cast<double>(two.rgb[i]);
          sum += static_cast<double>(out.radiance.rgb[i]);
        }
        squares += difference * difference;
      }
    }
    // The mean of two has a quarter of the variance of their difference.
    out.variance_px_per_radiance[c] = sum > 0.0 ? 0.25 * squares / sum : 0.0;
  }
  return out;
}

}  // namespace

std::shared_ptr<const UnitPicture> UnitPictures::of(const TrueSetup& setup, const SceneLight& light,
                                                    const std::array<Medium, 3>& media,
                                                    bool volume) {
  const std::string key = key_of(setup, light, media, volume);
  if (const auto it = kept_.find(key); it != kept_.end()) {
    by_use_.splice(by_use_.begin(), by_use_, it->second.use);
    return it->second.picture;
  }
  Rig rig = setup.rig;
  rig.scene.lights = {of_unit_power(light)};
  rig.scene.shots.resize(1);
  rig.scene.shots.front().lights = {"light"};
  rig.truth.materials[rig.scene.shots.front().material] = media;
  const ObjectScenes objects = open_objects(rig, [&](const SceneObject&) { return setup.mesh; });
  // A stream of its own for each picture, which does not depend on those made before.
  const std::uint64_t stream = capture::VirtualSensor::stream(1, key);
  const auto render = [&](std::uint64_t half) {
    RenderTransport transport;
    transport.volume = volume;
    transport.paths = paths_ / 2;
    transport.seed = stream + half;
    return ShotRenderer(rig, objects, transport).render_colour(rig.scene.shots[0]);
  };
  auto picture = std::make_shared<UnitPicture>();
  if (volume) {
    *picture = mean_of(render(0), render(1));
  } else {
    picture->radiance = render(0);
  }
  ++rendered_;
  if (kept_.size() >= most_) {
    kept_.erase(by_use_.back());
    by_use_.pop_back();
  }
  by_use_.push_front(key);
  kept_[key] = {picture, by_use_.begin()};
  return picture;
}

}  // namespace scattermeter::apps
