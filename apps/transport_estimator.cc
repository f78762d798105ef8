// --model transport: the medium whose image by volume Monte Carlo is the observed one.
//
// An estimating equation (core/scattering_equation.h) is solved by Newton steps that start from the
// dipole's answer; every step draws new paths, twice as many as it closes in, until those of the
// last step serve the root as well. Z and the weights are the dipole's at the place, which no
// path's noise moves. A 20 mm cube under two LEDs, shots rendered with 10^6 paths a light and
// channel, 30 s on one core a channel: 2.194 +- 0.006 / 0.00202 +- 0.00003 per mm for 2.19 / 0.002
// and 0.4999 +- 0.0006 / 0.01003 +- 0.00002 for 0.5 / 0.01, the rendering's own noise not counted;
// the dipole: 2.086 / 0.00014 and 0.473 / 0.0029. With Z of a pilot simulation's noisy derivatives,
// the deviation of the first was four times as large.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/estimation_task.h"
#include "apps/progress.h"
#include "apps/rig_probes.h"
#include "core/camera_connection.h"
#include "core/dipole_curve.h"
#include "core/entry_source.h"
#include "core/path_boundary.h"
#include "core/residual.h"
#include "core/scattering_equation.h"
#include "core/scattering_rows.h"

namespace scattermeter::apps {
namespace {

// One light on one object, as the camera sees it.
struct LitView {
  const SeenObject* seen;
  const RigLight* light;
  std::unique_ptr<EntrySource> source;
  const PathBoundary* boundary;
  const CameraConnection* camera;  // of some medium
  const ScatteringView* view;
  double power;
  // Rows of the task's system that it lights, and of the view's, side by side.
  std::vector<std::pair<Eigen::Index, Eigen::Index>> rows;
};

// A material in a channel, on the way to its medium.
class TransportFit {
 public:
  TransportFit(const Rig& rig, const RigProbes& probes, const Task& task,
               const DipoleSystem& dipole, const ScalePrior& scale, const MeasureOptions& options)
      : task_(task),
        system_(dipole.system),
        knots_(dipole.knots),
        scale_(scale),
        options_(options) {
    const TaskRows& rows = dipole.rows;
    Eigen::Index at = 0;
    for (std::size_t s = 0; s < task.shots.size(); ++s) {
      const OpenedShot& shot = *task.shots[s];
      const SeenObject& seen = *shot.seen;
      const auto [view, is_new] = views_.try_emplace(&seen);
      if (is_new) {
        view->second.boundary = std::make_unique<PathBoundary>(*seen.object->rays);
        view->second.camera.emplace(*view->second.boundary, seen.camera_center_mm,
                                    ScatteringMedium{1.0, 0.0, 0.0, task.eta});
        view->second.rows = scattering_view(*seen.patches, seen.map.patch_of_row);
      }
      std::vector<std::pair<Eigen::Index, Eigen::Index>> pairs;
      for (std::size_t j = 0; j < rows[s].state.size(); ++j) {
        if (rows[s].state[j] == RowState::kUsed) {
          pairs.emplace_back(at++, static_cast<Eigen::Index>(j));
        }
      }
      for (const std::string& name : shot.rig->lights) {
        const RigLight& light = rig.light(name);
        const double power = light.power()[static_cast<Eigen::Index>(task.channel)];
        if (!(power > 0.0)) continue;
        auto known = std::find_if(lit_.begin(), lit_.end(), [&](const LitView& v) {
          return v.seen == &seen && v.light == &light;
        });
        if (known == lit_.end()) {
          LitView v{&seen,
                    &light,
                    nullptr,
                    view->second.boundary.get(),
                    &*view->second.camera,
                    &view->second.rows,
                    power,
                    {}};
          v.source = entry_of(name, light, probes, *seen.object->rays,
                              static_cast<int>(task.channel), task.eta);
          lit_.push_back(std::move(v));
          known = std::prev(lit_.end());
        }
        known->rows.insert(known->rows.end(), pairs.begin(), pairs.end());
      }
    }
  }

  // Starts from `estimate` and replaces it.
  void run(Estimate& estimate) {
    const auto start = std::chrono::steady_clock::now();
    const auto seconds = [&] {
      return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    ScatteringPoint at{estimate.sigma_s_prime_per_mm.value, estimate.sigma_a_per_mm.value,
                       estimate.scale.value};
    int blocks = 8;  // per light and view; more as the search closes in
    Sums first = sums(Eigen::MatrixXd::Zero(0, system_.l.size()));
    trace(first, at, blocks);
    // Of the time for all, what rows err by with this many blocks.
    constexpr double kFinalBlocks = 512.0;
    ScatteringImage noisy = image(first);
    double traced = blocks;
    constexpr int kRounds = 30;
    for (int round = 0; round < kRounds && seconds() < options_.time_limit_s; ++round) {
      const ScatteringEquation equation(system_, scale_, smooth_pilot(noisy, at), at,
                                        traced / kFinalBlocks);
      const double started_s = seconds();
      Sums sum = sums(equation.projection());
      trace(sum, at, blocks);
      ScatteringEquation::Step step = equation.step(image(sum), covariance(sum), at);
      // Close enough for the paths drawn here to serve the root as well: as many as matter.
      while (near(step) && !fine(step, at)) {
        const int so_far = sum.per_view.front().blocks();
        const double per_block_s = (seconds() - started_s) / so_far;
        const int affordable = static_cast<int>((options_.time_limit_s - seconds()) / per_block_s);
        if (affordable < so_far / 8 + 1) break;
        trace(sum, at, std::min(so_far, affordable));
        step = equation.step(image(sum), covariance(sum), at);
      }
      noisy = image(sum);
      traced = sum.per_view.front().blocks();
      if (near(step)) {
        report(equation, noisy, step, at, estimate);
        return;
      }
      if (step.change < 4.0 * std::sqrt(mc(step).maxCoeff()) || step.change < 0.2) blocks *= 2;
      at = step.to;
    }
    estimate.converged = false;
    estimate.reasons = {"the search for the medium by transport did not converge in time"};
  }

 private:
  struct View {
    std::unique_ptr<PathBoundary> boundary;
    std::optional<CameraConnection> camera;
    ScatteringView rows;
  };
  struct Sums {
    std::vector<ScatteringSum> per_view;
    std::uint64_t seed = 0;
  };

  Sums sums(const Eigen::MatrixXd& projection) {
    Sums out;
    out.seed = 1000 * ++draws_;
    for (const LitView& v : lit_) {
      Eigen::MatrixXd own = Eigen::MatrixXd::Zero(projection.rows(), v.view->n_rows);
      for (const auto& [row, view_row] : v.rows) own.col(view_row) += v.power * projection.col(row);
      out.per_view.emplace_back(*v.view, own);
    }
    return out;
  }

  void trace(Sums& sums, const ScatteringPoint& at, int blocks) {
    const ScatteringMedium medium{at.sigma_s_per_mm, at.sigma_a_per_mm, 0.0, task_.eta};
    for (std::size_t i = 0; i < lit_.size(); ++i) {
      const LitView& v = lit_[i];
      const CameraConnection camera = v.camera->with(medium);
      PathOptions options;
      options.seed = sums.seed + i;
      sums.per_view[i].trace({*v.boundary, medium, *v.source, &camera}, options, blocks);
    }
  }

  ScatteringImage image(const Sums& sums) const {
    ScatteringImage out;
    const Eigen::Index n = system_.l.size();
    out.l = out.per_log_sigma_s = out.per_sigma_a = out.variance = Eigen::VectorXd::Zero(n);
    for (std::size_t i = 0; i < lit_.size(); ++i) {
      const LitView& v = lit_[i];
      const ScatteringImage own = sums.per_view[i].image();
      for (const auto& [row, view_row] : v.rows) {
        out.l[row] += v.power * own.l[view_row];
        out.per_log_sigma_s[row] += v.power * own.per_log_sigma_s[view_row];
        out.per_sigma_a[row] += v.power * own.per_sigma_a[view_row];
        out.variance[row] += v.power * v.power * own.variance[view_row];
      }
    }
    return out;
  }

  static Eigen::MatrixXd covariance(const Sums& sums) {
    Eigen::MatrixXd out = sums.per_view.front().projected_covariance();
    for (std::size_t i = 1; i < sums.per_view.size(); ++i) {
      out += sums.per_view[i].projected_covariance();
    }
    return out;
  }

  // The dipole's image and derivatives, and Monte Carlo variances as light and area would have
  // them, on the whole as large as those of `noisy`: weights must not follow the noise of paths.
  ScatteringImage smooth_pilot(const ScatteringImage& noisy, const ScatteringPoint& at) const {
    const double sigma_t = at.sigma_s_per_mm + at.sigma_a_per_mm;
    const double albedo = at.sigma_s_per_mm / sigma_t;
    const DipoleCurve curve = dipole_curve(knots_, std::log(sigma_t), 1.0 - albedo, task_.eta);
    ScatteringImage out;
    out.l = system_.weights * curve.r;
    const Eigen::VectorXd d_u = system_.weights * curve.d_u;
    const Eigen::VectorXd d_q = system_.weights * curve.d_q;
    out.per_log_sigma_s = albedo * d_u - albedo * (1.0 - albedo) * d_q;
    out.per_sigma_a = (d_u + albedo * d_q) / sigma_t;
    Eigen::VectorXd share = Eigen::VectorXd::Zero(out.l.size());
    for (const LitView& v : lit_) {
      for (const auto& [row, view_row] : v.rows) {
        share[row] = std::max(out.l[row], 0.0) / v.view->area_mm2[view_row];
      }
    }
    out.variance = share * (noisy.variance.sum() / share.sum());
    return out;
  }

  static const Eigen::MatrixXd& mc(const ScatteringEquation::Step& step) {
    return std::find_if(step.causes.begin(), step.causes.end(),
                        [](const auto& c) { return c.name == "Monte Carlo"; })
        ->covariance;
  }

  // A step so short that what is not linear in it is small against the Monte Carlo error, or small.
  static bool near(const ScatteringEquation::Step& step) {
    constexpr double kNear = 0.03;
    constexpr double kFar = 0.1;
    return step.change < std::clamp(3.0 * std::sqrt(mc(step)(0, 0)), kNear, kFar);
  }

  // Monte Carlo is small against the rest, or against what anyone asks for.
  static bool fine(const ScatteringEquation::Step& step, const ScatteringPoint& at) {
    constexpr double kOfRest = 0.1;  // of the variance
    constexpr double kFloor[2] = {1e-3, 5e-3};
    const double unit[2] = {1.0, std::max(at.sigma_a_per_mm, 1e-3)};
    for (Eigen::Index k = 0; k < 2; ++k) {
      const double own = mc(step)(k, k);
      const double rest = step.covariance(k, k) - own;
      const double floor = kFloor[k] * unit[k];
      if (own > kOfRest * rest && own > floor * floor) return false;
    }
    return true;
  }

  void report(const ScatteringEquation& equation, const ScatteringImage& m,
              const ScatteringEquation::Step& step, const ScatteringPoint& at, Estimate& e) const {
    const double s = step.to.sigma_s_per_mm;
    const Eigen::MatrixXd& c = step.covariance;
    e.reasons.clear();
    e.converged = true;
    e.sigma_s_prime_per_mm = normal_quantity(s, s * std::sqrt(c(0, 0)));
    e.sigma_a_per_mm = normal_quantity(step.to.sigma_a_per_mm, std::sqrt(c(1, 1)));
    e.correlation = c(0, 1) / std::sqrt(c(0, 0) * c(1, 1));
    e.budget.clear();
    for (const auto& cause : step.causes) {
      e.budget.push_back(
          {cause.name, s * std::sqrt(cause.covariance(0, 0)), std::sqrt(cause.covariance(1, 1))});
    }
    e.scale =
        normal_quantity(step.to.scale, c.rows() > 2 ? std::sqrt(c(2, 2)) * step.to.scale : 0.0);
    const Eigen::VectorXd predicted =
        at.scale * (m.l + std::log(s / at.sigma_s_per_mm) * m.per_log_sigma_s +
                    (step.to.sigma_a_per_mm - at.sigma_a_per_mm) * m.per_sigma_a) +
        (step.to.scale - at.scale) * m.l;
    ScatteringImage there = m;
    there.l = predicted / at.scale;
    const double dof = static_cast<double>(system_.l.size() - c.rows());
    e.reduced_chi2 = equation.chi2(there, at) / dof;
    const Residual rest = residual(system_.l, predicted, system_.std_l);
    e.rms_relative = rest.rms_relative;
    e.psnr_db = rest.psnr_db;
  }

  const Task& task_;
  const DenseSystem& system_;
  const DistanceKnots& knots_;
  ScalePrior scale_;
  const MeasureOptions& options_;
  std::map<const SeenObject*, View> views_;
  std::vector<LitView> lit_;
  std::uint64_t draws_ = 0;
};

}  // namespace

void estimate_transport(Estimation& e) {
  std::vector<std::optional<DipoleSystem>> systems(e.tasks.size());
  estimate_dipole(e, &systems);
  const RigProbes probes = open_probes(e.rig);
  const ScalePrior scale = scale_prior(e.rig);
  Progress progress("transport", static_cast<int>(e.tasks.size()), e.options.quiet);
  for (std::size_t i = 0; i < e.tasks.size(); ++i) {
    if (!systems[i]) continue;
    ChannelResult& result = e.results[i];
    result.dipole = result.estimate;
    // Those are the dipole's.
    result.singles.clear();
    result.agreement = {};
    progress.step();
    TransportFit fit(e.rig, probes, e.tasks[i], *systems[i], scale, e.options);
    fit.run(result.estimate);
  }
  e.watch.lap("transport");
}

}  // namespace scattermeter::apps
