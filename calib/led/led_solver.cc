#include "calib/led/led_solver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>
#include <ceres/ceres.h>

#include "calib/led/cell_model.h"
#include "calib/led/led_frame.h"
#include "calib/led/led_start.h"
#include "core/base/solver_options.h"
#include "core/camera/pose_shift.h"

namespace scattermeter::calib {
namespace {

constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

struct HighlightCost {
  const LedFrame& frame;
  const SeenHighlight& seen;

  Eigen::Vector2d predict(const double* led, const double* pose, const double* sphere) const {
    const LedScene& scene = frame.scene;
    MirrorSphere s = scene.spheres[seen.sphere];
    s.center_mm += s.center_std_mm * Eigen::Vector3d(sphere[0], sphere[1], sphere[2]);
    s.radius_mm += s.radius_std_mm * sphere[3];
    const Eigen::Map<const Eigen::Matrix<double, 6, 1>> z(pose);
    return calib::highlight_px(
        frame.lens,
        shifted_pose(scene.views[seen.view].camera_from_world, frame.pose_root[seen.view] * z), s,
        frame.at(led));
  }

  bool operator()(const double* led, const double* pose, const double* sphere,
                  double* residual) const {
    const Eigen::Vector2d p = predict(led, pose, sphere);
    if (!p.allFinite()) return false;
    residual[0] = (p.x() - seen.image_px.x()) / seen.std_px;
    residual[1] = (p.y() - seen.image_px.y()) / seen.std_px;
    return true;
  }
};

struct CellCost {
  CellModel model;
  double measured, std, ambient_unit;

  template <typename T>
  bool operator()(const T* led, const T* pose, const T* albedo, const T* exposure, const T* ambient,
                  T* residual) const {
    residual[0] =
        (model.radiance(led, pose, albedo, exposure) + T(ambient_unit) * ambient[0] - T(measured)) /
        T(std);
    using std::isfinite;  // of numbers; Ceres has that of its derivatives
    return isfinite(residual[0]);
  }
};

template <int kSize>
struct UnitPrior {
  template <typename T>
  bool operator()(const T* z, T* residual) const {
    for (int i = 0; i < kSize; ++i) residual[i] = z[i];
    return true;
  }
};

struct Unknowns {
  std::array<double, kLedParameters> led;
  std::vector<std::array<double, 3>> ambient;  // per plane shot
  std::vector<std::array<double, 6>> pose;
  std::vector<std::array<double, 4>> sphere;
  std::vector<double> exposure;  // one more than the settings, for scenes without any
  double albedo = 0;             // the last

  std::vector<double*> blocks() {
    std::vector<double*> all = {led.data()};
    for (auto& a : ambient) {
      for (double& channel : a) all.push_back(&channel);
    }
    for (auto& p : pose) all.push_back(p.data());
    for (auto& s : sphere) all.push_back(s.data());
    for (double& e : exposure) all.push_back(&e);
    all.push_back(&albedo);
    return all;
  }
};

Eigen::MatrixXd information(ceres::Problem& problem, Unknowns& unknowns,
                            const std::vector<ceres::ResidualBlockId>& residuals,
                            const std::array<bool, kLedParameters>& free) {
  const auto size = static_cast<Eigen::Index>(
      kLedParameters + 3 * unknowns.ambient.size() + 6 * unknowns.pose.size() +
      4 * unknowns.sphere.size() + unknowns.exposure.size() + 1);
  Eigen::MatrixXd info = Eigen::MatrixXd::Zero(size, size);
  if (residuals.empty()) return info;
  ceres::Problem::EvaluateOptions options;
  options.residual_blocks = residuals;
  options.parameter_blocks = unknowns.blocks();
  options.apply_loss_function = false;
  ceres::CRSMatrix j;
  if (!problem.Evaluate(options, nullptr, nullptr, nullptr, &j)) {
    return Eigen::MatrixXd::Constant(size, size, kNoValue);
  }
  for (int row = 0; row < j.num_rows; ++row) {
    const int from = j.rows[static_cast<std::size_t>(row)];
    const int to = j.rows[static_cast<std::size_t>(row) + 1];
    for (int a = from; a < to; ++a) {
      for (int b = from; b < to; ++b) {
        info(j.cols[static_cast<std::size_t>(a)], j.cols[static_cast<std::size_t>(b)]) +=
            j.values[static_cast<std::size_t>(a)] * j.values[static_cast<std::size_t>(b)];
      }
    }
  }
  for (std::size_t i = 0; i < free.size(); ++i) {
    if (free[i]) continue;
    info.row(static_cast<Eigen::Index>(i)).setZero();
    info.col(static_cast<Eigen::Index>(i)).setZero();
  }
  return info;
}

// The least squares of highlights, cells and nuisances about the frame's axis. Ceres keeps pointers
// to the unknowns, so this neither moves nor copies.
class LedProblem {
 public:
  LedProblem(const LedFrame& frame, const LedSolve& what)
      : frame_(frame), what_(what), problem_(borrowed_loss()) {
    const LedScene& scene = frame.scene;
    x_.led = frame.start();
    x_.ambient.assign(scene.plane_shots(), {});
    x_.pose.assign(scene.views.size(), {});
    x_.sphere.assign(scene.spheres.size(), {});
    x_.exposure.assign(scene.exposure_relative_std.size() + 1, 0.0);
    add_bounds();
    add_priors();
    add_highlights();
    add_cells();
    for (std::size_t i = 0; i < what.free.size(); ++i) {
      if (!what.free[i]) held_.push_back(static_cast<int>(i));
    }
    if (!held_.empty()) {
      problem_.SetManifold(x_.led.data(), new ceres::SubsetManifold(kLedParameters, held_));
    }
  }
  LedProblem(const LedProblem&) = delete;
  LedProblem& operator=(const LedProblem&) = delete;

  LedSolution solve() {
    const double gradient = ceres::Solver::Options().gradient_tolerance;
    auto options =
        quiet_solver<ceres::Solver::Options>(what_.robust ? SolverStop{40, 1e-5, gradient, 1e-6}
                                                          : SolverStop{100, 1e-9, gradient, 1e-9});
    options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem_, &summary);
    LedSolution out;
    out.converged = summary.IsSolutionUsable();
    out.cost = out.converged ? summary.final_cost : std::numeric_limits<double>::infinity();
    predict(out);
    if (what_.robust) return out;
    // Fixed parameters count as free for the derivative; their columns are then removed.
    if (!held_.empty()) problem_.SetManifold(x_.led.data(), nullptr);
    out.highlight_information = information(problem_, x_, highlights_, what_.free);
    out.cell_information = information(problem_, x_, cells_, what_.free);
    return out;
  }

 private:
  static ceres::Problem::Options borrowed_loss() {
    ceres::Problem::Options options;
    options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    return options;
  }

  void add_bounds() {
    problem_.AddParameterBlock(x_.led.data(), kLedParameters);
    problem_.SetParameterLowerBound(x_.led.data(), kLedExponent, frame_.led.least_exponent());
    for (auto& shot : x_.ambient) {
      for (double& a : shot) {
        problem_.AddParameterBlock(&a, 1);
        problem_.SetParameterLowerBound(&a, 0, 0.0);
      }
    }
    problem_.AddParameterBlock(&no_ambient_, 1);
    problem_.SetParameterBlockConstant(&no_ambient_);
  }

  template <int kSize>
  void add_prior(double* unknowns) {
    problem_.AddResidualBlock(
        new ceres::AutoDiffCostFunction<UnitPrior<kSize>, kSize, kSize>(new UnitPrior<kSize>),
        nullptr, unknowns);
  }

  void add_priors() {
    for (auto& p : x_.pose) add_prior<6>(p.data());
    for (auto& s : x_.sphere) add_prior<4>(s.data());
    for (double& e : x_.exposure) add_prior<1>(&e);
    add_prior<1>(&x_.albedo);
  }

  void add_highlights() {
    const LedScene& scene = frame_.scene;
    for (std::size_t i = 0; i < scene.highlights.size(); ++i) {
      if (!what_.use_highlight[i]) continue;
      const SeenHighlight& h = scene.highlights[i];
      highlights_.push_back(problem_.AddResidualBlock(
          new ceres::NumericDiffCostFunction<HighlightCost, ceres::CENTRAL, 2, kLedParameters, 6,
                                             4>(new HighlightCost{frame_, h}),
          nullptr, x_.led.data(), x_.pose[h.view].data(), x_.sphere[h.sphere].data()));
    }
  }

  void add_cells() {
    const LedScene& scene = frame_.scene;
    for (std::size_t i = 0; i < scene.cells.size(); ++i) {
      const ShadedCell& cell = scene.cells[i];
      if (!what_.use_cell[i]) continue;
      const double std =
          std::hypot(cell.std_W_per_mm2_sr, what_.cell_relative_std * cell.radiance_W_per_mm2_sr);
      const bool ambient_is_free =
          cell.shot < what_.free_ambient.size() && what_.free_ambient[cell.shot];
      cells_.push_back(problem_.AddResidualBlock(
          new ceres::AutoDiffCostFunction<CellCost, 1, kLedParameters, 6, 1, 1, 1>(
              new CellCost{CellModel(frame_, cell), cell.radiance_W_per_mm2_sr, std,
                           frame_.ambient_unit[cell.shot][cell.channel]}),
          what_.robust ? &cauchy_ : nullptr, x_.led.data(), x_.pose[cell.view].data(), &x_.albedo,
          &x_.exposure.at(cell.setting),
          ambient_is_free ? &x_.ambient[cell.shot][static_cast<std::size_t>(cell.channel)]
                          : &no_ambient_));
    }
  }

  // The LED and its predictions for all data, at the current unknowns.
  void predict(LedSolution& out) const {
    const LedScene& scene = frame_.scene;
    out.led = frame_.at(x_.led.data());
    out.tangents = frame_.tangents;
    for (const SeenHighlight& h : scene.highlights) {
      out.highlight_px.push_back(HighlightCost{frame_, h}.predict(
          x_.led.data(), x_.pose[h.view].data(), x_.sphere[h.sphere].data()));
    }
    out.ambient_unit = frame_.ambient_unit;
    for (std::size_t s = 0; s < x_.ambient.size(); ++s) {
      out.ambient.emplace_back(Eigen::Map<const Eigen::Array3d>(x_.ambient[s].data()) *
                               frame_.ambient_unit[s]);
    }
    out.nuisances_at = out.ambient_at + static_cast<Eigen::Index>(3 * x_.ambient.size());
    for (const ShadedCell& cell : scene.cells) {
      out.cell_radiance.push_back(CellModel(frame_, cell)
                                      .radiance(x_.led.data(), x_.pose[cell.view].data(),
                                                &x_.albedo, &x_.exposure.at(cell.setting)) +
                                  out.ambient[cell.shot][cell.channel]);
    }
  }

  const LedFrame& frame_;
  const LedSolve& what_;
  Unknowns x_;
  double no_ambient_ = 0.0;
  ceres::CauchyLoss cauchy_{1.0};
  ceres::Problem problem_;
  std::vector<int> held_;
  std::vector<ceres::ResidualBlockId> highlights_, cells_;
};

}  // namespace

LedSolution solve_led(const LedScene& scene, const Led& start, const LedSolve& what) {
  const auto solve_about = [&](const Led& led) {
    const LedFrame frame(scene, led);
    return LedProblem(frame, what).solve();
  };
  // Tangents refer to an axis, so the solution is repeated about the fitted one.
  const LedSolution first = solve_about(start);
  if (!first.converged || what.robust) return first;
  return solve_about(first.led);
}

}  // namespace scattermeter::calib
