// The samples of a white plane, averaged over cells.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "calib/led/led_scene.h"
#include "calib/led/plane_image.h"
#include "calib/led/white_plane.h"
#include "core/camera/camera_model.h"
#include "core/camera/cfa_samples.h"
#include "core/camera/rigid3d.h"

namespace scattermeter::calib {

struct PlaneCellOptions {
  int cells_across = 16;      // at most, along the longer side of the plane
  double min_cell_px = 10;    // smallest edge of a cell in the image
  double border_px = 4;       // samples nearer than this to the edge of the plane are left out
  double max_left_out = 0.2;  // share of a cell's samples; with more the cell is dropped
  // Keeps cells below the floor of the camera and adds the bias of noise cut at zero to their
  // noise: for light that is to be subtracted.
  bool keep_faint = false;
};

struct PlaneCells {
  std::vector<ShadedCell> cells;
  int columns = 0, rows = 0;      // of the grid
  std::size_t clipped_cells = 0;  // clipped and therefore left out; each channel counts
  std::size_t spots = 0;          // number of samples left out: dust, hot pixels
};

// Means of the cells, separately for each channel, without dust (robust_cell_mean()). Clipped cells
// and those below the floor of the camera are left out. Radiance = signal / (exposure
// responsivity),
// W/(mm^2 sr). `samples` must contain the rectangle of plane_image().
PlaneCells plane_cells(const CfaSamples& samples, const CameraIntrinsics& intrinsics,
                       const Rigid3d& camera_from_world, const WhitePlane& plane,
                       const std::array<double, 3>& responsivity_counts_mm2_sr_per_W_s,
                       std::size_t view_idx, std::size_t plane_idx,
                       const PlaneCellOptions& options = {});

}  // namespace scattermeter::calib
