#include "core/estimation/channel_image.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include "core/base/position_cells.h"
#include "core/diffusion/dipole_curve.h"
#include "core/fit/method_errors.h"

namespace scattermeter {
namespace {

std::vector<Eigen::Index> used_rows(const ChannelObservation& o) {
  std::vector<Eigen::Index> rows;
  rows.reserve(o.rows_used);
  for (std::size_t j = 0; j < o.state.size(); ++j) {
    if (o.state[j] == RowState::kUsed) rows.push_back(static_cast<Eigen::Index>(j));
  }
  return rows;
}

double sigma_t_per_mm(const Medium& medium) {
  return medium.sigma_s_prime_per_mm + medium.sigma_a_per_mm;
}

// A nuisance, and the squared length of the image's change by one deviation of it, in deviations of
// the rows; infinite if it is free.
struct Effect {
  Nuisance nuisance;
  double square = 0;
};

// Of one shot, from a part of its rows evenly among all.
std::vector<Effect> effects(const SceneNuisances& nuisances, const ObservedShot& shot,
                            const ChannelObservation& rows) {
  constexpr std::size_t kRows = 500;
  const std::vector<Eigen::Index> used = used_rows(rows);
  const std::size_t step = std::max<std::size_t>(1, used.size() / kRows);
  std::vector<Eigen::Index> some;
  for (std::size_t i = 0; i < used.size(); i += step) some.push_back(used[i]);
  std::vector<Effect> out;
  for (const NuisanceColumn& c : nuisances.columns(shot, rows, some)) {
    Effect& effect = out.emplace_back(Effect{c.nuisance, 0.0});
    for (std::size_t i = 0; i < some.size(); ++i) {
      const double change = c.nuisance.std * c.change[static_cast<Eigen::Index>(i)];
      effect.square += static_cast<double>(step) * change * change /
                       rows.variance[static_cast<std::size_t>(some[i])];
    }
    if (!std::isfinite(effect.square)) effect.square = std::numeric_limits<double>::infinity();
  }
  return out;
}

// The effects summed over all shots, in the order of their first occurrence. Objects may state one
// quantity, such as eta, with different deviations: the largest counts.
std::vector<Effect> summed(const std::vector<std::vector<Effect>>& of_shot) {
  std::vector<Effect> all;
  std::map<std::string, std::size_t> known;
  for (const std::vector<Effect>& list : of_shot) {
    for (const Effect& e : list) {
      const auto [it, is_new] = known.try_emplace(e.nuisance.name, all.size());
      if (is_new) all.push_back({e.nuisance, 0.0});
      Effect& effect = all[it->second];
      if (e.nuisance.std > effect.nuisance.std) effect.nuisance = e.nuisance;
      effect.square += e.square;
    }
  }
  return all;
}

// The negligible ones: the smallest, as long as their sum is negligible.
std::vector<bool> negligible_of(const std::vector<Effect>& all) {
  constexpr double kNothing = 1e-2;
  std::vector<std::size_t> by_size(all.size());
  std::iota(by_size.begin(), by_size.end(), std::size_t{0});
  std::stable_sort(by_size.begin(), by_size.end(),
                   [&](std::size_t a, std::size_t b) { return all[a].square < all[b].square; });
  double together = 0.0;
  std::vector<bool> out(all.size());
  for (const std::size_t k : by_size) {
    together += all[k].square;
    if (!(together < kNothing * kNothing)) break;
    out[k] = true;
  }
  return out;
}

// The parts of a shot by the positions of its used patches: at most 32, of at least 24 rows each;
// and cells of six to twelve.
void divide(const ObservedShot& shot, const std::vector<Eigen::Index>& used, ShotSystem& out) {
  constexpr int kLevels = 5, kMostLevels = 20;
  constexpr int kLeastRows = 24, kNeighbours = 6;
  std::vector<Eigen::Vector3d> centers_mm;
  for (const Eigen::Index j : used) {
    centers_mm.push_back(shot.seen->sites[static_cast<std::size_t>(j)].center_mm);
  }
  out.part_of_row = position_cells(centers_mm, kLevels, kLeastRows);
  out.cell_of_row = position_cells(centers_mm, kMostLevels, kNeighbours);
}

Eigen::VectorXd reflectance(const LitMedium& first, const DistanceKnots& knots,
                            double eta_int_over_ext) {
  const double sigma_t = sigma_t_per_mm(first.medium);
  return first.scale * dipole_curve(knots, std::log(sigma_t), first.medium.sigma_a_per_mm / sigma_t,
                                    eta_int_over_ext)
                           .r;
}

}  // namespace

ChannelImage::ChannelImage(const Scene& scene, const MaterialChannel& channel,
                           const ChannelRows& rows, const Weights& weights,
                           const DistanceKnots& knots, const LitMedium& first,
                           const std::map<LightKey, ChannelSensitivity>& sensitivities,
                           std::optional<double> patch_mm)
    : scene_(scene),
      channel_(channel),
      rows_(rows),
      weights_(weights),
      knots_(knots),
      first_(first),
      r_(reflectance(first, knots, channel.eta_int_over_ext)),
      scene_nuisances_(scene, channel.channel, sensitivities),
      patch_mm_(patch_mm) {
  std::vector<std::vector<Effect>> of_shot(shots());
  tbb::this_task_arena::isolate([&] {
    tbb::parallel_for(std::size_t{0}, shots(), [&](std::size_t s) {
      of_shot[s] = effects(scene_nuisances_, *channel.shots[s], rows[s]);
    });
  });
  const std::vector<Effect> all = summed(of_shot);
  const std::vector<bool> negligible = negligible_of(all);
  // Those that are stated as exact, and only tested, follow the fitted ones.
  for (const bool fitted : {true, false}) {
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (all[k].nuisance.fitted != fitted) continue;
      if (fitted && negligible[k]) {
        ++negligible_;
        continue;
      }
      index_[all[k].nuisance.name] = static_cast<Eigen::Index>(nuisances_.size());
      nuisances_.push_back(all[k].nuisance);
    }
  }
  // The errors of the method, as for a shot without rows: those of the octaves, and its own.
  DenseSystem none{WeightMatrix(0, knots.size()), Eigen::VectorXd(0), Eigen::VectorXd(0)};
  add_errors_of_method(none);
  octaves_ = static_cast<Eigen::Index>(none.nuisances.size()) - 1;
  nuisances_.insert(nuisances_.end(), static_cast<std::size_t>(octaves_) + shots(),
                    none.nuisances.front());
}

DenseSystem ChannelImage::rows_of_shot(std::size_t shot) const {
  DenseSystem system = channel_system(scene_, channel_, shot, rows_[shot], weights_,
                                      1.0 / sigma_t_per_mm(first_.medium), patch_mm_);
  const std::vector<Eigen::Index> used = used_rows(rows_[shot]);
  system.l -= scene_nuisances_.light_by_plane(*channel_.shots[shot], used);
  system.l -= scene_nuisances_.light_by_shift(*channel_.shots[shot], used);
  system.l -= scene_nuisances_.light_by_displacement(*channel_.shots[shot], used);
  system.l -= scene_nuisances_.light_by_blur(*channel_.shots[shot], used);
  add_errors_of_method(system);
  return system;
}

Eigen::VectorXd ChannelImage::light_by_plane() const {
  Eigen::VectorXd all;
  for (std::size_t s = 0; s < shots(); ++s) {
    const Eigen::VectorXd own =
        scene_nuisances_.light_by_plane(*channel_.shots[s], used_rows(rows_[s]));
    all.conservativeResize(all.size() + own.size());
    all.tail(own.size()) = own;
  }
  return all;
}

void ChannelImage::add_errors_of_method(DenseSystem& system) const {
  add_method_errors(
      knots_, r_, patch_mm_.value_or(patch_size_mm(channel_)),
      {first_.medium.sigma_s_prime_per_mm, first_.medium.sigma_a_per_mm, channel_.eta_int_over_ext},
      system);
}

ShotSystem ChannelImage::shot(std::size_t shot) const {
  auto system = std::make_shared<DenseSystem>(rows_of_shot(shot));
  const std::vector<Eigen::Index> used = used_rows(rows_[shot]);
  std::vector<NuisanceColumn> own =
      scene_nuisances_.columns(*channel_.shots[shot], rows_[shot], used);
  std::erase_if(own, [&](const NuisanceColumn& c) { return !index_.contains(c.nuisance.name); });
  // The rig's first, as in the image's list.
  const auto n_own = static_cast<Eigen::Index>(own.size());
  Eigen::MatrixXd columns(system->l.size(), n_own + system->nuisance_columns.cols());
  ShotSystem out;
  if (!used.empty()) divide(*channel_.shots[shot], used, out);
  std::vector<Nuisance> nuisances;
  std::map<Eigen::Index, const NuisanceColumn*> in_order;
  for (const NuisanceColumn& c : own) in_order[index_.at(c.nuisance.name)] = &c;
  for (const auto& [index, c] : in_order) {
    columns.col(static_cast<Eigen::Index>(nuisances.size())) = c->change;
    nuisances.push_back(nuisances_[static_cast<std::size_t>(index)]);
    out.nuisances.push_back(index);
  }
  columns.rightCols(system->nuisance_columns.cols()) = system->nuisance_columns;
  const auto first_held = static_cast<Eigen::Index>(index_.size());
  for (Eigen::Index o = 0; o < octaves_; ++o) out.nuisances.push_back(first_held + o);
  out.nuisances.push_back(first_held + octaves_ + static_cast<Eigen::Index>(shot));
  nuisances.insert(nuisances.end(), system->nuisances.begin(), system->nuisances.end());
  system->nuisance_columns = std::move(columns);
  system->nuisances = std::move(nuisances);
  out.system = std::move(system);
  return out;
}

FirstChannelImage::FirstChannelImage(const Scene& scene, const MaterialChannel& channel,
                                     const ChannelRows& rows, const Weights& weights)
    : scene_(scene),
      channel_(channel),
      rows_(rows),
      weights_(weights),
      has_ambient_(channel.shots.size()) {
  bool any = false;
  for (std::size_t s = 0; s < channel.shots.size(); ++s) {
    for (const std::string& name : channel.shots[s]->stated->lights) {
      const SceneLight& light = scene.light(name);
      if (light->is_fitted() && !light->nuisances(name, channel.channel).empty()) {
        has_ambient_[s] = any = true;
      }
    }
  }
  if (!any) return;
  nuisances_.push_back({"ambient", std::numeric_limits<double>::infinity(), true});
  std::size_t used = 0;
  for (const ChannelObservation& o : rows) {
    for (const Eigen::Index j : used_rows(o)) mean_l_ += o.l[static_cast<std::size_t>(j)];
    used += o.rows_used;
  }
  if (used > 0) mean_l_ /= static_cast<double>(used);
}

ShotSystem FirstChannelImage::shot(std::size_t shot) const {
  auto system = std::make_shared<DenseSystem>(
      channel_system(scene_, channel_, shot, rows_[shot], weights_, 0.0));
  ShotSystem out;
  if (has_ambient_[shot]) {
    system->nuisances = nuisances_;
    system->nuisance_columns = Eigen::MatrixXd::Constant(system->l.size(), 1, mean_l_);
    out.nuisances = {0};
  }
  out.system = std::move(system);
  return out;
}

}  // namespace scattermeter
