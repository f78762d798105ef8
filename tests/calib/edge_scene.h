// A cube, its camera, and its outline with known errors, for the tests of edges.
#pragma once

#include <map>
#include <random>
#include <vector>

#include <Eigen/Geometry>

#include "calib/camera_model.h"
#include "calib/edge_points.h"
#include "core/ray_scene.h"
#include "core/visible_edges.h"
#include "tests/calib/pose_scenes.h"
#include "tests/core/boxes.h"

namespace scattermeter::calib {

inline CameraIntrinsics small_lens() {
  CameraIntrinsics k;
  k.width_px = 240;
  k.height_px = 160;
  k.fx_px = k.fy_px = 620;
  k.cx_px = 119.3;
  k.cy_px = 80.2;
  return k;
}

inline Rigid3d cube_view() { return camera_looking_at({0, 0, 10}, 180, 0.6, 1.2); }

// Pieces of the outline as the pose shows them, each end of a line off by line_std_px, each piece
// by piece_std_px (its std_px). The mesh's points are given, multiplied by 1 / scale: the body is
// `scale` times as large as the mesh says.
inline std::vector<EdgePoint> outline(const RayScene& scene, const CameraIntrinsics& lens,
                                      const Rigid3d& pose, int body_idx, double line_std_px,
                                      double piece_std_px, double scale, std::mt19937_64* random) {
  VisibleEdgesOptions options;
  options.step_rad = 8 / lens.fx_px;
  std::normal_distribution<double> normal;
  std::map<int, std::vector<EdgePoint>> lines;
  for (const EdgePiece& e : visible_edges(scene, inverse(pose).translation_mm, options)) {
    if (e.kind != EdgeKind::kContour) continue;
    const auto px =
        project(lens, pose, {e.center_mm, e.center_mm + e.half_mm, e.center_mm + 0.1 * e.outward});
    EdgePoint p;
    p.body_idx = body_idx;
    p.line_idx = e.line_idx;
    p.point_mm = e.center_mm / scale;
    p.tangent = e.half_mm.normalized();
    const Eigen::Vector2d along = px[1] - px[0];
    p.outward = Eigen::Vector2d(-along.y(), along.x()).normalized();
    if (p.outward.dot(px[2] - px[0]) < 0) p.outward = -p.outward;
    p.std_px = piece_std_px;
    p.measured_px = px[0];
    lines[p.line_idx].push_back(p);
  }
  std::vector<EdgePoint> out;
  for (auto& [idx, pieces] : lines) {
    const double from = line_std_px * normal(*random);
    const double to = line_std_px * normal(*random);
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const double t =
          pieces.size() > 1 ? static_cast<double>(i) / static_cast<double>(pieces.size() - 1) : 0.5;
      EdgePoint p = pieces[i];
      p.measured_px += ((1 - t) * from + t * to + piece_std_px * normal(*random)) * p.outward;
      out.push_back(p);
    }
  }
  return out;
}

// A picture of the body, evenly bright, by rays: 64 a pixel near the outline.
inline CfaSamples picture(const RayScene& scene, const CameraIntrinsics& lens, const Rigid3d& pose,
                          double counts, std::mt19937_64* random) {
  CfaSamples s;
  s.width = lens.width_px;
  s.height = lens.height_px;
  s.channel_of_phase = {0, 1, 1, 2};
  s.exposure_s = 0.1;
  s.variance_per_count = 1.0 / 6;
  const Eigen::Vector3d eye = inverse(pose).translation_mm;
  const Eigen::Matrix3d world_from_camera = pose.rotation.conjugate().toRotationMatrix();
  const auto is_hit = [&](double x, double y) {
    const Eigen::Vector3d d((x - lens.cx_px) / lens.fx_px, (y - lens.cy_px) / lens.fy_px, 1);
    return scene.first_hit(eye, world_from_camera * d).facet_idx >= 0;
  };
  std::normal_distribution<double> normal;
  for (int y = 0; y < s.height; ++y) {
    for (int x = 0; x < s.width; ++x) {
      int corners = 0;
      for (const double dx : {-0.5, 0.5}) {
        for (const double dy : {-0.5, 0.5}) corners += is_hit(x + dx, y + dy) ? 1 : 0;
      }
      double share = 0.25 * corners;
      if (corners != 0 && corners != 4) {
        share = 0;
        for (int i = 0; i < 64; ++i) {
          share +=
              is_hit(x + (i + 0.5) / 64 - 0.5, y + (19 * i % 64 + 0.5) / 64 - 0.5) ? 1.0 / 64 : 0.0;
        }
      }
      const double variance = 1.4 + share * counts / 6;
      s.signal_counts.push_back(
          static_cast<float>(share * counts + std::sqrt(variance) * normal(*random)));
      s.variance_counts2.push_back(
          static_cast<float>(1.4 + std::max(0.0F, s.signal_counts.back()) * s.variance_per_count));
      s.clipped.push_back(0);
    }
  }
  return s;
}

}  // namespace scattermeter::calib
