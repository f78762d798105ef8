// Projections of the sphere of directions onto the picture of a light probe.
#pragma once

#include <Eigen/Core>

#include "core/light/image_rect.h"

namespace scattermeter {

// In the probe's frame the image centre shows +y and the top of the picture lies towards +z.
//
// equirectangular (latitude-longitude): right of the centre lies +x, a quarter of the width away;
// the left and right edges show -y, the top row +z.
// angular map (Debevec): a disc in the middle, whose radius is half the shorter side; the angle
// from +y grows linearly with the radius, to -y on the rim; right of the centre lies +x.
// mirror ball: a distant camera's picture of a mirrored ball that fills the disc, as taken. The
// centre shows the camera (+y), the rim -y, and the picture is mirrored: right of the centre lies
// -x, at 1/sqrt(2) of the radius.
enum class ProbeProjection { kEquirectangular, kAngularMap, kMirrorBall };

// A projection onto a picture of given size.
class ProbeMap {
 public:
  // Throws std::invalid_argument for a size that is not positive.
  ProbeMap(ProbeProjection projection, int width_px, int height_px);

  ProbeProjection projection() const { return projection_; }
  int width_px() const { return width_px_; }
  int height_px() const { return height_px_; }

  // Unit direction shown at a position in the picture. Positions beyond the disc show the same as
  // the nearest point of its rim, -y.
  Eigen::Vector3d direction(double x_px, double y_px) const;
  // Its inverse, for any direction but zero. If several positions show the direction (the poles,
  // the seam, -y), one of them; at the seam, the left edge.
  Eigen::Vector2d position_px(const Eigen::Vector3d& direction) const;
  // Solid angle of a rectangle, sr; 0 where it lies beyond the disc. Exact for equirectangular and
  // mirror ball; for the angular map to 1e-9 of a rectangle of at most a quarter of the picture's
  // side.
  double solid_angle_sr(const ImageRect& rect) const;
  // Mean direction over a rectangle, weighted by solid angle (of length below 1: the wider the
  // rectangle, the shorter); accurate to fourth order in its size, near the rim of a disc to
  // second.
  Eigen::Vector3d mean_direction(const ImageRect& rect) const;

 private:
  // Solid angle per unit of the disc's area, or per square pixel of the equirectangular picture up
  // to a factor.
  double density(double x_px, double y_px) const;
  double disc_solid_angle_sr(const ImageRect& disc) const;
  ProbeProjection projection_;
  int width_px_;
  int height_px_;
  double radius_px_;  // of the disc
};

}  // namespace scattermeter
