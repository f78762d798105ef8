// The rows of a material's shots in one channel, and the linear systems that they make.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "core/estimation/channel_result.h"
#include "core/estimation/channel_weights.h"
#include "core/estimation/material_channel.h"
#include "core/fit/linear_shot.h"

namespace scattermeter {

// What the shots show in the channel, one a shot; rows are left out as the estimate learns more
// about them.
using ChannelRows = std::vector<ChannelObservation>;

// As observed, without the rows that mirror a light into the camera.
ChannelRows channel_rows(const Scene& scene, const MaterialChannel& channel);

// The used rows of one of the shots under all its lights. `mean_free_path_mm`: of the material, for
// the error of patches that are not small against it; 0: not known yet. patch_mm: of the patches
// that this error is stated for, where they are others.
DenseSystem channel_system(const Scene& scene, const MaterialChannel& channel, std::size_t shot,
                           const ChannelObservation& rows, const Weights& weights,
                           double mean_free_path_mm, std::optional<double> patch_mm = std::nullopt);
// Of all its shots, one below the other.
DenseSystem channel_system(const Scene& scene, const MaterialChannel& channel,
                           const ChannelRows& rows, const Weights& weights,
                           double mean_free_path_mm);

// Counts rows by what kept them out.
void report_rows(const MaterialChannel& channel, const ChannelRows& rows, ChannelResult& result);

// The shots' rows with what the model makes of those in use. predicted, std: of the used rows of
// `rows`, shot by shot.
std::vector<ShotRows> shot_rows(const MaterialChannel& channel, const ChannelRows& rows,
                                const Eigen::VectorXd& predicted, const Eigen::VectorXd& std);

}  // namespace scattermeter
