// One estimate to make: a material in a channel, from its shots.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "apps/measure.h"
#include "apps/nuisances.h"
#include "apps/shot_system.h"
#include "apps/stopwatch.h"
#include "core/linear_shot.h"

namespace scattermeter::apps {

struct Task {
  std::string material;
  std::size_t channel;
  std::vector<const OpenedShot*> shots;
  double eta = 0;
};

// Materials of the shots in the rig's order, of each those of R, G, B that `channels` holds; empty:
// all. Throws InputError where the shots of one
// material are of objects with different eta.
std::vector<Task> tasks_of(const Rig& rig, const std::vector<OpenedShot>& shots,
                           const std::string& channels = {});

// What makes a shot useless as a whole in a channel (dark, over-exposed, nothing seen); empty:
// nothing.
std::string shot_problem(const OpenedShot& shot, std::size_t channel);

// Weights by (view of an object, light, channel; 0 for an LED, whose channels share theirs).
using WeightKey = std::tuple<const SeenObject*, std::string, std::size_t>;
using Weights = std::map<WeightKey, WeightMatrix>;

// Makes W of every view and light that a shot needs, each once, several at a time; those that are
// there already stay.
void add_weights(const std::vector<OpenedShot>& shots, ObjectLibrary& library, bool quiet,
                 const std::function<WeightMatrix(const SeenObject&, const SourceCloud&)>& make,
                 Weights& weights);

// What the task's shots show in its channel, one a shot; rows are left out as the estimate learns
// more about them.
using TaskRows = std::vector<ChannelObservation>;

// As observed, without the rows that mirror a light into the camera.
TaskRows rows_of(const Rig& rig, const Task& task);

// Of the task's objects, the largest.
double patch_size_mm(const Task& task);

// The used rows of one of the task's shots under all its lights. `mean_free_path_mm`: of the
// material, for the error of patches that are not small against it; 0: not known yet. patch_mm: of
// the patches that this error is stated for, where they are others.
DenseSystem system_of(const Rig& rig, const Task& task, std::size_t shot,
                      const ChannelObservation& rows, const Weights& weights,
                      double mean_free_path_mm, std::optional<double> patch_mm = std::nullopt);
// Of all its shots, one below the other.
DenseSystem system_of(const Rig& rig, const Task& task, const TaskRows& rows,
                      const Weights& weights, double mean_free_path_mm);

// Counts of rows by what kept them out.
void report_rows(const Task& task, const TaskRows& rows, ChannelResult& result);

// The shots' rows with what the model makes of those in use. predicted, std: of the used rows of
// `rows`, shot by shot.
std::vector<ShotRows> shot_rows(const Task& task, const TaskRows& rows,
                                const Eigen::VectorXd& predicted, const Eigen::VectorXd& std);

// The knots of the library's objects: as fine as their patches allow for.
DistanceKnots smooth_knots(const ObjectLibrary& library);
// Near-field options for these knots.
PairSumOptions pair_options(const DistanceKnots& knots);
// add_weights() on smooth knots. Of the shots it needs rig and view alone.
void add_smooth_weights(const std::vector<OpenedShot>& shots, ObjectLibrary& library, bool quiet,
                        Weights& weights);

// Everything that an estimator works on.
struct Estimation {
  const Rig& rig;
  const std::vector<OpenedShot>& shots;
  const std::vector<Task>& tasks;
  ObjectLibrary& library;
  // On smooth knots, kept from one set of shots to the next.
  Weights& weights;
  ChangedWeightsByLight& changed_weights;
  const MeasureOptions& options;
  Stopwatch& watch;
  std::vector<ChannelResult>& results;  // one per task; those refused already are left alone
  bool without_noise = false;           // the shots show what is expected (dipole only)
};

// Runs `work` on every task whose result is not refused yet, in parallel, under a progress line.
void for_open_tasks(const std::string& label, const Estimation& e,
                    const std::function<void(std::size_t)>& work);

// How well the rig knows the scale: free without a responsivity.
ScalePrior scale_prior(const Rig& rig);

// What the dipole is fitted to, before it calls rows outliers.
struct DipoleSystem {
  // Of all shots; made when asked for, since it is large. As long as the estimation is there.
  std::function<DenseSystem()> system;
  DistanceKnots knots;
  std::shared_ptr<const TaskRows> rows;
  double image_in_std = 0;  // |l / std|
};

// The estimators: fill the results' estimates. systems: if given, those of the tasks that came to a
// fit.
void estimate_dipole(Estimation& e, std::vector<std::optional<DipoleSystem>>* systems = nullptr);
void estimate_transport(Estimation& e);
void estimate_paper(Estimation& e);

}  // namespace scattermeter::apps
