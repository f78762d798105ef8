#include "core/fit/prior_pulls.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <stdexcept>
#include <utility>

#include <fmt/core.h>
#include <fmt/format.h>

#include "core/base/chi_square.h"
#include "core/base/dense_solve.h"

namespace scattermeter {
namespace {

// What remains of the model's rows when the free unknowns are projected out.
struct Projected {
  Eigen::VectorXd residual;
  Eigen::MatrixXd moving;  // columns times their deviations
  Eigen::MatrixXd exact;   // columns of unit size
};

Eigen::MatrixXd side_by_side(const Eigen::MatrixXd& columns, const std::vector<Eigen::Index>& which,
                             const std::vector<double>& size) {
  Eigen::MatrixXd out(columns.rows(), static_cast<Eigen::Index>(which.size()));
  for (Eigen::Index k = 0; k < out.cols(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    out.col(k) = size[i] * columns.col(which[i]);
  }
  return out;
}

double over(double value, double size) {
  return size > 0.0 && std::isfinite(value) ? value / size : 0.0;
}

double over_root(double value, double variance) {
  return over(value, std::sqrt(std::max(0.0, variance)));
}

// The next step for a contradiction, by the group of the quantity.
const char* advice(const std::string& group) {
  constexpr std::array<std::pair<const char*, const char*>, 23> kAdvice = {{
      {"pose", "check the pose points, and that neither camera nor object has moved"},
      {"camera shift", "fasten camera and object, and take the shot again"},
      {"lens", "calibrate the camera at this focus, and check the mesh's proportions"},
      {"mesh position", "check where the object stands and that its mesh is the right one"},
      {"mesh scale", "measure the object and scale its mesh"},
      {"edges", "round the mesh's edges as those of the object are"},
      {"LED position", "measure the LED's position, and check which LED is on"},
      {"LED axis", "measure where the LED points"},
      {"LED exponent", "calibrate the LED's lobe"},
      {"LED power", "measure the LED's intensity, and check which LED is on"},
      {"LED calibration", "calibrate the LED again"},
      {"scale", "check the LED's intensity and the camera's responsivity"},
      {"eta", "measure the refractive index, or state a larger eta_std"},
      {"roughness", "state the roughness of the object's surface"},
      {"phase function", "state the phase function of the material, or a larger g_std"},
      {"even light", "switch off other lamps, or list an ambient light"},
      {"surroundings", "state the surroundings, or put the object on a black stand"},
      {"pedestal", "check the black level, and look for stray light and glare in the lens"},
      {"halo", "clean the lens, shade it from the LEDs, and darken what lies beside the object"},
      {"vignetting", "take flats, and calibrate the camera's radiance"},
      {"non-linearity", "take flats, and calibrate the camera's radiance"},
      {"exposure time", "calibrate the camera's radiance"},
      {"radiance", "measure the radiance of the environment again"},
  }};
  const auto* it = std::find_if(kAdvice.begin(), kAdvice.end(),
                                [&](const auto& known) { return group == known.first; });
  return it == kAdvice.end() ? "check it, or state a larger uncertainty" : it->second;
}

std::string named(const PriorPull& p) {
  return p.name.empty() || p.name == p.group ? p.group : fmt::format("{} ({})", p.group, p.name);
}

// The largest pulls of other groups that come near to the worst, each group once.
std::vector<PriorPull> rivals(const PriorPull& worst, std::vector<PriorPull> pulls) {
  constexpr double kNear = 0.7;
  constexpr std::size_t kMost = 2;
  std::erase_if(pulls, [&](const PriorPull& p) {
    return !(std::abs(p.pull) > kNear * std::abs(worst.pull)) ||
           !(p.image_relative > kLeastPullImage);
  });
  std::stable_sort(pulls.begin(), pulls.end(), [](const PriorPull& a, const PriorPull& b) {
    return std::abs(a.pull) > std::abs(b.pull);
  });
  std::set<std::string> groups = {worst.group};
  std::erase_if(pulls, [&](const PriorPull& p) { return !groups.insert(p.group).second; });
  if (pulls.size() > kMost) pulls.resize(kMost);
  return pulls;
}

}  // namespace

ModelJudgement judge(const WhitenedModel& model) {
  const Eigen::Index rows = model.residual.size();
  const auto n = static_cast<Eigen::Index>(model.nuisances.size());
  if (model.free.rows() != rows || (n > 0 && model.columns.rows() != rows) ||
      model.columns.cols() != n) {
    throw std::invalid_argument("judge: sizes differ");
  }
  std::vector<Eigen::Index> moving, exact, unbound;
  std::vector<double> std, ones;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double own = model.nuisances[static_cast<std::size_t>(i)].std;
    if (std::isinf(own)) {
      unbound.push_back(i);
    } else if (own > 0.0) {
      moving.push_back(i);
      std.push_back(own);
    } else {
      exact.push_back(i);
      ones.push_back(1.0);
    }
  }
  Eigen::MatrixXd free(rows, model.free.cols() + static_cast<Eigen::Index>(unbound.size()));
  free.leftCols(model.free.cols()) = model.free;
  for (std::size_t k = 0; k < unbound.size(); ++k) {
    free.col(model.free.cols() + static_cast<Eigen::Index>(k)) = model.columns.col(unbound[k]);
  }
  const Eigen::VectorXd per_unit = free.colwise().norm().transpose();
  for (Eigen::Index k = 0; k < free.cols(); ++k) {
    if (per_unit[k] > 0.0) free.col(k) /= per_unit[k];
  }
  // Eigen does not decompose matrices without columns.
  if (free.cols() == 0) free = Eigen::MatrixXd::Zero(rows, 1);
  const PivotedSolver qr(free);
  const Eigen::Index left = rows - qr.rank();
  ModelJudgement out;
  out.dof = static_cast<double>(left);
  if (left <= 0) return out;
  const auto projected = [&](const Eigen::MatrixXd& columns) -> Eigen::MatrixXd {
    if (columns.cols() == 0) return Eigen::MatrixXd(left, 0);
    return qr.rotate_columns(columns).bottomRows(left);
  };
  const Eigen::MatrixXd by_std = side_by_side(model.columns, moving, std);
  const Projected rest{qr.rotate(model.residual).tail(left), projected(by_std),
                       projected(side_by_side(model.columns, exact, ones))};
  const Eigen::MatrixXd& b = rest.moving;
  const Eigen::MatrixXd information = b.transpose() * b;
  const Eigen::MatrixXd posterior =
      b.cols() > 0
          ? SymmetricSolver(Eigen::MatrixXd::Identity(b.cols(), b.cols()) + information).inverse()
          : Eigen::MatrixXd(0, 0);
  const Eigen::VectorXd v = posterior * (b.transpose() * rest.residual);
  const Eigen::VectorXd settled = rest.residual - b * v;
  out.chi2 = as_chi_square(rest.residual.dot(settled));
  out.p_value = chi_square_tail(out.chi2, out.dof);
  const Eigen::MatrixXd told = information * posterior;
  constexpr double kRounding = 1e-12;
  // Of the unknowns, by one deviation of each: as far as it is not taken for what it is.
  const Eigen::MatrixXd shifts = qr.solve_columns(by_std * posterior);
  std::vector<PriorPull> pulls(model.nuisances.size());
  std::vector<bool> has_pull(model.nuisances.size());
  const double length = std::max(model.data_length, 1e-300);
  out.evidence.data_length = model.data_length;
  out.evidence.information = information;
  out.evidence.score = b.transpose() * rest.residual;
  out.evidence.image_relative.resize(b.cols());
  for (std::size_t k = 0; k < moving.size(); ++k) {
    out.evidence.nuisances.push_back(model.nuisances[static_cast<std::size_t>(moving[k])]);
    out.evidence.image_relative[static_cast<Eigen::Index>(k)] =
        std[k] * model.columns.col(moving[k]).norm() / length;
  }
  const auto report = [&](Eigen::Index i, double offset, double pull) {
    const Nuisance& nuisance = model.nuisances[static_cast<std::size_t>(i)];
    has_pull[static_cast<std::size_t>(i)] = true;
    pulls[static_cast<std::size_t>(i)] = {nuisance.name,
                                          nuisance.group,
                                          pull,
                                          offset,
                                          std::abs(offset) * model.columns.col(i).norm() / length,
                                          std::abs(pull) / length};
  };
  for (std::size_t k = 0; k < moving.size(); ++k) {
    const auto at = static_cast<Eigen::Index>(k);
    if (!model.nuisances[static_cast<std::size_t>(moving[k])].fitted) continue;
    const double variance = told(at, at) > kRounding ? told(at, at) : 0.0;
    report(moving[k], std[k] * v[at], over_root(v[at], variance));
    PriorPull& pull = pulls[static_cast<std::size_t>(moving[k])];
    const double unseen = kMostPull / std::sqrt(std::max(told(at, at), kRounding));
    pull.least_seen_in_std = unseen;
    if (model.free.cols() < 2) continue;
    pull.unseen_sigma_s_prime_per_mm = unseen * over(shifts(0, at), per_unit[0]);
    pull.unseen_sigma_a_per_mm = unseen * over(shifts(1, at), per_unit[1]);
  }
  for (std::size_t k = 0; k < exact.size(); ++k) {
    const Eigen::VectorXd e = rest.exact.col(static_cast<Eigen::Index>(k));
    const Eigen::VectorXd shared = b.transpose() * e;
    const double score = e.dot(settled);
    const double e2 = e.squaredNorm();
    double variance = e2 - shared.dot(posterior * shared);
    if (!(variance > kRounding * model.columns.col(exact[k]).squaredNorm())) variance = 0.0;
    report(exact[k], variance > 0.0 ? score / variance : 0.0, over_root(score, variance));
  }
  for (std::size_t i = 0; i < pulls.size(); ++i) {
    if (has_pull[i]) out.pulls.push_back(std::move(pulls[i]));
  }
  return out;
}

const PriorPull* contradiction(const std::vector<PriorPull>& pulls, double most_pull,
                               double least_image, double least_explained) {
  const PriorPull* worst = nullptr;
  const auto is_visible = [&](const PriorPull& p) { return p.image_relative > least_image; };
  for (const PriorPull& p : pulls) {
    if (!(std::abs(p.pull) > (is_visible(p) ? most_pull : std::max(most_pull, kClearPull)))) {
      continue;
    }
    const bool is_far = is_visible(p) && std::abs(p.pull) > kFarPull;
    if (!is_far && !(p.explained_relative > least_explained)) continue;
    if (worst == nullptr || std::pair(is_visible(p), std::abs(p.pull)) >
                                std::pair(is_visible(*worst), std::abs(worst->pull))) {
      worst = &p;
    }
  }
  return worst;
}

void see_from(double least_seen_in_std, PriorPull& pull) {
  if (!(least_seen_in_std < pull.least_seen_in_std)) return;
  const double share = least_seen_in_std / pull.least_seen_in_std;
  pull.least_seen_in_std = least_seen_in_std;
  pull.unseen_sigma_s_prime_per_mm *= share;
  pull.unseen_sigma_a_per_mm *= share;
}

void set_unseen(const Eigen::VectorXd& moves, double sigma_s_per_mm, PriorPull& pull) {
  pull.unseen_sigma_s_prime_per_mm = pull.least_seen_in_std * sigma_s_per_mm * moves[0];
  pull.unseen_sigma_a_per_mm = pull.least_seen_in_std * moves[1];
}

double unseen_in_std(const PriorPull& pull, const Estimate& e) {
  return std::max(std::abs(over(pull.unseen_sigma_s_prime_per_mm, e.sigma_s_prime_per_mm.std)),
                  std::abs(over(pull.unseen_sigma_a_per_mm, e.sigma_a_per_mm.std)));
}

std::vector<PriorPull> rests_on(const Estimate& estimate) {
  std::vector<PriorPull> out = estimate.pulls;
  std::erase_if(out,
                [&](const PriorPull& p) { return !(unseen_in_std(p, estimate) > kMostUnseen); });
  std::stable_sort(out.begin(), out.end(), [&](const PriorPull& a, const PriorPull& b) {
    return unseen_in_std(a, estimate) > unseen_in_std(b, estimate);
  });
  std::set<std::string> groups;
  std::erase_if(out, [&](const PriorPull& p) { return !groups.insert(p.group).second; });
  return out;
}

std::string rests_on_sentence(const Estimate& estimate) {
  const std::vector<PriorPull> on = rests_on(estimate);
  if (on.empty()) return "";
  std::vector<std::string> groups;
  for (const PriorPull& p : on) groups.push_back(p.group);
  const PriorPull& worst = on.front();
  return fmt::format(
      "rests on the stated {}: an error of {} of up to {:.2g} stated deviations would not show, "
      "and would shift sigma_s' by {:.2g} and sigma_a by {:.2g} /mm",
      fmt::join(groups, ", "), named(worst), worst.least_seen_in_std,
      std::abs(worst.unseen_sigma_s_prime_per_mm), std::abs(worst.unseen_sigma_a_per_mm));
}

std::string contradiction_sentence(const PriorPull& worst, const std::vector<PriorPull>& pulls) {
  std::string out = fmt::format(
      "the shots contradict the {} that the rig states, by {:.3g} standard deviations: {}",
      named(worst), std::abs(worst.pull), advice(worst.group));
  const std::vector<PriorPull> others = rivals(worst, pulls);
  for (std::size_t i = 0; i < others.size(); ++i) {
    out += fmt::format("{}{}, by {:.3g}", i == 0 ? "; or perhaps the " : ", or the ",
                       named(others[i]), std::abs(others[i].pull));
  }
  return out;
}

std::string far_eta(const std::vector<PriorPull>& pulls, double eta_int_over_ext) {
  constexpr double kFarthest = 0.12;
  for (const PriorPull& p : pulls) {
    if (p.group != "eta" || !(std::abs(p.offset) > kFarthest)) continue;
    // Where eta is stated as exact, its offset is what the image alone says, however little.
    const bool is_exact = p.least_seen_in_std == 0.0;
    if (is_exact && !(std::abs(p.pull) > kDoubtfulPull)) continue;
    return fmt::format(
        "the shots put eta at {:.2f}, which differs from the {:g} that the rig states by more than "
        "tables are off ({:g}): measure the refractive index, and check the focus",
        eta_int_over_ext + p.offset, eta_int_over_ext, kFarthest);
  }
  return "";
}

}  // namespace scattermeter
