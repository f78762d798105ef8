#include "apps/bench_transport/lit_body.h"

#include <utility>

#include "apps/simulation/bodies_rig.h"
#include "calib/pose/shot_pose.h"
#include "core/estimation/transport_pilot.h"
#include "core/scene/surroundings.h"

namespace scattermeter::apps {

LitBody::LitBody(const std::string& body, const LitBodyOptions& options)
    : rig_(bodies_rig(options.image_width_px, kEta, {{"medium", {}}}, {body})) {
  rig_.scene.shots.resize(1);
  rig_.scene.objects.front().phase = options.g;
  objects_ = bodies_scenes(rig_);
  const PoseResult pose = calib::pose_from_points(rig_.scene, rig_.pose);
  const CameraView camera{rig_.scene.camera.intrinsics, pose.camera_from_world};
  lit_.emplace(rig_.scene, objects_, options.patch_size_mm,
               (camera.center_in_world_mm() - objects_.at(body).box.center_mm()).norm());
  ObservedShot& shot = shots_.emplace_back();
  shot.stated = &rig_.scene.shots.front();
  shot.seen = see(rig_.scene, objects_, *lit_, body, pose);
  shot.pose = pose;
  channel_ = material_channels(rig_.scene, shots_, "R").front();
  const SampleMap& map = shot.seen->map;
  ChannelObservation& rows = rows_.emplace_back();
  for (std::size_t j = 0; j < map.patch_of_row.size(); ++j) {
    const bool whole = map.guarded_of_row[j] == 0;
    rows.state.push_back(whole ? RowState::kUsed : RowState::kEdge);
    if (!whole) continue;
    patches_.push_back(map.patch_of_row[j]);
    center_mm_.push_back(shot.seen->patches->center_mm(patches_.back()));
  }
  area_mm2_.resize(n_rows());
  for (Eigen::Index row = 0; row < n_rows(); ++row) {
    area_mm2_[row] = shot.seen->patches->area_mm2(patches_[static_cast<std::size_t>(row)]);
  }
}

TransportAtlas::LitView& LitBody::in(TransportAtlas& atlas) const {
  return atlas.lit_view(rig_.scene, *shots_.front().seen, rig_.scene.lights.front(),
                        channel_.channel, {channel_.eta_int_over_ext, channel_.phase});
}

ChannelSimulation LitBody::simulation(TransportAtlas& atlas) const {
  ChannelSimulation out(rig_.scene, channel_, atlas);
  out.set_rows(rows_);
  return out;
}

ScatteringImage LitBody::dipole(const ScatteringPoint& at) {
  if (weights_.size() == 0) {
    Weights weights;
    add_smooth_weights(rig_.scene, shots_, *lit_, nullptr, weights);
    const WeightMatrix& all = weights.begin()->second;
    weights_.resize(n_rows(), all.cols());
    const double power = rig_.scene.lights.front()->power()[0];
    Eigen::Index row = 0;
    for (std::size_t j = 0; j < rows_.front().state.size(); ++j) {
      if (rows_.front().state[j] != RowState::kUsed) continue;
      weights_.row(row++) = power * all.row(static_cast<Eigen::Index>(j));
    }
  }
  return dipole_pilot(weights_, smooth_knots(*lit_), at, channel_.eta_int_over_ext);
}

std::array<Eigen::VectorXd, 2> LitBody::halves_at_node(TransportAtlas& atlas, int node,
                                                       double sigma_a_per_mm,
                                                       std::int64_t paths) const {
  TransportAtlas::LitView& lit = in(atlas);
  const std::shared_ptr<const WhiteRows> at =
      lit.node(node, WhiteRows::levels_for(static_cast<double>(paths)));
  const Eigen::VectorXd l = at->light(sigma_a_per_mm).l;
  const Eigen::VectorXd off = at->departures(sigma_a_per_mm).second_half.l;
  const double power =
      rig_.scene.lights.front()->power()[static_cast<Eigen::Index>(channel_.channel)];
  std::array<Eigen::VectorXd, 2> out{Eigen::VectorXd(n_rows()), Eigen::VectorXd(n_rows())};
  for (Eigen::Index row = 0; row < n_rows(); ++row) {
    const Eigen::Index of_view = lit.row_of_patch(patches_[static_cast<std::size_t>(row)]);
    out[0][row] = power * (l[of_view] - off[of_view]);
    out[1][row] = power * (l[of_view] + off[of_view]);
  }
  return out;
}

LitBody::Traced LitBody::traced(const Medium& medium, std::uint64_t seed, int blocks) const {
  const SeenObject& seen = *shots_.front().seen;
  const SceneLight& light = rig_.scene.lights.front();
  const DiffusePlane plane = plane_below(rig_.scene, *seen.object).in(channel_.channel);
  const ScatteringMedium of_paths =
      scattering_medium({medium.sigma_s_prime_per_mm, medium.sigma_a_per_mm, kEta}, channel_.phase);
  const auto source =
      entry_above(light, *seen.object->rays, kEta, static_cast<int>(channel_.channel), plane);
  const PathBoundary boundary(*seen.object->rays);
  const CameraConnection camera =
      CameraConnection(boundary, seen.camera_center_mm, of_paths).with(of_paths, plane);
  const ScatteringView view = scattering_view(*seen.patches, patches_);
  ScatteringSum sum(view, Eigen::MatrixXd(0, view.n_rows));
  PathOptions options;
  options.seed = seed;
  options.paths_per_block = static_cast<int>(ChannelSimulation::kBlockPaths);
  sum.trace({boundary, of_paths, *source, &camera, plane}, options, blocks);
  Traced out{sum.image(), sum.audit()};
  const double power = light->power()[static_cast<Eigen::Index>(channel_.channel)];
  for (Eigen::VectorXd* v : {&out.image.l, &out.image.per_log_sigma_s, &out.image.per_sigma_a}) {
    *v *= power;
  }
  out.image.variance *= power * power;
  return out;
}

}  // namespace scattermeter::apps
