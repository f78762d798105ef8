#include "calib/pose/outline_contour.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "core/camera/lens.h"

namespace scattermeter::calib {
namespace {

constexpr int kAround = 4;      // cells to each side from which the contour's direction is taken
constexpr int kHalvings = 6;    // of 1.5 cells
constexpr double kReach = 1.5;  // cells from a cell of the body to its contour
// Share of the cells around a point of a smooth contour that are the body's; fewer or more: a
// corner.
constexpr double kLeastInside = 0.42, kMostInside = 0.66;
constexpr int kMostCells = 4096;  // in each direction

// The body's image on cells, with a border of kAround + 1 cells.
struct Mask {
  int x0 = 0, y0 = 0, width = 0, height = 0;  // cells
  std::vector<std::uint8_t> body;
  bool at(int x, int y) const {
    return body[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                static_cast<std::size_t>(x)] != 0;
  }
};

class ContourFinder {
 public:
  ContourFinder(const RayScene& scene, const CameraIntrinsics& intrinsics,
                const Rigid3d& camera_from_world, int cell_px)
      : scene_(scene),
        lens_(intrinsics),
        pose_(camera_from_world),
        eye_mm_(inverse(camera_from_world).translation_mm),
        cell_px_(cell_px) {
    find_mask(intrinsics);
  }

  std::vector<ContourPoint> points() const {
    std::vector<ContourPoint> out;
    for (int y = kAround; y + kAround < mask_.height; ++y) {
      for (int x = kAround; x + kAround < mask_.width; ++x) {
        if (!mask_.at(x, y)) continue;
        if (mask_.at(x - 1, y) && mask_.at(x + 1, y) && mask_.at(x, y - 1) && mask_.at(x, y + 1)) {
          continue;
        }
        const std::optional<Eigen::Vector2d> outward = outward_at(x, y);
        if (!outward) continue;
        if (const auto point = point_at(x, y, *outward)) out.push_back(*point);
      }
    }
    return out;
  }

 private:
  Eigen::Vector2d px_of(double x, double y) const {
    return cell_px_ * (Eigen::Vector2d(mask_.x0 + x, mask_.y0 + y).array() + 0.5) - 0.5;
  }
  Eigen::Vector3d direction(const Eigen::Vector2d& px) const {
    return pose_.rotation.conjugate() * lens_.unproject(px).homogeneous();
  }

  void find_mask(const CameraIntrinsics& intrinsics) {
    double x0 = 1e30, y0 = 1e30, x1 = -1e30, y1 = -1e30;
    for (const Eigen::Vector2d& p : project(intrinsics, pose_, scene_.mesh().vertices_mm)) {
      if (!p.allFinite()) return;
      x0 = std::min(x0, p.x());
      y0 = std::min(y0, p.y());
      x1 = std::max(x1, p.x());
      y1 = std::max(y1, p.y());
    }
    mask_.x0 = static_cast<int>(std::floor(x0 / cell_px_)) - kAround - 1;
    mask_.y0 = static_cast<int>(std::floor(y0 / cell_px_)) - kAround - 1;
    const double width = std::ceil(x1 / cell_px_) + kAround + 2 - mask_.x0;
    const double height = std::ceil(y1 / cell_px_) + kAround + 2 - mask_.y0;
    if (!(width < kMostCells) || !(height < kMostCells)) return;
    mask_.width = static_cast<int>(width);
    mask_.height = static_cast<int>(height);
    std::vector<Eigen::Vector3f> rays;
    for (int y = 0; y < mask_.height; ++y) {
      for (int x = 0; x < mask_.width; ++x) {
        rays.emplace_back(direction(px_of(x, y)).cast<float>());
      }
    }
    std::vector<RayHit> hits(rays.size());
    scene_.first_hits(eye_mm_, rays, hits);
    for (const RayHit& hit : hits) mask_.body.push_back(hit.facet_idx >= 0 ? 1 : 0);
  }

  // None at a corner.
  std::optional<Eigen::Vector2d> outward_at(int x, int y) const {
    Eigen::Vector2d away = Eigen::Vector2d::Zero();
    double inside = 0;
    double all = 0;
    for (int j = -kAround; j <= kAround; ++j) {
      for (int i = -kAround; i <= kAround; ++i) {
        if (i * i + j * j > kAround * kAround) continue;
        const bool body = mask_.at(x + i, y + j);
        away += (body ? -1.0 : 1.0) * Eigen::Vector2d(i, j);
        inside += body ? 1.0 : 0.0;
        all += 1.0;
      }
    }
    const double share = inside / all;
    if (share < kLeastInside || share > kMostInside || !(away.norm() > 0)) return std::nullopt;
    return away.normalized();
  }

  std::optional<ContourPoint> point_at(int x, int y, const Eigen::Vector2d& outward) const {
    const Eigen::Vector2d center = px_of(x, y);
    const auto hit_at = [&](double cells) {
      const Eigen::Vector3d along = direction(center + cell_px_ * cells * outward);
      const RayHit hit = scene_.first_hit(eye_mm_, along);
      return hit.facet_idx < 0 ? std::optional<Eigen::Vector3d>()
                               : std::optional<Eigen::Vector3d>(eye_mm_ + hit.distance * along);
    };
    double low = 0;
    double high = kReach;
    std::optional<Eigen::Vector3d> on = hit_at(low);
    if (!on || hit_at(high)) return std::nullopt;
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = 0.5 * (low + high);
      const auto hit = hit_at(middle);
      (hit ? low : high) = middle;
      if (hit) on = hit;
    }
    return ContourPoint{*on, center + cell_px_ * low * outward, outward};
  }

  const RayScene& scene_;
  Lens lens_;
  Rigid3d pose_;
  Eigen::Vector3d eye_mm_;
  int cell_px_;
  Mask mask_;
};

}  // namespace

std::vector<ContourPoint> contour_points(const RayScene& scene, const CameraIntrinsics& intrinsics,
                                         const Rigid3d& camera_from_world, int cell_px) {
  return ContourFinder(scene, intrinsics, camera_from_world, cell_px).points();
}

}  // namespace scattermeter::calib
