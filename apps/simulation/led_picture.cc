#include "apps/simulation/led_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include <oneapi/tbb/parallel_for.h>

#include "apps/simulation/board_picture.h"
#include "apps/simulation/radiance_canvas.h"
#include "apps/simulation/sphere_painter.h"
#include "calib/led/plane_cells.h"
#include "core/camera/cfa_samples.h"
#include "core/mesh/ray_scene.h"

namespace scattermeter::apps {
namespace {

constexpr int kBorder = 5;  // sub-samples per side of a pixel at the plane's border
constexpr int kRings = 4;   // of an LED's disc, of equal area
constexpr int kSpokes = 16;

// Points all over the LED's disc, each for an equal share of its area.
std::vector<Eigen::Vector3d> disc_points_mm(const Led& led) {
  if (!(led.radius_mm > 0.0)) return {led.position_mm};
  const Eigen::Vector3d u = led.axis.unitOrthogonal();
  const Eigen::Vector3d v = led.axis.cross(u);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < kRings; ++i) {
    const double r = led.radius_mm * std::sqrt((i + 0.5) / kRings);
    for (int k = 0; k < kSpokes; ++k) {
      const double t = 2.0 * std::numbers::pi * (k + 0.5 * (i % 2)) / kSpokes;
      points.push_back(led.position_mm + r * (std::cos(t) * u + std::sin(t) * v));
    }
  }
  return points;
}

double irradiance_per_mm2(const Led& led, const std::vector<Eigen::Vector3d>& points,
                          const Eigen::Vector3d& point, const Eigen::Vector3d& normal) {
  double sum = 0.0;
  Led part = led;
  for (const Eigen::Vector3d& p : points) {
    part.position_mm = p;
    sum += part.transmitted_irradiance_per_mm2(point, normal, 1.0);
  }
  return sum / static_cast<double>(points.size());
}

void paint_plane(const CameraIntrinsics& k, const Rigid3d& pose, const calib::WhitePlane& plane,
                 const std::vector<Led>& lit, const Eigen::Array3d& ambient,
                 RadianceCanvas& canvas) {
  const calib::PlaneImage image = calib::plane_image(k, pose, plane);
  std::vector<std::vector<Eigen::Vector3d>> points;
  for (const Led& led : lit) points.push_back(disc_points_mm(led));
  const Eigen::Vector3d normal = plane.normal();
  const auto on_plane = [&](const std::optional<Eigen::Vector2d>& p) {
    return p && p->x() >= 0.0 && p->y() >= 0.0 && p->x() <= plane.width_mm &&
           p->y() <= plane.height_mm;
  };
  tbb::parallel_for(image.y0, image.y0 + image.height, [&](int y) {
    for (int x = image.x0; x < image.x0 + image.width; ++x) {
      const auto middle = plane.meet_mm(canvas.eye_mm, canvas.ray(x, y));
      if (!middle) continue;
      const double edge = std::min(
          {middle->x(), middle->y(), plane.width_mm - middle->x(), plane.height_mm - middle->y()});
      double share = edge > 0.0 ? 1.0 : 0.0;
      if (std::abs(edge) < 2.0 * image.mm_per_px) {
        int inside = 0;
        for (int i = 0; i < kBorder * kBorder; ++i) {
          const double dx = (i % kBorder + 0.5) / kBorder - 0.5;
          const double dy = (i / kBorder + 0.5) / kBorder - 0.5;
          inside += on_plane(plane.meet_mm(canvas.eye_mm, canvas.ray(x + dx, y + dy))) ? 1 : 0;
        }
        share = static_cast<double>(inside) / (kBorder * kBorder);
      }
      if (share == 0.0) continue;
      const Eigen::Vector3d point =
          plane.origin_mm + middle->x() * plane.x_axis + middle->y() * plane.y_axis;
      const int c = canvas.channel(x, y);
      double irradiance = ambient[c];
      for (std::size_t i = 0; i < lit.size(); ++i) {
        irradiance +=
            lit[i].intensity_W_per_sr[c] * irradiance_per_mm2(lit[i], points[i], point, normal);
      }
      const double radiance = plane.albedo[c] / std::numbers::pi * irradiance;
      canvas.at(x, y) = static_cast<float>(share * radiance + (1.0 - share) * canvas.at(x, y));
    }
  });
}

// A triangle far behind the camera, which hides nothing of the board.
TriangleMesh far_away(const Eigen::Vector3d& eye_mm) {
  TriangleMesh mesh;
  const Eigen::Vector3d far = eye_mm + Eigen::Vector3d(0.0, 0.0, 1e7);
  mesh.vertices_mm = {far, far + Eigen::Vector3d::UnitX(), far + Eigen::Vector3d::UnitY()};
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

}  // namespace

std::vector<float> led_picture(const Rig& rig, const calib::LedCalibrationShot& shot,
                               const CameraView& view) {
  const calib::LedCalibrationShots& calibration = *rig.calibration.led;
  std::vector<Led> lit;
  if (shot.kind != calib::LedShotKind::kAmbient) lit = {rig.scene.light(shot.light).led()->led};
  RadianceCanvas canvas(rig.scene.camera.sensor.cfa, view);
  if (rig.pose.charuco) {
    const RayScene nothing(far_away(canvas.eye_mm));
    add_board(view, *rig.pose.charuco, lit, rig.truth.ambient_irradiance_W_per_mm2, nothing,
              rig.scene.camera.sensor.cfa, canvas.pixels);
  }
  if (shot.kind != calib::LedShotKind::kSpheres) {
    paint_plane(view.intrinsics, view.camera_from_world, calibration.planes.at(shot.plane), lit,
                rig.truth.ambient_irradiance_W_per_mm2, canvas);
    return std::move(canvas.pixels);
  }
  paint_spheres(calibration.spheres, lit.front(), view, canvas);
  return std::move(canvas.pixels);
}

}  // namespace scattermeter::apps
