#include "core/material/rough_boundary.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include <Eigen/Geometry>

#include "core/material/fresnel.h"
#include "core/material/smooth_boundary.h"

namespace scattermeter {
namespace {

// Axes of a surface: the normal is the third.
struct Axes {
  explicit Axes(const Eigen::Vector3d& normal)
      : x(normal.unitOrthogonal()), y(normal.cross(x)), z(normal) {}
  Eigen::Vector3d in_surface(const Eigen::Vector3d& v) const {
    return {x.dot(v), y.dot(v), z.dot(v)};
  }
  Eigen::Vector3d in_world(const Eigen::Vector3d& v) const {
    return v.x() * x + v.y() * y + v.z() * z;
  }
  Eigen::Vector3d x, y, z;
};

// A normal that the direction `out`, which may point below the horizon, sees: its density is D
// times the cosine between the two. GGX is a hemisphere stretched by alpha, of which a point is
// visible with a reflected direction uniform over a spherical cap (Dupuy & Benyoub 2023).
Eigen::Vector3d visible_normal(const Eigen::Vector3d& out, double alpha, RandomStream& random) {
  const Eigen::Vector3d seen =
      Eigen::Vector3d(alpha * out.x(), alpha * out.y(), out.z()).normalized();
  const RandomStream::DiscPoint p = random.disc();
  const double z = (1.0 - p.r2) * (1.0 + seen.z()) - seen.z();
  const double ring = std::sqrt(std::max(0.0, 1.0 - z * z) / p.r2);
  const Eigen::Vector3d half(ring * p.x + seen.x(), ring * p.y + seen.y(), z + seen.z());
  return Eigen::Vector3d(alpha * half.x(), alpha * half.y(), std::max(0.0, half.z())).normalized();
}

// ∫ u^a (1 - u)^b du over 0 .. 1: of rays with Smith's a and b on opposite sides of the surface,
// the share that meets no other facet, over all heights u of the one between them.
double both_clear(double a, double b) {
  constexpr double kGrazing = 80.0;  // where the share is nothing, and gamma too large
  if (!(a < kGrazing && b < kGrazing)) return 0.0;
  return std::tgamma(1.0 + a) * std::tgamma(1.0 + b) / std::tgamma(2.0 + a + b);
}

}  // namespace

RoughBoundary::RoughBoundary(double alpha, double eta_int_over_ext)
    : alpha_(alpha), eta_(eta_int_over_ext) {
  if (!(alpha > 0.0 && alpha <= kMostAlpha && eta_int_over_ext >= 1.0)) {
    throw std::invalid_argument("RoughBoundary: alpha = " + std::to_string(alpha) +
                                ", eta = " + std::to_string(eta_int_over_ext));
  }
}

double RoughBoundary::lambda(double cosine) const {
  const double tan2 = std::max(0.0, 1.0 / (cosine * cosine) - 1.0);
  return 0.5 * (std::sqrt(1.0 + alpha_ * alpha_ * tan2) - 1.0);
}

double RoughBoundary::smooth_transmittance(double cos_theta) const {
  return fresnel_transmittance(eta_, std::max(kLeastCosine, cos_theta));
}

// Inside, the microsurface is seen from below: turned over by a reflection at a point, it is the
// same surface again. `v` and `height` (the share of the surface that lies lower) are those of the
// flight as seen from above the side that it is on.
RoughBoundary::Meeting RoughBoundary::meet(const Eigen::Vector3d& direction,
                                           const Eigen::Vector3d& normal,
                                           RandomStream& random) const {
  const Axes axes(normal);
  const Eigen::Vector3d from = axes.in_surface(direction);
  const bool from_outside = from.z() < 0.0;
  bool outside = from_outside;
  Eigen::Vector3d v = outside ? from : Eigen::Vector3d(-from);
  double height = 1.0;
  Meeting out;
  for (;;) {
    // To the next facet: the share of the surface above a ray that it has not met falls with
    // height^Lambda (same paper, eq. 15).
    if (v.z() > 0.0) {
      const double l = lambda(v.z());
      const double u = random.uniform();
      const double clear = std::pow(height, l);
      // Not the other way round: a direction that is no number leaves as well.
      if (!(u > clear)) break;
      height = std::min(1.0, height * std::pow(u, -1.0 / l));
    } else if (v.z() < 0.0) {
      height *= std::pow(random.uniform(), 1.0 / (1.0 + lambda(-v.z())));
    }
    ++out.facets;
    const Eigen::Vector3d facet = visible_normal(-v, alpha_, random);
    const double eta = outside ? eta_ : 1.0 / eta_;
    if (random.uniform() < fresnel_transmittance(eta, -v.dot(facet))) {
      v = -refracted(v, facet, eta);
      height = 1.0 - height;
      outside = !outside;
    } else {
      v = reflected(v, facet);
    }
  }
  out.direction = axes.in_world(outside ? v : Eigen::Vector3d(-v)).normalized();
  out.passed = outside != from_outside;
  return out;
}

double RoughBoundary::reflection_per_sr(const Eigen::Vector3d& to_light,
                                        const Eigen::Vector3d& to_viewer,
                                        const Eigen::Vector3d& normal) const {
  const double cos_light = to_light.dot(normal);
  const double cos_viewer = to_viewer.dot(normal);
  if (!(cos_light > 0.0 && cos_viewer > 0.0)) return 0.0;
  const Eigen::Vector3d facet = (to_light + to_viewer).normalized();
  const double cosine = facet.dot(normal);
  const double a2 = alpha_ * alpha_;
  const double t = 1.0 - (1.0 - a2) * cosine * cosine;
  const double density = a2 / (std::numbers::pi * t * t);
  const double clear = 1.0 / (1.0 + lambda(cos_light) + lambda(cos_viewer));
  return density * clear * (1.0 - fresnel_transmittance(eta_, facet.dot(to_light))) /
         (4.0 * cos_light * cos_viewer);
}

// Of D cos(tilt) a share falls on tilts of tangent t that goes as t / (alpha^2 + t^2)^2, with mean
// tangent alpha pi / 2. A ray sees of it cos + sin t cos(around): at steep angles, steep facets.
// The density drawn from is (1 + t) times the former, so that the ratio of the two is bounded:
// either that itself, or t times it, for which t / alpha = tan(psi) with a density of sin(psi)^2,
// cos(psi) being a coordinate of a point uniform over a disc.
RoughBoundary::Facet RoughBoundary::draw_facet(RandomStream& random) const {
  const double mean_tan = 0.5 * std::numbers::pi * alpha_;
  Facet facet;
  const RandomStream::DiscPoint p = random.disc();
  if (random.uniform() * (1.0 + mean_tan) < 1.0) {
    const double u = random.uniform();
    facet.tan_tilt = alpha_ * std::sqrt(u / (1.0 - u));
  } else {
    const double x = random.disc().x;
    facet.tan_tilt = alpha_ * std::sqrt(1.0 - x * x) / std::abs(x);
  }
  const double r = std::sqrt(p.r2);
  facet.cos_around = p.x / r;
  facet.sin_around = p.y / r;
  facet.weight = (1.0 + mean_tan) / (1.0 + facet.tan_tilt);
  return facet;
}

std::optional<RoughBoundary::Passage> RoughBoundary::pass(const Eigen::Vector3d& to_viewer,
                                                          const Eigen::Vector3d& normal,
                                                          const Facet& facet) const {
  const double cos_viewer = to_viewer.dot(normal);
  if (!(cos_viewer > 0.0)) return std::nullopt;
  const Axes axes(normal);
  const Eigen::Vector3d m =
      (normal + facet.tan_tilt * (facet.cos_around * axes.x + facet.sin_around * axes.y))
          .normalized();
  const double cos_before = to_viewer.dot(m);
  if (!(cos_before > 0.0)) return std::nullopt;
  const Eigen::Vector3d direction = refracted(-to_viewer, m, eta_);
  const double cos_inside = -direction.dot(normal);
  if (!(cos_inside > 0.0)) return std::nullopt;
  return Passage{direction, m, cos_viewer, cos_inside,
                 1.0 - cos_before / (eta_ * -direction.dot(m))};
}

double RoughBoundary::share(const Eigen::Vector3d& to_viewer, const Facet& facet,
                            const Passage& passage) const {
  const double cos_before = to_viewer.dot(passage.facet_normal);
  return facet.weight * cos_before * std::sqrt(1.0 + facet.tan_tilt * facet.tan_tilt) /
         passage.cos_viewer * fresnel_transmittance(eta_, cos_before) *
         both_clear(lambda(passage.cos_viewer), lambda(passage.cos_inside));
}

// By the middles of equal shares of draw_facet()'s first density, and of equal angles around.
RoughBoundary::First RoughBoundary::first_facets(double cos_theta) const {
  constexpr int kTilts = 64;
  constexpr int kAround = 32;
  const double sin_theta = std::sqrt(std::max(0.0, 1.0 - cos_theta * cos_theta));
  const Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d to_viewer(sin_theta, 0.0, cos_theta);
  const Axes axes(normal);
  First sum;
  for (int i = 0; i < kTilts; ++i) {
    // Finer where tilts are steep: u = 1 - (1 - s)^2, of density 2 (1 - s).
    const double s = (i + 0.5) / kTilts;
    const double u = 1.0 - (1.0 - s) * (1.0 - s);
    Facet facet;
    facet.tan_tilt = alpha_ * std::sqrt(u / (1.0 - u));
    facet.weight = 2.0 * (1.0 - s) / (kTilts * kAround);
    for (int j = 0; j < kAround; ++j) {
      const double around = 2.0 * std::numbers::pi * (j + 0.5) / kAround;
      facet.cos_around = std::cos(around);
      facet.sin_around = std::sin(around);
      if (const auto passage = pass(to_viewer, normal, facet)) {
        sum.passed += share(to_viewer, facet, *passage);
      }
      const Eigen::Vector3d m =
          (normal + facet.tan_tilt * (facet.cos_around * axes.x + facet.sin_around * axes.y))
              .normalized();
      const double cosine = m.dot(to_viewer);
      const double out_cosine = (2.0 * cosine * m - to_viewer).z();
      if (!(cosine > 0.0 && out_cosine > 0.0)) continue;
      sum.reflected += facet.weight * cosine / (cos_theta * m.z()) *
                       (1.0 - fresnel_transmittance(eta_, cosine)) /
                       (1.0 + lambda(cos_theta) + lambda(out_cosine));
    }
  }
  return sum;
}

double RoughBoundary::transmittance(double cos_theta) const {
  if (!(cos_theta > 0.0)) return 0.0;
  const First first = first_facets(std::min(1.0, cos_theta));
  return first.passed / (first.passed + first.reflected);
}

double RoughBoundary::transmittance_by_several(double cos_theta) const {
  if (!(cos_theta > 0.0)) return 0.0;
  const First first = first_facets(std::min(1.0, cos_theta));
  const double once = first.passed + first.reflected;
  return std::max(0.0, first.passed * (1.0 / once - 1.0));
}

}  // namespace scattermeter
