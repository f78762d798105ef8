// A path of light while it is traced.
#pragma once

#include <Eigen/Core>

#include "core/transport/path_score.h"

namespace scattermeter {

struct LightPath {
  Eigen::Vector3d x;
  Eigen::Vector3d direction;  // of flight
  double weight;
  int scatterings = 0;
  double length_mm = 0.0;        // up to the end of the current step
  double per_eta = 0.0;          // as in PathScore
  double per_eta_outside = 0.0;  // the same of what met the surface since it left
  bool straight = false;         // as in PathScore
  bool by_plane = false;
  bool by_several = false;  // as it last met the surface

  // If it ended there, at one of the body's facets or on the plane (-1).
  PathScore score_at(const Eigen::Vector3d& point_mm, int facet_idx) const {
    return {point_mm,  direction, facet_idx, weight,   scatterings,
            length_mm, per_eta,   straight,  by_plane, by_several};
  }
};

}  // namespace scattermeter
