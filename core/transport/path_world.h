// Where paths are traced, and how.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "core/light/diffuse_plane.h"
#include "core/light/entry_source.h"
#include "core/material/scattering_medium.h"
#include "core/transport/camera_connection.h"
#include "core/transport/path_boundary.h"
#include "core/transport/path_peers.h"

namespace scattermeter {

// For PathOptions::isotropic_beyond. Of a 20 mm cube (1.3 and 0.004 per mm, g 0.8) all light that
// leaves is then that of exact paths within 0.03 %, that of each of 46 cells of the surface within
// the 0.5 % of the comparison, from 64 % of the scatterings (g 0.95: from 42 %).
inline constexpr double kIsotropicBeyond = 1.0;

struct PathOptions {
  std::uint64_t seed = 1;
  int paths_per_block = 4096;        // >= 1
  double roulette_weight = 0.1;      // relative to the initial weight; below it, roulette
  int max_scatterings = 10'000'000;  // of one path; its remaining power counts as lost
  // Where the phase function is not isotropic: farther than this from the surface, in transport
  // mean free paths (1 / sigma_s'), scattering is isotropic with the same sigma_s' (see
  // PathTracer).
  double isotropic_beyond = std::numeric_limits<double>::infinity();
  // Processes that share the blocks (in trace_blocks with a SentTally); null: all are traced here.
  PathPeers* peers = nullptr;
};

// The body, medium, source, camera and surroundings of the paths. Pointers and references must
// outlive it.
struct PathWorld {
  const PathBoundary& boundary;
  ScatteringMedium medium;
  const EntrySource& source;
  const CameraConnection* camera = nullptr;  // null: no connections
  // Below the body (precondition). Light of the source that meets the plane first belongs to the
  // source (plane_entry()).
  std::optional<DiffusePlane> plane = std::nullopt;
};

}  // namespace scattermeter
