// A rough dielectric boundary: smooth microfacets, tilted at random.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "core/base/random_stream.h"

namespace scattermeter {

// Microfacets with GGX's distribution of normals (Trowbridge & Reitz 1975; Walter et al. 2007, eq.
// 33), of width alpha, each a smooth dielectric boundary after Fresnel, and Smith's model of the
// surface between them: heights and normals are independent. Light is followed from facet to facet
// until it leaves the microsurface on either side (Heitz et al. 2016, "Multiple-scattering
// microfacet BSDFs with the Smith model"), so that no power is lost, and the boundary is reciprocal
// with f(i -> o) / eta_o^2 = f(o -> i) / eta_i^2. Facets are large against the wavelength.
//
// Directions are unit vectors in the world's frame, `normal` is the macroscopic surface's,
// outwards.
class RoughBoundary {
 public:
  static constexpr double kMostAlpha = 0.5;
  static constexpr double kLeastCosine = 0.05;

  // 0 < alpha <= kMostAlpha, eta_int_over_ext >= 1; std::invalid_argument otherwise. A smooth
  // boundary (alpha 0) is that of fresnel.h and smooth_boundary.h.
  RoughBoundary(double alpha, double eta_int_over_ext);

  double alpha() const { return alpha_; }

  // Ft of the smooth boundary, by which l = pi L_o / Ft is expressed, rough or not; at cosines
  // below kLeastCosine, that of kLeastCosine.
  double smooth_transmittance(double cos_theta) const;

  // What becomes of light that meets the surface.
  struct Meeting {
    Eigen::Vector3d direction;  // of flight, after
    bool passed = false;        // to the other side
    int facets = 0;             // met on the way, >= 1
  };
  // `direction`: of flight, before; against the normal it comes from outside, along it from inside.
  // The direction's density is the boundary's scattering function times the cosine behind it.
  Meeting meet(const Eigen::Vector3d& direction, const Eigen::Vector3d& normal,
               RandomStream& random) const;

  // Power of light from outside that gets in, by any number of facets; 0 for cos_theta <= 0. By
  // quadrature over the first facet; of light that meets more than one, as large a share gets in as
  // of that which meets one (test: for cosines from 0.25 on within 5e-3 of meet(), at alpha = 0.5
  // within 0.016).
  double transmittance(double cos_theta) const;
  // The part of it that meets several facets.
  double transmittance_by_several(double cos_theta) const;

  // 1/sr: radiance towards `to_viewer` per irradiance on the macroscopic surface by light from
  // `to_light`, both outside, reflected by one facet. Light that meets several adds at most a tenth
  // of all that is so reflected for alpha <= 0.3, a fifth at 0.5 (test: cosines 0.4 and 0.9).
  double reflection_per_sr(const Eigen::Vector3d& to_light, const Eigen::Vector3d& to_viewer,
                           const Eigen::Vector3d& normal) const;

  // A facet drawn for connections through the surface.
  struct Facet {
    double tan_tilt = 0;  // against the macroscopic normal
    double cos_around = 1, sin_around = 0;
    double weight = 1;  // visible area is proportional to D cos(tilt) per solid angle of the
                        // normals: the inverse of the facet's density, relative to that
  };
  Facet draw_facet(RandomStream& random) const;
  // The way inside of a ray of the viewer through such a facet, and no other.
  struct Passage {
    Eigen::Vector3d direction;  // of flight of the viewer's ray, inside
    Eigen::Vector3d facet_normal;
    double cos_viewer = 0, cos_inside = 0;  // to the macroscopic normal
    // d (direction) / d (ray) is (1 - stretch m m^T) / eta, with the facet's normal m.
    double stretch = 0;
  };
  // Empty where no light passes so.
  std::optional<Passage> pass(const Eigen::Vector3d& to_viewer, const Eigen::Vector3d& normal,
                              const Facet& facet) const;
  // In the mean over draw_facet(), of passages or nothing: the share of the ray's power that passes
  // by a single facet. L_o towards the viewer is the mean of share / eta^2 times the radiance
  // inside against the passage's direction, by reciprocity; for light that meets one facet.
  double share(const Eigen::Vector3d& to_viewer, const Facet& facet, const Passage& passage) const;

 private:
  // Smith's Lambda of a direction with this cosine, in (0, 1].
  double lambda(double cosine) const;
  // Of the power of a ray from outside, with this cosine, by facets met first.
  struct First {
    double passed = 0, reflected = 0;
  };
  First first_facets(double cos_theta) const;

  double alpha_;
  double eta_;
};

}  // namespace scattermeter
