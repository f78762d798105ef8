#include "calib/led/led_mistakes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include <fmt/core.h>
#include <oneapi/tbb/parallel_for.h>

#include "core/base/input_error.h"
#include "core/base/median.h"

namespace scattermeter::calib {
namespace {

constexpr double kNoMistakeBelow = 2.0;  // departure of a median cell, deviations of its noise
constexpr double kMuchBetter = 3.0;
constexpr double kFitting_px = 0.3;  // of highlights
constexpr std::array<int, 12> kHeights_mm = {-10, -7, -5, -3, -2, -1, 1, 2, 3, 5, 7, 10};
constexpr std::size_t kCells = 50;

// Median departure of the cells from a fit, in standard deviations of their noise.
double departure(const LedScene& scene, const LedFit& fit) {
  std::vector<double> off;
  for (std::size_t i = 0; i < fit.cell_residuals.size(); ++i) {
    const ShadedCell& cell = scene.cells[i];
    const double stds =
        std::abs(fit.cell_residuals[i]) * cell.radiance_W_per_mm2_sr / cell.std_W_per_mm2_sr;
    if (std::isfinite(stds)) off.push_back(stds);
  }
  return off.empty() ? std::numeric_limits<double>::infinity() : upper_median(std::move(off));
}

// Cells alone could fit where the spheres are left out.
bool uses_all_highlights(const LedFit& fit) {
  return std::all_of(fit.highlight_used.begin(), fit.highlight_used.end(),
                     [](bool used) { return used; });
}

// The scene with a plane moved along its normal: its cells are where the camera's rays meet it.
LedScene with_height(const LedScene& stated, std::size_t plane_idx, double height_mm) {
  LedScene scene = stated;
  WhitePlane& plane = scene.planes[plane_idx];
  plane.origin_mm += height_mm * plane.normal();
  for (ShadedCell& cell : scene.cells) {
    if (cell.plane != plane_idx) continue;
    const Eigen::Vector3d eye_mm = inverse(scene.views[cell.view].camera_from_world).translation_mm;
    const auto met = plane.meet_mm(eye_mm, stated.cell_mm(cell) - eye_mm);
    if (!met) continue;
    cell.on_plane_mm = *met;
    const double eye_above_mm = plane.normal().dot(eye_mm - plane.origin_mm);
    const double size = eye_above_mm / (eye_above_mm + height_mm);
    cell.spread_mm2 *= size * size;
  }
  return scene;
}

// Some of the cells, of all channels, which follow one another: they suffice to tell a mistake.
void thin(std::vector<ShadedCell>& cells) {
  std::size_t step = std::max<std::size_t>(1, cells.size() / kCells);
  if (step % 3 == 0) ++step;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < cells.size(); i += step) cells[kept++] = cells[i];
  cells.resize(kept);
}

class Mistakes {
 public:
  Mistakes(const LedCalibrationInput& input, const std::string& light, const LedFrames& frames,
           const LedFitOptions& options, const LedFit& fit, double departure)
      : input_(input),
        light_(light),
        frames_(frames),
        options_(options),
        most_px_(std::max(kFitting_px, fit.highlight_rms_px)),
        least_(departure / kMuchBetter) {}

  // "" if none is.
  const std::string& likely() const { return likely_; }

  void try_radius() {
    LedCalibrationInput halved = input_;
    for (MirrorSphere& sphere : halved.shots.spheres) sphere.radius_mm *= 0.5;
    try_input(halved, "half the radius of the spheres; is their diameter stated as radius_mm?");
  }

  void try_exchanged_planes() {
    const std::vector<std::size_t> own = shots_of(LedShotKind::kPlane, light_);
    for (std::size_t i = 0; i < own.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k) {
        LedCalibrationInput other = input_;
        LedCalibrationShot& one = other.shots.shots[own[k]];
        LedCalibrationShot& two = other.shots.shots[own[i]];
        if (one.plane == two.plane) continue;
        std::swap(one.plane, two.plane);
        try_input(other, fmt::format("the planes of {} and {} exchanged", one.file, two.file));
      }
    }
  }

  void try_exchanged_leds() {
    for (const std::string& name : input_.shots.lights()) {
      if (name == light_ || shots_of(LedShotKind::kSpheres, name).empty()) continue;
      LedCalibrationInput other = input_;
      for (LedCalibrationShot& shot : other.shots.shots) {
        if (shot.kind != LedShotKind::kSpheres) continue;
        if (shot.light == light_) {
          shot.light = name;
        } else if (shot.light == name) {
          shot.light = light_;
        }
      }
      try_input(other, fmt::format("the spheres' shots of {} and {} exchanged", light_, name));
    }
  }

  void try_heights(const LedShots& shots) {
    if (options_.ambient == AmbientModel::kWhereSeen) options_.ambient = AmbientModel::kNone;
    std::vector<bool> is_seen(shots.scene.planes.size(), false);
    for (const ShadedCell& cell : shots.scene.cells) is_seen[cell.plane] = true;
    for (std::size_t plane = 0; plane < is_seen.size(); ++plane) {
      if (!is_seen[plane]) continue;
      std::array<double, kHeights_mm.size()> off{};
      oneapi::tbb::parallel_for(std::size_t{0}, off.size(), [&](std::size_t i) {
        off[i] = departure_of(with_height(shots.scene, plane, kHeights_mm[i]));
      });
      const auto best = std::min_element(off.begin(), off.end());
      const int mm = kHeights_mm[static_cast<std::size_t>(best - off.begin())];
      take(*best, fmt::format("plane {} about {} mm {} than its origin_mm", plane + 1, std::abs(mm),
                              mm > 0 ? "higher" : "lower"));
    }
  }

 private:
  std::vector<std::size_t> shots_of(LedShotKind kind, const std::string& light) const {
    std::vector<std::size_t> out;
    for (std::size_t i = 0; i < input_.shots.shots.size(); ++i) {
      const LedCalibrationShot& shot = input_.shots.shots[i];
      if (shot.kind == kind && shot.light == light) out.push_back(i);
    }
    return out;
  }

  double departure_of(LedScene scene) const {
    thin(scene.cells);
    const LedFit fit = fit_led(scene, input_.led(light_).led, options_);
    const bool counts = uses_all_highlights(fit) && fit.highlight_rms_px <= most_px_;
    return counts ? departure(scene, fit) : std::numeric_limits<double>::infinity();
  }

  void try_input(const LedCalibrationInput& input, const std::string& text) {
    try {
      take(departure_of(read_led_shots(input, light_, frames_).scene), text);
    } catch (const InputError&) {  // a plane out of view: that is not how the shots were taken
    }
  }

  void take(double departure, const std::string& text) {
    if (!(departure < least_)) return;
    least_ = departure;
    likely_ = text;
  }

  const LedCalibrationInput& input_;
  const std::string& light_;
  const LedFrames& frames_;
  LedFitOptions options_;
  double most_px_;  // of the highlights, rms
  double least_;
  std::string likely_;
};

}  // namespace

std::string likely_mistake(const LedCalibrationInput& input, const std::string& light,
                           const LedFrames& frames, const LedShots& shots, const LedFit& fit,
                           const LedFitOptions& options) {
  const double off = departure(shots.scene, fit);
  if (shots.scene.cells.empty() || off < kNoMistakeBelow) return "";
  Mistakes mistakes(input, light, frames, options, fit, off);
  mistakes.try_radius();
  mistakes.try_exchanged_planes();
  mistakes.try_exchanged_leds();
  if (mistakes.likely().empty()) mistakes.try_heights(shots);
  if (mistakes.likely().empty()) return "";
  return "the planes' shading fits far better with " + mistakes.likely();
}

}  // namespace scattermeter::calib
