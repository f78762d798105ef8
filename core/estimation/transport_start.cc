#include "core/estimation/transport_start.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "core/atlas/transport_atlas.h"
#include "core/estimation/model_choice.h"

namespace scattermeter {
namespace {

// Mean free paths across the largest body, at least.
constexpr double kThinnest = 5.0;

bool determines(const Estimate& estimate) {
  return estimate.converged && !is_undetermined(estimate.sigma_s_prime_per_mm);
}

double squared_distance(const Estimate& one, const Estimate& other) {
  constexpr double kDilute = 1e-3;  // sigma_a / sigma_s' below which media are alike
  const double a = one.sigma_s_prime_per_mm.value;
  const double b = other.sigma_s_prime_per_mm.value;
  const double scattering = std::log(a / b);
  const double absorption = std::log((one.sigma_a_per_mm.value / a + kDilute) /
                                     (other.sigma_a_per_mm.value / b + kDilute));
  return scattering * scattering + 0.1 * absorption * absorption;
}

// Mean square, by weight, of log(measured light over this), and the scale that was fitted for it,
// else 1.
std::pair<double, double> offset_of(const Eigen::ArrayXd& light, const Eigen::ArrayXd& weight,
                                    bool has_free_scale) {
  constexpr double kDarkPart = 1e-3;  // of the brightest, of a part that has none
  const double brightest = light.maxCoeff();
  if (!(brightest > 0.0)) return {std::numeric_limits<double>::max(), 1.0};
  Eigen::ArrayXd offset = light.max(kDarkPart * brightest).log();
  const double common = has_free_scale ? (weight * offset).sum() / weight.sum() : 0.0;
  offset -= common;
  return {(weight * offset.square()).sum() / weight.sum(), std::exp(-common)};
}

}  // namespace

ChannelResult start_from_dipole(const ChannelResult& by_dipole) {
  ChannelResult out = by_dipole;
  out.dipole = by_dipole.estimate;
  out.model = "transport";
  out.rows.clear();
  return out;
}

void start_like_others(std::span<const ChannelResult> found, Estimate& start) {
  if (!determines(start)) return;
  const ChannelResult* like = nullptr;
  double least = 1.0;  // squared distance
  for (const ChannelResult& r : found) {
    if (!r.dipole || !r.estimate.converged || r.refused() || !determines(*r.dipole)) continue;
    const double distance = squared_distance(*r.dipole, start);
    if (distance >= least) continue;
    least = distance;
    like = &r;
  }
  if (like == nullptr) return;
  const Estimate& to = like->estimate;
  start.sigma_s_prime_per_mm.value *=
      to.sigma_s_prime_per_mm.value / like->dipole->sigma_s_prime_per_mm.value;
  double& a = start.sigma_a_per_mm.value;
  a = std::max(0.0, a + to.sigma_a_per_mm.value - like->dipole->sigma_a_per_mm.value);
}

bool start_as_before(std::span<const ChannelResult> found, ChannelResult& result) {
  const auto same = std::find_if(found.begin(), found.end(), [&](const ChannelResult& r) {
    return r.material == result.material && r.channel == result.channel;
  });
  if (same == found.end() || same->model != "transport" || !determines(same->estimate))
    return false;
  result.estimate.sigma_s_prime_per_mm = same->estimate.sigma_s_prime_per_mm;
  result.estimate.sigma_a_per_mm = same->estimate.sigma_a_per_mm;
  result.estimate.scale = same->estimate.scale;
  result.estimate.misfit_p_value = same->estimate.misfit_p_value;
  result.estimate.misfit_relative = same->estimate.misfit_relative;
  return true;
}

ScatteringPoint nearest_point(double size_mm, bool has_free_scale, const Eigen::ArrayXd& weight,
                              const std::function<Eigen::ArrayXd(int, double)>& light) {
  constexpr double kMost = 300.0;  // mean free paths across
  constexpr int kStep = 2;         // nodes
  constexpr std::array<double, 17> kDark = {1e-4, 1e-3, 3e-3, 0.01, 0.02, 0.035, 0.06, 0.1, 0.15,
                                            0.22, 0.32, 0.45, 0.65, 0.9,  1.3,   2.0,  4.0};
  const auto node_at = [&](double paths_across) {
    return std::log(paths_across / size_mm) / TransportAtlas::kSpacing;
  };
  const int first = static_cast<int>(std::ceil(node_at(kThinnest)));
  const int steps = static_cast<int>(std::floor(node_at(kMost)) - first) / kStep + 1;
  Eigen::ArrayXXd distance(steps, kDark.size()), scale(steps, kDark.size());
  for (Eigen::Index i = 0; i < steps; ++i) {
    const int node = first + kStep * static_cast<int>(i);
    for (Eigen::Index k = 0; k < distance.cols(); ++k) {
      std::tie(distance(i, k), scale(i, k)) = offset_of(
          light(node, kDark[static_cast<std::size_t>(k)] * TransportAtlas::sigma_s_per_mm(node)),
          weight, has_free_scale);
    }
  }
  Eigen::Index i = 0, k = 0;
  distance.minCoeff(&i, &k);
  double x = first + kStep * static_cast<double>(i);
  if (i > 0 && i + 1 < steps) {
    const double before = distance(i - 1, k) - distance(i, k);
    const double after = distance(i + 1, k) - distance(i, k);
    if (before + after > 0.0) x += kStep * 0.5 * (before - after) / (before + after);
  }
  const double sigma_s = std::exp(TransportAtlas::kSpacing * x);
  return {sigma_s, kDark[static_cast<std::size_t>(k)] * sigma_s, scale(i, k)};
}

ScatteringPoint starting_point(const Estimate& dipole, double size_mm, bool has_free_scale,
                               const Eigen::ArrayXd& weight,
                               const std::function<Eigen::ArrayXd(int, double)>& light) {
  // Of the image: the dipole's estimates are then off by factors.
  constexpr double kFarOff = 5e-3;
  const Quantity& s = dipole.sigma_s_prime_per_mm;
  if (is_undetermined(s) || (misses_image(dipole) && dipole.misfit_relative > kFarOff)) {
    return nearest_point(size_mm, has_free_scale, weight, light);
  }
  return {std::max(s.value, kThinnest / size_mm), dipole.sigma_a_per_mm.value,
          has_free_scale ? dipole.scale.value : 1.0};
}

}  // namespace scattermeter
