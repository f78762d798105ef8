#include "core/transport/scattering_view.h"

#include "core/transport/patch_scores.h"

namespace scattermeter {

ScatteringView scattering_view(const PatchMesh& patches, const std::vector<int>& patch_of_row) {
  ScatteringView view;
  view.patches = &patches;
  view.row_of_patch.assign(static_cast<std::size_t>(patches.size()), -1);
  view.n_rows = static_cast<Eigen::Index>(patch_of_row.size());
  view.area_mm2.resize(view.n_rows);
  for (Eigen::Index row = 0; row < view.n_rows; ++row) {
    const int patch = patch_of_row[static_cast<std::size_t>(row)];
    view.row_of_patch[static_cast<std::size_t>(patch)] = static_cast<std::int32_t>(row);
    view.area_mm2[row] = patches.area_mm2(patch);
  }
  return view;
}

std::int32_t row_of(const ScatteringView& view, const TriangleMesh& mesh, int facet_idx,
                    const Eigen::Vector3d& point_mm) {
  const int patch = patch_of(*view.patches, mesh, facet_idx, point_mm).patch_idx;
  return view.row_of_patch[static_cast<std::size_t>(patch)];
}

}  // namespace scattermeter
