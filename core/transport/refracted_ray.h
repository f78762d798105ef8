// The camera's ray to a point inside, through a plane.
#pragma once

#include <utility>

#include <Eigen/Core>

namespace scattermeter {

// The ray from a point inside to the camera through a plane, and its spread.
struct RefractedRay {
  double radius_mm = 0;  // distance on the plane from the camera's foot to the passage
  double length_mm = 0;  // from the point to the passage
  double cos_inside = 1;
  double spread = 1;  // ratio of a ray bundle's area at the point's depth to that on the plane
  double radius_mm_per_eta = 0;  // change by eta, of the same point's ray
};

// Snell on a plane: the camera is `height_mm` above it, the point `depth_mm` below it, and their
// feet are `foot_mm` apart. Solves r + depth r / sqrt(eta^2 (r^2 + height^2) - r^2) = foot by
// Newton's method, to 1e-10 of the distance to the camera. Domain: height > 0, depth >= 0, foot >=
// 0, eta >= 1.
RefractedRay refracted_ray(double height_mm, double depth_mm, double foot_mm,
                           double eta_int_over_ext);

// The camera's ray through a plane to a point at a depth below it.
struct Passage {
  RefractedRay ray;
  Eigen::Vector3d point;                                       // on the plane
  Eigen::Vector3d moved_mm_per_eta = Eigen::Vector3d::Zero();  // of `point`, for the same x
};
Passage passage_to(const Eigen::Vector3d& x, double depth_mm, const Eigen::Vector3d& normal,
                   const Eigen::Vector3d& foot, double height_mm, double eta);
// The ends of a short line on the plane that contains the passage: with q as in refracted_ray(),
// radius / foot = q / (q + depth), and eta height <= q <= its value at the foot.
std::pair<Eigen::Vector3d, Eigen::Vector3d> passage_between(const Eigen::Vector3d& x,
                                                            double depth_mm,
                                                            const Eigen::Vector3d& normal,
                                                            const Eigen::Vector3d& foot,
                                                            double height_mm, double eta);

}  // namespace scattermeter
