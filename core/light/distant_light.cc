#include "core/light/distant_light.h"

#include <mutex>
#include <stdexcept>
#include <utility>

#include "core/light/environment_light.h"

namespace scattermeter {
namespace {

constexpr double kSmoothPatches = 60.0;  // across an object, for a simulated picture

}  // namespace

struct DistantLight::Picture {
  explicit Picture(std::function<Environment()> source) : read(std::move(source)) {}
  std::function<Environment()> read;
  std::mutex mutex;
  std::optional<ProbeTree> tree;
};

DistantLight::DistantLight(std::function<Environment()> read)
    : picture_(std::make_shared<Picture>(std::move(read))) {}

const ProbeTree& DistantLight::probe() const {
  if (!picture_) throw std::logic_error("DistantLight: no picture was given");
  const std::lock_guard lock(picture_->mutex);
  if (!picture_->tree) picture_->tree.emplace(picture_->read());
  return *picture_->tree;
}

std::vector<IncidentLight> DistantLight::illuminate(const PatchMesh& patches, const RayScene& scene,
                                                    double eta_int_over_ext,
                                                    LightUse /*use*/) const {
  const auto rgb = scattermeter::illuminate(patches, scene, probe(), eta_int_over_ext);
  return {rgb.begin(), rgb.end()};
}

std::unique_ptr<EntrySource> DistantLight::entry(const RayScene& scene, double eta_int_over_ext,
                                                 int channel) const {
  return environment_entry(scene, probe().environment(), channel, eta_int_over_ext);
}

Eigen::Array3d DistantLight::open_irradiance_W_per_mm2(const Eigen::Vector3d& normal) const {
  return radiance_W_per_mm2_sr * open_irradiance(probe(), normal, 1.0);
}

std::optional<double> DistantLight::patches_across(LightUse use) const {
  // The light is smooth but for edges that are found on any patches.
  if (use == LightUse::kRender) return kSmoothPatches;
  return std::nullopt;
}

std::vector<LightNuisance> DistantLight::nuisances(const std::string& name,
                                                   std::size_t /*channel*/) const {
  if (!(radiance_relative_std > 0.0)) return {};
  return {{name + ".power", "environment power", radiance_relative_std, {}, 1.0, 0.0}};
}

}  // namespace scattermeter
