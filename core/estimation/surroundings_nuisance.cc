#include "core/estimation/surroundings_nuisance.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/diffusion/source_cloud.h"
#include "core/light/diffuse_plane.h"
#include "core/light/plane_irradiance.h"
#include "core/light/plane_light.h"
#include "core/light/transmitted_cosine.h"

namespace scattermeter {
namespace {

// Points of the plane between which the irradiance by the object is taken as linear.
class PlaneGrid {
 public:
  // Around the object, one size beyond it on each side.
  PlaneGrid(const Box3d& box, double z_mm) {
    const double size_mm = box.size_mm().maxCoeff();
    cell_mm_ = 3.0 * size_mm / kSide;
    const Eigen::Vector3d center = box.center_mm();
    low_mm_ = {center.x() - 1.5 * size_mm, center.y() - 1.5 * size_mm, z_mm};
    value_.setZero(kSide + 1, kSide + 1);
  }
  template <class F>
  void fill(const F& irradiance) {
    for (int j = 0; j <= kSide; ++j) {
      for (int i = 0; i <= kSide; ++i) {
        value_(i, j) = irradiance(low_mm_ + cell_mm_ * Eigen::Vector3d(i, j, 0.0));
      }
    }
  }
  double at(const Eigen::Vector3d& p) const {
    const double x = (p.x() - low_mm_.x()) / cell_mm_;
    const double y = (p.y() - low_mm_.y()) / cell_mm_;
    if (!(x >= 0.0 && y >= 0.0 && x < kSide && y < kSide)) return 0.0;
    const int i = static_cast<int>(x);
    const int j = static_cast<int>(y);
    const double u = x - i;
    const double v = y - j;
    return (1.0 - u) * ((1.0 - v) * value_(i, j) + v * value_(i, j + 1)) +
           u * ((1.0 - v) * value_(i + 1, j) + v * value_(i + 1, j + 1));
  }

 private:
  static constexpr int kSide = 32;
  double cell_mm_;
  Eigen::Vector3d low_mm_;
  Eigen::MatrixXd value_;
};

// The object's own light by way of the plane.
class OwnLight {
 public:
  OwnLight(const SeenObject& seen, const PatchMesh& patches, const ScenePlane& plane)
      : object_(*seen.object),
        patches_(patches),
        plane_(plane),
        eta_(object_.stated->eta_int_over_ext),
        transmitted_(eta_) {
    constexpr int kSteps = 200;
    for (int i = 0; i < kSteps; ++i) {
      diffuse_ += 2.0 * transmitted_((i + 0.5) / kSteps) / kSteps;
    }
  }

  // Transmitted again, where l (W/mm^2 per W/sr) of the patches is this.
  IncidentLight coming_back(const Eigen::VectorXd& l) const {
    PlaneGrid grid(object_.box, plane_.z_mm);
    grid.fill([&](const Eigen::Vector3d& p) { return irradiance(p, l); });
    PlaneIrradianceOptions few;
    few.rings = 6;
    few.sectors = 24;
    IncidentLight light = light_from_plane(
        patches_, *object_.rays, plane_.z_mm, eta_,
        [&](const Eigen::Vector3d& p) { return grid.at(p); }, few);
    for (int k = 0; k < patches_.size() && plane_.contact == PlaneContact::kAir; ++k) {
      if (!is_close(k)) continue;
      // Where it left: once through the face on either way.
      const double e = std::max(0.0, l[k]) * diffuse_ * diffuse_;
      light.lit.push_back({patches_.corners_mm(k), {e, e, e}, k});
      light.patch_power_sr[static_cast<std::size_t>(k)] += e * patches_.area_mm2(k);
    }
    return light;
  }

 private:
  // Facing the plane so near that light comes back where it left.
  bool is_close(int k) const {
    return patches_.normal(k).z() < -1.0 + 1e-9 &&
           patches_.center_mm(k).z() - plane_.z_mm < 0.5 * patches_.patch_size_mm();
  }
  double irradiance(const Eigen::Vector3d& p, const Eigen::VectorXd& l) const {
    double e = 0.0;
    for (int k = 0; k < patches_.size(); ++k) {
      const Eigen::Vector3d way = p - patches_.center_mm(k);
      const Eigen::Vector3d& normal = patches_.normal(k);
      if (!(normal.dot(way) > 0.0) || is_close(k)) continue;
      const double r2 = way.squaredNorm();
      const double r = std::sqrt(r2);
      e += l[k] * transmitted_(normal.dot(way) / r) * (-way.z() / r) * patches_.area_mm2(k) / r2;
    }
    return std::max(0.0, e) / std::numbers::pi;
  }

  const ObjectScene& object_;
  const PatchMesh& patches_;
  const ScenePlane& plane_;
  double eta_;
  TransmittedCosine transmitted_;
  double diffuse_ = 0;  // transmittance of diffuse light
};

IncidentLight sum_of(IncidentLight a, const IncidentLight& b) {
  a.lit.insert(a.lit.end(), b.lit.begin(), b.lit.end());
  for (std::size_t k = 0; k < a.patch_power_sr.size(); ++k) {
    a.patch_power_sr[k] += b.patch_power_sr[k];
  }
  return a;
}

}  // namespace

Eigen::MatrixXd change_by_plane(const SeenObject& seen, const Led& led, const ScenePlane& plane,
                                const DistanceKnots& knots, const std::vector<LitMedium>& media) {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(seen.sites.size()),
                                              static_cast<Eigen::Index>(media.size()));
  if (!(led.position_mm.z() > plane.z_mm)) return out;
  const ObjectScene& object = *seen.object;
  const double eta = object.stated->eta_int_over_ext;
  const Eigen::Vector3d center_mm = object.box.center_mm();
  const PlaneLight by_plane(led, plane.z_mm, Eigen::Array3d::Ones(), Eigen::Array3d::Zero());
  const PatchMesh patches(object.mesh(),
                          object.size_mm() / *by_plane.patches_across(LightUse::kMeasure));
  const IncidentLight once = by_plane.illuminate(patches, *object.rays, eta, LightUse::kMeasure)[0];
  const IncidentLight direct = illuminate(patches, *object.rays, led, eta);
  std::vector<ExitSite> on_patches, sites;
  for (int k = 0; k < patches.size(); ++k) on_patches.push_back(exit_point(patches.center_mm(k)));
  for (const ExitSite& site : seen.sites) sites.push_back(exit_point(site.center_mm));
  const PairSumOptions pairs = coarse_pair_options(knots);
  const DistanceKnots few = knots.with_fine_bits(4);
  const Eigen::MatrixXd r = scaled_curves(media, knots, eta);
  const Eigen::MatrixXd l =
      smooth_images(on_patches, SourceCloud(direct, center_mm), few, pairs, r);
  const OwnLight own(seen, patches, plane);
  for (std::size_t m = 0; m < media.size(); ++m) {
    const auto column = static_cast<Eigen::Index>(m);
    // l is that of the measured scale, and so is the change: the way back is not scaled again.
    const IncidentLight light = sum_of(once, own.coming_back(l.col(column) / media[m].scale));
    out.col(column) =
        smooth_images(sites, SourceCloud(light, center_mm), few, pairs, r.col(column));
  }
  return out;
}

}  // namespace scattermeter
