#include "apps/results/comparison.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "core/base/chi_square.h"
#include "core/base/input_error.h"

namespace scattermeter::apps {
namespace {

constexpr std::array<std::string_view, 12> kOfTheRig = {
    "scale", "LED power", "LED position", "LED axis",      "LED exponent",  "LED calibration",
    "lens",  "pose",      "vignetting",   "non-linearity", "veiling glare", "surroundings"};

// Of one error that both measurements had: not of a piece, and not of a shot ("pose a.dng0").
bool is_of_the_rig(const RigResponse& r) {
  return std::find(kOfTheRig.begin(), kOfTheRig.end(), r.cause) != kOfTheRig.end() &&
         !r.quantity.starts_with("pose ");
}

Eigen::Matrix2d covariance_of(const ReadChannel& c) {
  const double s = c.sigma_s_prime_per_mm.std, a = c.sigma_a_per_mm.std;
  Eigen::Matrix2d out;
  out << s * s, c.correlation * s * a, c.correlation * s * a, a * a;
  return out;
}

// Of the errors of the first result with those of the second, by what is common to both.
Eigen::Matrix2d shared_covariance(const ReadChannel& first, const ReadChannel& second) {
  Eigen::Matrix2d out = Eigen::Matrix2d::Zero();
  for (const RigResponse& a : first.responses) {
    if (!is_of_the_rig(a)) continue;
    for (const RigResponse& b : second.responses) {
      if (a.quantity == b.quantity && a.cause == b.cause) {
        out += a.shift_per_mm * b.shift_per_mm.transpose();
      }
    }
  }
  return out;
}

// The noise of both, which no common cause takes away.
Eigen::Vector2d noise_variance(const ReadChannel& first, const ReadChannel& second) {
  Eigen::Vector2d out = Eigen::Vector2d::Zero();
  for (const ReadChannel* c : {&first, &second}) {
    for (const BudgetLine& line : c->budget) {
      if (line.cause != "noise") continue;
      out += Eigen::Vector2d(line.std_sigma_s_prime_per_mm, line.std_sigma_a_per_mm).cwiseAbs2();
    }
  }
  return out;
}

const ReadChannel* measured(const ReadResult& result, const std::string& material, char channel) {
  for (const ReadChannel& c : result.channels) {
    const bool is_known =
        std::isfinite(c.sigma_s_prime_per_mm.std) && std::isfinite(c.sigma_a_per_mm.std);
    if (c.material == material && c.channel == channel && !c.refused && is_known) return &c;
  }
  return nullptr;
}

}  // namespace

ChannelComparison compare(const ReadChannel& first, const ReadChannel& second, bool share_rig) {
  const Eigen::Matrix2d apart = covariance_of(first) + covariance_of(second);
  Eigen::Matrix2d covariance = apart;
  if (share_rig) {
    const Eigen::Matrix2d shared = shared_covariance(first, second);
    covariance -= shared + shared.transpose();
    // Responses are to first order, and of priors as stated.
    const Eigen::Vector2d least = noise_variance(first, second);
    const bool is_possible =
        (covariance.diagonal().array() > least.array()).all() && covariance.determinant() > 0.0;
    if (!is_possible) covariance = apart;
  }
  ChannelComparison out{first, second, {}, {}, 1.0};
  const Eigen::Vector2d value(second.sigma_s_prime_per_mm.value - first.sigma_s_prime_per_mm.value,
                              second.sigma_a_per_mm.value - first.sigma_a_per_mm.value);
  out.sigma_s_prime_per_mm = {value[0], std::sqrt(covariance(0, 0))};
  out.sigma_a_per_mm = {value[1], std::sqrt(covariance(1, 1))};
  out.p_value = chi_square_tail(as_chi_square(value.dot(covariance.inverse() * value)), 2.0);
  return out;
}

std::vector<std::pair<std::string, std::string>> pairs_of(const ReadResult& first,
                                                          const ReadResult& second,
                                                          const std::vector<std::string>& named) {
  std::vector<std::pair<std::string, std::string>> out;
  for (const std::string& name : named) {
    const std::size_t equals = name.find('=');
    const std::string to = equals == std::string::npos ? name : name.substr(equals + 1);
    out.emplace_back(name.substr(0, equals), to);
    require_material(first, out.back().first);
    require_material(second, to);
  }
  if (!out.empty()) return out;
  const std::vector<std::string> ours = material_names(first), theirs = material_names(second);
  for (const std::string& name : ours) {
    if (std::find(theirs.begin(), theirs.end(), name) != theirs.end()) out.emplace_back(name, name);
  }
  if (out.empty() && ours.size() == 1 && theirs.size() == 1) out.emplace_back(ours[0], theirs[0]);
  if (!out.empty()) return out;
  throw InputError(second.path,
                   fmt::format("has none of the materials {} of {}; name pairs by --material {}={}",
                               fmt::join(ours, ", "), first.path, ours[0], theirs[0]));
}

bool have_same_rig(const ReadResult& first, const ReadResult& second) {
  return !first.rig_sha256.empty() && first.rig_sha256 == second.rig_sha256;
}

MaterialComparison compare(const ReadResult& first, const ReadResult& second,
                           const std::string& ours, const std::string& theirs, bool share_rig) {
  MaterialComparison m{ours, theirs, {}, 1.0};
  for (const char channel : {'R', 'G', 'B'}) {
    const ReadChannel* a = measured(first, ours, channel);
    const ReadChannel* b = measured(second, theirs, channel);
    if (a == nullptr || b == nullptr) continue;
    m.channels.push_back(compare(*a, *b, share_rig));
    m.p_value = std::min(m.p_value, m.channels.back().p_value);
  }
  m.p_value = std::min(1.0, m.p_value * static_cast<double>(m.channels.size()));
  if (m.channels.empty()) m.p_value = 1.0;
  return m;
}

std::vector<MaterialComparison> compare(
    const ReadResult& first, const ReadResult& second,
    const std::vector<std::pair<std::string, std::string>>& pairs, bool share_rig) {
  std::vector<MaterialComparison> out;
  for (const auto& [ours, theirs] : pairs) {
    out.push_back(compare(first, second, ours, theirs, share_rig));
  }
  if (std::any_of(out.begin(), out.end(), [](const auto& m) { return !m.channels.empty(); })) {
    return out;
  }
  throw InputError(first.path, "no channel is measured in this result and in " + second.path);
}

}  // namespace scattermeter::apps
