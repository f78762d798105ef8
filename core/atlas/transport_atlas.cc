#include "core/atlas/transport_atlas.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/random_stream.h"
#include "core/scene/surroundings.h"

namespace scattermeter {
namespace {

// Nodes, lights and channels of one seed.
constexpr std::uint64_t kNodes = 4096;
constexpr std::uint64_t kLights = 1024;
// Raised whenever the same seed gives other paths, or paths other scores.
constexpr double kPathsVersion = 2.0;

bool same(const DiffusePlane& a, const DiffusePlane& b) {
  return a.z_mm == b.z_mm && a.albedo == b.albedo && a.contact == b.contact;
}

std::uint64_t index_in(const Scene& scene, const SceneLight& light) {
  return static_cast<std::uint64_t>(&light - scene.lights.data());
}

// Seen from the object.
bool are_near(const ObjectScene& object, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Vector3d from = object.box.center_mm();
  return (a - b).norm() <= TransportAtlas::kNearViews * (a - from).norm();
}

// Of the paths seen from a direction: views that do not share nodes must not share random numbers
// either, as the errors of different nodes count as independent. From the direction in steps well
// above rounding, so that the same view has the same paths on every machine.
std::uint64_t seed_of_view(std::uint64_t seed, const ObjectScene& object,
                           const Eigen::Vector3d& camera_mm) {
  constexpr double kStep = TransportAtlas::kNearViews / 2.0;
  constexpr std::uint64_t kSteps = 4096;  // from -1 to 1
  static_assert(2.0 / kStep < kSteps);
  std::uint64_t view = 0;
  for (const double d : (camera_mm - object.box.center_mm()).normalized()) {
    view = view * kSteps + static_cast<std::uint64_t>(std::llround((d + 1.0) / kStep));
  }
  return RandomStream(seed, view).bits();
}

// Those exactly from the side included, as rounding may show them.
std::vector<int> facing(const PatchMesh& patches, const Eigen::Vector3d& camera_mm) {
  constexpr double kGrazing = -1e-9;
  std::vector<int> out;
  for (int p = 0; p < patches.size(); ++p) {
    const Eigen::Vector3d to_camera = camera_mm - patches.center_mm(p);
    if (patches.normal(p).dot(to_camera) > kGrazing * to_camera.norm()) out.push_back(p);
  }
  return out;
}

// From which the paths follow. A light is told by where it enters: the first of its samples stand
// for its position, lobe or picture, and for the plane that it may come by.
std::vector<double> numbers_of(const TriangleMesh& mesh, const PatchMesh& patches,
                               const AtlasMedium& medium, const DiffusePlane& plane,
                               const EntrySource& source, std::uint64_t seed) {
  constexpr int kSamples = 512;
  std::vector<double> n = {kPathsVersion,
                           WhiteRows::kFirstPaths,
                           WhiteRows::kBatches,
                           TransportAtlas::kSpacing,
                           medium.eta_int_over_ext,
                           patches.patch_size_mm(),
                           plane.z_mm,
                           plane.albedo,
                           static_cast<double>(plane.contact),
                           static_cast<double>(seed)};
  const auto add = [&](const auto& v) { n.insert(n.end(), v.begin(), v.end()); };
  if (!medium.phase.is_isotropic()) add(medium.phase.numbers());
  if (medium.surface_alpha > 0.0) n.push_back(medium.surface_alpha);
  for (const Eigen::Vector3d& v : mesh.vertices_mm) add(v);
  for (const auto& facet : mesh.triangles) n.insert(n.end(), facet.begin(), facet.end());
  RandomStream random(seed, 0);
  for (int i = 0; i < kSamples; ++i) {
    const std::optional<Entry> entry = source.sample((i + 0.5) / kSamples, random);
    n.push_back(entry ? entry->power : 0.0);
    if (!entry) continue;
    add(entry->position_mm);
    add(entry->direction);
  }
  return n;
}

}  // namespace

double TransportAtlas::sigma_s_per_mm(int node) { return std::exp(kSpacing * node); }

bool TransportAtlas::LitView::View::shows(const SeenObject& seen, const AtlasMedium& medium) const {
  return object == seen.object && patches == seen.patches && eta == medium.eta_int_over_ext &&
         surface_alpha == medium.surface_alpha &&
         are_near(*object, center_mm, seen.camera_center_mm) &&
         std::all_of(seen.map.patch_of_row.begin(), seen.map.patch_of_row.end(), [&](int patch) {
           return rows.row_of_patch[static_cast<std::size_t>(patch)] >= 0;
         });
}

const TransportAtlas::View& TransportAtlas::view(const SeenObject& seen,
                                                 const Eigen::Vector3d& center_mm,
                                                 const AtlasMedium& medium) {
  const auto known = std::find_if(views_.begin(), views_.end(), [&](const View& v) {
    return v.center_mm == center_mm && v.shows(seen, medium);
  });
  if (known != views_.end()) return *known;
  View& v = views_.emplace_back();
  v.object = seen.object;
  v.patches = seen.patches;
  v.eta = medium.eta_int_over_ext;
  v.surface_alpha = medium.surface_alpha;
  v.center_mm = center_mm;
  v.boundary = std::make_unique<PathBoundary>(*seen.object->rays);
  v.camera.emplace(*v.boundary, center_mm, ScatteringMedium{1.0, 0.0, 0.0, v.eta, v.surface_alpha});
  v.rows = scattering_view(*seen.patches, facing(*seen.patches, center_mm));
  return v;
}

TransportAtlas::LitView& TransportAtlas::lit_view(const Scene& scene, const SeenObject& seen,
                                                  const SceneLight& light, std::size_t channel,
                                                  const AtlasMedium& medium) {
  const std::scoped_lock lock(in_use_);
  const double eta_int_over_ext = medium.eta_int_over_ext;
  const DiffusePlane plane = plane_below(scene, *seen.object).in(channel);
  // An LED lights all channels alike but for its power.
  const int own = light.led() != nullptr ? -1 : static_cast<int>(channel);
  const auto known = std::find_if(lit_.begin(), lit_.end(), [&](const LitView& v) {
    return v.view_->shows(seen, medium) && v.light_ == &light && v.channel_ == own &&
           v.phase_ == medium.phase && same(v.plane_, plane);
  });
  if (known != lit_.end()) return *known;
  LitView v;
  v.in_use_ = &in_use_;
  v.source_ = entry_above(light, *seen.object->rays, eta_int_over_ext, static_cast<int>(channel),
                          plane, medium.surface_alpha);
  v.light_ = &light;
  v.phase_ = medium.phase;
  v.channel_ = own;
  v.plane_ = plane;
  v.seed_ = (static_cast<std::uint64_t>(own + 1) * kLights + index_in(scene, light)) * kNodes;
  // From the nearest centre in the store that shows all that is seen, or else from this one.
  std::vector<Eigen::Vector3d> centers;
  if (store_) {
    v.store_ = store_.get();
    v.body_ = store_->name(
        numbers_of(seen.object->rays->mesh(), *seen.patches, medium, plane, *v.source_, v.seed_));
    centers = store_->centers_mm(v.body_);
    std::erase_if(centers, [&](const Eigen::Vector3d& c) {
      return !are_near(*seen.object, c, seen.camera_center_mm);
    });
    std::sort(centers.begin(), centers.end(), [&](const auto& a, const auto& b) {
      return (a - seen.camera_center_mm).norm() < (b - seen.camera_center_mm).norm();
    });
  }
  centers.push_back(seen.camera_center_mm);
  for (const Eigen::Vector3d& center : centers) {
    v.view_ = &view(seen, center, medium);
    if (v.view_->shows(seen, medium)) break;
  }
  v.seed_ = seed_of_view(v.seed_, *seen.object, v.view_->center_mm);
  return lit_.emplace_back(std::move(v));
}

// With the paths that are in the store.
const std::shared_ptr<WhiteRows>& TransportAtlas::LitView::known_node(int idx) const {
  std::shared_ptr<WhiteRows>& node = nodes_[idx];
  if (node) return node;
  node = std::make_shared<WhiteRows>(view_->rows, sigma_s_per_mm(idx), view_->boundary->size_mm());
  if (store_ == nullptr) return node;
  const auto is_farther = [&](const auto& a, const auto& b) {
    // Those that somebody holds come last.
    return std::pair(a.second.use_count() == 1, std::abs(a.first - idx)) <
           std::pair(b.second.use_count() == 1, std::abs(b.first - idx));
  };
  while (nodes_.size() > kHeldNodes) {
    const auto farthest = std::max_element(nodes_.begin(), nodes_.end(), is_farther);
    if (farthest->second.use_count() > 1 || farthest->first == idx) break;
    nodes_.erase(farthest);
  }
  if (auto sums = store_->find(body_, view_->center_mm, idx)) node->take(std::move(*sums));
  return node;
}

std::int64_t TransportAtlas::LitView::missing_paths(int idx, int levels) const {
  const std::scoped_lock lock(*in_use_);
  return std::max<std::int64_t>(0, WhiteRows::paths_of(levels) - known_node(idx)->paths());
}

std::shared_ptr<const WhiteRows> TransportAtlas::LitView::node(int idx, int levels) {
  const std::scoped_lock lock(*in_use_);
  const std::shared_ptr<WhiteRows> out = known_node(idx);
  if (out->levels() >= levels) return out;
  const ScatteringMedium medium =
      scattering_medium({out->sigma_s_per_mm(), 0.0, view_->eta}, phase_, view_->surface_alpha);
  const CameraConnection camera = view_->camera->with(medium, plane_);
  const PathWorld world{*view_->boundary, medium, *source_, &camera, plane_};
  const std::uint64_t seed = seed_ + static_cast<std::uint64_t>(idx + static_cast<int>(kNodes / 2));
  while (out->levels() < levels) out->refine(world, seed);
  if (store_ != nullptr) store_->keep(body_, view_->center_mm, idx, out->sums());
  return out;
}

}  // namespace scattermeter
