#include "apps/deviations/unit_pictures.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "apps/instrument/open_objects.h"
#include "capture/sensor/virtual_sensor.h"
#include "core/transport/volume_light.h"

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
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

std::string key_of(const TrueSetup& setup, const SceneLight& light,
                   const std::array<Medium, 3>& media, bool volume) {
  Key key;
  key.add(volume);
  if (volume) key.add(setup.phase_mean_cosine);
  for (const Medium& m : media) key.add(m);
  key.add(setup.rig.scene.objects.front().eta_int_over_ext);
  key.add(setup.rig.scene.camera.intrinsics);
  key.add(setup.rig.truth.pose->position_mm);
  key.add(setup.rig.truth.pose->look_at_mm);
  key.add(setup.rig.truth.pose->up);
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

// That of the volume's renderer.
double patch_size_mm(const TriangleMesh& mesh, const std::array<Medium, 3>& media) {
  const double size_mm = bounds(mesh).size_mm().maxCoeff();
  double shortest_mm = size_mm;
  for (const Medium& m : media) shortest_mm = std::min(shortest_mm, 1.0 / m.sigma_t_prime_per_mm());
  return volume_patch_size_mm(shortest_mm, size_mm);
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
  RenderTransport transport;
  transport.volume = volume;
  transport.paths = paths_;
  transport.phase_mean_cosine = setup.phase_mean_cosine;
  // A stream of its own for each picture, which does not depend on those made before.
  transport.seed = capture::VirtualSensor::stream(1, key);
  ShotRenderer renderer(rig, objects, transport);
  auto picture = std::make_shared<UnitPicture>();
  picture->radiance = renderer.render_colour(rig.scene.shots[0]);
  if (volume) {
    picture->relative_variance_mm2 =
        std::pow(renderer.monte_carlo_std() * patch_size_mm(setup.mesh, media), 2);
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
