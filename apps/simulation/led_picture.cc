#include "apps/simulation/led_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include <oneapi/tbb/parallel_for.h>

#include "apps/simulation/board_picture.h"
#include "calib/led/highlight.h"
#include "calib/led/plane_cells.h"
#include "core/camera/cfa_samples.h"
#include "core/camera/lens.h"
#include "core/mesh/ray_scene.h"

namespace scattermeter::apps {
namespace {

constexpr double kBlurPx = 0.7;
constexpr int kFineSide = 8;  // sub-samples of a pixel and side, around a highlight
constexpr int kBorder = 5;    // sub-samples of a pixel and side, at an edge
constexpr int kRings = 4;     // of an LED's disc: parts of equal area
constexpr int kSpokes = 16;

// Places all over a disc about the axis: equal shares of its area.
std::vector<Eigen::Vector3d> disc_places_mm(const Led& led) {
  if (!(led.radius_mm > 0.0)) return {led.position_mm};
  const Eigen::Vector3d u = led.axis.unitOrthogonal();
  const Eigen::Vector3d v = led.axis.cross(u);
  std::vector<Eigen::Vector3d> places;
  for (int i = 0; i < kRings; ++i) {
    const double r = led.radius_mm * std::sqrt((i + 0.5) / kRings);
    for (int k = 0; k < kSpokes; ++k) {
      const double t = 2.0 * std::numbers::pi * (k + 0.5 * (i % 2)) / kSpokes;
      places.push_back(led.position_mm + r * (std::cos(t) * u + std::sin(t) * v));
    }
  }
  return places;
}

double irradiance_per_mm2(const Led& led, const std::vector<Eigen::Vector3d>& places,
                          const Eigen::Vector3d& point, const Eigen::Vector3d& normal) {
  double sum = 0.0;
  Led part = led;
  for (const Eigen::Vector3d& p : places) {
    part.position_mm = p;
    sum += part.transmitted_irradiance_per_mm2(point, normal, 1.0);
  }
  return sum / static_cast<double>(places.size());
}

// A frame under way.
class Canvas {
 public:
  Canvas(const Rig& rig, const CameraView& view)
      : rig_(rig),
        lens_(view.intrinsics),
        world_from_camera_(view.camera_from_world.rotation.conjugate()),
        eye_mm(view.center_in_world_mm()) {
    pixels.assign(static_cast<std::size_t>(view.intrinsics.width_px) *
                      static_cast<std::size_t>(view.intrinsics.height_px),
                  0.0F);
  }
  int channel(int x, int y) const {
    return static_cast<int>(rig_.scene.camera.sensor.cfa.at(x, y));
  }
  float& at(int x, int y) {
    return pixels[static_cast<std::size_t>(y) *
                      static_cast<std::size_t>(rig_.scene.camera.intrinsics.width_px) +
                  static_cast<std::size_t>(x)];
  }
  // Into the scene through a place of the frame.
  Eigen::Vector3d ray(double x, double y) const {
    return world_from_camera_ * lens_.unproject({x, y}).homogeneous();
  }

 private:
  const Rig& rig_;
  Lens lens_;
  Eigen::Quaterniond world_from_camera_;

 public:
  Eigen::Vector3d eye_mm;
  std::vector<float> pixels;
};

void paint_plane(const CameraIntrinsics& k, const Rigid3d& pose, const calib::WhitePlane& plane,
                 const std::vector<Led>& lit, const Eigen::Array3d& ambient, Canvas& canvas) {
  const calib::PlaneImage image = calib::plane_image(k, pose, plane);
  std::vector<std::vector<Eigen::Vector3d>> places;
  for (const Led& led : lit) places.push_back(disc_places_mm(led));
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
            lit[i].intensity_W_per_sr[c] * irradiance_per_mm2(lit[i], places[i], point, normal);
      }
      const double radiance = plane.albedo[c] / std::numbers::pi * irradiance;
      canvas.at(x, y) = static_cast<float>(share * radiance + (1.0 - share) * canvas.at(x, y));
    }
  });
}

// The first sphere that a ray meets.
struct SphereHit {
  std::size_t sphere;
  Eigen::Vector3d point;
};
std::optional<SphereHit> first_sphere(const std::vector<calib::MirrorSphere>& spheres,
                                      const Eigen::Vector3d& from, const Eigen::Vector3d& ray,
                                      std::size_t but) {
  std::optional<SphereHit> hit;
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    if (i == but) continue;
    const auto p = calib::first_point_mm(spheres[i], from, ray);
    if (!p || (hit && (*p - from).norm() >= (hit->point - from).norm())) continue;
    hit = SphereHit{i, *p};
  }
  return hit;
}

class SpherePainter {
 public:
  SpherePainter(const std::vector<calib::MirrorSphere>& spheres, const Led& led, Canvas& canvas)
      : spheres_(spheres), led_(led), canvas_(canvas) {
    if (!(led_.radius_mm > 0.0)) led_.radius_mm = kChipRadius_mm;
  }

  void paint_base(const calib::SphereImage& image) {
    for (int y = image.y0; y < image.y0 + image.height; ++y) {
      for (int x = image.x0; x < image.x0 + image.width; ++x) {
        double sum = 0.0;
        double share = 0.0;
        for (int i = 0; i < 4; ++i) {
          const auto hit = first_sphere(
              spheres_, canvas_.eye_mm,
              canvas_.ray(x + 0.5 * (i % 2) - 0.25, y + 0.5 * (i / 2) - 0.25), spheres_.size());
          if (!hit) continue;
          share += 0.25;
          const Eigen::Vector3d normal =
              (hit->point - spheres_[hit->sphere].center_mm).normalized();
          if (!reaches_led(*hit)) continue;
          sum += 0.25 * led_.transmitted_irradiance_per_mm2(hit->point, normal, 1.0);
        }
        if (share == 0.0) continue;
        const int c = canvas_.channel(x, y);
        const double base = kMirrorBaseAlbedo / std::numbers::pi * led_.intensity_W_per_sr[c] * sum;
        canvas_.at(x, y) = static_cast<float>(base + (1.0 - share) * canvas_.at(x, y));
      }
    }
  }

  // Adds the mirrored LED: on a fine grid about its place, then through the lens's blur.
  void add_highlight(std::size_t sphere, const CameraIntrinsics& k, const Rigid3d& pose) {
    const auto middle = calib::mirror_point_mm(spheres_[sphere], canvas_.eye_mm, led_.position_mm);
    if (!middle) return;
    const Eigen::Vector2d at = project(k, pose, {*middle}).front();
    if (!at.allFinite()) return;
    // How far it may reach: the disc as a flat mirror would show it, at most.
    const double reach_mm = led_.radius_mm;
    const double px_per_mm = k.fx_px / (pose * *middle).z();
    const double r = spheres_[sphere].radius_mm;
    const double shrink = r / (2.0 * (led_.position_mm - *middle).norm());
    const int half = static_cast<int>(std::ceil(3.0 * shrink * reach_mm * px_per_mm)) + 6;
    const int x0 = static_cast<int>(std::lround(at.x())) - half;
    const int y0 = static_cast<int>(std::lround(at.y())) - half;
    const int size = 2 * half + 1;
    const int n = size * kFineSide;
    std::vector<double> fine(static_cast<std::size_t>(n) * static_cast<std::size_t>(n), 0.0);
    tbb::parallel_for(0, n, [&](int j) {
      for (int i = 0; i < n; ++i) {
        fine[static_cast<std::size_t>(j) * static_cast<std::size_t>(n) +
             static_cast<std::size_t>(i)] =
            mirrored(sphere, canvas_.ray(x0 - 0.5 + (i + 0.5) / kFineSide,
                                         y0 - 0.5 + (j + 0.5) / kFineSide));
      }
    });
    // Share of a fine sample's light that falls on a pixel d pixels away.
    const auto share = [](double d) {
      const auto below = [](double t) { return 0.5 * std::erfc(-t / (kBlurPx * M_SQRT2)); };
      return (below(d + 0.5) - below(d - 0.5)) / kFineSide;
    };
    std::vector<double> rows(static_cast<std::size_t>(size) * static_cast<std::size_t>(n), 0.0);
    std::vector<double> shares(static_cast<std::size_t>(size) * static_cast<std::size_t>(n));
    for (int p = 0; p < size; ++p) {
      for (int i = 0; i < n; ++i) {
        shares[static_cast<std::size_t>(p) * static_cast<std::size_t>(n) +
               static_cast<std::size_t>(i)] = share((i + 0.5) / kFineSide - 0.5 - p);
      }
    }
    for (std::size_t j = 0; j < static_cast<std::size_t>(n); ++j) {
      for (std::size_t p = 0; p < static_cast<std::size_t>(size); ++p) {
        double sum = 0.0;
        for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i) {
          sum += shares[p * static_cast<std::size_t>(n) + i] *
                 fine[j * static_cast<std::size_t>(n) + i];
        }
        rows[p * static_cast<std::size_t>(n) + j] = sum;
      }
    }
    for (int q = 0; q < size; ++q) {
      for (int p = 0; p < size; ++p) {
        const int x = x0 + p;
        const int y = y0 + q;
        if (x < 0 || y < 0 || x >= k.width_px || y >= k.height_px) continue;
        double sum = 0.0;
        for (std::size_t j = 0; j < static_cast<std::size_t>(n); ++j) {
          sum += shares[static_cast<std::size_t>(q) * static_cast<std::size_t>(n) + j] *
                 rows[static_cast<std::size_t>(p) * static_cast<std::size_t>(n) + j];
        }
        canvas_.at(x, y) +=
            static_cast<float>(sum * led_.intensity_W_per_sr[canvas_.channel(x, y)]);
      }
    }
  }

 private:
  bool reaches_led(const SphereHit& hit) const {
    const auto other = first_sphere(spheres_, hit.point, led_.position_mm - hit.point, hit.sphere);
    return !other || (other->point - hit.point).norm() > (led_.position_mm - hit.point).norm();
  }

  // Radiance per W/sr that a ray of the camera finds in a sphere.
  double mirrored(std::size_t sphere, const Eigen::Vector3d& ray) const {
    const auto hit = first_sphere(spheres_, canvas_.eye_mm, ray, spheres_.size());
    if (!hit || hit->sphere != sphere) return 0.0;
    const Eigen::Vector3d n = (hit->point - spheres_[sphere].center_mm).normalized();
    const Eigen::Vector3d d = ray.normalized();
    const Eigen::Vector3d out = d - 2.0 * d.dot(n) * n;
    // The disc shines along its axis, and is met from there.
    const double facing = -led_.axis.dot(out);
    if (!(facing > 1e-6)) return 0.0;
    const double t = -led_.axis.dot(led_.position_mm - hit->point) / facing;
    if (!(t > 0.0)) return 0.0;
    if ((hit->point + t * out - led_.position_mm).norm() > led_.radius_mm) return 0.0;
    if (!reaches_led(*hit)) return 0.0;
    // Radiance of a disc of even radiance: intensity over its area as seen.
    const double area = std::numbers::pi * led_.radius_mm * led_.radius_mm;
    return kMirrorReflectance * led_.lobe(-out) / (area * facing);
  }

  const std::vector<calib::MirrorSphere>& spheres_;
  Led led_;
  Canvas& canvas_;
};

// Nothing to hide a board: far behind the camera.
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
  Canvas canvas(rig, view);
  if (rig.pose.charuco) {
    const RayScene nothing(far_away(canvas.eye_mm));
    std::array<int, 4> channel_of_phase{};
    for (std::size_t p = 0; p < 4; ++p) {
      channel_of_phase[p] = static_cast<int>(rig.scene.camera.sensor.cfa.phase[p]);
    }
    add_board(view, *rig.pose.charuco, lit, rig.truth.ambient_irradiance_W_per_mm2, nothing,
              channel_of_phase, canvas.pixels);
  }
  if (shot.kind != calib::LedShotKind::kSpheres) {
    paint_plane(view.intrinsics, view.camera_from_world, calibration.planes.at(shot.plane), lit,
                rig.truth.ambient_irradiance_W_per_mm2, canvas);
    return std::move(canvas.pixels);
  }
  SpherePainter painter(calibration.spheres, lit.front(), canvas);
  for (const calib::MirrorSphere& sphere : calibration.spheres) {
    painter.paint_base(calib::sphere_image(view.intrinsics, view.camera_from_world, sphere));
  }
  for (std::size_t i = 0; i < calibration.spheres.size(); ++i) {
    painter.add_highlight(i, view.intrinsics, view.camera_from_world);
  }
  return std::move(canvas.pixels);
}

}  // namespace scattermeter::apps
