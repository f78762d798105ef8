#include "core/nuisances/surroundings_nuisance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <numbers>

#include <oneapi/tbb/parallel_for.h>

#include "core/diffusion/source_cloud.h"
#include "core/light/diffuse_plane.h"
#include "core/light/plane_entry.h"
#include "core/light/plane_irradiance.h"
#include "core/light/transmitted_cosine.h"

namespace scattermeter {
namespace {

constexpr double kAcross = 8.0;  // places across the object
constexpr PlaneIrradianceOptions kDirections{6, 16};

// A part of the surface, about one cell wide, that faces one way.
struct Place {
  SurfacePoint point;
  double area_mm2 = 0;
};

// The surface as places; every patch belongs to one. A mesh of many facets has as few as another.
struct Places {
  Places(const PatchMesh& patches, double size_mm) : cell_mm(size_mm) {
    using Key = std::array<int, 6>;
    std::map<Key, std::size_t> known;
    std::vector<Eigen::Vector3d> sum;
    for (int k = 0; k < patches.size(); ++k) {
      const Eigen::Vector3d at = patches.center_mm(k);
      Key key{};
      for (int i = 0; i < 3; ++i) {
        key[static_cast<std::size_t>(i)] = static_cast<int>(std::floor(at[i] / size_mm));
        key[static_cast<std::size_t>(i + 3)] =
            static_cast<int>(std::lround(1.49 * patches.normal(k)[i]));
      }
      const auto [it, is_new] = known.try_emplace(key, all.size());
      if (is_new) {
        all.push_back({{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()}, 0.0});
        sum.emplace_back(Eigen::Vector3d::Zero());
      }
      const double area = patches.area_mm2(k);
      of_patch.push_back(it->second);
      all[it->second].area_mm2 += area;
      sum[it->second] += area * at;
    }
    // Each stands where the patch nearest to its centre is.
    std::vector<double> nearest(all.size(), std::numeric_limits<double>::infinity());
    for (int k = 0; k < patches.size(); ++k) {
      const std::size_t p = of_patch[static_cast<std::size_t>(k)];
      const Eigen::Vector3d middle = sum[p] / all[p].area_mm2;
      const double distance = (patches.center_mm(k) - middle).norm();
      if (distance >= nearest[p] - 1e-9 * size_mm) continue;
      nearest[p] = distance;
      // In the middle itself where the place is flat.
      const double off = patches.normal(k).dot(middle - patches.center_mm(k));
      all[p].point = {std::abs(off) < 1e-6 * size_mm ? middle : patches.center_mm(k),
                      patches.normal(k)};
    }
  }

  double cell_mm;
  std::vector<Place> all;
  std::vector<std::size_t> of_patch;
};

// What comes back of the object's own light, for several media at once.
class OwnLight {
 public:
  OwnLight(const SeenObject& seen, const Places& places, const ScenePlane& plane)
      : object_(*seen.object),
        places_(places),
        plane_(plane),
        eta_(object_.stated->eta_int_over_ext),
        transmitted_(eta_) {
    constexpr int kSteps = 200;
    for (int i = 0; i < kSteps; ++i) diffuse_ += 2.0 * transmitted_((i + 0.5) / kSteps) / kSteps;
    // Points of the plane from one size before to one size behind the object.
    const double size_mm = object_.size_mm();
    low_mm_ = object_.box.center_mm() - 1.5 * size_mm * Eigen::Vector3d(1.0, 1.0, 0.0);
    low_mm_.z() = plane.z_mm;
    step_mm_ = 3.0 * size_mm / kSide;
  }

  // Transmitted irradiance of the places, where l of the places is this; one column a medium.
  Eigen::MatrixXd coming_back(const Eigen::MatrixXd& l) const {
    Eigen::MatrixXd on_plane((kSide + 1) * (kSide + 1), l.cols());
    tbb::parallel_for(0, kSide + 1, [&](int j) {
      for (int i = 0; i <= kSide; ++i) {
        on_plane.row(j * (kSide + 1) + i) =
            irradiance(low_mm_ + step_mm_ * Eigen::Vector3d(i, j, 0.0), l);
      }
    });
    Eigen::MatrixXd out(l.rows(), l.cols());
    std::vector<SurfacePoint> points;
    for (const Place& place : places_.all) points.push_back(place.point);
    for (Eigen::Index m = 0; m < l.cols(); ++m) {
      const auto at = [&](const Eigen::Vector3d& p) { return interpolated(on_plane.col(m), p); };
      const std::vector<double> e = irradiance_from_plane(
          points, *object_.rays, plane_.z_mm, 0.05 * places_.cell_mm, eta_, at, kDirections);
      for (std::size_t p = 0; p < e.size(); ++p) {
        const auto row = static_cast<Eigen::Index>(p);
        const double here = plane_.contact == PlaneContact::kAir
                                ? diffuse_ * diffuse_ * std::max(0.0, l(row, m))
                                : 0.0;
        out(row, m) = is_close(places_.all[p]) ? here : e[p];
      }
    }
    return out;
  }

 private:
  static constexpr int kSide = 24;

  // Facing the plane so near that light comes back where it left, through the face on either way.
  bool is_close(const Place& place) const {
    return place.point.normal.z() < -0.95 &&
           place.point.at_mm.z() - plane_.z_mm < 0.5 * places_.cell_mm;
  }
  Eigen::RowVectorXd irradiance(const Eigen::Vector3d& p, const Eigen::MatrixXd& l) const {
    Eigen::RowVectorXd e = Eigen::RowVectorXd::Zero(l.cols());
    for (std::size_t k = 0; k < places_.all.size(); ++k) {
      const Place& place = places_.all[k];
      const Eigen::Vector3d way = p - place.point.at_mm;
      const double along = place.point.normal.dot(way);
      if (!(along > 0.0) || is_close(place)) continue;
      const double r2 = way.squaredNorm();
      const double r = std::sqrt(r2);
      e += transmitted_(along / r) * (-way.z() / r) * place.area_mm2 / r2 *
           l.row(static_cast<Eigen::Index>(k));
    }
    return e.cwiseMax(0.0) / std::numbers::pi;
  }
  double interpolated(const Eigen::Ref<const Eigen::VectorXd>& value,
                      const Eigen::Vector3d& p) const {
    const double x = (p.x() - low_mm_.x()) / step_mm_;
    const double y = (p.y() - low_mm_.y()) / step_mm_;
    if (!(x >= 0.0 && y >= 0.0 && x < kSide && y < kSide)) return 0.0;
    const int i = static_cast<int>(x);
    const int j = static_cast<int>(y);
    const double u = x - i;
    const double v = y - j;
    const Eigen::Index at = j * (kSide + 1) + i;
    return (1.0 - v) * ((1.0 - u) * value[at] + u * value[at + 1]) +
           v * ((1.0 - u) * value[at + kSide + 1] + u * value[at + kSide + 2]);
  }

  const ObjectScene& object_;
  const Places& places_;
  const ScenePlane& plane_;
  double eta_;
  TransmittedCosine transmitted_;
  double diffuse_ = 0;  // transmittance of diffuse light
  Eigen::Vector3d low_mm_;
  double step_mm_;
};

// The patches as light sources, with the irradiance of their places.
IncidentLight light_on(const PatchMesh& patches, const Places& places, const Eigen::VectorXd& e) {
  IncidentLight light;
  light.patch_power_sr.assign(static_cast<std::size_t>(patches.size()), 0.0);
  for (int k = 0; k < patches.size(); ++k) {
    const double here = e[static_cast<Eigen::Index>(places.of_patch[static_cast<std::size_t>(k)])];
    if (!(here > 0.0)) continue;
    light.lit.push_back({patches.corners_mm(k), {here, here, here}, k});
    light.patch_power_sr[static_cast<std::size_t>(k)] = here * patches.area_mm2(k);
  }
  return light;
}

// Values of the places, interpolated to the rows: means of those nearer than 1.5 cells that face
// the same way.
Eigen::MatrixXd on_rows(const SeenObject& seen, const Places& places,
                        const Eigen::MatrixXd& value) {
  const double reach2 = 2.25 * places.cell_mm * places.cell_mm;
  Eigen::MatrixXd out(static_cast<Eigen::Index>(seen.sites.size()), value.cols());
  tbb::parallel_for(std::size_t{0}, seen.sites.size(), [&](std::size_t j) {
    const Eigen::Vector3d& normal = seen.patches->normal(seen.map.patch_of_row[j]);
    Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(value.cols());
    double weights = 0.0;
    for (std::size_t p = 0; p < places.all.size(); ++p) {
      const SurfacePoint& point = places.all[p].point;
      const double d2 = (point.at_mm - seen.sites[j].center_mm).squaredNorm() / reach2;
      if (d2 >= 1.0 || point.normal.dot(normal) < 0.5) continue;
      const double w = (1.0 - d2) * (1.0 - d2) * places.all[p].area_mm2;
      weights += w;
      sum += w * value.row(static_cast<Eigen::Index>(p));
    }
    out.row(static_cast<Eigen::Index>(j)) = weights > 0.0 ? Eigen::RowVectorXd(sum / weights) : sum;
  });
  return out;
}

}  // namespace

Eigen::MatrixXd change_by_plane(const SeenObject& seen, const Led& led, const IncidentLight& direct,
                                const ScenePlane& plane, const DistanceKnots& knots,
                                const std::vector<LitMedium>& media) {
  if (!(led.position_mm.z() > plane.z_mm)) {
    return Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(seen.sites.size()),
                                 static_cast<Eigen::Index>(media.size()));
  }
  const ObjectScene& object = *seen.object;
  const double eta = object.stated->eta_int_over_ext;
  const Eigen::Vector3d center_mm = object.box.center_mm();
  const double cell_mm = object.size_mm() / kAcross;
  const PatchMesh patches(object.mesh(), cell_mm);
  const Places places(patches, 0.999 * cell_mm);
  std::vector<ExitSite> sites;
  std::vector<SurfacePoint> points;
  for (const Place& place : places.all) {
    sites.push_back(exit_point(place.point.at_mm));
    points.push_back(place.point);
  }
  const std::vector<double> of_led = irradiance_from_plane(
      points, *object.rays, plane.z_mm, 0.05 * cell_mm, eta,
      [&](const Eigen::Vector3d& at) { return plane_irradiance_per_mm2(*object.rays, led, at); },
      kDirections);
  const Eigen::Map<const Eigen::VectorXd> once(of_led.data(),
                                               static_cast<Eigen::Index>(of_led.size()));
  const PairSumOptions pairs = coarse_pair_options(knots);
  const DistanceKnots few = coarse_knots(knots);
  const Eigen::MatrixXd r = scaled_curves(media, few, eta);
  // One medium at a time: its digits do not depend on the others. The scale is that of the
  // measurement, not of the light itself.
  const SourceCloud direct_light(direct, center_mm);
  Eigen::MatrixXd l(static_cast<Eigen::Index>(sites.size()), r.cols());
  for (Eigen::Index m = 0; m < l.cols(); ++m) {
    l.col(m) = smooth_images(sites, direct_light, few, pairs, r.col(m)) /
               media[static_cast<std::size_t>(m)].scale;
  }
  const Eigen::MatrixXd back = OwnLight(seen, places, plane).coming_back(l);
  Eigen::MatrixXd change(l.rows(), l.cols());
  for (Eigen::Index m = 0; m < l.cols(); ++m) {
    const IncidentLight light = light_on(patches, places, once + back.col(m));
    change.col(m) = smooth_images(sites, SourceCloud(light, center_mm), few, pairs, r.col(m));
  }
  return on_rows(seen, places, change);
}

}  // namespace scattermeter
