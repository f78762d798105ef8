#include "calib/pose/edge_explanations.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <set>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "calib/pose/edge_scatter.h"
#include "core/base/chi_square.h"
#include "core/base/dense_solve.h"

namespace scattermeter::calib {
namespace {

using namespace edge_parameter;

constexpr double kDoubt = 1e-4;    // p below which chance is out of the question
constexpr double kCloseScore = 6;  // causes closer than this cannot be distinguished
constexpr double kCloseChi2 = 9;   // a cause that fits as well within this is named, too
// Standard deviations of priors that bound what the outline does not determine.
constexpr double kLooseTurn_rad = 0.3;
constexpr double kLooseDistance = 0.3;
constexpr double kLooseLog = 0.2;
constexpr double kLooseDistortion = 0.3;

std::vector<int> with_pose(std::vector<int> more) {
  std::vector<int> all = {0, 1, 2, 3, 4, 5};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

std::string formatted(const char* format, double value, double std) {
  char text[160];
  std::snprintf(text, sizeof text, format, value, std);
  return text;
}

// Length of a part of the values and its standard deviation along its direction.
std::pair<double, double> length(const EdgeFit& f, int first) {
  const Eigen::Vector3d v = f.value.segment<3>(first);
  const Eigen::Matrix3d c = f.covariance.block<3, 3>(first, first);
  const Eigen::Vector3d u = v.norm() > 0 ? v.normalized().eval() : Eigen::Vector3d::UnitX().eval();
  return {v.norm(), std::sqrt(u.dot(c * u))};
}

double rms(const std::vector<double>& residual) {
  double sum = 0;
  for (const double r : residual) sum += r * r;
  return std::sqrt(sum / static_cast<double>(residual.size()));
}

void describe(const EdgeFit& f, const std::vector<std::string>& names, EdgeExplanation& e) {
  constexpr double kDegree = 180 / std::numbers::pi;
  const auto relative = [&](int parameter) {
    e.value = std::expm1(f.value[parameter]);
    e.std = std::exp(f.value[parameter]) * std::sqrt(f.covariance(parameter, parameter));
  };
  switch (e.cause) {
    case EdgeCause::kNone:
      e.text = "the rig as it is";
      break;
    case EdgeCause::kCameraTurned:
      std::tie(e.value, e.std) = length(f, kTurn);
      e.value *= kDegree;
      e.std *= kDegree;
      e.text = formatted("camera turned by %.3f +- %.3f deg", e.value, e.std);
      break;
    case EdgeCause::kCameraMoved:
      std::tie(e.value, e.std) = length(f, kMove);
      e.text = formatted("camera moved by %.3f +- %.3f mm", e.value, e.std);
      break;
    case EdgeCause::kMeshScale:
    case EdgeCause::kAllMeshScales: {
      relative(e.cause == EdgeCause::kAllMeshScales ? kScale : kScaleOfBody + e.body_idx);
      const std::string whose = e.cause == EdgeCause::kAllMeshScales
                                    ? "all meshes"
                                    : "mesh of " + names.at(static_cast<std::size_t>(e.body_idx));
      e.text = whose +
               formatted(e.value > 0 ? " %.2f +- %.2f %% too small" : " %.2f +- %.2f %% too large",
                         100 * std::abs(e.value), 100 * e.std);
      break;
    }
    case EdgeCause::kFocalLength:
      relative(kFocal);
      e.text = formatted(e.value > 0 ? "focal length %.2f +- %.2f %% longer"
                                     : "focal length %.2f +- %.2f %% shorter",
                         100 * std::abs(e.value), 100 * e.std);
      e.text += formatted(", k1 changed by %.3f +- %.3f", f.value[kDistortion],
                          std::sqrt(f.covariance(kDistortion, kDistortion)));
      break;
    case EdgeCause::kCameraTurnedMoved: {
      std::tie(e.value, e.std) = length(f, kTurn);
      e.value *= kDegree;
      e.std *= kDegree;
      const auto [move, move_std] = length(f, kMove);
      e.text = formatted("camera turned by %.3f +- %.3f deg", e.value, e.std) +
               formatted(" and moved by %.3f +- %.3f mm", move, move_std);
      break;
    }
  }
}

// Causes are limited by their loose standard deviations only, the pose by its covariance.
EdgeFitOptions loose_fit(const std::vector<EdgePoint>& points, const PoseResult& pose) {
  const int size = edge_parameters(points);
  const double distance_mm = pose.camera_from_world.translation_mm.norm();
  EdgeFitOptions fit;
  fit.prior = Eigen::MatrixXd::Zero(size, size);
  fit.prior.topLeftCorner<6, 6>() = SymmetricSolver(pose.covariance).inverse();
  for (int i = 0; i < 3; ++i) {
    fit.prior(kTurn + i, kTurn + i) = 1 / std::pow(kLooseTurn_rad, 2);
    fit.prior(kMove + i, kMove + i) = 1 / std::pow(kLooseDistance * distance_mm, 2);
  }
  fit.prior(kDistortion, kDistortion) = 1 / std::pow(kLooseDistortion, 2);
  for (int i = 0; i < size; ++i) {
    if (i == kFocal || i >= kScale) fit.prior(i, i) = 1 / std::pow(kLooseLog, 2);
  }
  return fit;
}

// Fits one cause after the other, each together with the pose and the other uncertain quantities of
// the rig.
class CauseFits {
 public:
  CauseFits(const std::vector<EdgePoint>& points, const CameraIntrinsics& intrinsics,
            const PoseResult& pose, const std::vector<std::string>& names,
            const EdgeExplanationOptions& options)
      : points_(points),
        intrinsics_(intrinsics),
        pose_(pose.camera_from_world),
        names_(names),
        fit_(loose_fit(points, pose)) {
    for (const EdgePoint& p : points) bodies_.insert(p.body_idx);
    fit_all_causes(options.line_std_px);
    known_prior_ = fit_.prior;
    know(kFocal, options.focal_relative_std);
    know(kDistortion, options.k1_std);
    for (const int b : bodies_) know(kScaleOfBody + b, options.scale_relative_std);
  }

  const EdgeFit& all_causes() const { return rich_; }
  const EdgeScatter& scatter() const { return scatter_; }

  std::vector<EdgeExplanation> explanations() const {
    std::vector<EdgeExplanation> out;
    out.push_back(fit(EdgeCause::kNone, -1, {}));
    out.push_back(fit(EdgeCause::kCameraTurned, -1, {kTurn, kTurn + 1, kTurn + 2}));
    out.push_back(fit(EdgeCause::kCameraMoved, -1, {kMove, kMove + 1, kMove + 2}));
    for (const int b : bodies_) out.push_back(fit(EdgeCause::kMeshScale, b, {kScaleOfBody + b}));
    if (bodies_.size() > 1) out.push_back(fit(EdgeCause::kAllMeshScales, -1, {kScale}));
    out.push_back(fit(EdgeCause::kFocalLength, -1, {kFocal, kDistortion}));
    out.push_back(fit(EdgeCause::kCameraTurnedMoved, -1,
                      {kTurn, kTurn + 1, kTurn + 2, kMove, kMove + 1, kMove + 2}));
    return out;
  }

 private:
  // A turn and a move in addition to a free pose are redundant: the pose without its prior
  // represents both.
  void fit_all_causes(double line_std_px) {
    std::vector<int> all = {kFocal, kDistortion};
    for (const int b : bodies_) all.push_back(kScaleOfBody + b);
    EdgeFitOptions every = fit_;
    every.free = with_pose(all);
    // As loose as turn and move.
    every.prior.topLeftCorner<6, 6>() = fit_.prior.block<6, 6>(kTurn, kTurn);
    scatter_ = edge_scatter(points_, intrinsics_, pose_, every, line_std_px);
    fit_.line_std_px = every.line_std_px = scatter_.line_std_px;
    fit_.piece_std_px = every.piece_std_px = scatter_.piece_std_px;
    rich_ = fit_edges(points_, intrinsics_, pose_, every);
    rich_parameters_ = static_cast<int>(every.free.size());
  }

  void know(int parameter, double std) {
    if (!(std > 0)) return;
    known_.push_back(parameter);
    known_prior_(parameter, parameter) = 1 / std::pow(std, 2);
  }

  EdgeExplanation fit(EdgeCause cause, int body_idx, const std::vector<int>& extra) const {
    EdgeFitOptions o = fit_;
    o.prior = known_prior_;
    std::vector<int> more = known_;
    for (const int p : extra) {
      o.prior(p, p) = fit_.prior(p, p);
      if (std::find(more.begin(), more.end(), p) == more.end()) more.push_back(p);
    }
    o.free = with_pose(more);
    const EdgeFit f = fit_edges(points_, intrinsics_, pose_, o);
    EdgeExplanation e;
    e.cause = cause;
    e.body_idx = body_idx;
    e.parameters = static_cast<int>(extra.size());
    e.chi2 = f.chi2;
    e.rms_px = rms(f.residual_px);
    const double left = std::max(0.0, f.chi2 - rich_.chi2);
    e.explains =
        f.converged && chi_square_tail(left, std::max(1, rich_parameters_ - e.parameters)) > kDoubt;
    describe(f, names_, e);
    return e;
  }

  const std::vector<EdgePoint>& points_;
  const CameraIntrinsics& intrinsics_;
  const Rigid3d& pose_;
  const std::vector<std::string>& names_;
  EdgeFitOptions fit_;
  std::set<int> bodies_;
  EdgeScatter scatter_;
  EdgeFit rich_;  // of all causes at once
  int rich_parameters_ = 0;
  std::vector<int> known_;
  Eigen::MatrixXd known_prior_;
};

// Cause, body and verdict from the explanations tried, with `n_lines` lines in all.
void conclude(std::size_t n_lines, EdgeDiagnosis& out) {
  if (out.agrees) {
    out.is_unambiguous = true;
    out.verdict = "the outline agrees with the rig";
    return;
  }
  const double per_parameter = std::log(2.0 * static_cast<double>(n_lines));
  const auto score = [&](const EdgeExplanation& e) {
    return e.chi2 + e.parameters * per_parameter;
  };
  const EdgeExplanation* best = nullptr;
  for (const EdgeExplanation& e : out.explanations) {
    if (e.explains && (best == nullptr || score(e) < score(*best))) best = &e;
  }
  if (best == nullptr) {
    out.verdict =
        "the outline contradicts the rig, and neither the camera's pose, the mesh's scale nor the "
        "focal length alone explains it";
    return;
  }
  out.cause = best->cause;
  out.body_idx = best->body_idx;
  out.verdict = best->text;
  out.is_unambiguous = true;
  std::string others;
  std::string unlikely;
  for (const EdgeExplanation& e : out.explanations) {
    const bool holds_best =
        e.cause == EdgeCause::kCameraTurnedMoved &&
        (best->cause == EdgeCause::kCameraTurned || best->cause == EdgeCause::kCameraMoved);
    if (&e == best || !e.explains || holds_best || e.chi2 > best->chi2 + kCloseChi2) continue;
    if (score(e) <= score(*best) + kCloseScore) {
      out.is_unambiguous = false;
      others += (others.empty() ? "; cannot be distinguished from: " : ", ") + e.text;
    } else {
      unlikely += (unlikely.empty() ? "; as good a fit with more freedom: " : ", ") + e.text;
    }
  }
  out.verdict += others + unlikely;
}

}  // namespace

EdgeDiagnosis explain_edges(const std::vector<EdgePoint>& points,
                            const CameraIntrinsics& intrinsics, const PoseResult& pose,
                            const std::vector<std::string>& names,
                            const EdgeExplanationOptions& options) {
  if (points.empty()) throw std::invalid_argument("explain_edges: no points");
  const CauseFits fits(points, intrinsics, pose, names, options);
  EdgeDiagnosis out;
  out.line_std_px = fits.scatter().line_std_px;
  out.piece_std_px = fits.scatter().piece_std_px;
  out.residual_px = fits.all_causes().residual_px;
  out.explanations = fits.explanations();
  out.agrees = fits.all_causes().converged && out.explanations[0].explains;
  std::set<std::pair<int, int>> lines;
  for (const EdgePoint& p : points) lines.insert({p.body_idx, p.line_idx});
  conclude(lines.size(), out);
  return out;
}

}  // namespace scattermeter::calib
