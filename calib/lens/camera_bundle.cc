#include "calib/lens/camera_bundle.h"

#include <cmath>
#include <limits>
#include <optional>

#include <Eigen/Geometry>
#include <ceres/ceres.h>

#include "core/base/cross_matrix.h"
#include "core/base/dense_solve.h"
#include "core/base/rotation_vector.h"
#include "core/base/solver_options.h"
#include "core/camera/lens.h"

namespace scattermeter::calib {
namespace {

constexpr double kMaxFocalWidths = 100;  // focal length over frame width; more is not plausible

// exp([w + d]) = exp([J d]) exp([w]) to first order: the left Jacobian of SO(3).
Eigen::Matrix3d left_jacobian(const Eigen::Vector3d& w) {
  const double angle = w.norm();
  const Eigen::Matrix3d m = cross_matrix(w);
  if (angle < 1e-5) return Eigen::Matrix3d::Identity() + 0.5 * m;
  const double s = angle * angle;
  return Eigen::Matrix3d::Identity() + (1 - std::cos(angle)) / s * m +
         (angle - std::sin(angle)) / (s * angle) * m * m;
}

// The lens at the point that Ceres evaluates, computed once for all corners.
class CurrentLens final : public ceres::EvaluationCallback {
 public:
  CurrentLens(const Eigen::MatrixXd& map, const double* fitted, int width_px, int height_px)
      : map_(map), fitted_(fitted), width_px_(width_px), height_px_(height_px) {}

  void PrepareForEvaluation(bool /*jacobians*/, bool new_point) override {
    if (!new_point && lens_) return;
    parameters_ = map_ * Eigen::Map<const Eigen::VectorXd>(fitted_, map_.cols());
    lens_.reset();
    if (!parameters_.allFinite() || !(parameters_[0] < kMaxFocalWidths * width_px_)) return;
    const CameraIntrinsics k = intrinsics_of(parameters_, width_px_, height_px_);
    if (intrinsics_problem(k).empty()) lens_.emplace(k);
  }
  const std::optional<Lens>& lens() const { return lens_; }
  const LensParameters& parameters() const { return parameters_; }
  const Eigen::MatrixXd& map() const { return map_; }

 private:
  const Eigen::MatrixXd& map_;
  const double* fitted_;
  int width_px_;
  int height_px_;
  LensParameters parameters_;
  std::optional<Lens> lens_;
};

// Blocks: fitted parameters, pose (rotation vector, translation in mm).
class CornerCost final : public ceres::CostFunction {
 public:
  CornerCost(const CurrentLens& lens, const PointPair& corner) : lens_(lens), corner_(corner) {
    set_num_residuals(2);
    mutable_parameter_block_sizes()->push_back(static_cast<int>(lens.map().cols()));
    mutable_parameter_block_sizes()->push_back(6);
  }

  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    if (!lens_.lens()) return false;
    const Eigen::Map<const Eigen::Vector3d> w(blocks[1]);
    const Eigen::Map<const Eigen::Vector3d> t(blocks[1] + 3);
    const Eigen::Vector3d turned = rotation_by(w) * corner_.world_mm;
    const Eigen::Vector3d x = turned + t;
    Eigen::Matrix<double, 2, 3> per_mm;
    const Eigen::Vector2d pixel = lens_.lens()->project(x, &per_mm);
    if (!pixel.allFinite()) return false;
    Eigen::Map<Eigen::Vector2d> r(residuals);
    r = pixel - corner_.image_px;
    if (jacobians == nullptr) return true;
    using RowMajor = Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::RowMajor>;
    if (jacobians[0] != nullptr) {
      Eigen::Map<RowMajor> j(jacobians[0], 2, lens_.map().cols());
      j = shift_per_lens_parameter(lens_.parameters(), {x.x() / x.z(), x.y() / x.z()}) *
          lens_.map();
    }
    if (jacobians[1] != nullptr) {
      Eigen::Map<RowMajor> j(jacobians[1], 2, 6);
      j.leftCols<3>() = per_mm * (-cross_matrix(turned) * left_jacobian(w));
      j.rightCols<3>() = per_mm;
    }
    return true;
  }

 private:
  const CurrentLens& lens_;
  const PointPair& corner_;
};

}  // namespace

CameraBundle adjust_bundle(const std::vector<BoardView>& views, const LensModel& model,
                           int width_px, int height_px, const CameraBundle& start,
                           double cauchy_px) {
  const Eigen::MatrixXd map = parameter_map(model);
  // Fitted numbers of the start: means over the parameters that the map keeps equal.
  Eigen::VectorXd fitted =
      (map.transpose() * start.lens).cwiseQuotient(map.colwise().sum().transpose());
  std::vector<Eigen::Matrix<double, 6, 1>> poses;
  for (const Rigid3d& pose : start.camera_from_board) {
    const Eigen::AngleAxisd turn(pose.rotation);
    poses.emplace_back() << turn.angle() * turn.axis(), pose.translation_mm;
  }
  CurrentLens lens(map, fitted.data(), width_px, height_px);
  ceres::Problem::Options ownership;
  ownership.evaluation_callback = &lens;
  ceres::Problem problem(ownership);
  auto* order = new ceres::ParameterBlockOrdering;  // owned by the options
  for (std::size_t i = 0; i < views.size(); ++i) {
    for (const PointPair& corner : views[i].corners) {
      problem.AddResidualBlock(new CornerCost(lens, corner),
                               cauchy_px > 0 ? new ceres::CauchyLoss(cauchy_px) : nullptr,
                               fitted.data(), poses[i].data());
    }
    if (!views[i].corners.empty()) order->AddElementToGroup(poses[i].data(), 0);
  }
  order->AddElementToGroup(fitted.data(), 1);
  auto solver = quiet_solver<ceres::Solver::Options>({100, 1e-13, 1e-14, 1e-11});
  solver.linear_solver_ordering.reset(order);
  solver.linear_solver_type = ceres::DENSE_SCHUR;
  // A damping of at least 1e-9 keeps the equations of a model with terms of no effect solvable;
  // Ceres would otherwise write to stderr whatever the logging type.
  solver.max_trust_region_radius = 1e9;

  CameraBundle out = start;
  // Ceres would print an error for a start at which the cost has no value.
  lens.PrepareForEvaluation(false, true);
  bool can_start = lens.lens().has_value();
  for (std::size_t i = 0; can_start && i < views.size(); ++i) {
    for (const PointPair& corner : views[i].corners) {
      const Eigen::Vector3d x =
          rotation_by(poses[i].head<3>()) * corner.world_mm + poses[i].tail<3>();
      can_start = can_start && lens.lens()->project(x).allFinite();
    }
  }
  out.converged = false;
  if (!can_start) return out;
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &problem, &summary);
  out.converged = summary.termination_type == ceres::CONVERGENCE && fitted.allFinite();
  if (!summary.IsSolutionUsable() || !fitted.allFinite()) return out;
  out.lens = map * fitted;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    out.camera_from_board[i].rotation = rotation_by(poses[i].head<3>());
    out.camera_from_board[i].translation_mm = poses[i].tail<3>();
  }
  out.sum_squares_px2 = 0;
  const CameraIntrinsics k = intrinsics_of(out.lens, width_px, height_px);
  for (std::size_t i = 0; i < views.size(); ++i) {
    for (const Eigen::Vector2d& r : view_residuals(views[i], out.camera_from_board[i], k)) {
      out.sum_squares_px2 += r.squaredNorm();
    }
  }
  return out;
}

std::vector<Eigen::Vector2d> view_residuals(const BoardView& view, const Rigid3d& camera_from_board,
                                            const CameraIntrinsics& intrinsics) {
  const Lens lens(intrinsics);
  std::vector<Eigen::Vector2d> out;
  for (const PointPair& corner : view.corners) {
    out.push_back(lens.project(camera_from_board * corner.world_mm) - corner.image_px);
  }
  return out;
}

ViewEquations view_equations(const BoardView& view, const Rigid3d& camera_from_board,
                             const CameraIntrinsics& intrinsics, const LensModel& model) {
  const Lens lens(intrinsics);
  const LensParameters parameters = lens_parameters(intrinsics);
  const Eigen::MatrixXd map = parameter_map(model);
  const Eigen::Matrix3d rotation = camera_from_board.rotation.toRotationMatrix();
  const auto n = static_cast<Eigen::Index>(view.corners.size());
  Eigen::MatrixXd per_parameter(2 * n, map.cols());
  Eigen::MatrixXd per_pose(2 * n, 6);
  Eigen::MatrixXd per_mm(2 * n, 3);
  Eigen::VectorXd r(2 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const PointPair& corner = view.corners[static_cast<std::size_t>(i)];
    const Eigen::Vector3d turned = rotation * corner.world_mm;
    const Eigen::Vector3d x = turned + camera_from_board.translation_mm;
    Eigen::Matrix<double, 2, 3> j;
    r.segment<2>(2 * i) = lens.project(x, &j) - corner.image_px;
    per_parameter.middleRows<2>(2 * i) =
        shift_per_lens_parameter(parameters, {x.x() / x.z(), x.y() / x.z()}) * map;
    per_pose.block<2, 3>(2 * i, 0) = -j * cross_matrix(turned);
    per_pose.block<2, 3>(2 * i, 3) = j;
    per_mm.middleRows<2>(2 * i) = j * rotation;
  }
  const Eigen::MatrixXd basis = HouseholderSolver(per_pose).thin_q();
  const Eigen::MatrixXd a = per_parameter - basis * (basis.transpose() * per_parameter);
  const Eigen::VectorXd own = r - basis * (basis.transpose() * r);
  ViewEquations out;
  out.information = a.transpose() * a;
  out.gradient = a.transpose() * own;
  out.sum_squares_px2 = own.squaredNorm();
  out.n_corners = view.corners.size();
  for (Eigen::Index i = 0; i < n; ++i) {
    out.gradient_per_mm.emplace_back(a.middleRows<2>(2 * i).transpose() *
                                     per_mm.middleRows<2>(2 * i));
  }
  return out;
}

}  // namespace scattermeter::calib
