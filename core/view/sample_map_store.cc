#include "core/view/sample_map_store.h"

#include <vector>

namespace scattermeter {
namespace {

std::vector<double> numbers_of(const CameraView& view, const PatchMesh& patches,
                               const TriangleMesh& mesh, double eta_int_over_ext,
                               const SampleMapOptions& options) {
  // To be raised when the same inputs give another map.
  constexpr int kForm = 1;
  const CameraIntrinsics& k = view.intrinsics;
  const Rigid3d& pose = view.camera_from_world;
  std::vector<double> out{kForm,
                          static_cast<double>(k.width_px),
                          static_cast<double>(k.height_px),
                          k.fx_px,
                          k.fy_px,
                          k.cx_px,
                          k.cy_px,
                          static_cast<double>(k.distortion.size()),
                          patches.patch_size_mm(),
                          eta_int_over_ext,
                          static_cast<double>(options.guard_px),
                          options.min_coverage,
                          options.edge_reach_mm,
                          options.least_cosine,
                          static_cast<double>(mesh.vertices_mm.size())};
  out.insert(out.end(), k.distortion.begin(), k.distortion.end());
  for (const double v : pose.rotation.coeffs()) out.push_back(v);
  for (const double v : pose.translation_mm) out.push_back(v);
  for (const Eigen::Vector3d& p : mesh.vertices_mm) out.insert(out.end(), p.begin(), p.end());
  for (const auto& t : mesh.triangles) out.insert(out.end(), t.begin(), t.end());
  return out;
}

}  // namespace

SampleMap map_samples(const CameraView& view, const RayScene& scene, const PatchMesh& patches,
                      double eta_int_over_ext, const SampleMapOptions& options,
                      SampleMapStore* store) {
  const auto make = [&] {
    return map_samples(rays_around(view, scene.mesh(), 2 * options.guard_px), scene, patches,
                       eta_int_over_ext, options);
  };
  if (store == nullptr) return make();
  return found_or_made(*store, numbers_of(view, patches, scene.mesh(), eta_int_over_ext, options),
                       make);
}

}  // namespace scattermeter
