#include "core/estimation/joint_evidence.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/core.h>

#include "core/base/chi_square.h"
#include "core/base/dense_solve.h"
#include "core/base/symmetric_eigen.h"
#include "core/estimation/model_choice.h"

namespace scattermeter {
namespace {

// The nuisances of one channel that are shared, and its evidence about them.
struct Shared {
  std::vector<Eigen::Index> at;  // in the channel's evidence
  Eigen::MatrixXd information;
  Eigen::VectorXd score;
};

Shared shared_part(const RigEvidence& e, bool (*shared)(const Nuisance&)) {
  Shared out;
  std::vector<Eigen::Index> own;
  for (std::size_t k = 0; k < e.nuisances.size(); ++k) {
    (shared(e.nuisances[k]) ? out.at : own).push_back(static_cast<Eigen::Index>(k));
  }
  out.information = e.information(out.at, out.at);
  out.score = e.score(out.at);
  if (own.empty() || out.at.empty()) return out;
  const auto n = static_cast<Eigen::Index>(own.size());
  const SymmetricSolver solver(Eigen::MatrixXd::Identity(n, n) + e.information(own, own));
  const Eigen::MatrixXd across = e.information(own, out.at);
  out.information -= across.transpose() * solver.solve_columns(across);
  out.score -= across.transpose() * solver.solve(Eigen::VectorXd(e.score(own)));
  return out;
}

bool is_of(const Nuisance& nuisance, std::initializer_list<std::string_view> groups) {
  return nuisance.fitted && !nuisance.name.empty() &&
         std::find(groups.begin(), groups.end(), nuisance.group) != groups.end();
}

// The covariance of paths is itself an estimate from so many blocks: pulls by transport have longer
// tails.
double most_pull_of(const std::vector<ChannelResult>& results) {
  return std::any_of(results.begin(), results.end(),
                     [](const ChannelResult& r) { return r.model == "transport"; })
             ? kMostPullByPaths
             : kMostPull;
}

// As improbable as one pull of that many deviations.
double probability_of(double pull) { return std::erfc(pull * M_SQRT1_2); }

// Of one material, or of all (empty).
void refuse_with_all_channels(const JointJudgement& joint, const std::string& material,
                              std::vector<ChannelResult>& results) {
  const double most_pull = most_pull_of(results);
  const PriorPull* worst = contradiction(joint.pulls, most_pull, kLeastPullImage);
  std::string text;
  if (worst != nullptr) {
    text = "all channels together: " + contradiction_sentence(*worst, joint.pulls);
  } else if (joint.dof > 0.0 &&
             chi_square_tail(joint.chi2, joint.dof) < probability_of(most_pull) &&
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
    if (!(p_value < probability_of(most_pull_of(results)))) continue;
    for (auto& [r, pull] : channels) {
      if (r->refused() || !(pull.image_relative > kLeastPullImage)) continue;
      pull.pull = std::copysign(std::sqrt(chi2), pull.pull);
      r->estimate.reasons.push_back("all channels together: " + contradiction_sentence(pull, {}));
    }
  }
}

// Where the model misses the images of two channels, the rig is not as stated, and the third
// channel may owe its good fit to wrong coefficients.
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
    if (r.material == material && !r.refused()) r.estimate.reasons.push_back(text);
  }
}

}  // namespace

bool is_shared(const Nuisance& nuisance) {
  return is_of(nuisance, {"pose", "camera shift", "lens", "mesh position", "mesh scale",
                          "LED position", "LED axis", "LED exponent"});
}

bool is_shared_by_material(const Nuisance& nuisance) {
  return is_shared(nuisance) ||
         is_of(nuisance, {"scale", "LED power", "exposure time", "eta", "edges", "surroundings"});
}

JointJudgement joint_pulls(const std::vector<const RigEvidence*>& channels,
                           bool (*shared)(const Nuisance&)) {
  JointJudgement out;
  for (const RigEvidence* e : channels) {
    out.data_length = std::hypot(out.data_length, e->data_length);
  }
  std::map<std::string, Eigen::Index> index;
  std::vector<Shared> parts;
  std::vector<double> image;  // by one deviation
  std::vector<double> std;
  for (const RigEvidence* e : channels) {
    const Shared& part = parts.emplace_back(shared_part(*e, shared));
    for (const Eigen::Index k : part.at) {
      const Nuisance& n = e->nuisances[static_cast<std::size_t>(k)];
      const auto [it, is_new] =
          index.try_emplace(n.name, static_cast<Eigen::Index>(out.pulls.size()));
      if (is_new) {
        out.pulls.push_back({n.name, n.group});
        image.push_back(0.0);
        std.push_back(n.std);
      }
      double& most = image[static_cast<std::size_t>(it->second)];
      most = std::max(most, e->image_relative[k]);
    }
  }
  const auto n = static_cast<Eigen::Index>(out.pulls.size());
  if (n == 0) return out;
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd score = Eigen::VectorXd::Zero(n);
  for (std::size_t c = 0; c < channels.size(); ++c) {
    std::vector<Eigen::Index> to;
    for (const Eigen::Index k : parts[c].at) {
      to.push_back(index.at(channels[c]->nuisances[static_cast<std::size_t>(k)].name));
    }
    information(to, to) += parts[c].information;
    score(to) += parts[c].score;
  }
  const Eigen::MatrixXd posterior =
      SymmetricSolver(Eigen::MatrixXd::Identity(n, n) + information).inverse();
  const Eigen::VectorXd v = posterior * score;
  // The variance that v has if all statements hold.
  const Eigen::MatrixXd told = information * posterior;
  for (Eigen::Index k = 0; k < n; ++k) {
    constexpr double kRounding = 1e-12;
    PriorPull& pull = out.pulls[static_cast<std::size_t>(k)];
    pull.pull = told(k, k) > kRounding ? v[k] / std::sqrt(told(k, k)) : 0.0;
    pull.offset = v[k] * std[static_cast<std::size_t>(k)];
    pull.std = std::sqrt(posterior(k, k)) * std[static_cast<std::size_t>(k)];
    pull.image_relative = std::abs(v[k]) * image[static_cast<std::size_t>(k)];
    pull.explained_relative = std::abs(pull.pull) / std::max(out.data_length, 1e-300);
  }
  // The score has the covariance information (1 + information) if all statements hold.
  const SymmetricEigen by = symmetric_eigen(information);
  constexpr double kLeastInformation = 1e-2;
  for (Eigen::Index k = 0; k < n; ++k) {
    const double told_k = by.values[k];
    if (!(told_k > kLeastInformation)) continue;
    const double along = by.vectors.col(k).dot(score);
    out.chi2 += along * along / (told_k * (1.0 + told_k));
    out.dof += 1.0;
  }
  return out;
}

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
  // channel whose model misses its image counts if a second channel contradicts the rig as well.
  std::map<std::string, std::string> contradicted;
  std::set<std::string> doubtful;
  for (const ChannelResult& r : results) {
    const PriorPull* worst =
        contradiction(r.estimate.pulls, most_pull_of(results), kLeastPullImage);
    if (worst == nullptr || !r.estimate.converged) continue;
    const bool is_second = !doubtful.insert(r.material).second;
    if (explains_its_image(r) || is_second) {
      contradicted.try_emplace(r.material,
                               fmt::format("channel {} of these shots: {}", r.channel,
                                           contradiction_sentence(*worst, r.estimate.pulls)));
    }
  }
  refuse_with_all_channels(joint_pulls_of(results), "", results);
  std::set<std::string> materials;
  for (const ChannelResult& r : results) materials.insert(r.material);
  for (const std::string& material : materials) {
    refuse_with_all_channels(joint_pulls_of(results, material), material, results);
    refuse_stray_light(material, results);
    refuse_beside_missed(material, results);
  }
  for (ChannelResult& r : results) {
    const auto by = contradicted.find(r.material);
    if (by == contradicted.end() || r.refused()) continue;
    r.estimate.reasons.push_back(by->second);
  }
}

}  // namespace scattermeter
