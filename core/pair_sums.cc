#include "core/pair_sums.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

namespace scattermeter {
namespace {

using Triangle = std::array<Eigen::Vector3d, 3>;
using Density = std::array<double, 3>;

double longest_edge_mm(const Triangle& t) {
  return std::sqrt(std::max(
      {(t[1] - t[0]).squaredNorm(), (t[2] - t[1]).squaredNorm(), (t[0] - t[2]).squaredNorm()}));
}

// Integral of density times f(|p - x|) over a triangle into bins; density is linear.
template <class Bins>
class NearIntegral {
 public:
  NearIntegral(const Eigen::Vector3d& p, double weight, const Bins& bins,
               const PairSumOptions& options, double* sums)
      : p_(p), weight_(weight), bins_(bins), options_(options), sums_(sums) {}

  void add(const Triangle& t, const Density& e, double area, double edge) const {
    const Eigen::Vector3d center = (t[0] + t[1] + t[2]) / 3.0;
    const double distance = (center - p_).norm();
    if (edge <= options_.floor_mm || edge * options_.near_ratio <= distance) {
      // Three-point rule of degree 2: barycentric (2/3, 1/6, 1/6) and its turns.
      for (int i = 0; i < 3; ++i) {
        const Eigen::Vector3d q = 0.5 * t[i] + 0.5 * center;
        const double density = 0.5 * e[i] + (e[0] + e[1] + e[2]) / 6.0;
        bins_.add(static_cast<float>((q - p_).squaredNorm()),
                  static_cast<float>(weight_ * density * area / 3.0), sums_);
      }
      return;
    }
    const Triangle m = {0.5 * (t[1] + t[2]), 0.5 * (t[2] + t[0]), 0.5 * (t[0] + t[1])};
    const Density f = {0.5 * (e[1] + e[2]), 0.5 * (e[2] + e[0]), 0.5 * (e[0] + e[1])};
    add({t[0], m[2], m[1]}, {e[0], f[2], f[1]}, 0.25 * area, 0.5 * edge);
    add({t[1], m[0], m[2]}, {e[1], f[0], f[2]}, 0.25 * area, 0.5 * edge);
    add({t[2], m[1], m[0]}, {e[2], f[1], f[0]}, 0.25 * area, 0.5 * edge);
    add({m[0], m[1], m[2]}, {f[0], f[1], f[2]}, 0.25 * area, 0.5 * edge);
  }

 private:
  const Eigen::Vector3d& p_;
  double weight_;
  const Bins& bins_;
  const PairSumOptions& options_;
  double* sums_;
};

}  // namespace

ExitSite exit_patch(const PatchMesh& patches, int patch_idx) {
  const Triangle t = patches.corners_mm(patch_idx);
  const Eigen::Vector3d center = (t[0] + t[1] + t[2]) / 3.0;
  return {center,
          {0.5 * (t[0] + center), 0.5 * (t[1] + center), 0.5 * (t[2] + center)},
          longest_edge_mm(t)};
}

ExitSite exit_samples(const Eigen::Vector3d& mean_mm, const Eigen::Matrix3d& covariance_mm2,
                      double size_mm) {
  // In the plane of the two larger eigenvectors e1, e2: mean + sqrt(2 lambda1) cos(phi) e1 +
  // sqrt(2 lambda2) sin(phi) e2 for three phi a third of a turn apart; the mean of cos^2 is 1/2.
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(covariance_mm2);
  ExitSite site{mean_mm, {mean_mm, mean_mm, mean_mm}, size_mm};
  for (int i = 0; i < 3; ++i) {
    const double phi = 2.0 * std::numbers::pi / 3.0 * i;
    site.points_mm[static_cast<std::size_t>(i)] +=
        std::sqrt(2.0 * std::max(0.0, eigen.eigenvalues()[2])) * std::cos(phi) *
            eigen.eigenvectors().col(2) +
        std::sqrt(2.0 * std::max(0.0, eigen.eigenvalues()[1])) * std::sin(phi) *
            eigen.eigenvectors().col(1);
  }
  return site;
}

SourceCloud::SourceCloud(const IncidentLight& light, const Eigen::Vector3d& origin_mm)
    : origin_mm_(origin_mm), triangles_(light.lit) {
  for (LitTriangle& t : triangles_) {
    // Positions relative to the origin from here on.
    for (Eigen::Vector3d& corner : t.corners_mm) corner -= origin_mm_;
    const auto& c = t.corners_mm;
    const auto& e = t.irradiance_sr_per_mm2;
    const double sum = e[0] + e[1] + e[2];
    // Linear density e over a triangle: its integral is the mean of e times the area; its centroid
    // weighs corner i with (sum + e_i) / (4 sum).
    const Eigen::Vector3d centroid =
        ((sum + e[0]) * c[0] + (sum + e[1]) * c[1] + (sum + e[2]) * c[2]) / (4.0 * sum);
    const double area_mm2 = 0.5 * (c[1] - c[0]).cross(c[2] - c[0]).norm();
    x_.push_back(static_cast<float>(centroid.x()));
    y_.push_back(static_cast<float>(centroid.y()));
    z_.push_back(static_cast<float>(centroid.z()));
    power_.push_back(static_cast<float>(sum / 3.0 * area_mm2));
    edge_.push_back(static_cast<float>(longest_edge_mm(c)));
  }
}

template <class Bins>
void SourceCloud::add_to(const ExitSite& site, const Bins& bins, const PairSumOptions& options,
                         double* sums) const {
  const Eigen::Vector3d center = site.center_mm - origin_mm_;
  const float cx = static_cast<float>(center.x());
  const float cy = static_cast<float>(center.y());
  const float cz = static_cast<float>(center.z());
  const float site_edge = static_cast<float>(site.size_mm);
  const float far_ratio = static_cast<float>(options.far_ratio);
  const int n_points = site.size_mm > 0.0 ? 3 : 1;
  const std::array<Eigen::Vector3d, 3> points = {site.points_mm[0] - origin_mm_,
                                                 site.points_mm[1] - origin_mm_,
                                                 site.points_mm[2] - origin_mm_};
  const std::size_t n = power_.size();
  for (std::size_t k = 0; k < n; ++k) {
    const float dx = x_[k] - cx;
    const float dy = y_[k] - cy;
    const float dz = z_[k] - cz;
    const float d2 = dx * dx + dy * dy + dz * dz;
    const float far = far_ratio * std::max(site_edge, edge_[k]);
    if (d2 > far * far) {
      bins.add(d2, power_[k], sums);
      continue;
    }
    const LitTriangle& t = triangles_[k];
    const double area_mm2 =
        0.5 * (t.corners_mm[1] - t.corners_mm[0]).cross(t.corners_mm[2] - t.corners_mm[0]).norm();
    for (int i = 0; i < n_points; ++i) {
      NearIntegral<Bins>(points[i], 1.0 / n_points, bins, options, sums)
          .add(t.corners_mm, t.irradiance_sr_per_mm2, area_mm2, static_cast<double>(edge_[k]));
    }
  }
}

template void SourceCloud::add_to(const ExitSite&, const UniformBins&, const PairSumOptions&,
                                  double*) const;
template void SourceCloud::add_to(const ExitSite&, const OctaveBins&, const PairSumOptions&,
                                  double*) const;

}  // namespace scattermeter
