#include "core/estimation/contradictions.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>

#include <fmt/core.h>

#include "core/base/chi_square.h"
#include "core/estimation/model_choice.h"

namespace scattermeter {
namespace {

// As improbable as one pull of that many deviations.
double probability_of(double pull) { return std::erfc(pull * M_SQRT1_2); }

// Of one material, or of all (empty).
void refuse_with_all_channels(const JointJudgement& joint, const std::string& material,
                              std::vector<ChannelResult>& results) {
  const PriorPull* worst = contradiction(joint.pulls, kMostPull, kLeastPullImage);
  std::string text;
  if (worst != nullptr) {
    text = "all channels together: " + contradiction_sentence(*worst, joint.pulls);
  } else if (joint.dof > 0.0 &&
             chi_square_tail(joint.chi2, joint.dof) < probability_of(kMostPull) &&
             std::sqrt(std::max(0.0, joint.chi2 - joint.dof)) >
                 kLeastExplained * joint.data_length) {
    // No single quantity is far off, but many are.
    worst = contradiction(joint.pulls, 0.0, kLeastPullImage, 0.0);
    if (worst == nullptr) return;
    text = fmt::format(
        "all channels together contradict what the rig states "
        "(chi-square {:.0f} of {:.0f} quantities), most of all: {}",
        joint.chi2, joint.dof, contradiction_sentence(*worst, joint.pulls));
  }
  if (worst == nullptr) return;
  for (ChannelResult& r : results) {
    if (!material.empty() && r.material != material) continue;
    std::vector<std::string>& reasons = r.estimate.reasons;
    const auto& own = r.evidence.nuisances;
    const auto it = std::find_if(own.begin(), own.end(),
                                 [&](const Nuisance& n) { return n.name == worst->name; });
    // A reason of its own tells as much.
    if (it == own.end() || !reasons.empty()) continue;
    const double by_std = r.evidence.image_relative[it - own.begin()];
    if (!(by_std * std::abs(worst->offset) / it->std > kLeastPullImage)) continue;
    reasons.push_back(text);
  }
}

bool explains_its_image(const ChannelResult& r) {
  return r.estimate.converged && !misses_image(r.estimate);
}

// Of one material, or of all (empty).
std::vector<const RigEvidence*> evidence_of(const std::vector<ChannelResult>& results,
                                            const std::string& material) {
  std::vector<const RigEvidence*> out;
  for (const ChannelResult& r : results) {
    if (!material.empty() && r.material != material) continue;
    if (!r.evidence.nuisances.empty() && explains_its_image(r)) out.push_back(&r.evidence);
  }
  return out;
}

// Light that no lamp of the rig sends has another amount in each channel, but one cause: what one
// channel alone does not contradict, several may. Of each channel counts its largest pull, chosen
// among those of its shots.
void refuse_stray_light(const std::string& material, std::vector<ChannelResult>& results) {
  for (const char* group : {"even light", "pedestal"}) {
    double chi2 = 0.0;
    double choices = 1.0;
    std::vector<std::pair<ChannelResult*, PriorPull>> channels;
    for (ChannelResult& r : results) {
      if (r.material != material || !explains_its_image(r)) continue;
      const PriorPull* largest = nullptr;
      double among = 0.0;
      for (const PriorPull& p : r.estimate.pulls) {
        if (p.group != group) continue;
        among += 1.0;
        if (largest == nullptr || std::abs(p.pull) > std::abs(largest->pull)) largest = &p;
      }
      if (largest == nullptr) continue;
      channels.emplace_back(&r, *largest);
      chi2 += largest->pull * largest->pull;
      choices *= among;
    }
    if (channels.size() < 2) continue;
    const double p_value = choices * chi_square_tail(chi2, static_cast<double>(channels.size()));
    if (!(p_value < probability_of(kMostPull))) continue;
    for (auto& [r, pull] : channels) {
      if (r->refused() || !(pull.image_relative > kLeastPullImage)) continue;
      pull.pull = std::copysign(std::sqrt(chi2), pull.pull);
      r->estimate.reasons.push_back("all channels together: " + contradiction_sentence(pull, {}));
    }
  }
}

// What a channel alone may explain by light or camera elsewhere, where the other channels do not
// see them: its scale, for one.
void refuse_beside_others(std::vector<ChannelResult>& results) {
  const std::vector<const RigEvidence*> evidence = evidence_of(results, "");
  for (ChannelResult& r : results) {
    if (r.refused() || std::find(evidence.begin(), evidence.end(), &r.evidence) == evidence.end()) {
      continue;
    }
    const std::vector<PriorPull> own = own_pulls_beside(r.evidence, evidence);
    const PriorPull* worst = contradiction(own, kMostPull, kLeastPullImage);
    if (worst == nullptr) continue;
    r.estimate.reasons.push_back("in view of the other channels: " +
                                 contradiction_sentence(*worst, own));
  }
}

// For what another channel of the same shots shows, unless the result is refused for a reason of
// its own; that nothing was found is none.
void refuse_as_another(const std::string& sentence, ChannelResult& result) {
  std::vector<std::string>& reasons = result.estimate.reasons;
  const bool in_vain =
      !result.estimate.converged && result.estimate.sigma_s_prime_per_mm.value > 0.0;
  if (result.refused() && (!in_vain || reasons.front().starts_with("channel "))) return;
  reasons.insert(reasons.begin(), sentence);
}

// Where the model misses the images of two channels, the rig is not as stated, and the third
// channel may owe its good fit to wrong coefficients, or have no fit for the same reason.
void refuse_beside_missed(const std::string& material, std::vector<ChannelResult>& results) {
  const ChannelResult* first = nullptr;
  int missed = 0;
  for (const ChannelResult& r : results) {
    if (r.material != material || !r.estimate.converged || !r.refused()) continue;
    if (!misses_image(r.estimate)) continue;
    if (first == nullptr) first = &r;
    ++missed;
  }
  if (missed < 2) return;
  const std::string text =
      fmt::format("channel {} of these shots: {}", first->channel, first->estimate.reasons.front());
  for (ChannelResult& r : results) {
    if (r.material == material) refuse_as_another(text, r);
  }
}

// What one channel does not show of the positions and directions that all share, the others may.
void see_with_all_channels(const JointJudgement& joint, std::vector<ChannelResult>& results) {
  for (ChannelResult& r : results) {
    for (PriorPull& own : r.estimate.pulls) {
      const auto same_name = [&](const auto& other) { return other.name == own.name; };
      const auto all = std::find_if(joint.pulls.begin(), joint.pulls.end(), same_name);
      const auto stated =
          std::find_if(r.evidence.nuisances.begin(), r.evidence.nuisances.end(), same_name);
      if (all == joint.pulls.end() || stated == r.evidence.nuisances.end()) continue;
      see_from(kMostPull / std::sqrt(1.0 - std::pow(all->std / stated->std, 2)), own);
    }
  }
}

}  // namespace

JointJudgement joint_pulls_of(const std::vector<ChannelResult>& results) {
  return joint_pulls(evidence_of(results, ""));
}

JointJudgement most_probable_pulls_of(const std::vector<ChannelResult>& results) {
  std::vector<const RigEvidence*> evidence = evidence_of(results, "");
  if (evidence.empty()) {
    for (const ChannelResult& r : results) {
      if (r.estimate.converged && !r.evidence.nuisances.empty()) evidence.push_back(&r.evidence);
    }
  }
  return joint_pulls(evidence);
}

JointJudgement joint_pulls_of(const std::vector<ChannelResult>& results,
                              const std::string& material) {
  return joint_pulls(evidence_of(results, material), is_shared_by_material);
}

void refuse_contradicted(std::vector<ChannelResult>& results) {
  // By material: the channel that contradicts the rig, as it stands without the others. That of a
  // channel whose model misses its image counts if a second channel contradicts the rig as well,
  // and for channels that nearly do.
  constexpr double kNearly = 3.0;
  std::map<std::string, std::string> contradicted, doubtful;
  for (const ChannelResult& r : results) {
    const PriorPull* worst = contradiction(r.estimate.pulls, kMostPull, kLeastPullImage);
    if (worst == nullptr || !r.estimate.converged) continue;
    const std::string text = fmt::format("channel {} of these shots: {}", r.channel,
                                         contradiction_sentence(*worst, r.estimate.pulls));
    const bool is_second = !doubtful.try_emplace(r.material, text).second;
    if (explains_its_image(r) || is_second) contradicted.try_emplace(r.material, text);
  }
  const JointJudgement joint = joint_pulls_of(results);
  see_with_all_channels(joint, results);
  refuse_with_all_channels(joint, "", results);
  std::set<std::string> materials;
  for (const ChannelResult& r : results) materials.insert(r.material);
  for (const std::string& material : materials) {
    refuse_with_all_channels(joint_pulls_of(results, material), material, results);
    refuse_stray_light(material, results);
    refuse_beside_missed(material, results);
  }
  refuse_beside_others(results);
  for (ChannelResult& r : results) {
    const bool nearly = contradiction(r.estimate.pulls, kNearly, kLeastPullImage) != nullptr;
    const auto& by = nearly && !contradicted.contains(r.material) ? doubtful : contradicted;
    if (const auto it = by.find(r.material); it != by.end()) refuse_as_another(it->second, r);
  }
}

}  // namespace scattermeter
