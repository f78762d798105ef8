#include "core/agreement/joint_evidence.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <iterator>
#include <map>
#include <string_view>

#include "core/base/dense_solve.h"
#include "core/base/symmetric_eigen.h"

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

bool is_named(const Nuisance& nuisance) { return nuisance.fitted && !nuisance.name.empty(); }

// The sum of what the channels say about the nuisances for which `shared` is true, and about all
// named ones of the channel `whole` (may be null), the others of each channel eliminated. In the
// order of their first occurrence; image_relative is that of the channel in which it is largest.
RigEvidence joint_evidence(const std::vector<const RigEvidence*>& channels,
                           bool (*shared)(const Nuisance&), const RigEvidence* whole) {
  RigEvidence out;
  std::map<std::string, Eigen::Index> index;
  std::vector<Shared> parts;
  std::vector<double> image;  // by one deviation
  for (const RigEvidence* e : channels) {
    out.data_length = std::hypot(out.data_length, e->data_length);
    const Shared& part = parts.emplace_back(shared_part(*e, e == whole ? is_named : shared));
    for (const Eigen::Index k : part.at) {
      const Nuisance& n = e->nuisances[static_cast<std::size_t>(k)];
      const auto [it, is_new] =
          index.try_emplace(n.name, static_cast<Eigen::Index>(out.nuisances.size()));
      if (is_new) {
        out.nuisances.push_back(n);
        image.push_back(0.0);
      }
      double& most = image[static_cast<std::size_t>(it->second)];
      most = std::max(most, e->image_relative[k]);
    }
  }
  const auto n = static_cast<Eigen::Index>(out.nuisances.size());
  out.image_relative = Eigen::Map<const Eigen::VectorXd>(image.data(), n);
  out.information = Eigen::MatrixXd::Zero(n, n);
  out.score = Eigen::VectorXd::Zero(n);
  for (std::size_t c = 0; c < channels.size(); ++c) {
    std::vector<Eigen::Index> to;
    for (const Eigen::Index k : parts[c].at) {
      to.push_back(index.at(channels[c]->nuisances[static_cast<std::size_t>(k)].name));
    }
    out.information(to, to) += parts[c].information;
    out.score(to) += parts[c].score;
  }
  return out;
}

JointJudgement judgement_of(const RigEvidence& evidence) {
  JointJudgement out;
  out.data_length = evidence.data_length;
  const Eigen::Index n = evidence.score.size();
  if (n == 0) return out;
  const Eigen::MatrixXd posterior =
      SymmetricSolver(Eigen::MatrixXd::Identity(n, n) + evidence.information).inverse();
  const Eigen::VectorXd v = posterior * evidence.score;
  // The variance that v has if all statements hold.
  const Eigen::MatrixXd told = evidence.information * posterior;
  for (Eigen::Index k = 0; k < n; ++k) {
    constexpr double kRounding = 1e-12;
    const Nuisance& nuisance = evidence.nuisances[static_cast<std::size_t>(k)];
    PriorPull& pull = out.pulls.emplace_back(PriorPull{nuisance.name, nuisance.group});
    pull.pull = told(k, k) > kRounding ? v[k] / std::sqrt(told(k, k)) : 0.0;
    pull.offset = v[k] * nuisance.std;
    pull.std = std::sqrt(posterior(k, k)) * nuisance.std;
    pull.image_relative = std::abs(v[k]) * evidence.image_relative[k];
    pull.explained_relative = std::abs(pull.pull) / std::max(out.data_length, 1e-300);
  }
  // The score has the covariance information (1 + information) if all statements hold.
  const SymmetricEigen by = symmetric_eigen(evidence.information);
  constexpr double kLeastInformation = 1e-2;
  for (Eigen::Index k = 0; k < n; ++k) {
    const double told_k = by.values[k];
    if (!(told_k > kLeastInformation)) continue;
    const double along = by.vectors.col(k).dot(evidence.score);
    out.chi2 += along * along / (told_k * (1.0 + told_k));
    out.dof += 1.0;
  }
  return out;
}

bool is_of(const Nuisance& nuisance, std::initializer_list<std::string_view> groups) {
  return is_named(nuisance) &&
         std::find(groups.begin(), groups.end(), nuisance.group) != groups.end();
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
  return judgement_of(joint_evidence(channels, shared, nullptr));
}

std::vector<PriorPull> own_pulls_beside(const RigEvidence& one,
                                        const std::vector<const RigEvidence*>& others) {
  std::vector<const RigEvidence*> all = {&one};
  std::copy_if(others.begin(), others.end(), std::back_inserter(all),
               [&](const RigEvidence* e) { return e != &one; });
  const RigEvidence together = joint_evidence(all, is_shared, &one);
  const std::vector<PriorPull> pulls = judgement_of(together).pulls;
  std::vector<PriorPull> own;
  for (std::size_t k = 0; k < pulls.size(); ++k) {
    if (!is_shared(together.nuisances[k])) own.push_back(pulls[k]);
  }
  return own;
}

}  // namespace scattermeter
