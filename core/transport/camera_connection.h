// Connections from scattering events to a camera, through the surface.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "core/base/random_stream.h"
#include "core/light/diffuse_plane.h"
#include "core/material/phase_function.h"
#include "core/material/rough_boundary.h"
#include "core/material/scattering_medium.h"
#include "core/transport/escape_cone.h"
#include "core/transport/facet_beams.h"
#include "core/transport/path_boundary.h"
#include "core/transport/path_score.h"
#include "core/transport/refracted_ray.h"

namespace scattermeter {

// Scores l (paper eq. 11), integrated over the surface: the sum of the scores on a patch estimates
// area * mean of pi L_o(P, toward the camera) / Ft(eta, w_o).
//
// Radiance outside is radiance inside times Ft / eta^2, so Ft cancels: l = pi / eta^2 L_inside(P).
// That is an integral of the in-scattered light along the camera's ray inside:
// l dA = pi / eta^2 ∫ exp(-sigma_t s) S ds dA, and a scattering at x is a point sample of S dV.
// With ds dA = dV / (cos_inside spread), it scores
//   pi / eta^2 * weight * p(angle) exp(-sigma_t s) / (cos_inside * spread)
// at the point where its ray passes the surface; no point is chosen at random, so there is no bias.
//
// The ray may have been reflected inside before it leaves (near edges, where the camera looks along
// a wall, that is much of the light): the mirror images of the point in one or two walls are
// connected likewise, times the walls' reflectances. Images in three walls and more are left out;
// they matter within a mean free path of corners only.
//
// A connection of n images through one plane is made with a probability that decreases with the
// depth below the plane and the walls' distances, and is weighted by its inverse (roulette;
// unbiased).
//
// Bodies of more than PathBoundary::kFewPlanes planes: through every unobstructed facet whose
// refracted beam contains the point (FacetBeams), with a probability by the ray's length. No
// images: light that after its last scattering is reflected inside, or leaves a non-convex body and
// enters it again, is not connected. Its share in per cent of the light that leaves within 0.38 rad
// of (1, -1, 1), for eta 1.3, isotropic, sigma_a 0.002 per mm, LED at (30, -60, 80) mm, +- the last
// digit (0.00: below 0.01):
//   mean free path mm           0.46   2
//   20 mm cube, sharp           0.9    4.8   (few planes: images make up for it)
//   edges rounded by 1 mm       0.02   2.0
//   edges rounded by 3 mm       0.00   0.17
//   edges rounded by 8 mm              0.00
//   sphere of radius 10 mm      0.00   0.04 at 3.3 mm
//   the same, its radius waved by 30 % (about 6 mm from dent to dent): 0.9 at 0.46 and at 1 mm
// It is scored if it leaves in roughly the camera's direction, the only biased part: see
// not_connected(). A box of 8 x 8 x 6 mm, mean free path 0.5 mm, beam from above, from three sides:
// 1.85 +- 0.05, 1.33 +- 0.05 and 0.53 +- 0.04 % of the light, where images give 1.99, 1.40 and 0.43
// %; within a mean free path of the edges the error of the light is at most 1.6 %.
//
// Rough boundaries, of bodies of any number of planes: l stays pi L_o / Ft
// (RoughBoundary::smooth_transmittance()), and is the mean over microfacets of the share of the
// camera's ray that passes by them, times pi / (eta^2 Ft) L_inside. One is drawn for every
// connection; every facet of the mesh whose beam, refracted by it, contains the point is connected
// as above. The camera's ray is taken to have the direction that it has at the point, not at the
// passage, which lies some mean free paths beside it: 1e-3 rad. Light that meets several
// microfacets as it leaves is not connected but scored as an escape, like light that was reflected
// inside.
class CameraConnection {
 public:
  // The boundary must outlive the object. most_walls: 0 .. 2, number of internal reflections; for
  // bodies of few planes only.
  CameraConnection(const PathBoundary& boundary, const Eigen::Vector3d& camera_in_world_mm,
                   const ScatteringMedium& medium, int most_walls = 2);
  // The same camera and body for another medium, above a plane (a face without a gap of air to the
  // plane is no mirror); shares the data that are expensive to build. std::invalid_argument if eta
  // or surface_alpha differs.
  CameraConnection with(const ScatteringMedium& medium,
                        const std::optional<DiffusePlane>& plane = std::nullopt) const;

  // A scattering event: position, direction of flight before it, the path's weight after it, number
  // of scatterings (this one included) and length so far.
  struct Vertex {
    const Eigen::Vector3d& x;
    const Eigen::Vector3d& before;
    double weight;
    int scatterings;
    double length_mm;
    double per_eta = 0;  // as in PathScore
  };
  // Replaces `scores` by those of the vertex.
  void connect(const Vertex& vertex, RandomStream& random, std::vector<PathScore>& scores) const;

  // The score of an escape that did not come directly from a scattering and hence was not
  // connected: l toward the camera, averaged over a cone (EscapeCone). Empty for other escapes and
  // for light that was never scattered; from bodies of few planes, only light that has come from
  // the plane below since it was scattered is scored.
  std::optional<PathScore> not_connected(const PathScore& escape) const;

 private:
  // A plane that faces the camera.
  struct Window {
    int plane_idx;
    double height_mm;      // of the camera above it
    Eigen::Vector3d foot;  // of the camera on it
    bool surely_seen;      // all of its facets are visible from the camera
  };
  // A mirror image of the scattering. walls[0]: the wall that the light hits first.
  struct Image {
    Eigen::Vector3d x;            // the image in all walls
    Eigen::Vector3d before_last;  // the image in all but the last one
    int walls[2] = {-1, -1};
    int n_walls = 0;
  };
  void through(const Window& window, const Image& image, const Vertex& vertex, double deepest_mm,
               double least_bound_mm, std::vector<PathScore>& scores) const;
  void through_facets(const Vertex& vertex, double deepest_mm,
                      std::vector<PathScore>& scores) const;
  void through_rough_facets(const Vertex& vertex, double deepest_mm, RandomStream& random,
                            std::vector<PathScore>& scores) const;
  bool may_be_seen(const Vertex& vertex, const FacetBeams::Facet& facet,
                   const Eigen::Vector3d& passage) const;

  // What becomes of a connection on its way.
  struct Way {
    double share = 1;    // of the light inside that passes, over Ft
    double per_eta = 0;  // relative change of the connection but for pi / eta^2
    bool straight = true;
  };
  void push(const Vertex& vertex, const Passage& to_camera, int facet,
            const Eigen::Vector3d& outgoing, const Way& way, double bound_mm,
            std::vector<PathScore>& scores) const;

  const PathBoundary& boundary_;
  Eigen::Vector3d camera_mm_;
  double eta_;
  double sigma_t_;
  int most_walls_;
  PhaseFunction phase_;
  std::vector<Window> windows_;
  int no_mirror_ = -1;  // plane that does not reflect inside
  std::optional<RoughBoundary> rough_;
  std::optional<RoughBoundary> of_more_eta_;  // by kEtaStep
  // For a body of many planes or with a rough boundary.
  std::shared_ptr<const FacetBeams> beams_;
  std::shared_ptr<const EscapeCone> cone_;
};

}  // namespace scattermeter
