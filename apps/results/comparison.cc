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

constexpr std::array<std::string_view, 8> kOfTheRig = {"scale",    "LED power",    "LED position",
                                                       "LED axis", "LED exponent", "lens",
                                                       "pose",     "surroundings"};

// Sum over the shared causes of the products of their deviations: the covariance of both results.
Eigen::Array2d shared_variance(const ReadChannel& first, const ReadChannel& second) {
  Eigen::Array2d out = Eigen::Array2d::Zero();
  for (const BudgetLine& a : first.budget) {
    if (std::find(kOfTheRig.begin(), kOfTheRig.end(), a.cause) == kOfTheRig.end()) continue;
    for (const BudgetLine& b : second.budget) {
      if (a.cause != b.cause) continue;
      out[0] += a.std_sigma_s_prime_per_mm * b.std_sigma_s_prime_per_mm;
      out[1] += a.std_sigma_a_per_mm * b.std_sigma_a_per_mm;
    }
  }
  return out;
}

const ReadChannel* measured(const ReadResult& result, const std::string& material, char channel) {
  for (const ReadChannel& c : result.channels) {
    if (c.material == material && c.channel == channel && !c.refused) return &c;
  }
  return nullptr;
}

}  // namespace

ChannelComparison compare(const ReadChannel& first, const ReadChannel& second, bool share_rig) {
  const auto std_of = [](const ReadChannel& c) {
    return Eigen::Array2d(c.sigma_s_prime_per_mm.std, c.sigma_a_per_mm.std);
  };
  const Eigen::Array2d a = std_of(first), b = std_of(second);
  const Eigen::Array2d own = a.square() + b.square();
  Eigen::Array2d variance = own;
  if (share_rig) variance -= 2.0 * shared_variance(first, second);
  // The correlation of the two coefficients, that of independent results.
  const double correlation =
      (first.correlation * a.prod() + second.correlation * b.prod()) / std::sqrt(own.prod());
  ChannelComparison out{first, second, {}, {}, 1.0};
  const Eigen::Array2d value(second.sigma_s_prime_per_mm.value - first.sigma_s_prime_per_mm.value,
                             second.sigma_a_per_mm.value - first.sigma_a_per_mm.value);
  out.sigma_s_prime_per_mm = {value[0], std::sqrt(variance[0])};
  out.sigma_a_per_mm = {value[1], std::sqrt(variance[1])};
  const Eigen::Array2d in_std = value / variance.sqrt();
  const double chi2 = (in_std.square().sum() - 2.0 * correlation * in_std.prod()) /
                      (1.0 - correlation * correlation);
  out.p_value = chi_square_tail(chi2, 2.0);
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
