// A material in one channel, and the shots that show it.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/fit/estimate.h"
#include "core/scene/observed_shot.h"
#include "core/scene/scene.h"

namespace scattermeter {

struct MaterialChannel {
  std::string material;
  std::size_t channel;  // 0 R, 1 G, 2 B
  std::vector<const ObservedShot*> shots;
  double eta_int_over_ext = 0;
  PhaseFunction phase = {};
  double gamma_std = 0;  // the largest of the objects
  // The largest of the objects', too.
  double surface_alpha = 0;
  double surface_alpha_std = 0;
};

// The shots' materials in the scene's order, each in the channels of `channels` (R, G, B; empty:
// all). Throws InputError if the shots of one material show objects with different eta.
std::vector<MaterialChannel> material_channels(const Scene& scene,
                                               std::span<const ObservedShot> shots,
                                               const std::string& channels = {});

// The patch size of the channel's objects, the largest, mm.
double patch_size_mm(const MaterialChannel& channel);

// An object that is larger than its mesh by a factor 1 + s, with light and camera at the matching
// scale, looks like the mesh with coefficients that are larger by the same factor: lengths are
// known by their products with the coefficients alone. Divides both coefficients by the most
// probable factor, by mesh and image (of the pull of "NAME.size"; the mean over the shots), and
// widens deviations and 95 % intervals by the largest ObservedShot::size_relative_std() of the
// channel, common to both, which is more than the image leaves of it: where edges are cut, it may
// take that for a size. Adds the budget's line "mesh scale".
void apply_mesh_scale(const MaterialChannel& channel, Estimate& estimate);

// Whether a light of its shots is fitted along (ambient light).
bool has_fitted_light(const Scene& scene, const MaterialChannel& channel);

// Why a shot is useless as a whole in a channel (dark, over-exposed, much noisier than stated,
// nothing seen); empty: it is usable.
std::string shot_problem(const ObservedShot& shot, std::size_t channel);

}  // namespace scattermeter
