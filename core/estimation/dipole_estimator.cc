// --model dipole: the dipole, fitted with all uncertain quantities of the setup.
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include <oneapi/tbb/parallel_for.h>

#include "core/agreement/shot_agreement.h"
#include "core/estimation/channel_image.h"
#include "core/estimation/contradictions.h"
#include "core/estimation/estimation.h"
#include "core/estimation/material_channel.h"
#include "core/estimation/model_choice.h"
#include "core/estimation/residual_look.h"
#include "core/estimation/sensitivities.h"
#include "core/fit/dipole_fit.h"
#include "core/fit/dipole_misfit.h"
#include "core/fit/image_information.h"
#include "core/fit/smooth_reflectance.h"
#include "core/nuisances/nuisances.h"
#include "core/view/row_selection.h"

namespace scattermeter {
namespace {

// The state of the estimation of one material and channel.
struct Work {
  ChannelRows rows;
  bool estimated = false;                              // there is a first estimate
  bool far_off = false;                                // which misses the image by per cents
  bool settled = false;                                // another round would not change it
  JointPulls joint_pulls;                              // known from other channels
  std::shared_ptr<const Sensitivities> sensitivities;  // of the latest final fit
};

class DipoleEstimator {
 public:
  DipoleEstimator(Estimation& e, std::vector<std::optional<DipoleSystem>>* systems,
                  bool transport_follows)
      : e_(e),
        systems_(systems),
        transport_follows_(transport_follows),
        knots_(smooth_knots(e.lit)),
        work_(e.channels.size()) {
    fit_.scale = scale_prior(e.scene);
    fit_.without_noise = e.options.without_noise;
  }

  // First without nuisances, for the material for which rows are weighted and nuisance derivatives
  // computed; then with nuisances, and once more if that reveals outliers.
  void run() {
    for (ChannelResult& result : e_.results) result.model = "dipole";
    add_smooth_weights(e_.scene, e_.shots, e_.lit, e_.progress, e_.kept.weights,
                       e_.kept.store.get());
    e_.watch.lap("light");
    e_.for_open_channels("fitting", [&](std::size_t i) { first_fit(i); });
    e_.watch.lap("first fit");
    std::vector<bool> open(work_.size());
    for (std::size_t i = 0; i < open.size(); ++i) open[i] = work_[i].estimated;
    // What ambient light adds depends on the material itself, and so does what a quantity that is
    // off changes, which hides the material from the first estimate: those channels are repeated
    // until they settle (an error falls to a sixth each time).
    constexpr int kRounds = 8;
    for (int round = 0; round < kRounds; ++round) {
      final_fits(open);
      open = take_found(e_.scene, e_.results, changes_at_);
      for (std::size_t i = 0; i < open.size(); ++i) {
        open[i] = open[i] || (!work_[i].settled && e_.results[i].estimate.converged);
      }
      if (std::find(open.begin(), open.end(), true) == open.end()) break;
    }
    fit_with_joint_pulls();
    e_.watch.lap("fit");
  }

 private:
  // Of the open channels, with the nuisances' derivatives at their latest estimates.
  void final_fits(const std::vector<bool>& open) {
    const auto of_lights = sensitivities(e_, open, knots_, changes_at_);
    e_.watch.lap("sensitivities");
    tbb::parallel_for(std::size_t{0}, e_.channels.size(), [&](std::size_t i) {
      if (!open[i]) return;
      work_[i].sensitivities = of_lights;
      const Estimate before = e_.results[i].estimate;
      final_fit(i);
      constexpr double kOfStd = 0.02;
      constexpr double kBent = 6.0;  // beyond, coefficients shift by some hundredths of theirs
      const Estimate& now = e_.results[i].estimate;
      // Changes by eta look like the medium's: less of them shifts the coefficients.
      const bool is_bent = finds_other_eta(now) || bent_in_std(before, e_.results[i]) > kBent;
      work_[i].settled =
          !(has_fitted_light(e_.scene, e_.channels[i]) || is_bent) || is_near(before, now, kOfStd);
    });
    e_.watch.lap("fit");
  }

  // Once more those channels that doubt a quantity of the rig that all share, or of which all
  // together doubt one. What only the channels of a material probably share is doubted as much as
  // the channel itself or all of them together doubt it.
  void fit_with_joint_pulls() {
    const auto is_doubted = [](double pull) { return std::abs(pull) > kDoubtfulPull; };
    JointPulls shared;
    for (const PriorPull& p : joint_pulls_of(e_.results).pulls) shared[p.name] = p.pull;
    std::map<std::string, JointPulls> of_material;
    for (const ChannelResult& r : e_.results) {
      const auto [it, is_new] = of_material.try_emplace(r.material);
      if (!is_new) continue;
      for (const PriorPull& p : joint_pulls_of(e_.results, r.material).pulls) {
        it->second[p.name] = p.pull;
      }
    }
    tbb::parallel_for(std::size_t{0}, e_.channels.size(), [&](std::size_t i) {
      const Estimate& estimate = e_.results[i].estimate;
      if (!work_[i].estimated || !estimate.converged) return;
      JointPulls& joint = work_[i].joint_pulls = shared;
      const JointPulls& material = of_material.at(e_.results[i].material);
      bool again = false;
      for (const PriorPull& p : estimate.pulls) {
        const auto it = material.find(p.name);
        if (it == material.end()) continue;
        const bool own_is_larger = std::abs(p.pull) > std::abs(it->second);
        const double known =
            joint.try_emplace(p.name, own_is_larger ? p.pull : it->second).first->second;
        again = again || is_doubted(p.pull) || is_doubted(known);
      }
      if (again) final_fit(i);
    });
  }

  DipoleFitOptions options_of(std::size_t i) const {
    DipoleFitOptions own = fit_;
    own.eta_int_over_ext = e_.channels[i].eta_int_over_ext;
    own.joint_pulls = work_[i].joint_pulls;
    own.all_rows = e_.options.all_rows;
    if (e_.results[i].estimate.converged) {
      const LitMedium first = lit_medium(e_.results[i].estimate);
      own.near = DipoleSolver::Point::of(first.medium, first.scale);
    }
    return own;
  }

  void first_fit(std::size_t i) {
    Work& work = work_[i];
    const MaterialChannel& channel = e_.channels[i];
    work.rows = channel_rows(e_.scene, channel);
    const DipoleFit fit =
        fit_to_some(FirstChannelImage(e_.scene, channel, work.rows, e_.kept.weights), i);
    e_.results[i].estimate = fit.estimate;
    report_rows(channel, work.rows, e_.results[i]);
    work.estimated = fit.estimate.converged;
    if (!work.estimated) return;
    constexpr double kFarOff = 0.01;
    work.far_off = misses_image(fit.estimate) && fit.estimate.misfit_relative > kFarOff;
    e_.results[i].look =
        residual_look(shot_rows(channel, work.rows, fit.image.predicted, fit.image.std_l), channel);
    Eigen::Index at = 0;
    for (ChannelObservation& o : work.rows) {
      const auto n = static_cast<Eigen::Index>(o.rows_used);
      expect(o, fit.image.predicted.segment(at, n));
      at += n;
    }
  }

  // To some thousand rows evenly among all, which determine a material well enough to begin with;
  // if not, to all of them.
  DipoleFit fit_to_some(const ImageRows& image, std::size_t i) const {
    constexpr std::size_t kRows = 4096;
    const DipoleFitOptions options = options_of(i);
    std::size_t used = 0;
    for (const ChannelObservation& o : work_[i].rows) used += o.rows_used;
    if (used / kRows > 1) {
      const DenseSystem some = stacked(image, static_cast<Eigen::Index>(used / kRows));
      DipoleFit fit = fit_dipole(some, knots_, options);
      if (fit.estimate.converged) {
        fit.image = compared_image(image, knots_, fit.optimum, options.eta_int_over_ext);
        return fit;
      }
    }
    return fit_dipole(image,
                      joint_information(information_by_shot(image), image.nuisances().size()),
                      knots_, options);
  }

  void remember(std::size_t i, const LitMedium& first) {
    const auto rows = std::make_shared<const ChannelRows>(work_[i].rows);
    const auto of_lights = work_[i].sensitivities;
    const Estimation& e = e_;
    const DistanceKnots knots = knots_;
    const auto image = [&e, i, rows, of_lights, knots, first] {
      return ChannelImage(e.scene, e.channels[i], *rows, e.kept.weights, knots, first,
                          of_lights->of_channel[i]);
    };
    (*systems_)[i] = DipoleSystem{[image] { return stacked(image()); }, knots_, rows,
                                  [image] { return image().light_by_plane(); }};
  }

  void final_fit(std::size_t i) {
    const MaterialChannel& channel = e_.channels[i];
    ChannelResult& result = e_.results[i];
    const LitMedium medium = lit_medium(result.estimate);
    if (systems_ != nullptr) remember(i, medium);
    if (transport_follows_ && work_[i].far_off && some_rows_refuse(i, medium)) return;
    const ChannelImage image(e_.scene, channel, work_[i].rows, e_.kept.weights, knots_, medium,
                             work_[i].sensitivities->of_channel[i]);
    std::optional<KeptRows> kept;
    std::vector<ShotInformation> shots;
    ImageInformation joint;
    const auto fitted = [&] {
      kept.emplace(image);
      shots = information_by_shot(*kept);
      joint = joint_information(shots, image.nuisances().size());
      return fit_dipole(*kept, joint, knots_, options_of(i));
    };
    DipoleFit fit = fitted();
    if (leave_outliers_out(fit.image, work_[i].rows)) fit = fitted();
    report_rows(channel, work_[i].rows, result);
    report(i, image, joint, fit);
    if (!fit.estimate.converged) return;
    if (e_.options.keep_rows) {
      result.rows = shot_rows(channel, work_[i].rows, fit.image.predicted + image.light_by_plane(),
                              fit.image.std_l);
    }
    if (channel.shots.size() > 1) compare_shots(i, *kept, shots, fit, result);
    refuse_undetermined(result.estimate);
  }

  // Whether a quarter of the rows, nuisances fitted, refuse the dipole; then that is the result.
  bool some_rows_refuse(std::size_t i, const LitMedium& medium) {
    constexpr std::size_t kStep = 4;
    const ChannelRows some = every_nth(kStep, work_[i].rows);
    const ChannelImage image(e_.scene, e_.channels[i], some, e_.kept.weights, knots_, medium,
                             work_[i].sensitivities->of_channel[i]);
    const KeptRows kept(image);
    const ImageInformation joint =
        joint_information(information_by_shot(kept), image.nuisances().size());
    const DipoleFit fit = fit_dipole(kept, joint, knots_, options_of(i));
    if (!misses_image(fit.estimate) || fit.estimate.reasons.empty()) return false;
    report(i, image, joint, fit);
    return true;
  }

  void report(std::size_t i, const ChannelImage& image, const ImageInformation& joint,
              const DipoleFit& fit) {
    ChannelResult& result = e_.results[i];
    result.nuisances_negligible = image.negligible_nuisances();
    result.estimate = fit.estimate;
    result.evidence = fit.evidence;
    result.more_rows = fit.more_rows;
    result.image_in_std = std::sqrt(joint.l2);
    if (!fit.estimate.converged) return;
    const DipoleSolver::Point& p = fit.optimum;
    const Medium medium{p.sigma_s_prime_per_mm(), p.sigma_a_per_mm(),
                        e_.channels[i].eta_int_over_ext};
    result.recovered =
        smooth_reflectance(fit.recovered, image.nuisances(), knots_, {.scale = fit_.scale});
    result.misfit = dipole_misfit(fit.recovered, image.nuisances(), knots_, medium,
                                  std::exp(p.log_s), {.scale = fit_.scale});
    apply_mesh_scale(e_.channels[i], result.estimate);
  }

  // Fits each shot by itself and widens the joint estimate by what they disagree.
  void compare_shots(std::size_t i, const ImageRows& image,
                     const std::vector<ShotInformation>& shots, const DipoleFit& fit,
                     ChannelResult& result) const {
    const DipoleFitOptions options = options_of(i);
    result.singles.assign(shots.size(), {});
    for_each_shot(image, [&](std::size_t s, const ShotSystem& own) {
      result.singles[s] = {
          result.shots[s],
          fit_dipole(SystemRows(*own.system), shots[s].image, knots_, options).estimate};
    });
    result.agreement =
        shot_agreement(shots, image.nuisances(), knots_, fit.optimum, options.eta_int_over_ext,
                       options.scale, std::max(1.0, fit.estimate.reduced_chi2));
    widen_by_disagreement(result.agreement, result.estimate);
  }

  Estimation& e_;
  std::vector<std::optional<DipoleSystem>>* systems_;
  bool transport_follows_;
  DistanceKnots knots_;
  DipoleFitOptions fit_;
  std::vector<Work> work_;
  ChangesAt changes_at_;
};

}  // namespace

void estimate_dipole(Estimation& e, std::vector<std::optional<DipoleSystem>>* systems,
                     bool transport_follows) {
  DipoleEstimator(e, systems, transport_follows).run();
  e.refuse_rough_surfaces();
}

}  // namespace scattermeter
