#include "capture/shots/shot_key.h"

#include "core/base/version.h"

namespace scattermeter::capture {
namespace {

// To be incremented whenever the same inputs are decoded to something else than before.
constexpr int kFormat = 8;

void add_camera(const SceneCamera& camera, const ShotDecoding& decoding, FileDigests& digests,
                Digest& key) {
  const CameraIntrinsics& k = camera.intrinsics;
  key.text(camera.model).number(k.width_px).number(k.height_px);
  key.number(k.fx_px).number(k.fy_px).number(k.cx_px).number(k.cy_px);
  key.number(static_cast<double>(k.distortion.size())).numbers(k.distortion);
  key.number(camera.responsivity.has_value());
  if (camera.responsivity) key.numbers(*camera.responsivity);
  if (decoding.radiance) {
    key.text(decoding.radiance_path.empty() ? "" : digests.of(decoding.radiance_path));
  } else {
    key.number(camera.sensor.noise.gain_e_per_count).number(camera.sensor.noise.read_noise_counts);
  }
}

}  // namespace

std::string shot_key(const Scene& scene, const ShotDecoding& decoding, const ObservedShot& shot,
                     const std::vector<std::string>& names, FileDigests& digests) {
  Digest key;
  key.text(kVersion).number(kFormat).number(decoding.max_megapixels);
  for (std::size_t k = 0; k < names.size(); ++k) {
    // The file's name in the rig is stored with the shot.
    key.text(shot.stated->files().at(k)).text(digests.of(names[k]));
  }
  add_camera(scene.camera, decoding, digests, key);
  const SeenObject& seen = *shot.seen;
  for (const Rigid3d& pose : {shot.pose.camera_from_world, seen.object->stated->world_from_mesh}) {
    for (const double v : pose.rotation.coeffs()) key.number(v);
    for (const double v : pose.translation_mm) key.number(v);
  }
  for (const double v : seen.shift) key.number(v);
  key.text(digests.of(seen.object->stated->mesh_path));
  key.number(seen.patches->patch_size_mm()).number(seen.object->stated->eta_int_over_ext);
  // They decide which samples a row has.
  key.number(seen.object->stated->edge_std_mm).number(seen.object->stated->position_std_mm);
  return key.hex();
}

}  // namespace scattermeter::capture
