#include "core/estimation/channel_simulation.h"

#include <algorithm>
#include <iterator>
#include <string>

#include "core/scene/surroundings.h"

namespace scattermeter {

ChannelSimulation::ChannelSimulation(const Scene& scene, const MaterialChannel& channel)
    : channel_(channel) {
  for (std::size_t s = 0; s < channel.shots.size(); ++s) {
    const ObservedShot& shot = *channel.shots[s];
    const SeenObject& seen = *shot.seen;
    const auto [view, is_new] = views_.try_emplace(&seen);
    if (is_new) {
      view->second.boundary = std::make_unique<PathBoundary>(*seen.object->rays);
      view->second.camera.emplace(*view->second.boundary, seen.camera_center_mm,
                                  ScatteringMedium{1.0, 0.0, 0.0, channel.eta_int_over_ext});
      view->second.plane = plane_below(scene, *seen.object).in(channel.channel);
      view->second.rows = scattering_view(*seen.patches, seen.map.patch_of_row);
    }
    for (const std::string& name : shot.stated->lights) {
      const SceneLight& light = scene.light(name);
      const double power = light->power()[static_cast<Eigen::Index>(channel.channel)];
      if (!(power > 0.0)) continue;
      auto known = std::find_if(lit_.begin(), lit_.end(), [&](const LitView& v) {
        return v.seen == &seen && v.light == &light;
      });
      if (known == lit_.end()) {
        lit_.push_back({&seen,
                        &light,
                        &view->second,
                        entry_above(light, *seen.object->rays, channel.eta_int_over_ext,
                                    static_cast<int>(channel.channel), view->second.plane),
                        power,
                        {},
                        {}});
        known = std::prev(lit_.end());
      }
      known->shots.push_back(s);
    }
  }
}

void ChannelSimulation::set_rows(const ChannelRows& rows) {
  area_mm2_.clear();
  center_mm_.clear();
  for (LitView& v : lit_) v.rows.clear();
  Eigen::Index at = 0;
  for (std::size_t s = 0; s < channel_.shots.size(); ++s) {
    const SeenObject& seen = *channel_.shots[s]->seen;
    std::vector<std::pair<Eigen::Index, Eigen::Index>> pairs;
    for (std::size_t j = 0; j < rows[s].state.size(); ++j) {
      if (rows[s].state[j] != RowState::kUsed) continue;
      pairs.emplace_back(at++, static_cast<Eigen::Index>(j));
      const int patch = seen.map.patch_of_row[j];
      area_mm2_.push_back(seen.patches->area_mm2(patch));
      center_mm_.push_back(seen.patches->center_mm(patch));
    }
    for (LitView& v : lit_) {
      for (const std::size_t own : v.shots) {
        if (own == s) v.rows.insert(v.rows.end(), pairs.begin(), pairs.end());
      }
    }
  }
}

ChannelSimulation::Draw ChannelSimulation::draw(const Eigen::MatrixXd& projection) {
  Draw out;
  out.seed = 1000 * ++draws_;
  out.n_projected = projection.rows();
  for (const LitView& v : lit_) {
    Eigen::MatrixXd own = Eigen::MatrixXd::Zero(projection.rows(), v.view->rows.n_rows);
    for (const auto& [row, view_row] : v.rows) own.col(view_row) += v.power * projection.col(row);
    std::vector<Eigen::Index>& touched = out.projected.emplace_back();
    for (Eigen::Index k = 0; k < own.rows(); ++k) {
      if (!own.row(k).isZero(0.0)) touched.push_back(k);
    }
    out.of_light.emplace_back(v.view->rows, own(touched, Eigen::all));
  }
  return out;
}

void ChannelSimulation::trace(Draw& draw, const ScatteringPoint& at, int blocks) const {
  const ScatteringMedium medium{at.sigma_s_per_mm, at.sigma_a_per_mm, 0.0,
                                channel_.eta_int_over_ext};
  for (std::size_t i = 0; i < lit_.size(); ++i) {
    const LitView& v = lit_[i];
    const CameraConnection camera = v.view->camera->with(medium, v.view->plane);
    PathOptions options;
    options.seed = draw.seed + i;
    draw.of_light[i].trace({*v.view->boundary, medium, *v.source, &camera, v.view->plane}, options,
                           blocks);
  }
}

ScatteringImage ChannelSimulation::image(const Draw& draw) const {
  ScatteringImage out;
  out.l = out.per_log_sigma_s = out.per_sigma_a = out.variance = Eigen::VectorXd::Zero(n_rows());
  for (std::size_t i = 0; i < lit_.size(); ++i) {
    const LitView& v = lit_[i];
    const ScatteringImage own = draw.of_light[i].image();
    for (const auto& [row, view_row] : v.rows) {
      out.l[row] += v.power * own.l[view_row];
      out.per_log_sigma_s[row] += v.power * own.per_log_sigma_s[view_row];
      out.per_sigma_a[row] += v.power * own.per_sigma_a[view_row];
      out.variance[row] += v.power * v.power * own.variance[view_row];
    }
  }
  return out;
}

Eigen::MatrixXd ChannelSimulation::covariance(const Draw& draw) {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(draw.n_projected, draw.n_projected);
  for (std::size_t i = 0; i < draw.of_light.size(); ++i) {
    out(draw.projected[i], draw.projected[i]) += draw.of_light[i].projected_covariance();
  }
  return out;
}

}  // namespace scattermeter
