#include "calib/led/led_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

#include <fmt/core.h>

#include "calib/led/consistent_cells.h"
#include "calib/led/led_ambient.h"
#include "calib/led/led_covariance.h"
#include "calib/led/led_solver.h"
#include "calib/led/led_start.h"
#include "calib/led/led_verdict.h"
#include "calib/led/residual_inflation.h"
#include "calib/led/start_candidates.h"

namespace scattermeter::calib {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kLitSnr = 10.0;  // least SNR of the mean of a channel that is used
constexpr int kRounds = 6;        // of outlier rejection
constexpr std::size_t kStartCells = 240;

class LedFitter {
 public:
  LedFitter(const LedScene& scene, const Led& start, const LedFitOptions& options, bool ambient)
      : scene_(scene), options_(options), led_(start) {
    for (std::size_t i = 0; i < scene.plane_shots(); ++i) {
      const bool subtracted = i < scene.ambient_subtracted.size() && scene.ambient_subtracted[i];
      what_.free_ambient.push_back(ambient && !subtracted);
    }
    what_.use_highlight.assign(scene.highlights.size(), false);
    what_.use_cell.assign(scene.cells.size(), false);
    fit_.led = start;
  }

  LedFit run() {
    choose_channels();
    const bool position_is_known = choose_highlights();
    if (!fit_.lobe_fitted && !position_is_known) {
      return refuse(LedStatus::kTooFewData,
                    scene_.highlights.size() < 2
                        ? "a position needs highlights in at least two spheres, or a white plane"
                        : "the highlights do not agree on a position: fewer than two rays meet");
    }
    const bool solved =
        fit_.lobe_fitted ? solve_with_planes(position_is_known) : solve_highlights();
    if (!solved) {
      return refuse(
          LedStatus::kNotConverged,
          "no LED near the stated position explains the shots: look at position_mm and axis");
    }
    report_residuals();
    if (fit_.lobe_fitted) {
      const auto used = std::count(what_.use_cell.begin(), what_.use_cell.end(), true);
      const auto all = std::count(lit_.begin(), lit_.end(), true);
      if (static_cast<double>(used) < (1.0 - options_.max_left_out) * static_cast<double>(all)) {
        return refuse(
            LedStatus::kMisfit,
            fmt::format("{:.3g} % of the plane's cells do not follow one LED on a matt plane: look "
                        "for shadows, other light, or a wrong position of the plane",
                        100.0 - 100.0 * static_cast<double>(used) / static_cast<double>(all)));
      }
    }
    set_uncertainty();
    return fit_;
  }

 private:
  LedFit refuse(LedStatus status, const std::string& message) {
    refuse_led(fit_, status, message);
    return fit_;
  }

  // Channels in which the plane is lit are used; the others have no power.
  void choose_channels() {
    std::array<double, 3> sum{}, variance{};
    for (const ShadedCell& cell : scene_.cells) {
      const auto c = static_cast<std::size_t>(cell.channel);
      sum[c] += cell.radiance_W_per_mm2_sr;
      variance[c] += cell.std_W_per_mm2_sr * cell.std_W_per_mm2_sr;
    }
    std::array<bool, 3> lit{};
    for (std::size_t c = 0; c < 3; ++c) {
      lit[c] = sum[c] > kLitSnr * std::sqrt(variance[c]);
      fit_.lobe_fitted = fit_.lobe_fitted || lit[c];
    }
    what_.free[0] = what_.free[1] = what_.free[2] = true;
    if (!fit_.lobe_fitted) return;
    what_.free[kLedAxis] = what_.free[kLedAxis + 1] = what_.free[kLedExponent] = true;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto i = static_cast<Eigen::Index>(c);
      what_.free[kLedLogIntensity + c] = lit[c];
      led_.intensity_W_per_sr[i] = lit[c] ? std::max(led_.intensity_W_per_sr[i], 1e-3) : 0.0;
    }
    for (const ShadedCell& cell : scene_.cells) {
      lit_.push_back(lit[static_cast<std::size_t>(cell.channel)]);
    }
    what_.use_cell = lit_;
  }

  bool choose_highlights() {
    const auto start = led_start(scene_, options_.inlier_px);
    if (!start) {
      if (scene_.highlights.size() == 1 && fit_.lobe_fitted) what_.use_highlight[0] = true;
      return false;
    }
    what_.use_highlight = start->agrees;
    led_.position_mm = start->position_mm;
    return true;
  }

  bool solve_highlights() {
    solution_ = solve_led(scene_, led_, what_);
    return solution_.converged;
  }

  // Stage 1: a robust fit from several starts to some of the cells. Stage 2: all cells except
  // outliers, until the set of outliers no longer changes.
  bool solve_with_planes(bool position_is_known) {
    LedSolve some = what_;
    const std::size_t step = std::max<std::size_t>(
        1, static_cast<std::size_t>(std::count(lit_.begin(), lit_.end(), true)) / kStartCells);
    std::size_t count = 0;
    for (std::size_t i = 0; i < lit_.size(); ++i) {
      some.use_cell[i] = lit_[i] && count++ % step == 0;
    }
    some.robust = true;
    some.cell_relative_std = 0.01;
    LedSolution best;
    best.cost = std::numeric_limits<double>::infinity();
    for (const Led& start : start_candidates(scene_, some, led_, position_is_known)) {
      LedSolution tried = solve_led(scene_, start, some);
      if (tried.converged && tried.cost < best.cost) best = std::move(tried);
    }
    if (!std::isfinite(best.cost)) return false;
    solution_ = std::move(best);
    std::set<std::vector<bool>> met;
    for (int round = 0; round < kRounds; ++round) {
      what_.use_cell =
          consistent_cells(scene_, lit_, solution_.cell_radiance, options_.outlier_stds);
      if (std::count(what_.use_cell.begin(), what_.use_cell.end(), true) < kLedParameters) {
        return false;
      }
      if (!met.insert(what_.use_cell).second) break;
      solution_ = solve_led(scene_, solution_.led, what_);
      if (!solution_.converged) return false;
    }
    return true;
  }

  void report_residuals() {
    fit_.led = solution_.led;
    fit_.highlight_used = what_.use_highlight;
    fit_.cell_used = what_.use_cell;
    double sum = 0.0, n = 0.0;
    for (std::size_t i = 0; i < scene_.highlights.size(); ++i) {
      fit_.highlight_residuals_px.push_back(solution_.highlight_px[i] -
                                            scene_.highlights[i].image_px);
      if (!what_.use_highlight[i]) continue;
      const double off = fit_.highlight_residuals_px.back().norm();
      sum += off * off;
      n += 1.0;
      fit_.highlight_worst_px = std::max(fit_.highlight_worst_px, off);
    }
    if (n > 0.0) fit_.highlight_rms_px = std::sqrt(sum / n);
    sum = n = 0.0;
    for (std::size_t i = 0; i < scene_.cells.size(); ++i) {
      const double predicted = solution_.cell_radiance[i];
      fit_.cell_residuals.push_back(
          predicted > 0.0 ? scene_.cells[i].radiance_W_per_mm2_sr / predicted - 1.0 : kNone);
      if (!what_.use_cell[i]) continue;
      const double off = std::abs(fit_.cell_residuals.back());
      sum += off * off;
      n += 1.0;
      fit_.plane_worst = std::max(fit_.plane_worst, off);
    }
    if (n > 0.0) fit_.plane_rms = std::sqrt(sum / n);
  }

  // Inflations, covariance, fitted ambient light and, from these, the verdict.
  void set_uncertainty() {
    double parameters = static_cast<double>(free_ambient_indices(scene_, what_, solution_).size());
    for (bool f : what_.free) parameters += f ? 1.0 : 0.0;
    double chi2 = 0.0, n = 0.0;
    for (std::size_t i = 0; i < scene_.highlights.size(); ++i) {
      if (!what_.use_highlight[i]) continue;
      chi2 += fit_.highlight_residuals_px[i].squaredNorm() /
              (scene_.highlights[i].std_px * scene_.highlights[i].std_px);
      n += 2.0;
    }
    fit_.highlight_inflation = residual_inflation(chi2, n, fit_.lobe_fitted ? 0.0 : 3.0);
    fit_.plane_inflation = fit_.lobe_fitted ? cell_inflation(scene_, solution_.cell_radiance,
                                                             what_.use_cell, parameters)
                                            : 1.0;
    const LedCovariance found =
        led_covariance(scene_, what_, solution_, fit_.highlight_inflation, fit_.plane_inflation);
    fit_.ambient = fitted_ambient(scene_, what_, solution_, found.covariance);
    if (!found.determined) {
      refuse(LedStatus::kUndetermined, "the shots do not determine these separately: " +
                                           combination_name(found.open_combination) + "; " +
                                           layout_advice(what_));
      return;
    }
    fit_.uncertainty =
        led_uncertainty(found.covariance, solution_, fit_.led, albedo_is_uncertain());
    if (!fit_.lobe_fitted) {
      LedMatrix& c = fit_.uncertainty.covariance;
      for (Eigen::Index k = kLedAxis; k < kLedExponent; ++k) {
        c(k, k) = options_.axis_std_rad * options_.axis_std_rad;
      }
      c(kLedExponent, kLedExponent) = options_.exponent_std * options_.exponent_std;
      for (Eigen::Index k = 0; k < 3; ++k) {
        c(kLedLogIntensity + k, kLedLogIntensity + k) =
            options_.log_intensity_std * options_.log_intensity_std;
      }
    }
    judge_led(scene_, what_, options_, fit_);
  }

  bool albedo_is_uncertain() const {
    return fit_.lobe_fitted &&
           std::any_of(scene_.planes.begin(), scene_.planes.end(),
                       [](const WhitePlane& p) { return p.albedo_relative_std > 0.0; });
  }

  const LedScene& scene_;
  const LedFitOptions& options_;
  Led led_;
  LedSolve what_;
  std::vector<bool> lit_;
  LedSolution solution_;
  LedFit fit_;
};

}  // namespace

void LedFitOptions::Check() const {
  const auto positive = [](double v, const char* name) {
    if (!(v > 0.0)) throw std::invalid_argument(std::string("LedFitOptions::") + name);
  };
  positive(inlier_px, "inlier_px");
  positive(outlier_stds, "outlier_stds");
  positive(max_left_out, "max_left_out");
  if (!(exponent_std >= 0.0)) throw std::invalid_argument("LedFitOptions::exponent_std");
  if (!(log_intensity_std >= 0.0)) throw std::invalid_argument("LedFitOptions::log_intensity_std");
}

LedFit fit_led(const LedScene& scene, const Led& start, const LedFitOptions& options) {
  options.Check();
  LedFit without = LedFitter(scene, start, options, options.ambient == AmbientModel::kFitted).run();
  const bool doubtful = without.plane_inflation > 1.0 || without.status == LedStatus::kMisfit;
  if (options.ambient != AmbientModel::kWhereSeen || !doubtful) return without;
  LedFit with = LedFitter(scene, start, options, true).run();
  if (!ambient_is_seen(scene, without, with)) return without;
  double brightest = 0.0;
  for (const FittedAmbient& a : with.ambient) {
    for (const double share : a.relative) brightest = std::fmax(brightest, share);
  }
  const std::string seen = fmt::format(
      "the planes show ambient light of up to {:.3g} % of the light of the LED", 100.0 * brightest);
  if (with.status != LedStatus::kOk) {
    with.message = seen + ", and with that " + with.message;
  } else {
    with.warnings.push_back(fmt::format(
        "{}; it is fitted as a constant of each shot, so that the distance is known to {:.3g} mm "
        "instead of {:.3g} mm; a shot of the plane with the LED off would determine the ambient "
        "light",
        seen, with.distance_std_mm, without.distance_std_mm));
  }
  return with;
}

}  // namespace scattermeter::calib
