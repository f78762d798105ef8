#include "core/light/plane_entry.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "core/light/choice.h"
#include "core/light/disc_light.h"
#include "core/material/fresnel.h"
#include "core/material/smooth_boundary.h"

namespace scattermeter {
namespace {

class PlaneEntry : public EntrySource {
 public:
  PlaneEntry(const RayScene& scene, const Led& led, const DiffusePlane& plane, double eta)
      : scene_(scene), led_(led), plane_(plane), eta_(eta) {
    if (led.radius_mm > 0.0) disc_.emplace(led, scene, 1.0);
    const double touching_mm = DiffusePlane::touching_mm(scene.size_mm());
    std::vector<double> weights;
    for (int f = 0; f < static_cast<int>(scene.mesh().triangles.size()); ++f) {
      const Eigen::Vector3d area = area_vector_mm2(scene.mesh(), f);
      // Area times the share of the diffuse view that the plane fills.
      const double weight = 0.5 * (area.norm() - area.z());
      const double height_mm = corners(f)[0].z() - plane.z_mm;
      const bool touches = area.normalized().z() < -1.0 + 1e-9 && height_mm < touching_mm;
      if (touches || !(weight > 1e-12 * area.norm())) continue;
      facets_.push_back(f);
      weights.push_back(weight);
    }
    choice_.emplace(weights);
  }

  std::optional<Entry> sample(double stratum, RandomStream& random) const override {
    if (facets_.empty() || !(plane_.albedo > 0.0)) return std::nullopt;
    const int f = facets_[choice_->at(stratum)];
    const Eigen::Vector3d normal = area_vector_mm2(scene_.mesh(), f).normalized();
    const Eigen::Vector3d x = even_point(corners(f), random);
    const Eigen::Vector3d toward = downwards(normal, random);
    // By rejection, so that the entries have nearly equal power.
    if (!(random.uniform() < fresnel_transmittance(eta_, normal.dot(toward)))) return std::nullopt;
    const double height_mm = std::max(0.0, x.z() - plane_.z_mm);
    Eigen::Vector3d on_plane = x + height_mm / -toward.z() * toward;
    on_plane.z() = plane_.z_mm;
    Led from = led_;
    if (disc_) from.position_mm = disc_->disc_point_mm(random.uniform(), random.uniform());
    const double e = plane_irradiance_per_mm2(scene_, from, on_plane);
    if (!(e > 0.0)) return std::nullopt;
    if (!scene_.convex() && scene_.occluded(x, normal, on_plane)) return std::nullopt;
    return Entry{x, refracted(-toward, normal, eta_), choice_->sum() * plane_.albedo * e, normal};
  }

 private:
  std::array<Eigen::Vector3d, 3> corners(int facet) const {
    const auto& t = scene_.mesh().triangles[static_cast<std::size_t>(facet)];
    return {scene_.mesh().vertices_mm[static_cast<std::size_t>(t[0])],
            scene_.mesh().vertices_mm[static_cast<std::size_t>(t[1])],
            scene_.mesh().vertices_mm[static_cast<std::size_t>(t[2])]};
  }
  // Of a Lambertian distribution about the normal, the part that points down.
  static Eigen::Vector3d downwards(const Eigen::Vector3d& normal, RandomStream& random) {
    const Eigen::Vector3d across = normal.unitOrthogonal();
    const Eigen::Vector3d along = normal.cross(across);
    for (;;) {
      const RandomStream::DiscPoint p = random.disc();
      const Eigen::Vector3d w = p.x * across + p.y * along + std::sqrt(1.0 - p.r2) * normal;
      if (w.z() < 0.0) return w;
    }
  }

  const RayScene& scene_;
  Led led_;
  DiffusePlane plane_;
  double eta_;
  std::optional<DiscLight> disc_;
  std::vector<int> facets_;  // that the plane can light
  std::optional<Choice> choice_;
};

class SumEntry : public EntrySource {
 public:
  // share: of the samples, for the second source.
  SumEntry(std::unique_ptr<EntrySource> first, std::unique_ptr<EntrySource> second, double share)
      : first_(std::move(first)), second_(std::move(second)), share_(share) {}
  std::optional<Entry> sample(double stratum, RandomStream& random) const override {
    const bool is_first = stratum < 1.0 - share_;
    const double of_samples = is_first ? 1.0 - share_ : share_;
    std::optional<Entry> entry =
        is_first ? first_->sample(stratum / of_samples, random)
                 : second_->sample((stratum - (1.0 - share_)) / of_samples, random);
    if (entry) entry->power /= of_samples;
    return entry;
  }

 private:
  std::unique_ptr<EntrySource> first_, second_;
  double share_;
};

double rough_power(const EntrySource& source) {
  constexpr int kSamples = 400;
  RandomStream random(1, 0);
  double sum = 0.0;
  for (int i = 0; i < kSamples; ++i) {
    const auto entry = source.sample((i + 0.5) / kSamples, random);
    if (entry) sum += entry->power;
  }
  return sum / kSamples;
}

}  // namespace

double plane_irradiance_per_mm2(const RayScene& scene, const Led& led,
                                const Eigen::Vector3d& on_plane_mm) {
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  const double e = led.transmitted_irradiance_per_mm2(on_plane_mm, up, 1.0);
  return e > 0.0 && !scene.occluded(on_plane_mm, up, led.position_mm) ? e : 0.0;
}

std::unique_ptr<EntrySource> plane_entry(const RayScene& scene, const Led& led,
                                         const DiffusePlane& plane, double eta_int_over_ext) {
  return std::make_unique<PlaneEntry>(scene, led, plane, eta_int_over_ext);
}

std::unique_ptr<EntrySource> led_entry_above(const RayScene& scene, const Led& led,
                                             const DiffusePlane& plane, double eta_int_over_ext) {
  auto direct = led_entry(scene, led, eta_int_over_ext);
  if (!(plane.albedo > 0.0) || !(led.position_mm.z() > plane.z_mm)) return direct;
  auto by_plane = plane_entry(scene, led, plane, eta_int_over_ext);
  const double direct_power = rough_power(*direct);
  const double plane_power = rough_power(*by_plane);
  // Not too few, whatever the rough powers are.
  constexpr double kLeast = 0.02;
  const double share =
      std::clamp(plane_power / std::max(1e-300, direct_power + plane_power), kLeast, 1.0 - kLeast);
  return std::make_unique<SumEntry>(std::move(direct), std::move(by_plane), share);
}

}  // namespace scattermeter
