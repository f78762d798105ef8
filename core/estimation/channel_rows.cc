#include "core/estimation/channel_rows.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/fit/method_errors.h"
#include "core/scene/rough_surfaces.h"
#include "core/view/row_blur.h"
#include "core/view/row_selection.h"

namespace scattermeter {
namespace {

// Error of the predicted l of a row while the material is not known.
constexpr double kFirstNumericalStd = 5e-4;

// About the mirror direction of a light: as wide as the gloss of a satin surface.
constexpr double kMirrorCone_rad = 0.17;

LinearShot linear_shot(const Scene& scene, const MaterialChannel& channel, std::size_t shot_idx,
                       const ChannelObservation& rows, const Weights& weights,
                       double mean_free_path_mm, std::optional<double> patch_mm) {
  const ObservedShot* shot = channel.shots[shot_idx];
  LinearShot linear{{}, &rows, kFirstNumericalStd};
  if (mean_free_path_mm > 0.0) {
    linear.numerical_relative_std = row_method_error(
        patch_mm.value_or(shot->seen->patches->patch_size_mm()), mean_free_path_mm);
  }
  for (const std::string& name : shot->stated->lights) {
    const SceneLight& light = scene.light(name);
    linear.lights.push_back(
        {&weights.at({shot->seen.get(), name, light.channel_of(channel.channel)}),
         light->power()[static_cast<Eigen::Index>(channel.channel)]});
  }
  return linear;
}

// Those that blur mixes with what lies beyond the edges beside them.
void leave_out_blurred(const Scene& scene, const ObservedShot& shot, ChannelObservation& rows) {
  constexpr double kMostLeak = 5e-4;
  // Motion by 4 px, 1.2 px in standard deviation, looks like 0.8 px across slanted edges.
  constexpr double kMayBeWider = 1.4;
  if (!shot.edge_blur || shot.edge_blur->mm2.isZero(0.0)) return;
  const std::vector<double> leaked = leaked_by_blur(
      shot.seen->map, rows.l,
      kMayBeWider * shot.edge_blur->largest_std_mm() / shot.px_mm(scene.camera.intrinsics.fx_px));
  for (std::size_t j = 0; j < leaked.size(); ++j) {
    if (leaked[j] > kMostLeak) leave_out(rows, j, RowState::kEdge);
  }
}

}  // namespace

ChannelRows channel_rows(const Scene& scene, const MaterialChannel& channel) {
  ChannelRows rows;
  for (const ObservedShot* shot : channel.shots) {
    const SeenObject& seen = *shot->seen;
    ChannelObservation& o = rows.emplace_back(shot->observation.channel[channel.channel]);
    leave_out_blurred(scene, *shot, o);
    const SceneObject& object = *seen.object->stated;
    const bool is_rough = object.surface_alpha > 0.0;
    const double alpha = is_rough ? object.surface_alpha : object.surface_alpha_std;
    if (alpha > 0.0) {
      const RowGloss gloss = row_gloss(scene, *shot->stated, seen, channel.channel, alpha);
      for (std::size_t j = 0; j < o.l.size(); ++j) {
        if (is_glossy(gloss, j)) leave_out(o, j, RowState::kMirror);
      }
    }
    if (is_rough) continue;
    for (const std::string& name : shot->stated->lights) {
      const auto position_mm = scene.light(name)->position_mm();
      if (!position_mm) continue;
      for (std::size_t j = 0; j < o.l.size(); ++j) {
        if (mirrors(seen.sites[j].center_mm, seen.patches->normal(seen.map.patch_of_row[j]),
                    seen.camera_center_mm, *position_mm, kMirrorCone_rad)) {
          leave_out(o, j, RowState::kMirror);
        }
      }
    }
  }
  return rows;
}

DenseSystem channel_system(const Scene& scene, const MaterialChannel& channel, std::size_t shot,
                           const ChannelObservation& rows, const Weights& weights,
                           double mean_free_path_mm, std::optional<double> patch_mm) {
  return stack({linear_shot(scene, channel, shot, rows, weights, mean_free_path_mm, patch_mm)});
}

DenseSystem channel_system(const Scene& scene, const MaterialChannel& channel,
                           const ChannelRows& rows, const Weights& weights,
                           double mean_free_path_mm) {
  std::vector<LinearShot> shots;
  for (std::size_t i = 0; i < channel.shots.size(); ++i) {
    shots.push_back(
        linear_shot(scene, channel, i, rows[i], weights, mean_free_path_mm, std::nullopt));
  }
  return stack(shots);
}

std::vector<Eigen::Index> keep_rows(ChannelRows& rows, const StateOfRow& state_of) {
  std::vector<Eigen::Index> kept;
  Eigen::Index at = 0;
  for_used_rows(rows, [&](std::size_t s, std::size_t j) {
    const RowState state = state_of(s, j, at);
    if (state == RowState::kUsed) {
      kept.push_back(at);
    } else {
      leave_out(rows[s], j, state);
    }
    ++at;
  });
  return kept;
}

StateOfRow state_at(std::vector<Eigen::Index> numbers, RowState state) {
  return [numbers = std::move(numbers), state](std::size_t, std::size_t, Eigen::Index row) {
    return std::binary_search(numbers.begin(), numbers.end(), row) ? state : RowState::kUsed;
  };
}

void report_rows(const MaterialChannel& channel, const ChannelRows& rows, ChannelResult& result) {
  result.patches_by_state.fill(0);
  result.patches_partly_seen = 0;
  for (const ChannelObservation& o : rows) {
    for (RowState state : o.state) ++result.patches_by_state[static_cast<std::size_t>(state)];
  }
  for (const ObservedShot* shot : channel.shots) {
    result.patches_partly_seen += shot->seen->map.patches_partly_seen;
  }
}

ChannelRows every_nth(std::size_t n, ChannelRows rows) {
  keep_rows(rows, [n](std::size_t, std::size_t, Eigen::Index row) {
    return static_cast<std::size_t>(row) % n == 0 ? RowState::kUsed : RowState::kOutlier;
  });
  return rows;
}

bool leave_outliers_out(const ComparedImage& image, ChannelRows& rows) {
  const std::vector<Eigen::Index> far = outliers(image.l, image.predicted, image.std_l);
  keep_rows(rows, state_at(far, RowState::kOutlier));
  return !far.empty();
}

std::vector<ShotRows> shot_rows(const MaterialChannel& channel, const ChannelRows& rows,
                                const Eigen::VectorXd& predicted, const Eigen::VectorXd& std) {
  std::vector<ShotRows> out;
  Eigen::Index at = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const ChannelObservation& o = rows[i];
    const ObservedShot& shot = *channel.shots[i];
    ShotRows& r = out.emplace_back();
    r.file = shot.stated->file;
    r.map = {shot.seen, &shot.seen->map};
    r.observed.assign(o.l.begin(), o.l.end());
    r.state = o.state;
    r.predicted.assign(o.l.size(), std::numeric_limits<float>::quiet_NaN());
    r.std = r.predicted;
    for (std::size_t j = 0; j < o.l.size(); ++j) {
      if (o.state[j] != RowState::kUsed) continue;
      r.predicted[j] = static_cast<float>(predicted[at]);
      r.std[j] = static_cast<float>(std[at]);
      ++at;
    }
  }
  return out;
}

}  // namespace scattermeter
