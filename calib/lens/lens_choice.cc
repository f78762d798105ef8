#include "calib/lens/lens_choice.h"

#include <cmath>
#include <limits>

#include <tbb/parallel_for.h>

#include "core/base/symmetric_eigen.h"
#include "core/camera/lens.h"

namespace scattermeter::calib {
namespace {

constexpr double kStandardErrors = 0.5;
constexpr std::size_t kLeastViewsOfChoice = 4;

struct Trial {
  LensCandidate candidate;
  CameraBundle bundle;
  std::vector<double> left_out_px2;  // sum of squares per view
};

// Whether every point on the border of the frame, half a pixel outside it, has a ray.
bool covers_frame(const CameraIntrinsics& k) {
  const Lens lens(k);
  constexpr int kSteps = 32;
  for (int i = 0; i <= kSteps; ++i) {
    const double x = -0.5 + static_cast<double>(i) / kSteps * k.width_px;
    const double y = -0.5 + static_cast<double>(i) / kSteps * k.height_px;
    for (const Eigen::Vector2d& p :
         {Eigen::Vector2d(x, -0.5), Eigen::Vector2d(x, k.height_px - 0.5), Eigen::Vector2d(-0.5, y),
          Eigen::Vector2d(k.width_px - 0.5, y)}) {
      if (!lens.unproject(p).allFinite()) return false;
    }
  }
  return true;
}

// Solves symmetric equations scaled to unit diagonal; false if they are singular.
bool solve(const Eigen::MatrixXd& m, const Eigen::VectorXd& right, Eigen::VectorXd* x) {
  const Eigen::VectorXd scale = m.diagonal().cwiseSqrt().cwiseInverse();
  if (!scale.allFinite()) return false;
  const SymmetricEigen eigen = symmetric_eigen(scale.asDiagonal() * m * scale.asDiagonal());
  if (!(eigen.values[0] > 1e-13)) return false;
  const Eigen::VectorXd scaled = eigen.vectors.transpose() * scale.cwiseProduct(right);
  *x = scale.cwiseProduct(eigen.vectors * scaled.cwiseQuotient(eigen.values).matrix());
  return x->allFinite();
}

Trial try_model(const std::vector<BoardView>& views, const LensModel& model, int width_px,
                int height_px, const CameraBundle& start) {
  Trial t;
  t.candidate.model = model;
  t.candidate.left_out_rms_px = std::numeric_limits<double>::quiet_NaN();
  t.bundle = adjust_bundle(views, model, width_px, height_px, start);
  if (!t.bundle.converged) {
    t.candidate.fault = "the fit does not converge";
    return t;
  }
  const CameraIntrinsics k = intrinsics_of(t.bundle.lens, width_px, height_px);
  std::size_t n = 0;
  Eigen::MatrixXd all;
  std::vector<ViewEquations> equations;
  for (std::size_t i = 0; i < views.size(); ++i) {
    equations.push_back(view_equations(views[i], t.bundle.camera_from_board[i], k, model));
    n += views[i].corners.size();
    all = i == 0 ? equations.back().information : (all + equations.back().information).eval();
  }
  t.candidate.rms_px = std::sqrt(t.bundle.sum_squares_px2 / static_cast<double>(n));
  if (!covers_frame(k)) {
    t.candidate.fault = "its distortion folds back within the frame";
    return t;
  }
  double sum = 0;
  for (const ViewEquations& e : equations) {
    Eigen::VectorXd step;
    if (!solve(all - e.information, e.gradient, &step)) {
      t.candidate.fault = "is not determined when a view is left out";
      return t;
    }
    t.left_out_px2.push_back(e.sum_squares_px2 + 2 * e.gradient.dot(step) +
                             step.dot(e.information * step));
    sum += t.left_out_px2.back();
  }
  t.candidate.left_out_rms_px = std::sqrt(sum / static_cast<double>(n));
  return t;
}

// Whether `simple` is as good as `best` within half a standard error.
bool as_good(const Trial& simple, const Trial& best) {
  const std::size_t n = best.left_out_px2.size();
  double mean = 0, square = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double d = simple.left_out_px2[i] - best.left_out_px2[i];
    mean += d / static_cast<double>(n);
    square += d * d / static_cast<double>(n);
  }
  const double error = std::sqrt(std::max(0.0, square - mean * mean) / static_cast<double>(n - 1));
  return mean <= kStandardErrors * error;
}

}  // namespace

LensChoice choose_lens(const std::vector<BoardView>& views, int width_px, int height_px,
                       const CameraBundle& start, const std::optional<LensModel>& only) {
  std::vector<LensModel> models = all_lens_models();
  if (only) {
    models = {*only};
  } else if (views.size() < kLeastViewsOfChoice) {
    models = {{true, DistortionTerms::kK1K2}};
  } else {
    std::erase_if(models, [](const LensModel& m) { return m.terms == DistortionTerms::kK1; });
  }
  std::vector<Trial> trials(models.size());
  tbb::parallel_for(std::size_t{0}, models.size(), [&](std::size_t i) {
    trials[i] = try_model(views, models[i], width_px, height_px, start);
    // With so few views there is no cross-validation.
    if (models.size() == 1 && trials[i].bundle.converged &&
        trials[i].candidate.fault.starts_with("is not determined")) {
      trials[i].candidate.fault.clear();
    }
  });
  LensChoice out;
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    out.candidates.push_back(trials[i].candidate);
    if (!trials[i].candidate.fault.empty()) continue;
    if (!best || trials[i].candidate.left_out_rms_px < trials[*best].candidate.left_out_rms_px) {
      best = i;
    }
  }
  if (!best) {
    if (!trials.empty()) out.bundle = trials.front().bundle;
    return out;
  }
  out.chosen = best;
  const auto size = [&](std::size_t i) { return parameter_names(models[i]).size(); };
  for (std::size_t i = 0; i < trials.size() && models.size() > 1; ++i) {
    if (!trials[i].candidate.fault.empty() || size(i) >= size(*best)) continue;
    if (!as_good(trials[i], trials[*best])) continue;
    // Of two with as many parameters, the better one.
    if (out.chosen == best ||
        (size(i) == size(*out.chosen) &&
         trials[i].candidate.left_out_rms_px < trials[*out.chosen].candidate.left_out_rms_px)) {
      out.chosen = i;
    }
  }
  out.bundle = trials[*out.chosen].bundle;
  return out;
}

}  // namespace scattermeter::calib
