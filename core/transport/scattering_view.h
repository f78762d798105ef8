// The rows of a view: the patches whose light is asked for.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "core/mesh/patch_mesh.h"

namespace scattermeter {

// A view: the rows of the patches.
struct ScatteringView {
  const PatchMesh* patches = nullptr;
  std::vector<std::int32_t> row_of_patch;  // -1: no row
  Eigen::Index n_rows = 0;
  Eigen::VectorXd area_mm2;  // of the rows' patches
};
ScatteringView scattering_view(const PatchMesh& patches, const std::vector<int>& patch_of_row);
// The row of a point of a facet; -1: none.
std::int32_t row_of(const ScatteringView& view, const TriangleMesh& mesh, int facet_idx,
                    const Eigen::Vector3d& point_mm);

}  // namespace scattermeter
