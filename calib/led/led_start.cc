#include "calib/led/led_start.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "core/base/dense_solve.h"

namespace scattermeter::calib {
namespace {

struct MirroredRay {
  Eigen::Vector3d from_mm, direction;
};

// The camera ray through the highlight after reflection by the sphere.
std::optional<MirroredRay> mirrored_ray(const LedScene& scene, const Lens& lens,
                                        const SeenHighlight& h) {
  const Rigid3d world_from_camera = inverse(scene.views[h.view].camera_from_world);
  const Eigen::Vector2d xy = lens.unproject(h.image_px);
  if (!xy.allFinite()) return std::nullopt;
  const Eigen::Vector3d d = (world_from_camera.rotation * xy.homogeneous()).normalized();
  const MirrorSphere& sphere = scene.spheres[h.sphere];
  const auto p = first_point_mm(sphere, world_from_camera.translation_mm, d);
  if (!p) return std::nullopt;
  const Eigen::Vector3d n = (*p - sphere.center_mm) / sphere.radius_mm;
  return MirroredRay{*p, d - 2.0 * d.dot(n) * n};
}

// The point nearest to all rays: least squares of the distances over the lengths of the rays.
std::optional<Eigen::Vector3d> meeting_point(const std::vector<std::optional<MirroredRay>>& rays,
                                             const std::vector<bool>& use) {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  for (int round = 0; round < 4; ++round) {
    Eigen::Matrix3d a = Eigen::Matrix3d::Zero();
    Eigen::Vector3d b = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < rays.size(); ++i) {
      if (!use[i]) continue;
      const double range = round == 0 ? 1.0 : std::max(1e-3, (point - rays[i]->from_mm).norm());
      const Eigen::Matrix3d across =
          (Eigen::Matrix3d::Identity() - rays[i]->direction * rays[i]->direction.transpose()) /
          (range * range);
      a += across;
      b += across * rays[i]->from_mm;
    }
    point = SymmetricSolver(a).solve(b);
    if (!point.allFinite()) return std::nullopt;
  }
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (use[i] && (point - rays[i]->from_mm).dot(rays[i]->direction) <= 0.0) return std::nullopt;
  }
  return point;
}

}  // namespace

Eigen::Vector2d highlight_px(const Lens& lens, const Rigid3d& camera_from_world,
                             const MirrorSphere& sphere, const Led& led) {
  const Eigen::Vector3d eye = inverse(camera_from_world).translation_mm;
  const auto image = [&](const Eigen::Vector3d& light) -> Eigen::Vector2d {
    const auto p = mirror_point_mm(sphere, eye, light);
    if (!p) return Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
    return lens.project(camera_from_world * *p);
  };
  if (!(led.radius_mm > 0.0)) return image(led.position_mm);
  const Eigen::Vector3d u = led.radius_mm * M_SQRT1_2 * led.axis.unitOrthogonal();
  const Eigen::Vector3d v = led.axis.cross(u);
  return 0.25 * (image(led.position_mm + u) + image(led.position_mm - u) +
                 image(led.position_mm + v) + image(led.position_mm - v));
}

std::optional<LedStart> led_start(const LedScene& scene, double inlier_px) {
  const Lens lens(scene.intrinsics);
  const std::size_t n = scene.highlights.size();
  std::vector<std::optional<MirroredRay>> rays;
  for (const SeenHighlight& h : scene.highlights) rays.push_back(mirrored_ray(scene, lens, h));
  const auto agreement = [&](const Eigen::Vector3d& position, std::vector<bool>& agrees) {
    Led led;
    led.position_mm = position;
    double sum = 0.0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const SeenHighlight& h = scene.highlights[i];
      const Eigen::Vector2d p =
          highlight_px(lens, scene.views[h.view].camera_from_world, scene.spheres[h.sphere], led);
      const double off = (p - h.image_px).norm();
      agrees[i] = rays[i] && off <= std::max(inlier_px, 5.0 * h.std_px);
      if (agrees[i]) {
        ++count;
        sum += off * off;
      }
    }
    return std::pair(count, -sum);
  };
  std::optional<LedStart> best;
  std::pair<std::size_t, double> best_score{0, 0.0};
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      if (!rays[i] || !rays[j]) continue;
      std::vector<bool> pair(n, false);
      pair[i] = pair[j] = true;
      const auto point = meeting_point(rays, pair);
      if (!point) continue;
      std::vector<bool> agrees(n);
      const auto score = agreement(*point, agrees);
      if (score.first < 2 || score <= best_score) continue;
      best_score = score;
      best = LedStart{*point, agrees};
    }
  }
  if (!best) return std::nullopt;
  if (const auto point = meeting_point(rays, best->agrees)) best->position_mm = *point;
  return best;
}

}  // namespace scattermeter::calib
