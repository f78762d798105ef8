#include "core/light/entry_source.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Geometry>

#include "core/light/choice.h"
#include "core/light/disc_light.h"
#include "core/material/fresnel.h"
#include "core/material/smooth_boundary.h"

namespace scattermeter {
namespace {

// Patches across the object over which an LED's light is taken as uniform when positions are
// sampled; the power of a sample compensates for the difference.
constexpr double kPatches = 32.0;

class LedEntry : public EntrySource {
 public:
  LedEntry(const RayScene& scene, const Led& led, double eta)
      : scene_(scene), led_(led), eta_(eta), patches_(scene.mesh(), scene.size_mm() / kPatches) {
    if (led.radius_mm > 0.0) disc_.emplace(led, scene, eta);
    std::vector<double> weights;
    for (int k = 0; k < patches_.size(); ++k) {
      const double w = weight(k);
      if (!(w > 0.0)) continue;
      lit_.push_back(k);
      weights.push_back(w);
    }
    choice_.emplace(weights);
  }

  std::optional<Entry> sample(double stratum, RandomStream& random) const override {
    if (lit_.empty()) return std::nullopt;
    const std::size_t i = choice_->at(stratum);
    const int k = lit_[i];
    const Eigen::Vector3d x = even_point(patches_.corners_mm(k), random);
    const Eigen::Vector3d& facet_normal = patches_.normal(k);
    const Eigen::Vector3d normal = patches_.normal_at(k, x);
    Led from = led_;
    if (disc_) from.position_mm = disc_->disc_point_mm(random.uniform(), random.uniform());
    const double e = from.transmitted_irradiance_per_mm2(x, normal, eta_);
    if (!(e > 0.0) || scene_.occluded(x, facet_normal, from.position_mm)) return std::nullopt;
    return Entry{x, refracted((x - from.position_mm).normalized(), normal, eta_),
                 e * patches_.area_mm2(k) / choice_->probability(i), facet_normal};
  }

 private:
  // Approximate power on a patch; above zero wherever any part of it may be lit.
  double weight(int k) const {
    const auto corners = patches_.corners_mm(k);
    const Eigen::Vector3d center = patches_.center_mm(k);
    double mean = 0.0;
    double floor = 0.0;
    const auto add = [&](const Eigen::Vector3d& position_mm, double share) {
      Led from = led_;
      from.position_mm = position_mm;
      mean += share * 0.75 *
              from.transmitted_irradiance_per_mm2(center, patches_.normal_at(k, center), eta_);
      for (const Eigen::Vector3d& p : corners) {
        const Eigen::Vector3d normal = patches_.normal_at(k, p);
        mean += share / 12.0 * from.transmitted_irradiance_per_mm2(p, normal, eta_);
        if (normal.dot(position_mm - p) > 0.0) {
          floor = std::max(floor, 1e-3 / (position_mm - p).squaredNorm());
        }
      }
    };
    if (disc_) {
      for (double u : {0.0, 0.5, 1.0}) {
        for (double v : {0.0, 0.5, 1.0}) add(disc_->disc_point_mm(u, v), 1.0 / 9.0);
      }
    } else {
      add(led_.position_mm, 1.0);
    }
    // The floor is for the edge of a lobe and for a plane through the disc.
    return patches_.area_mm2(k) * (mean > 2.0 * floor ? mean : mean + 0.1 * floor);
  }

  const RayScene& scene_;
  Led led_;
  double eta_;
  PatchMesh patches_;
  std::optional<DiscLight> disc_;
  std::vector<int> lit_;
  std::optional<Choice> choice_;
};

class EnvironmentEntry : public EntrySource {
 public:
  EnvironmentEntry(const RayScene& scene, const Environment& environment, int channel, double eta)
      : scene_(scene),
        environment_(environment),
        eta_(eta),
        map_(environment.projection, environment.width_px, environment.height_px) {
    std::vector<double> area;
    for (int f = 0; f < static_cast<int>(scene.mesh().triangles.size()); ++f) {
      area.push_back(area_vector_mm2(scene.mesh(), f).norm());
    }
    facet_.emplace(area);
    std::vector<double> flux;
    for (int y = 0; y < environment.height_px; ++y) {
      for (int x = 0; x < environment.width_px; ++x) {
        const auto i =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(environment.width_px) +
            static_cast<std::size_t>(x);
        solid_angle_sr_.push_back(map_.solid_angle_sr(
            {static_cast<double>(x), static_cast<double>(y), x + 1.0, y + 1.0}));
        flux.push_back(solid_angle_sr_.back() *
                       environment.radiance[3 * i + static_cast<std::size_t>(channel)]);
      }
    }
    pixel_.emplace(flux);
  }

  std::optional<Entry> sample(double stratum, RandomStream& random) const override {
    if (!(pixel_->sum() > 0.0)) return std::nullopt;
    const std::size_t f = facet_->at(stratum);
    const std::size_t i = pixel_->at(random.uniform());
    const auto width = static_cast<std::size_t>(environment_.width_px);
    const double px = static_cast<double>(i % width) + random.uniform();
    const double py = static_cast<double>(i / width) + random.uniform();
    const Eigen::Vector3d toward = environment_.world_from_probe * map_.direction(px, py);
    const Eigen::Vector3d normal = area_vector_mm2(scene_.mesh(), static_cast<int>(f)).normalized();
    const double cosine = normal.dot(toward);
    // By rejection, so that the entries have nearly equal power.
    if (!(random.uniform() < cosine * fresnel_transmittance(eta_, cosine))) return std::nullopt;
    const auto& t = scene_.mesh().triangles[f];
    const Eigen::Vector3d x =
        even_point({scene_.mesh().vertices_mm[static_cast<std::size_t>(t[0])],
                    scene_.mesh().vertices_mm[static_cast<std::size_t>(t[1])],
                    scene_.mesh().vertices_mm[static_cast<std::size_t>(t[2])]},
                   random);
    if (scene_.occluded_toward(x, normal, toward)) return std::nullopt;
    // Solid angle varies over a pixel: that of a small square there over the mean.
    constexpr double kHalf = 5e-4;
    const double local = map_.solid_angle_sr({px - kHalf, py - kHalf, px + kHalf, py + kHalf}) /
                         (4.0 * kHalf * kHalf * solid_angle_sr_[i]);
    return Entry{x, refracted(-toward, normal, eta_), facet_->sum() * pixel_->sum() * local,
                 normal};
  }

 private:
  const RayScene& scene_;
  const Environment& environment_;
  double eta_;
  ProbeMap map_;
  std::vector<double> solid_angle_sr_;
  std::optional<Choice> facet_;
  std::optional<Choice> pixel_;
};

class BeamEntry : public EntrySource {
 public:
  explicit BeamEntry(const Beam& beam) : beam_(beam) {}
  std::optional<Entry> sample(double stratum, RandomStream& random) const override {
    return Entry{beam_.corner_mm + stratum * beam_.side1_mm + random.uniform() * beam_.side2_mm,
                 beam_.direction, 1.0, Eigen::Vector3d::Zero()};
  }

 private:
  Beam beam_;
};

}  // namespace

std::unique_ptr<EntrySource> led_entry(const RayScene& scene, const Led& led,
                                       double eta_int_over_ext) {
  return std::make_unique<LedEntry>(scene, led, eta_int_over_ext);
}

std::unique_ptr<EntrySource> environment_entry(const RayScene& scene,
                                               const Environment& environment, int channel,
                                               double eta_int_over_ext) {
  return std::make_unique<EnvironmentEntry>(scene, environment, channel, eta_int_over_ext);
}

std::unique_ptr<EntrySource> beam_entry(const Beam& beam) {
  return std::make_unique<BeamEntry>(beam);
}

}  // namespace scattermeter
