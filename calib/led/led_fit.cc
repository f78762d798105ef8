#include "calib/led/led_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>
#include <tuple>

#include <Eigen/Cholesky>

#include "calib/led/led_ambient.h"
#include "calib/led/led_solver.h"
#include "calib/led/led_start.h"
#include "core/base/median.h"
#include "core/base/symmetric_eigen.h"

namespace scattermeter::calib {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kLitSnr = 10.0;  // of a channel's mean, for the channel to take part
constexpr int kRounds = 6;        // of leaving cells out
constexpr std::size_t kStartCells = 240;

Eigen::Vector3d world_point(const LedScene& scene, const ShadedCell& cell) {
  const WhitePlane& plane = scene.planes[cell.plane];
  return plane.origin_mm + cell.place_mm.x() * plane.x_axis + cell.place_mm.y() * plane.y_axis;
}

Eigen::Vector3d middle_of(const LedScene& scene, const LedSolve& what) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double n = 0.0;
  for (std::size_t i = 0; i < scene.cells.size(); ++i) {
    if (!what.use_cell[i]) continue;
    sum += world_point(scene, scene.cells[i]);
    n += 1.0;
  }
  if (n == 0.0) {
    for (std::size_t i = 0; i < scene.highlights.size(); ++i) {
      if (!what.use_highlight[i]) continue;
      sum += scene.spheres[scene.highlights[i].sphere].center_mm;
      n += 1.0;
    }
  }
  return sum / n;
}

// Intensities that make the median cell of each channel right; false where the LED does not shine
// on half of a channel's cells.
bool set_intensity(const LedScene& scene, const std::vector<bool>& use, Led& led) {
  Led unit = led;
  for (int c = 0; c < 3; ++c) {
    if (led.intensity_W_per_sr[c] > 0.0) unit.intensity_W_per_sr[c] = 1.0;
  }
  std::array<std::vector<double>, 3> ratios;
  for (std::size_t i = 0; i < scene.cells.size(); ++i) {
    if (!use[i]) continue;
    const double one = cell_radiance(scene, scene.cells[i], unit);
    ratios[static_cast<std::size_t>(scene.cells[i].channel)].push_back(
        one > 0.0 ? scene.cells[i].radiance_W_per_mm2_sr / one : 0.0);
  }
  for (std::size_t c = 0; c < 3; ++c) {
    if (ratios[c].empty()) continue;
    const double intensity = upper_median(ratios[c]);
    if (!(intensity > 0.0)) return false;
    led.intensity_W_per_sr[static_cast<Eigen::Index>(c)] = intensity;
  }
  return true;
}

// Starts to try: the told place (or that of the highlights), and, where only shading says where
// the LED is, nearer and farther ones; the told axis and one towards the plane.
std::vector<Led> starts(const LedScene& scene, const LedSolve& what, const Led& led,
                        bool place_is_sure) {
  const Eigen::Vector3d middle = middle_of(scene, what);
  std::vector<Led> all;
  for (double stretch : {1.0, 0.75, 1.35}) {
    if (place_is_sure && stretch != 1.0) continue;
    for (bool towards : {false, true}) {
      Led start = led;
      start.position_mm = middle + stretch * (led.position_mm - middle);
      const Eigen::Vector3d down = (middle - start.position_mm).normalized();
      if (towards) start.axis = down;
      if (!towards && start.axis.dot(down) < 0.3) continue;
      start.exponent = std::max(start.exponent, 0.5);
      if (set_intensity(scene, what.use_cell, start)) all.push_back(start);
    }
  }
  return all;
}

// Residuals over the deviation that the noise allows, and the ratio of the bulk's.
void leave_cells_out(const LedScene& scene, const std::vector<bool>& lit,
                     const LedSolution& solution, double outlier_stds, std::vector<bool>& use) {
  std::vector<double> r(scene.cells.size(), 0.0);
  std::vector<double> magnitudes, noises;
  for (std::size_t i = 0; i < r.size(); ++i) {
    if (!lit[i]) continue;
    const ShadedCell& cell = scene.cells[i];
    const double predicted = solution.cell_radiance[i];
    r[i] = predicted > 0.0 ? cell.radiance_W_per_mm2_sr / predicted - 1.0 : 1e3;
    magnitudes.push_back(std::abs(r[i]));
    noises.push_back(predicted > 0.0 ? cell.std_W_per_mm2_sr / predicted : 1e3);
  }
  const double bulk = kStdPerMad * upper_median(magnitudes);
  const double excess = std::max(1.0, bulk / upper_median(noises));
  // A cell that is left out takes its other channels along, and the next cells where it is off by
  // much: a shadow's edge reaches farther than it shows.
  std::set<std::tuple<std::size_t, int, int>> out;
  for (std::size_t i = 0; i < r.size(); ++i) {
    if (!lit[i]) continue;
    const ShadedCell& cell = scene.cells[i];
    const double limit =
        outlier_stds * excess * cell.std_W_per_mm2_sr / std::max(1e-300, solution.cell_radiance[i]);
    if (std::abs(r[i]) <= limit) continue;
    const int reach = std::abs(r[i]) > 4.0 * limit ? 1 : 0;
    for (int dy = -reach; dy <= reach; ++dy) {
      for (int dx = -reach; dx <= reach; ++dx) {
        out.insert({cell.shot, cell.column + dx, cell.row + dy});
      }
    }
  }
  for (std::size_t i = 0; i < r.size(); ++i) {
    const ShadedCell& cell = scene.cells[i];
    use[i] = lit[i] && !out.contains({cell.shot, cell.column, cell.row});
  }
}

// Mean square of normalised residuals over what noise would give, where it exceeds that by more
// than three of its own deviations; else 1.
double significant(double sum, double n, double spent) {
  const double dof = n - spent;
  if (!(dof >= 1.0)) return 1.0;
  const double ratio = sum / dof;
  return ratio > 1.0 + 3.0 * std::sqrt(2.0 / dof) ? ratio : 1.0;
}

// The same for the cells, alone and as blocks: errors that neighbours share show there.
double cell_inflation(const LedScene& scene, const LedSolution& solution,
                      const std::vector<bool>& use, double spent) {
  double worst = 1.0;
  for (int edge : {1, 3, 6}) {
    std::map<std::tuple<std::size_t, int, int, int>, std::pair<double, double>> blocks;
    for (std::size_t i = 0; i < use.size(); ++i) {
      if (!use[i]) continue;
      const ShadedCell& cell = scene.cells[i];
      auto& [sum, n] = blocks[{cell.shot, cell.channel, cell.column / edge, cell.row / edge}];
      sum += (cell.radiance_W_per_mm2_sr - solution.cell_radiance[i]) / cell.std_W_per_mm2_sr;
      n += 1.0;
    }
    double sum = 0.0, n = 0.0;
    for (const auto& [key, block] : blocks) {
      sum += block.first * block.first / block.second;
      n += 1.0;
    }
    worst = std::max(worst, significant(sum, n, std::min(spent, 0.5 * n)));
  }
  return worst;
}

// The name of the combination of unknowns that v is, for a person.
std::string combination_name(const Eigen::VectorXd& v) {
  std::string names;
  const auto add = [&](const std::string& name, double weight) {
    if (weight < 0.05) return;
    names += (names.empty() ? "" : ", ") + name;
  };
  const double all = v.squaredNorm();
  add("position", v.head<3>().squaredNorm() / all);
  add("axis", v.segment<2>(kLedAxis).squaredNorm() / all);
  add("exponent", v[kLedExponent] * v[kLedExponent] / all);
  add("power", v.segment<3>(kLedLogIntensity).squaredNorm() / all);
  add("ambient light", v.tail(v.size() - kLedParameters).squaredNorm() / all);
  return names.empty() ? "position" : names;
}

std::string digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

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
    const bool place_is_sure = choose_highlights();
    if (!fit_.lobe_fitted && !place_is_sure) {
      return refuse(LedStatus::kTooFewData,
                    scene_.highlights.size() < 2
                        ? "a place needs highlights in two spheres at least, or a white plane"
                        : "the highlights do not agree on a place: fewer than two rays meet");
    }
    const bool solved = fit_.lobe_fitted ? solve_with_planes(place_is_sure) : solve_highlights();
    if (!solved) {
      return refuse(LedStatus::kNotConverged,
                    "no LED near the told place explains the shots: look at position_mm and axis");
    }
    report_residuals();
    if (fit_.lobe_fitted) {
      const auto used = std::count(what_.use_cell.begin(), what_.use_cell.end(), true);
      const auto all = std::count(lit_.begin(), lit_.end(), true);
      if (static_cast<double>(used) < (1.0 - options_.max_left_out) * static_cast<double>(all)) {
        return refuse(LedStatus::kMisfit,
                      digits(100.0 - 100.0 * static_cast<double>(used) / static_cast<double>(all)) +
                          " % of the plane's cells do not follow one LED on a matt plane: look "
                          "for shadows, other light, or a wrong place of the plane");
      }
    }
    set_covariance();
    return fit_;
  }

 private:
  LedFit refuse(LedStatus status, const std::string& message) {
    fit_.status = status;
    fit_.message = message;
    fit_.warnings.clear();
    return fit_;
  }

  // Channels that the plane shows lit take part; the others have no power.
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

  // Stage 1: a robust fit from several starts on some of the cells. Stage 2: all cells but those
  // that are off.
  bool solve_with_planes(bool place_is_sure) {
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
    for (const Led& start : starts(scene_, some, led_, place_is_sure)) {
      LedSolution tried = solve_led(scene_, start, some);
      if (tried.converged && tried.cost < best.cost) best = std::move(tried);
    }
    if (!std::isfinite(best.cost)) return false;
    solution_ = std::move(best);
    std::set<std::vector<bool>> met;
    for (int round = 0; round < kRounds; ++round) {
      leave_cells_out(scene_, lit_, solution_, options_.outlier_stds, what_.use_cell);
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

  void set_covariance() {
    const std::set<Eigen::Index> ambients = free_ambients();
    double free = static_cast<double>(ambients.size());
    for (bool f : what_.free) free += f ? 1.0 : 0.0;
    double chi2 = 0.0, n = 0.0;
    for (std::size_t i = 0; i < scene_.highlights.size(); ++i) {
      if (!what_.use_highlight[i]) continue;
      chi2 += fit_.highlight_residuals_px[i].squaredNorm() /
              (scene_.highlights[i].std_px * scene_.highlights[i].std_px);
      n += 2.0;
    }
    fit_.highlight_inflation = significant(chi2, n, fit_.lobe_fitted ? 0.0 : 3.0);
    fit_.plane_inflation =
        fit_.lobe_fitted ? cell_inflation(scene_, solution_, what_.use_cell, free) : 1.0;

    // Information of what is free and of the nuisances, whose priors are of unit deviation.
    Eigen::MatrixXd info = solution_.highlight_information / fit_.highlight_inflation +
                           solution_.cell_information / fit_.plane_inflation;
    const Eigen::Index size = info.rows();
    std::vector<Eigen::Index> kept;
    for (Eigen::Index i = 0; i < kLedParameters; ++i) {
      if (what_.free[static_cast<std::size_t>(i)]) kept.push_back(i);
    }
    for (const Eigen::Index i : ambients) kept.push_back(i);
    for (Eigen::Index i = solution_.nuisances_at; i < size; ++i) {
      info(i, i) += 1.0;
      kept.push_back(i);
    }
    const Eigen::MatrixXd some = info(kept, kept);
    const Eigen::VectorXd scale = some.diagonal().cwiseSqrt().cwiseMax(1e-300).cwiseInverse();
    const Eigen::MatrixXd scaled = scale.asDiagonal() * some * scale.asDiagonal();
    const SymmetricEigen eigen = symmetric_eigen(scaled);
    if (!(eigen.values[0] > 1e-12)) {
      Eigen::VectorXd v = Eigen::VectorXd::Zero(size);
      for (std::size_t k = 0; scaled.allFinite() && k < kept.size(); ++k) {
        if (kept[k] < solution_.nuisances_at) {
          v[kept[k]] = eigen.vectors(static_cast<Eigen::Index>(k), 0);
        }
      }
      report_ambient(Eigen::MatrixXd::Constant(size, size, kNone));
      refuse(LedStatus::kUndetermined,
             "the shots do not determine " + combination_name(v) + " apart; " + advice());
      return;
    }
    const Eigen::MatrixXd inverse =
        scale.asDiagonal() *
        (eigen.vectors * eigen.values.cwiseInverse().asDiagonal() * eigen.vectors.transpose()) *
        scale.asDiagonal();
    Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(size, size);
    covariance(kept, kept) = inverse;
    LedUncertainty& u = fit_.uncertainty;
    u.tangents = solution_.tangents;
    // The axis moved a little after its tangents were chosen.
    u.tangents[0] = (u.tangents[0] - u.tangents[0].dot(fit_.led.axis) * fit_.led.axis).normalized();
    u.tangents[1] = fit_.led.axis.cross(u.tangents[0]);
    u.covariance = covariance.topLeftCorner<kLedParameters, kLedParameters>();
    u.covariance = (0.5 * (u.covariance + u.covariance.transpose())).eval();
    // How the answer follows an error of the albedo's prior: covariance times that prior's
    // information, which is 1.
    u.common.setZero();
    if (albedo_is_uncertain()) {
      u.common = covariance.block<kLedParameters, 1>(0, size - 1);
    }
    if (!fit_.lobe_fitted) {
      u.covariance(kLedExponent, kLedExponent) = options_.exponent_std * options_.exponent_std;
      for (Eigen::Index c = 0; c < 3; ++c) {
        u.covariance(kLedLogIntensity + c, kLedLogIntensity + c) =
            options_.log_intensity_std * options_.log_intensity_std;
      }
    }
    report_ambient(covariance);
    judge();
  }

  // Places among the unknowns of the ambient light of shots and channels that have cells.
  std::set<Eigen::Index> free_ambients() const {
    std::set<Eigen::Index> places;
    for (std::size_t i = 0; i < what_.use_cell.size(); ++i) {
      const ShadedCell& cell = scene_.cells[i];
      if (!what_.use_cell[i] || !what_.free_ambient[cell.shot]) continue;
      places.insert(solution_.ambient_at + 3 * static_cast<Eigen::Index>(cell.shot) + cell.channel);
    }
    return places;
  }

  void report_ambient(const Eigen::MatrixXd& covariance) {
    std::map<std::pair<std::size_t, int>, std::vector<double>> own;
    for (std::size_t i = 0; i < what_.use_cell.size(); ++i) {
      const ShadedCell& cell = scene_.cells[i];
      if (!what_.use_cell[i]) continue;
      own[{cell.shot, cell.channel}].push_back(solution_.cell_radiance[i] -
                                               solution_.ambient[cell.shot][cell.channel]);
    }
    for (std::size_t s = 0; s < what_.free_ambient.size(); ++s) {
      if (!what_.free_ambient[s]) continue;
      FittedAmbient found{s, solution_.ambient[s], Eigen::Array3d::Constant(kNone),
                          Eigen::Array3d::Constant(kNone)};
      for (int c = 0; c < 3; ++c) {
        const auto cells = own.find({s, c});
        if (cells == own.end()) continue;
        const double led = upper_median(cells->second);
        const Eigen::Index at = solution_.ambient_at + 3 * static_cast<Eigen::Index>(s) + c;
        found.relative[c] = solution_.ambient[s][c] / led;
        found.relative_std[c] = std::sqrt(covariance(at, at)) * solution_.ambient_unit[s][c] / led;
      }
      fit_.ambient.push_back(found);
    }
  }

  bool albedo_is_uncertain() const {
    return fit_.lobe_fitted &&
           std::any_of(scene_.planes.begin(), scene_.planes.end(),
                       [](const WhitePlane& p) { return p.albedo_relative_std > 0.0; });
  }

  std::string advice() const {
    const bool ambient = std::any_of(what_.free_ambient.begin(), what_.free_ambient.end(),
                                     [](bool free) { return free; });
    return std::string(ambient ? "shoot the planes with the LED off as well, " : "") +
           "add spheres, a plane nearer to the LED or at another height, or a tilted one";
  }

  void judge() {
    const LedMatrix& c = fit_.uncertainty.covariance;
    const Eigen::Vector3d from = middle_of(scene_, what_);
    const Eigen::Vector3d away = fit_.led.position_mm - from;
    fit_.distance_mm = away.norm();
    const Eigen::Vector3d d = away / fit_.distance_mm;
    fit_.distance_std_mm = std::sqrt(d.dot(c.topLeftCorner<3, 3>() * d));
    Eigen::Vector3d share = Eigen::Vector3d::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
      if (what_.free[kLedLogIntensity + k]) share[static_cast<Eigen::Index>(k)] = 1.0;
    }
    double power_std = 0.0;
    if (fit_.lobe_fitted) {
      share /= share.sum();
      power_std = std::sqrt(share.dot(c.block<3, 3>(kLedLogIntensity, kLedLogIntensity) * share));
      fit_.distance_power_correlation =
          d.dot(c.block<3, 3>(0, kLedLogIntensity) * share) / (fit_.distance_std_mm * power_std);
    }
    const double relative = fit_.distance_std_mm / fit_.distance_mm;
    const std::string together = "distance known to " + digits(fit_.distance_std_mm) + " mm of " +
                                 digits(fit_.distance_mm) + ", power to " +
                                 digits(100.0 * power_std) + " %, correlation " +
                                 digits(fit_.distance_power_correlation);
    const double place_std = std::sqrt(symmetric_eigen(c.topLeftCorner<3, 3>()).values[2]);
    const double axis_std =
        std::sqrt(std::max(c(kLedAxis, kLedAxis), c(kLedAxis + 1, kLedAxis + 1)));
    const double exponent_std = std::sqrt(c(kLedExponent, kLedExponent));
    const bool tied = fit_.lobe_fitted && std::abs(fit_.distance_power_correlation) > 0.95;
    if (place_std > 0.05 * fit_.distance_mm) {
      refuse(LedStatus::kIllConditioned,
             (tied ? "the layout cannot tell the LED's distance from its power (" + together + "); "
                   : "the place is known to " + digits(place_std) + " mm only; ") +
                 advice());
      return;
    }
    if (axis_std > 0.1 ||
        (fit_.lobe_fitted && exponent_std > 0.3 * std::max(1.0, fit_.led.exponent))) {
      refuse(LedStatus::kIllConditioned, "the axis is known to " + digits(axis_std) +
                                             " rad and the exponent to " + digits(exponent_std) +
                                             " only: the plane shows too little of the lobe; " +
                                             advice());
      return;
    }
    fit_.status = LedStatus::kOk;
    if (tied && relative > 0.003) {
      fit_.warnings.push_back("the layout hardly tells distance from power: " + together + "; " +
                              advice());
    }
    if (!fit_.lobe_fitted) {
      fit_.warnings.emplace_back(
          "no white plane was seen: axis, exponent and intensity stay as the rig says");
    }
    if (fit_.lobe_fitted && fit_.led.exponent == 0.0) {
      fit_.warnings.emplace_back("the exponent lies at its bound of 0");
    }
    const auto out = std::count(fit_.highlight_used.begin(), fit_.highlight_used.end(), false);
    if (out > 0) {
      fit_.warnings.push_back(std::to_string(out) +
                              " highlight(s) do not fit the others and were left out");
    }
    if (fit_.plane_inflation > 4.0) {
      fit_.warnings.push_back("the plane's shading departs from the model by " +
                              digits(100.0 * fit_.plane_rms) +
                              " % rms, beyond its noise; the covariance is widened " +
                              digits(fit_.plane_inflation) + " times" +
                              (options_.ambient == AmbientModel::kNone
                                   ? "; if the room is not dark, do not tell that it is"
                                   : ""));
    }
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
  const std::string seen =
      "the planes show light beside the LED, up to " + digits(100.0 * brightest) + " % of its own";
  if (with.status != LedStatus::kOk) {
    with.message = seen + ", and with that " + with.message;
  } else {
    with.warnings.push_back(
        seen + ": fitted as a constant of each shot, the distance is known to " +
        digits(with.distance_std_mm) + " mm, and to " + digits(without.distance_std_mm) +
        " mm if there were none; a shot of the plane with the LED off says "
        "more");
  }
  return with;
}

}  // namespace scattermeter::calib
