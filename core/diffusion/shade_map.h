// Pixels of a picture of an object, ready to be shaded with any field on its surface.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "core/diffusion/dipole_image.h"
#include "core/view/sample_map.h"

namespace scattermeter {

// Each pixel of a rectangle is a mean over surface points: one for pixels inside a facet, 64 spread
// over the pixel (core/view/pixel_points.h) if it includes another facet, a step in depth or the
// background.
class ShadeMap {
 public:
  ShadeMap(const RayGrid& rays, const RayScene& scene, const PatchMesh& patches,
           double eta_int_over_ext);

  int x0() const { return x0_; }
  int y0() const { return y0_; }
  int width() const { return width_; }
  int height() const { return height_; }
  // Share of the pixel that the object covers, 0 .. 1. (x, y) relative to the rectangle.
  double coverage(int x, int y) const;
  // Patches that any pixel needs, by patch index.
  std::vector<bool> needed_patches(int n_patches) const;
  // Mean over the pixel of L_o = Ft(eta, w_o) l / pi of one channel (background: 0), W/(mm^2 sr).
  double radiance(int x, int y, const SurfaceField& field, int channel) const;

 private:
  struct Point {
    std::int32_t patch;  // -1: background
    float w1, w2;        // barycentric weights of the second and third corner
    float transmittance_over_pi;
  };
  static constexpr int kPoints = 64;
  Point trace(const RayScene& scene, const PatchMesh& patches, const Eigen::Vector3d& origin_mm,
              const Eigen::Vector3d& direction, double eta, std::int32_t* facet) const;
  const Point* begin(int x, int y, int* count) const;

  int x0_, y0_, width_, height_;
  std::vector<Point> centers_;
  std::vector<std::int32_t> block_of_pixel_;  // -1: centre only; else of its points
  std::vector<Point> blocks_;
};

}  // namespace scattermeter
