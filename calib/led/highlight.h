// Detection of the image of a lamp in a mirror sphere, in raw samples.
#pragma once

#include <string>

#include <Eigen/Core>

#include "calib/led/sphere_image.h"
#include "core/camera/cfa_samples.h"

namespace scattermeter::calib {

struct HighlightOptions {
  double min_snr = 10;      // of the peak (of a 2 x 2 cell) over the noise and scatter around it
  double max_share = 0.25;  // largest share of the sphere's disc that a highlight fills
  // Added in quadrature to the noise of the centroid, px: the asymmetry of the blob and the error
  // of sampling by a filter array.
  double model_std_px = 0.02;
};

struct FoundHighlight {
  std::string problem;  // "" if found; else why not, and the rest is NaN or 0
  Eigen::Vector2d image_px;
  double std_px = 0;           // of each coordinate
  double saturated_share = 0;  // of the blob's samples
  double width_px = 0;         // across the blob at a tenth of its height
};

// Finds the brightest compact blob on the disc of the sphere, without any assumption about the
// position of the lamp. Clipped samples count as being at the clip level: the blob loses its top,
// but its centre does not move. The centroid of the signal above the surroundings is computed for
// each filter phase separately and averaged over the phases that see the lamp: their pitch of two
// samples then causes no more aliasing than a pitch of one sample would. `samples` must contain the
// image of the sphere.
FoundHighlight find_highlight(const CfaSamples& samples, const SphereImage& sphere,
                              const HighlightOptions& options = {});

}  // namespace scattermeter::calib
