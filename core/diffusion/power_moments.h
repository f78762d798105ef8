// Zeroth to second moment of the light that enters a part of the surface.
#pragma once

#include <Eigen/Core>

#include "core/light/incident_light.h"
#include "core/mesh/triangle_parts.h"

namespace scattermeter {

struct PowerMoments {
  double power = 0;                                      // sr
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();        // mm
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  // mm^2
  Eigen::Vector3d min, max;                              // bounds of the members, mm

  // Of a triangle with a linear density.
  static PowerMoments of(const LitTriangle& t) {
    const auto& c = t.corners_mm;
    const auto& e = t.irradiance_sr_per_mm2;
    PowerMoments m;
    const double sum = e[0] + e[1] + e[2];
    m.power = sum / 3.0 * area_mm2(c);
    // ∫ λ_i λ_j λ_k over a triangle of unit area is 1/10 (i = j = k), 1/30 (two alike), 1/60; a
    // linear density is Σ e_i λ_i. Centroid: (sum + e_i) / (4 sum) of corner i.
    for (int i = 0; i < 3; ++i) m.mean += (sum + e[i]) / (4.0 * sum) * c[i];
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        const double weight = i == j ? (2.0 * sum + 4.0 * e[i]) / 20.0 : (sum + e[i] + e[j]) / 20.0;
        m.covariance += weight / sum * (c[i] - m.mean) * (c[j] - m.mean).transpose();
      }
    }
    m.min = c[0].cwiseMin(c[1]).cwiseMin(c[2]);
    m.max = c[0].cwiseMax(c[1]).cwiseMax(c[2]);
    return m;
  }

  static PowerMoments joined(const PowerMoments& a, const PowerMoments& b) {
    PowerMoments m;
    m.power = a.power + b.power;
    const double share = b.power / m.power;
    const Eigen::Vector3d step = b.mean - a.mean;
    m.mean = a.mean + share * step;
    m.covariance = (1.0 - share) * a.covariance + share * b.covariance +
                   share * (1.0 - share) * step * step.transpose();
    m.min = a.min.cwiseMin(b.min);
    m.max = a.max.cwiseMax(b.max);
    return m;
  }

  // No member is farther from the mean.
  double radius_mm() const { return (max - mean).cwiseMax(mean - min).norm(); }
};

}  // namespace scattermeter
