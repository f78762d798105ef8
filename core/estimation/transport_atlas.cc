#include "core/estimation/transport_atlas.h"

#include <algorithm>
#include <cmath>

#include "core/scene/surroundings.h"

namespace scattermeter {
namespace {

// Nodes, lights and channels of one seed.
constexpr std::uint64_t kNodes = 4096;
constexpr std::uint64_t kLights = 1024;

bool same(const DiffusePlane& a, const DiffusePlane& b) {
  return a.z_mm == b.z_mm && a.albedo == b.albedo && a.contact == b.contact;
}

std::uint64_t index_in(const Scene& scene, const SceneLight& light) {
  return static_cast<std::uint64_t>(&light - scene.lights.data());
}

}  // namespace

double TransportAtlas::sigma_s_per_mm(int node) { return std::exp(kSpacing * node); }

const TransportAtlas::LitView::View& TransportAtlas::view(
    const std::shared_ptr<const SeenObject>& seen, double eta_int_over_ext) {
  const auto known =
      std::find_if(views_.begin(), views_.end(), [&](const auto& v) { return v.seen == seen; });
  if (known != views_.end()) return *known;
  LitView::View& v = views_.emplace_back();
  v.seen = seen;
  v.boundary = std::make_unique<PathBoundary>(*seen->object->rays);
  v.camera.emplace(*v.boundary, seen->camera_center_mm,
                   ScatteringMedium{1.0, 0.0, 0.0, eta_int_over_ext});
  v.rows = scattering_view(*seen->patches, seen->map.patch_of_row);
  return v;
}

TransportAtlas::LitView& TransportAtlas::lit_view(const Scene& scene,
                                                  const std::shared_ptr<const SeenObject>& seen,
                                                  const SceneLight& light, std::size_t channel,
                                                  double eta_int_over_ext) {
  const DiffusePlane plane = plane_below(scene, *seen->object).in(channel);
  // An LED lights all channels alike but for its power.
  const int own = light.led() != nullptr ? -1 : static_cast<int>(channel);
  const auto known = std::find_if(lit_.begin(), lit_.end(), [&](const LitView& v) {
    return v.view_->seen == seen && v.light_ == &light && v.channel_ == own &&
           v.eta_ == eta_int_over_ext && same(v.plane_, plane);
  });
  if (known != lit_.end()) return *known;
  auto source =
      entry_above(light, *seen->object->rays, eta_int_over_ext, static_cast<int>(channel), plane);
  LitView& v = lit_.emplace_back();
  v.view_ = &view(seen, eta_int_over_ext);
  v.light_ = &light;
  v.channel_ = own;
  v.eta_ = eta_int_over_ext;
  v.plane_ = plane;
  v.source_ = std::move(source);
  v.seed_ = (static_cast<std::uint64_t>(own + 1) * kLights + index_in(scene, light)) * kNodes;
  return v;
}

std::int64_t TransportAtlas::LitView::missing_paths(int idx, int levels) const {
  const std::int64_t wanted = WhiteRows::kFirstPaths << (levels - 1);
  const auto known = nodes_.find(idx);
  const std::int64_t traced = known == nodes_.end() ? 0 : known->second.paths();
  return std::max<std::int64_t>(0, wanted - traced);
}

const WhiteRows& TransportAtlas::LitView::node(int idx, int levels) {
  WhiteRows& out =
      nodes_.try_emplace(idx, view_->rows, sigma_s_per_mm(idx), view_->boundary->size_mm())
          .first->second;
  if (out.levels() >= levels) return out;
  const ScatteringMedium medium{out.sigma_s_per_mm(), 0.0, 0.0, eta_};
  const CameraConnection camera = view_->camera->with(medium, plane_);
  const PathWorld world{*view_->boundary, medium, *source_, &camera, plane_};
  while (out.levels() < levels) {
    out.refine(world, seed_ + static_cast<std::uint64_t>(idx + static_cast<int>(kNodes / 2)));
  }
  return out;
}

}  // namespace scattermeter
