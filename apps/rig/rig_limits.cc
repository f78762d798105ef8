#include "apps/rig/rig_limits.h"

#include <fmt/core.h>

#include "apps/rig/yaml_field.h"

namespace scattermeter::apps {
namespace {

constexpr double kMostItems = 2e9;  // near the largest int

}  // namespace

RigLimits read_limits(const YamlField& top) {
  RigLimits limits;
  const auto field = top.find("limits");
  if (!field) return limits;
  field->only({"raw_megapixels", "probe_megapixels", "mesh_triangles"});
  const auto megapixels = [&](const char* key, double* limit) {
    if (const auto f = field->find(key)) *limit = f->number(1e-6, 1e-6 * kMostItems);
  };
  megapixels("raw_megapixels", &limits.raw_megapixels);
  megapixels("probe_megapixels", &limits.probe_megapixels);
  if (const auto f = field->find("mesh_triangles"))
    limits.mesh_triangles = f->number(1, kMostItems);
  return limits;
}

void check_image_size(const YamlField& image_size_px, const RigLimits& limits) {
  const double pixels = image_size_px.items()[0].number() * image_size_px.items()[1].number();
  if (1e-6 * pixels > limits.raw_megapixels) {
    image_size_px.fail(
        fmt::format("more than the allowed {} megapixels (limits.raw_megapixels of the rig)",
                    limits.raw_megapixels));
  }
}

}  // namespace scattermeter::apps
