// The rows of a material's shots in one channel, and their linear systems.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "core/estimation/channel_result.h"
#include "core/estimation/channel_weights.h"
#include "core/estimation/material_channel.h"
#include "core/fit/compared_image.h"
#include "core/fit/linear_shot.h"

namespace scattermeter {

// The observations of the shots in the channel, one per shot; the estimation excludes rows as it
// proceeds.
using ChannelRows = std::vector<ChannelObservation>;

// The observed rows, without those that mirror a light into the camera (of a rough object:
// is_glossy()).
ChannelRows channel_rows(const Scene& scene, const MaterialChannel& channel);

// The used rows of one of the shots under all its lights. `mean_free_path_mm`: of the material, for
// the error of patches that are not small compared with it; 0: not known yet. patch_mm: the patch
// size for this error, if not the channel's.
DenseSystem channel_system(const Scene& scene, const MaterialChannel& channel, std::size_t shot,
                           const ChannelObservation& rows, const Weights& weights,
                           double mean_free_path_mm, std::optional<double> patch_mm = std::nullopt);
// The same for all its shots, one below the other.
DenseSystem channel_system(const Scene& scene, const MaterialChannel& channel,
                           const ChannelRows& rows, const Weights& weights,
                           double mean_free_path_mm);

// f(shot, row of its map) for every used row, shot by shot.
template <class F>
void for_used_rows(const ChannelRows& rows, const F& f) {
  for (std::size_t s = 0; s < rows.size(); ++s) {
    for (std::size_t j = 0; j < rows[s].state.size(); ++j) {
      if (rows[s].state[j] == RowState::kUsed) f(s, j);
    }
  }
}

// Of a used row: shot, row of its map, row among those used so far.
using StateOfRow = std::function<RowState(std::size_t, std::size_t, Eigen::Index)>;
// Gives the used rows these states. Returns those that stay in use, by their number among those
// used so far.
std::vector<Eigen::Index> keep_rows(ChannelRows& rows, const StateOfRow& state_of);
// For keep_rows(): the used rows of these numbers, in ascending order, get that state.
StateOfRow state_at(std::vector<Eigen::Index> numbers, RowState state);

// Counts the rows by state.
void report_rows(const MaterialChannel& channel, const ChannelRows& rows, ChannelResult& result);

// With every n-th of the used rows in use, evenly among all; the others count as outliers.
ChannelRows every_nth(std::size_t n, ChannelRows rows);

// Leaves out those used rows that are far from what the model predicts of them (outliers()), and
// returns whether there were any. image: of the used rows, shot by shot.
bool leave_outliers_out(const ComparedImage& image, ChannelRows& rows);

// The shots' rows with the model's predictions for those used. predicted, std: of the used rows of
// `rows`, shot by shot.
std::vector<ShotRows> shot_rows(const MaterialChannel& channel, const ChannelRows& rows,
                                const Eigen::VectorXd& predicted, const Eigen::VectorXd& std);

}  // namespace scattermeter
