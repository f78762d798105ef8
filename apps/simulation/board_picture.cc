#include "apps/simulation/board_picture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include "apps/instrument/rig_places.h"
#include "core/camera/cfa_samples.h"
#include "core/view/pixel_points.h"

namespace scattermeter::apps {
namespace {

constexpr double kWhite = 0.9;
constexpr double kBlack = 0.04;
// Sub-samples per side of a pixel; at edges, which may run along the pixels' rows and would then
// all be off by the same part of a sample, more.
constexpr int kSide = 3;
constexpr int kEdgeSide = 12;

// Of one pixel, on the board.
struct PixelSamples {
  double sum = 0.0, least = 1.0, most = 0.0;            // reflectances
  Eigen::Vector3d points_mm = Eigen::Vector3d::Zero();  // their sum, in the board's frame
  int hits = 0;

  void add(double reflectance, const Eigen::Vector3d& at_mm) {
    sum += reflectance;
    least = std::min(least, reflectance);
    most = std::max(most, reflectance);
    points_mm += at_mm;
    ++hits;
  }
};

}  // namespace

void add_board(const CameraView& view, const calib::CharucoBoard& board,
               const std::vector<Led>& leds, const Eigen::Array3d& ambient_W_per_mm2,
               const RayScene& object, const CfaPattern& cfa, std::vector<float>& radiance) {
  const auto corners_mm = board_corners(board);
  TriangleMesh corners;
  corners.vertices_mm.assign(corners_mm.begin(), corners_mm.end());
  const ViewCheck check = check_view(view, corners);
  if (!check.in_front || !check.in_frame) return;
  const RayGrid rays = rays_around(view, corners, 4);
  const calib::CharucoPattern pattern(board);
  const Rigid3d board_from_world = inverse(board.world_from_board);
  const Eigen::Vector3d origin = board_from_world * rays.origin_in_world_mm;
  const Eigen::Vector3d normal = board.world_from_board.rotation * Eigen::Vector3d::UnitZ();
  const auto shade = [&](int x, int y) {
    const PixelPoints pixel(rays, x, y);
    if (object.first_hit(rays.origin_in_world_mm, pixel.direction_at(0.0, 0.0)).facet_idx >= 0)
      return;  // the object is nearer
    const auto sampled = [&](int side) {
      PixelSamples out;
      for (int i = 0; i < side * side; ++i) {
        const double fx = (i % side + 0.5) / side - 0.5;
        const double fy = (static_cast<int>(i / side) + 0.5) / side - 0.5;
        const Eigen::Vector3d w = board_from_world.rotation * pixel.direction_at(fx, fy);
        if (!(origin.z() > 0.0) || !(w.z() < 0.0)) continue;
        const Eigen::Vector3d p = origin - origin.z() / w.z() * w;
        const double print = pattern.reflectance(p.x(), p.y());
        if (std::isfinite(print)) out.add(kBlack + (kWhite - kBlack) * print, p);
      }
      out.sum /= side * side;
      return out;
    };
    PixelSamples samples = sampled(kSide);
    if (samples.hits > 0 && (samples.hits < kSide * kSide || samples.least < samples.most)) {
      samples = sampled(kEdgeSide);
    }
    if (samples.hits == 0) return;
    const Eigen::Vector3d point = board.world_from_board * (samples.points_mm / samples.hits);
    const int xx = rays.x0 + x;
    const int yy = rays.y0 + y;
    const int channel = static_cast<int>(cfa.at(xx, yy));
    double irradiance = ambient_W_per_mm2[channel];
    for (const Led& led : leds) {
      const double e = led.transmitted_irradiance_per_mm2(point, normal, 1.0);
      if (e > 0.0 && !object.occluded(point, normal, led.position_mm)) {
        irradiance += e * led.intensity_W_per_sr[channel];
      }
    }
    radiance[static_cast<std::size_t>(yy) * static_cast<std::size_t>(view.intrinsics.width_px) +
             static_cast<std::size_t>(xx)] +=
        static_cast<float>(irradiance / std::numbers::pi * samples.sum);
  };
  tbb::parallel_for(tbb::blocked_range<int>(0, rays.height, 8),
                    [&](const tbb::blocked_range<int>& range) {
                      for (int y = range.begin(); y < range.end(); ++y) {
                        for (int x = 0; x < rays.width; ++x) shade(x, y);
                      }
                    });
}

}  // namespace scattermeter::apps
