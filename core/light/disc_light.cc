#include "core/light/disc_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include <Eigen/Geometry>

#include "core/light/visible_share.h"

namespace scattermeter {
namespace {

// Gauss-Legendre on [0, 1], eight points (Abramowitz and Stegun 25.4).
constexpr std::array<double, 8> kNode = {0.0198550717512319, 0.1016667612931866, 0.2372337950418355,
                                         0.4082826787521751, 0.5917173212478249, 0.7627662049581645,
                                         0.8983332387068134, 0.9801449282487681};
constexpr std::array<double, 8> kWeight = {
    0.0506142681451881, 0.1111905172266872, 0.1568533229389436, 0.1813418916891810,
    0.1813418916891810, 0.1568533229389436, 0.1111905172266872, 0.0506142681451881};
constexpr int kAngles = 32;

constexpr int kGrid = 128;  // parts of the unit square across, where the rule above does not hold
constexpr int kCells = 8;   // cells of level 0 across
constexpr int kRootLevel = 2;
constexpr int kLastLevel = -1;

}  // namespace

struct DiscEmitter {
  struct Cell {
    int level, x, y;
  };
  const DiscLight& disc;
  const Eigen::Vector3d& point_mm;
  const Eigen::Vector3d& normal;
  std::size_t& rays;

  // By the middle of cells of level 0 and below; relative to the whole disc.
  Eigen::Array3d energy(const Cell& c) const {
    const double size = std::ldexp(1.0, c.level) / kCells;
    if (c.level > 0) {
      Eigen::Array3d sum = Eigen::Array3d::Zero();
      for (const Cell& child : children(c)) sum += energy(child);
      return sum;
    }
    return Eigen::Array3d::Constant(
        size * size *
        disc.from_per_mm2(disc.disc_point_mm((c.x + 0.5) * size, (c.y + 0.5) * size), point_mm,
                          normal));
  }
  ImageRect rect(const Cell& c) const {
    const double size = std::ldexp(1.0, c.level) / kCells;
    return {c.x * size, c.y * size, (c.x + 1) * size, (c.y + 1) * size};
  }
  std::array<Cell, 4> children(const Cell& c) const {
    return {{{c.level - 1, 2 * c.x, 2 * c.y},
             {c.level - 1, 2 * c.x + 1, 2 * c.y},
             {c.level - 1, 2 * c.x, 2 * c.y + 1},
             {c.level - 1, 2 * c.x + 1, 2 * c.y + 1}}};
  }
  bool wide(const Cell&) const { return false; }
  bool last(const Cell& c, const Eigen::Array3d&) const { return c.level <= kLastLevel; }
  bool visible(double u, double v) const {
    const Eigen::Vector3d target_mm = disc.disc_point_mm(u, v);
    // A point below the surface's horizon contributes nothing; it is treated like one on the
    // horizon.
    if (!(normal.dot(target_mm - point_mm) > 0.0)) return true;
    ++rays;
    return !disc.scene_.occluded(point_mm, normal, target_mm);
  }
};

DiscLight::DiscLight(const Led& led, const RayScene& scene, double eta_int_over_ext)
    : led_(led), scene_(scene), eta_(eta_int_over_ext) {
  if (!(led.radius_mm > 0.0)) {
    throw std::invalid_argument("DiscLight: radius_mm = " + std::to_string(led.radius_mm));
  }
  across_mm_[0] = led.radius_mm * led.axis.unitOrthogonal();
  across_mm_[1] = led.axis.cross(across_mm_[0]);
}

Eigen::Vector3d DiscLight::disc_point_mm(double u, double v) const {
  const double a = 2.0 * u - 1.0;
  const double b = 2.0 * v - 1.0;
  if (a == 0.0 && b == 0.0) return led_.position_mm;
  constexpr double kQuarter = std::numbers::pi / 4.0;
  const bool by_a = std::abs(a) > std::abs(b);
  const double r = by_a ? a : b;
  const double phi = by_a ? kQuarter * (b / a) : 2.0 * kQuarter - kQuarter * (a / b);
  return led_.position_mm + r * std::cos(phi) * across_mm_[0] + r * std::sin(phi) * across_mm_[1];
}

double DiscLight::from_per_mm2(const Eigen::Vector3d& source_mm, const Eigen::Vector3d& point_mm,
                               const Eigen::Vector3d& normal) const {
  Led part = led_;
  part.position_mm = source_mm;
  return part.transmitted_irradiance_per_mm2(point_mm, normal, eta_);
}

double DiscLight::open_per_mm2(const Eigen::Vector3d& point_mm,
                               const Eigen::Vector3d& normal) const {
  const Eigen::Vector3d to_led_mm = led_.position_mm - point_mm;
  const double distance_mm = to_led_mm.norm();
  // How far the disc reaches above and below its centre, along the normal.
  const double reach_mm = std::hypot(normal.dot(across_mm_[0]), normal.dot(across_mm_[1]));
  const double height_mm = normal.dot(to_led_mm);
  if (height_mm <= -reach_mm) return 0.0;
  const bool behind = led_.axis.dot(to_led_mm) >= 0.0;
  if (behind) return 0.0;  // the disc shines away from the point
  double sum = 0.0;
  if (height_mm > reach_mm && distance_mm > 2.0 * led_.radius_mm) {
    for (std::size_t i = 0; i < kNode.size(); ++i) {
      const double r = std::sqrt(kNode[i]);  // equal areas by the square of the radius
      double ring = 0.0;
      for (int k = 0; k < kAngles; ++k) {
        const double phi = 2.0 * std::numbers::pi * (k + 0.5) / kAngles;
        ring += from_per_mm2(led_.position_mm + r * std::cos(phi) * across_mm_[0] +
                                 r * std::sin(phi) * across_mm_[1],
                             point_mm, normal);
      }
      sum += kWeight[i] * ring / kAngles;
    }
    return sum;
  }
  for (int i = 0; i < kGrid; ++i) {
    for (int j = 0; j < kGrid; ++j) {
      sum += from_per_mm2(disc_point_mm((i + 0.5) / kGrid, (j + 0.5) / kGrid), point_mm, normal);
    }
  }
  return sum / (kGrid * kGrid);
}

double DiscLight::visible_share(const Eigen::Vector3d& point_mm, const Eigen::Vector3d& normal,
                                std::size_t& rays) const {
  DiscEmitter emitter{*this, point_mm, normal, rays};
  VisibleShare<DiscEmitter> share(emitter);
  double seen = 0.0;
  double all = 0.0;
  for (int x = 0; x < 2; ++x) {
    for (int y = 0; y < 2; ++y) {
      const DiscEmitter::Cell cell{kRootLevel, x, y};
      all += emitter.energy(cell)[0];
      seen += share.sum(cell, {})[0];
    }
  }
  return all > 0.0 ? seen / all : 0.0;
}

}  // namespace scattermeter
