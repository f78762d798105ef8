#include "calib/pose/limb_blur.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <oneapi/tbb/parallel_for.h>

#include "calib/pose/blur_across.h"
#include "calib/pose/edge_shape.h"
#include "calib/pose/edge_strip.h"
#include "calib/pose/outline_contour.h"
#include "core/camera/lens.h"
#include "core/material/fresnel.h"
#include "core/mesh/surface_normals.h"

namespace scattermeter::calib {
namespace {

constexpr double kStep_px = 0.25;
constexpr double kDeep_px = 12.0;

EdgeStripOptions strip_options() {
  EdgeStripOptions strip;
  strip.half_length_px = 3.0;
  strip.half_width_px = 8.0;
  strip.search_px = 4.0;
  strip.max_blur_px = 6.0;
  return strip;
}

// Ft in steps from the contour inwards.
class Limb {
 public:
  Limb(const EdgeShot& shot, const CameraIntrinsics& intrinsics, const Rigid3d& camera_from_world,
       double eta)
      : scene_(*shot.scene),
        normals_(scene_.mesh()),
        lens_(intrinsics),
        pose_(camera_from_world),
        eye_mm_(inverse(camera_from_world).translation_mm),
        eta_(eta) {}

  std::vector<double> at(const ContourPoint& point) const {
    std::vector<double> out;
    for (double depth = 0.5 * kStep_px; depth < kDeep_px; depth += kStep_px) {
      const Eigen::Vector3d along =
          pose_.rotation.conjugate() *
          lens_.unproject(point.at_px - depth * point.outward).homogeneous();
      const RayHit hit = scene_.first_hit(eye_mm_, along);
      out.push_back(hit.facet_idx < 0 ? 0.0 : fresnel_transmittance(eta_, cosine(hit, along)));
    }
    return out;
  }

 private:
  double cosine(const RayHit& hit, const Eigen::Vector3d& along) const {
    const Eigen::Vector3d at_mm = eye_mm_ + hit.distance * along;
    return std::max(0.0, -normals_.at(hit.facet_idx, at_mm).dot(along.normalized()));
  }

  const RayScene& scene_;
  SurfaceNormals normals_;
  Lens lens_;
  Rigid3d pose_;
  Eigen::Vector3d eye_mm_;
  double eta_;
};

// The mean of those that are not empty; empty: there is none.
std::vector<double> mean_of(const std::vector<std::vector<double>>& limbs) {
  std::vector<double> mean;
  std::size_t n = 0;
  for (const std::vector<double>& own : limbs) {
    if (own.empty()) continue;
    mean.resize(own.size());
    for (std::size_t k = 0; k < own.size(); ++k) mean[k] += own[k];
    ++n;
  }
  for (double& share : mean) share /= static_cast<double>(n);
  return mean;
}

// What locate_edge() takes a limb for.
class SeenBlur {
 public:
  // like: with its photon noise.
  SeenBlur(const std::vector<double>& limb, const CfaSamples& like) {
    for (std::size_t k = 0; k < kBlurs_px.size(); ++k) {
      const double seen_px = of(limb, kBlurs_px[k], like);
      seen_px2_[k] = std::max(seen_px * seen_px, k > 0 ? seen_px2_[k - 1] + kLeast_px2 : 0.0);
    }
  }

  // The square of the true blur; at most that of the widest.
  double true_px2(double seen_px) const {
    const double px2 = seen_px * seen_px;
    const auto above = std::upper_bound(seen_px2_.begin(), seen_px2_.end(), px2);
    const auto k = static_cast<std::size_t>(above - seen_px2_.begin());
    if (k == 0) return 0.0;
    if (k == kBlurs_px.size()) return kBlurs_px.back() * kBlurs_px.back();
    const double share = (px2 - seen_px2_[k - 1]) / (seen_px2_[k] - seen_px2_[k - 1]);
    return std::lerp(kBlurs_px[k - 1] * kBlurs_px[k - 1], kBlurs_px[k] * kBlurs_px[k], share);
  }

 private:
  static constexpr std::array<double, 6> kBlurs_px = {0.05, 0.5, 1.0, 1.5, 2.5, 5.0};
  static constexpr double kLeast_px2 = 1e-3;

  // Blurred by that much, across the columns of a picture.
  static double of(const std::vector<double>& limb, double blur_px, const CfaSamples& like) {
    constexpr int kHalf = 16;
    constexpr double kCounts = 1000.0;
    const Eigen::Vector2d outward(1.0, 0.0);
    const EdgeShape shape(outward, blur_px);
    std::vector<float> row;
    for (int inwards = kHalf; inwards >= -kHalf; --inwards) {
      double share = 0.0, before = 0.0;
      for (std::size_t k = 0; k < limb.size(); ++k) {
        share += (limb[k] - before) * shape.at(inwards - kStep_px * static_cast<double>(k)).s[0];
        before = limb[k];
      }
      row.push_back(static_cast<float>(kCounts * share));
    }
    CfaSamples s;
    s.width = s.height = 2 * kHalf + 1;
    s.variance_per_count = like.variance_per_count;
    for (int y = 0; y < s.height; ++y) {
      s.signal_counts.insert(s.signal_counts.end(), row.begin(), row.end());
    }
    for (const float counts : s.signal_counts) {
      s.variance_counts2.push_back(1.0F + static_cast<float>(s.variance_per_count) * counts);
    }
    s.clipped.assign(s.signal_counts.size(), 0);
    return locate_edge(s, Eigen::Vector2d::Constant(kHalf), outward, strip_options()).blur_px;
  }

  std::array<double, kBlurs_px.size()> seen_px2_{};
};

}  // namespace

std::optional<Eigen::Matrix2d> limb_blur_px2(const EdgeShot& shot,
                                             const CameraIntrinsics& intrinsics,
                                             const Rigid3d& camera_from_world,
                                             double eta_int_over_ext) {
  constexpr int kCell_px = 8;
  constexpr std::size_t kMostPieces = 48;
  const std::vector<ContourPoint> points =
      contour_points(*shot.scene, intrinsics, camera_from_world, kCell_px);
  const std::size_t stride = 1 + points.size() / kMostPieces;
  std::vector<EdgeStrip> found((points.size() + stride - 1) / stride);
  std::vector<std::vector<double>> limbs(found.size());
  const Limb limb(shot, intrinsics, camera_from_world, eta_int_over_ext);
  tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t i) {
    const ContourPoint& p = points[i * stride];
    found[i] = locate_edge(shot.samples, p.at_px, p.outward, strip_options());
    if (found[i].found) limbs[i] = limb.at(p);
  });
  std::vector<BlurAcross> blurs;
  const SeenBlur seen(mean_of(limbs), shot.samples);
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (found[i].found) {
      blurs.push_back({points[i * stride].outward, seen.true_px2(found[i].blur_px)});
    }
  }
  return point_spread_px2(blurs);
}

}  // namespace scattermeter::calib
