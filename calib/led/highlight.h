// The image of a lamp in a mirror sphere, found in raw samples.
#pragma once

#include <string>

#include <Eigen/Core>

#include "calib/led/sphere_image.h"
#include "core/camera/cfa_samples.h"

namespace scattermeter::calib {

struct HighlightOptions {
  double min_snr = 10;      // of the peak (of a 2 x 2 cell) over the noise and scatter around it
  double max_share = 0.25;  // of the sphere's disc that a highlight may fill
  // What is added in quadrature to the noise of the centroid, px: the blob's own asymmetry and what
  // sampling by a filter array leaves of it.
  double model_std_px = 0.02;
};

struct FoundHighlight {
  std::string problem;  // "": found; else why not, and the rest is NaN or 0
  Eigen::Vector2d image_px;
  double std_px = 0;           // of each coordinate
  double saturated_share = 0;  // of the blob's samples
  double width_px = 0;         // across the blob at a tenth of its height
};

// The brightest compact blob on the sphere's disc. Nothing is assumed about where the lamp is.
// Samples at or above the clip are taken as bright as the clip: the blob loses its top, its middle
// stays. The centroid is that of the signal above the surroundings, each filter phase for itself,
// and the mean over the phases that see the lamp: their pitch of two samples then does not alias
// more than one of a single sample would. `samples` must hold the sphere's image.
FoundHighlight find_highlight(const CfaSamples& samples, const SphereImage& sphere,
                              const HighlightOptions& options = {});

}  // namespace scattermeter::calib
