#include "apps/simulation/sphere_painter.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>

#include <oneapi/tbb/parallel_for.h>

#include "calib/led/highlight.h"
#include "core/camera/camera_model.h"

namespace scattermeter::apps {
namespace {

constexpr double kBlur_px = 0.7;
constexpr std::size_t kFineSide = 8;  // sub-samples per side of a pixel around a highlight

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

// The fine picture, n x n sub-samples, blurred and reduced to n / kFineSide pixels a side.
std::vector<double> blurred_highlight(const std::vector<double>& fine, std::size_t n) {
  const std::size_t size = n / kFineSide;
  // Share of a sub-sample's light that falls on a pixel d pixels away.
  const auto share = [](double d) {
    const auto below = [](double t) { return 0.5 * std::erfc(-t / (kBlur_px * M_SQRT2)); };
    return (below(d + 0.5) - below(d - 0.5)) / kFineSide;
  };
  std::vector<double> shares(size * n), rows(size * n), out(size * size);
  for (std::size_t p = 0; p < size; ++p) {
    for (std::size_t i = 0; i < n; ++i) {
      shares[p * n + i] =
          share((static_cast<double>(i) + 0.5) / kFineSide - 0.5 - static_cast<double>(p));
    }
  }
  const auto weighted_sum = [&](std::size_t pixel, const double* line) {
    double sum = 0.0;
    for (std::size_t i = 0; i < n; ++i) sum += shares[pixel * n + i] * line[i];
    return sum;
  };
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t p = 0; p < size; ++p) rows[p * n + j] = weighted_sum(p, &fine[j * n]);
  }
  for (std::size_t q = 0; q < size; ++q) {
    for (std::size_t p = 0; p < size; ++p) out[q * size + p] = weighted_sum(q, &rows[p * n]);
  }
  return out;
}

class SpherePainter {
 public:
  SpherePainter(const std::vector<calib::MirrorSphere>& spheres, const Led& led,
                RadianceCanvas& canvas)
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

  // Adds the mirrored LED: on a fine grid around its image, then blurred by the lens.
  void add_highlight(std::size_t sphere, const CameraView& view) {
    const CameraIntrinsics& k = view.intrinsics;
    const auto middle = calib::mirror_point_mm(spheres_[sphere], canvas_.eye_mm, led_.position_mm);
    if (!middle) return;
    const Eigen::Vector2d at = project(k, view.camera_from_world, {*middle}).front();
    if (!at.allFinite()) return;
    // The image reaches at most as far as that of the disc in a flat mirror.
    const double px_per_mm = k.fx_px / (view.camera_from_world * *middle).z();
    const double r = spheres_[sphere].radius_mm;
    const double shrink = r / (2.0 * (led_.position_mm - *middle).norm());
    const int half = static_cast<int>(std::ceil(3.0 * shrink * led_.radius_mm * px_per_mm)) + 6;
    const int x0 = static_cast<int>(std::lround(at.x())) - half;
    const int y0 = static_cast<int>(std::lround(at.y())) - half;
    const auto size = static_cast<std::size_t>(2 * half + 1);
    const std::size_t n = size * kFineSide;
    std::vector<double> fine(n * n, 0.0);
    tbb::parallel_for(std::size_t{0}, n, [&](std::size_t j) {
      const double y = y0 - 0.5 + (static_cast<double>(j) + 0.5) / kFineSide;
      for (std::size_t i = 0; i < n; ++i) {
        const double x = x0 - 0.5 + (static_cast<double>(i) + 0.5) / kFineSide;
        fine[j * n + i] = mirrored(sphere, canvas_.ray(x, y));
      }
    });
    const std::vector<double> picture = blurred_highlight(fine, n);
    for (std::size_t i = 0; i < picture.size(); ++i) {
      const int x = x0 + static_cast<int>(i % size);
      const int y = y0 + static_cast<int>(i / size);
      if (x < 0 || y < 0 || x >= k.width_px || y >= k.height_px) continue;
      canvas_.at(x, y) +=
          static_cast<float>(picture[i] * led_.intensity_W_per_sr[canvas_.channel(x, y)]);
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
    // The disc emits to the side that its axis points to; the ray must come from there.
    const double facing = -led_.axis.dot(out);
    if (!(facing > 1e-6)) return 0.0;
    const double t = -led_.axis.dot(led_.position_mm - hit->point) / facing;
    if (!(t > 0.0)) return 0.0;
    if ((hit->point + t * out - led_.position_mm).norm() > led_.radius_mm) return 0.0;
    if (!reaches_led(*hit)) return 0.0;
    // Radiance of a uniform disc: intensity over projected area.
    const double area = std::numbers::pi * led_.radius_mm * led_.radius_mm;
    return kMirrorReflectance * led_.lobe(-out) / (area * facing);
  }

  const std::vector<calib::MirrorSphere>& spheres_;
  Led led_;
  RadianceCanvas& canvas_;
};

}  // namespace

void paint_spheres(const std::vector<calib::MirrorSphere>& spheres, const Led& led,
                   const CameraView& view, RadianceCanvas& canvas) {
  SpherePainter painter(spheres, led, canvas);
  for (const calib::MirrorSphere& sphere : spheres) {
    painter.paint_base(calib::sphere_image(view.intrinsics, view.camera_from_world, sphere));
  }
  for (std::size_t i = 0; i < spheres.size(); ++i) painter.add_highlight(i, view);
}

}  // namespace scattermeter::apps
