#include "calib/pose/edge_fit.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include <Eigen/Geometry>
#include <ceres/ceres.h>

#include "calib/pose/outline_errors.h"
#include "core/base/covariance_root.h"
#include "core/base/dense_solve.h"
#include "core/base/rotation_vector.h"
#include "core/base/solver_options.h"
#include "core/camera/lens.h"

namespace scattermeter::calib {
namespace {

using namespace edge_parameter;

Rigid3d changed_pose(const Rigid3d& camera_from_world, const Eigen::VectorXd& v) {
  const Rigid3d pose{rotation_by(v.segment<3>(kPose)) * camera_from_world.rotation,
                     camera_from_world.translation_mm + v.segment<3>(kPose + 3)};
  return Rigid3d{rotation_by(v.segment<3>(kTurn)), v.segment<3>(kMove)} * pose;
}

CameraIntrinsics changed_lens(CameraIntrinsics k, const Eigen::VectorXd& v) {
  k.fx_px *= std::exp(v[kFocal]);
  k.fy_px *= std::exp(v[kFocal]);
  if (v[kDistortion] != 0) {
    if (k.distortion.empty()) k.distortion.assign(4, 0.0);
    k.distortion[0] += v[kDistortion];
  }
  return k;
}

double residual_px(const EdgePoint& p, const Lens& lens, const Rigid3d& pose,
                   const Eigen::VectorXd& v) {
  const double scale = std::exp(v[kScale] + v[kScaleOfBody + p.body_idx]);
  const Eigen::Vector3d x = pose * Eigen::Vector3d(scale * p.point_mm);
  Eigen::Matrix<double, 2, 3> jacobian;
  const Eigen::Vector2d at = lens.project(x, &jacobian);
  const Eigen::Vector2d along = jacobian * (pose.rotation * p.tangent);
  Eigen::Vector2d normal = Eigen::Vector2d(-along.y(), along.x()).normalized();
  if (normal.dot(p.outward) < 0) normal = -normal;
  return normal.dot(p.measured_px - at);
}

struct Problem {
  const std::vector<EdgePoint>& points;
  const CameraIntrinsics& intrinsics;
  const Rigid3d& camera_from_world;
  const std::vector<int>& free;
  Eigen::Index size;
  Lens nominal;
  bool lens_changes;

  Eigen::VectorXd all(const double* values) const {
    Eigen::VectorXd v = Eigen::VectorXd::Zero(size);
    for (std::size_t i = 0; i < free.size(); ++i) v[free[i]] = values[i];
    return v;
  }
  Eigen::VectorXd residuals(const std::vector<std::size_t>& which, const Eigen::VectorXd& v) const {
    const Rigid3d pose = changed_pose(camera_from_world, v);
    Eigen::VectorXd r(static_cast<Eigen::Index>(which.size()));
    const Lens* lens = &nominal;
    std::optional<Lens> other;
    if (lens_changes) {
      other.emplace(changed_lens(intrinsics, v));
      lens = &*other;
    }
    for (std::size_t i = 0; i < which.size(); ++i) {
      r[static_cast<Eigen::Index>(i)] = residual_px(points[which[i]], *lens, pose, v);
    }
    return r;
  }
};

// A step that moves the image by about 1e-3 px at 10^4 px of focal length.
double difference_step(int parameter) {
  const bool is_mm =
      (parameter >= kPose + 3 && parameter < kTurn) || (parameter >= kMove && parameter < kFocal);
  if (parameter == kDistortion) return 1e-4;
  return is_mm ? 1e-4 : 1e-6;
}

// Whitened residuals of points whose errors are independent of those of all others.
class OutlineCost final : public ceres::CostFunction {
 public:
  OutlineCost(const Problem& problem, std::vector<std::size_t> which, const EdgeFitOptions& options)
      : problem_(problem),
        which_(std::move(which)),
        errors_(problem.points, which_, options.line_std_px,
                std::hypot(options.piece_std_px, options.robust ? options.robust_px : 0.0)) {
    set_num_residuals(static_cast<int>(which_.size()));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(problem.free.size()));
  }

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    const Eigen::VectorXd v = problem_.all(parameters[0]);
    Eigen::Map<Eigen::VectorXd> r(residuals, num_residuals());
    r = errors_.whitened(problem_.residuals(which_, v));
    if (!r.allFinite()) return false;
    if (jacobians == nullptr || jacobians[0] == nullptr) return true;
    Eigen::MatrixXd j(num_residuals(), static_cast<Eigen::Index>(problem_.free.size()));
    for (std::size_t i = 0; i < problem_.free.size(); ++i) {
      const double step = difference_step(problem_.free[i]);
      Eigen::VectorXd up = v;
      Eigen::VectorXd down = v;
      up[problem_.free[i]] += step;
      down[problem_.free[i]] -= step;
      j.col(static_cast<Eigen::Index>(i)) =
          (problem_.residuals(which_, up) - problem_.residuals(which_, down)) / (2 * step);
    }
    j = errors_.whitened(j);
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
        jacobians[0], j.rows(), j.cols()) = j;
    return j.allFinite();
  }

 private:
  const Problem& problem_;
  std::vector<std::size_t> which_;
  OutlineErrors errors_;
};

// Normal prior about 0: the residual is a root of its information times the values.
class PriorCost final : public ceres::CostFunction {
 public:
  explicit PriorCost(Eigen::MatrixXd root) : root_(std::move(root)) {
    set_num_residuals(static_cast<int>(root_.rows()));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(root_.cols()));
  }
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    Eigen::Map<Eigen::VectorXd>(residuals, root_.rows()) =
        root_ * Eigen::Map<const Eigen::VectorXd>(parameters[0], root_.cols());
    if (jacobians != nullptr && jacobians[0] != nullptr) {
      Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
          jacobians[0], root_.rows(), root_.cols()) = root_;
    }
    return true;
  }

 private:
  Eigen::MatrixXd root_;
};

// Points by the errors that they have in common: those of a body, or of each line of a body of so
// many that they are those of a curved surface; in a robust fit each by itself.
std::vector<std::vector<std::size_t>> groups_of(const std::vector<EdgePoint>& points, bool robust) {
  constexpr std::size_t kMostLines = 64;
  std::map<int, std::map<int, std::vector<std::size_t>>> bodies;
  for (std::size_t i = 0; i < points.size(); ++i) {
    bodies[points[i].body_idx][robust ? static_cast<int>(i) : points[i].line_idx].push_back(i);
  }
  std::vector<std::vector<std::size_t>> out;
  for (const auto& [body, lines] : bodies) {
    const bool is_one = !robust && lines.size() <= kMostLines;
    if (is_one) out.emplace_back();
    for (const auto& [line, which] : lines) {
      if (!is_one) out.emplace_back();
      out.back().insert(out.back().end(), which.begin(), which.end());
    }
  }
  return out;
}

// Inverse of J^T J at the current values of the problem.
Eigen::MatrixXd inverse_information(ceres::Problem& least_squares) {
  ceres::CRSMatrix sparse;
  double cost = 0;
  least_squares.Evaluate({}, &cost, nullptr, nullptr, &sparse);
  Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(sparse.num_rows, sparse.num_cols);
  for (int row = 0; row < sparse.num_rows; ++row) {
    for (int k = sparse.rows[static_cast<std::size_t>(row)];
         k < sparse.rows[static_cast<std::size_t>(row) + 1]; ++k) {
      jacobian(row, sparse.cols[static_cast<std::size_t>(k)]) =
          sparse.values[static_cast<std::size_t>(k)];
    }
  }
  // J^T J is scaled first, as radians and millimetres differ by orders of magnitude.
  const Eigen::VectorXd norms = jacobian.colwise().norm().cwiseMax(1e-300);
  jacobian = (jacobian * norms.cwiseInverse().asDiagonal()).eval();
  const Eigen::MatrixXd information = jacobian.transpose() * jacobian;
  const Eigen::MatrixXd covariance = SymmetricSolver(information).inverse();
  return norms.cwiseInverse().asDiagonal() * covariance * norms.cwiseInverse().asDiagonal();
}

// Sum of squares of the points at the current values; none if a point has no image.
std::optional<double> unfitted_chi2(const std::vector<std::unique_ptr<OutlineCost>>& costs) {
  double chi2 = 0;
  for (const auto& cost : costs) {
    Eigen::VectorXd r(cost->num_residuals());
    const double* none = nullptr;
    if (!cost->Evaluate(&none, r.data(), nullptr)) return std::nullopt;
    chi2 += r.squaredNorm();
  }
  return chi2;
}

}  // namespace

int edge_parameters(const std::vector<EdgePoint>& points) {
  int bodies = 0;
  for (const EdgePoint& p : points) bodies = std::max(bodies, p.body_idx + 1);
  return kScaleOfBody + bodies;
}

std::vector<double> edge_residuals_px(const std::vector<EdgePoint>& points,
                                      const CameraIntrinsics& intrinsics,
                                      const Rigid3d& camera_from_world,
                                      const Eigen::VectorXd& value) {
  const Lens lens(changed_lens(intrinsics, value));
  const Rigid3d pose = changed_pose(camera_from_world, value);
  std::vector<double> out;
  out.reserve(points.size());
  for (const EdgePoint& p : points) out.push_back(residual_px(p, lens, pose, value));
  return out;
}

EdgeFit fit_edges(const std::vector<EdgePoint>& points, const CameraIntrinsics& intrinsics,
                  const Rigid3d& camera_from_world, const EdgeFitOptions& options) {
  const Eigen::Index size = edge_parameters(points);
  if (points.empty() || options.prior.rows() != size || options.prior.cols() != size) {
    throw std::invalid_argument("fit_edges: no points, or a prior of another size");
  }
  EdgeFit out;
  out.value = Eigen::VectorXd::Zero(size);
  out.covariance = Eigen::MatrixXd::Zero(size, size);
  const auto finish = [&] {
    out.residual_px = edge_residuals_px(points, intrinsics, camera_from_world, out.value);
    out.camera_from_world = changed_pose(camera_from_world, out.value);
    return out;
  };
  const bool lens_changes = std::any_of(options.free.begin(), options.free.end(),
                                        [](int i) { return i == kFocal || i == kDistortion; });
  const Problem problem{points, intrinsics,       camera_from_world, options.free,
                        size,   Lens(intrinsics), lens_changes};
  std::vector<std::unique_ptr<OutlineCost>> costs;
  for (std::vector<std::size_t>& which : groups_of(points, options.robust)) {
    costs.push_back(std::make_unique<OutlineCost>(problem, std::move(which), options));
  }
  if (options.free.empty()) {
    const std::optional<double> chi2 = unfitted_chi2(costs);
    out.converged = chi2.has_value();
    out.chi2 = chi2.value_or(0.0);
    return finish();
  }
  ceres::Problem least_squares;
  std::vector<double> values(options.free.size(), 0.0);
  for (auto& cost : costs) {
    least_squares.AddResidualBlock(
        cost.release(), options.robust ? new ceres::CauchyLoss(2.0) : nullptr, values.data());
  }
  const Eigen::MatrixXd prior = options.prior(options.free, options.free);
  if (prior.squaredNorm() > 0) {
    least_squares.AddResidualBlock(new PriorCost(covariance_root(prior).transpose()), nullptr,
                                   values.data());
  }
  auto solver = quiet_solver<ceres::Solver::Options>({60, 1e-12, 1e-14, 1e-12});
  solver.linear_solver_type = ceres::DENSE_QR;
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &least_squares, &summary);
  out.chi2 = 2 * summary.final_cost;
  out.value = problem.all(values.data());
  const Eigen::MatrixXd covariance = inverse_information(least_squares);
  out.converged =
      summary.IsSolutionUsable() && covariance.allFinite() && covariance.diagonal().minCoeff() > 0;
  out.covariance(options.free, options.free) = covariance;
  return finish();
}

}  // namespace scattermeter::calib
