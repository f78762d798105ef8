// Scores of paths, and the audit of their power.
#pragma once

#include <cstdint>

#include <Eigen/Core>

namespace scattermeter {

// A share of light at a point of the surface, or of the plane below the body. Weighted by
// (sigma_s/sigma_s0)^scatterings exp(-(sigma_t - sigma_t0) length_mm) it becomes that of a material
// with sigma_s and sigma_t, if the path was drawn for sigma_s0 and sigma_t0 (same g and eta).
struct PathScore {
  Eigen::Vector3d point_mm;   // on the surface; of an escape by way of the plane: on the plane
  Eigen::Vector3d direction;  // unit, outside, away from the surface
  int facet_idx = -1;         // -1: on the plane
  double weight = 0;
  int scatterings = 0;   // before it
  double length_mm = 0;  // inside the body
  // Change by eta of the weight that such paths have, relative and per unit of eta (perturbation
  // Monte Carlo with core/material/eta_change.h), but for the share that passes as they leave here.
  // That light which is refracted otherwise moves sideways is left out where it leaves here.
  double per_eta = 0;
  // Since its last scattering it has neither been reflected nor left the body and entered again,
  // and of a rough boundary it met a single facet.
  bool straight = false;
  bool by_plane = false;    // since its last scattering it has come from the plane
  bool by_several = false;  // it left a rough boundary by several microfacets
  // Of a connection through a smooth face: how refraction moves the point
  // (core/transport/sideways_growth.h).
  Eigen::Vector3d moved_mm_per_eta = Eigen::Vector3d::Zero();
};

// Power by fate, in the source's unit. entered = absorbed + in_plane + escaped + roulette + lost to
// rounding.
struct PathAudit {
  double entered = 0;
  double absorbed = 0;
  double in_plane = 0;  // absorbed by the plane below the body
  double escaped = 0;
  double roulette = 0;  // ended by roulette minus the gain of its survivors; 0 in the mean
  double lost = 0;      // of paths found outside the body, or cut at max_scatterings
  std::int64_t paths = 0;
  std::int64_t lost_paths = 0;
  std::int64_t scatterings = 0;
  std::int64_t connections = 0;  // scored, to the camera

  // Calls f for each of the above. Counts below 2^53 are exact as double.
  template <class F>
  void numbers(const F& f) {
    for (double* power : {&entered, &absorbed, &in_plane, &escaped, &roulette, &lost}) f(*power);
    for (std::int64_t* count : {&paths, &lost_paths, &scatterings, &connections}) f(*count);
  }

  PathAudit& operator+=(const PathAudit& o) {
    entered += o.entered;
    absorbed += o.absorbed;
    in_plane += o.in_plane;
    escaped += o.escaped;
    roulette += o.roulette;
    lost += o.lost;
    paths += o.paths;
    lost_paths += o.lost_paths;
    scatterings += o.scatterings;
    connections += o.connections;
    return *this;
  }
};

}  // namespace scattermeter
