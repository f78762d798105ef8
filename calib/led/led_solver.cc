#include "calib/led/led_solver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <ceres/ceres.h>

#include "calib/led/led_start.h"
#include "core/base/covariance_root.h"
#include "core/base/solver_options.h"
#include "core/camera/lens.h"
#include "core/camera/pose_shift.h"

namespace scattermeter::calib {
namespace {

using Matrix6d = Eigen::Matrix<double, 6, 6>;
constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();
constexpr int kPoints = 4;  // of a cell, and of the LED's ring

Rigid3d moved(const Rigid3d& pose, const Eigen::Matrix<double, 6, 1>& by) {
  Rigid3d out = pose;
  const double angle = by.head<3>().norm();
  if (angle > 0.0) {
    out.rotation =
        (Eigen::Quaterniond(Eigen::AngleAxisd(angle, by.head<3>() / angle)) * pose.rotation)
            .normalized();
  }
  out.translation_mm += by.tail<3>();
  return out;
}

// What the unknowns count from.
struct Frame {
  const LedScene& scene;
  Lens lens;
  Led led;
  std::array<Eigen::Vector3d, 2> tangents;
  std::vector<Matrix6d> pose_root;
  std::vector<Eigen::Array3d> ambient_unit;  // by plane shot

  Frame(const LedScene& s, const Led& start) : scene(s), lens(s.intrinsics), led(start) {
    tangents[0] = led.axis.unitOrthogonal();
    tangents[1] = led.axis.cross(tangents[0]);
    for (const LedView& v : s.views) pose_root.push_back(covariance_root(v.pose_covariance));
    ambient_unit.assign(s.plane_shots(), Eigen::Array3d::Zero());
    std::vector<Eigen::Array3d> n(ambient_unit);
    for (const ShadedCell& cell : s.cells) {
      ambient_unit[cell.shot][cell.channel] += cell.radiance_W_per_mm2_sr;
      n[cell.shot][cell.channel] += 1.0;
    }
    for (std::size_t i = 0; i < n.size(); ++i) {
      ambient_unit[i] = (ambient_unit[i] / n[i].max(1.0)).max(1e-300);
    }
  }

  Led at(const double* x) const {
    Led out = led;
    out.position_mm = Eigen::Vector3d(x[0], x[1], x[2]);
    out.axis = (led.axis + x[3] * tangents[0] + x[4] * tangents[1]).normalized();
    out.exponent = x[5];
    for (int c = 0; c < 3; ++c) {
      out.intensity_W_per_sr[c] = led.intensity_W_per_sr[c] > 0.0 ? std::exp(x[6 + c]) : 0.0;
    }
    return out;
  }

  std::array<double, kLedParameters> start() const {
    std::array<double, kLedParameters> x{};
    for (std::size_t i = 0; i < 3; ++i) x[i] = led.position_mm[static_cast<Eigen::Index>(i)];
    x[5] = led.exponent;
    for (std::size_t c = 0; c < 3; ++c) {
      const double intensity = led.intensity_W_per_sr[static_cast<Eigen::Index>(c)];
      x[6 + c] = intensity > 0.0 ? std::log(intensity) : 0.0;
    }
    return x;
  }
};

struct HighlightCost {
  const Frame& frame;
  const SeenHighlight& seen;

  Eigen::Vector2d predict(const double* led, const double* pose, const double* sphere) const {
    const LedScene& scene = frame.scene;
    MirrorSphere s = scene.spheres[seen.sphere];
    s.center_mm += s.center_std_mm * Eigen::Vector3d(sphere[0], sphere[1], sphere[2]);
    s.radius_mm += s.radius_std_mm * sphere[3];
    const Eigen::Map<const Eigen::Matrix<double, 6, 1>> z(pose);
    return calib::highlight_px(
        frame.lens, moved(scene.views[seen.view].camera_from_world, frame.pose_root[seen.view] * z),
        s, frame.at(led));
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

// A cell made ready: points, their shift with the pose, the normal.
class CellModel {
 public:
  CellModel(const Frame& frame, const ShadedCell& cell) : frame_(frame), channel_(cell.channel) {
    const WhitePlane& plane = frame.scene.planes[cell.plane];
    normal_ = plane.normal();
    albedo_over_pi_ = plane.albedo[cell.channel] / std::numbers::pi;
    albedo_std_ = plane.albedo_relative_std;
    const std::vector<double>& exposures = frame.scene.exposure_relative_std;
    exposure_std_ = exposures.empty() ? 0.0 : exposures.at(cell.setting);
    const Eigen::Matrix2d root = cell.spread_mm2.llt().matrixL();
    for (std::size_t k = 0; k < kPoints; ++k) {
      const Eigen::Vector2d at =
          cell.place_mm + (k % 2 == 0 ? M_SQRT2 : -M_SQRT2) * root.col(static_cast<int>(k / 2));
      points_mm_[k] = plane.origin_mm + at.x() * plane.x_axis + at.y() * plane.y_axis;
    }
    const Eigen::Vector3d middle =
        plane.origin_mm + cell.place_mm.x() * plane.x_axis + cell.place_mm.y() * plane.y_axis;
    shift_ =
        surface_shift_by_pose(frame.scene.views[cell.view].camera_from_world, middle, normal_) *
        frame.pose_root[cell.view];
    if (frame.led.radius_mm > 0.0) {
      for (std::size_t k = 0; k < kPoints; ++k) {
        ring_mm_.push_back(frame.led.radius_mm * M_SQRT1_2 * (k % 2 == 0 ? 1.0 : -1.0) *
                           frame.tangents[k / 2]);
      }
    } else {
      ring_mm_.emplace_back(Eigen::Vector3d::Zero());
    }
  }

  template <typename T>
  T radiance(const T* led, const T* pose, const T* albedo, const T* exposure) const {
    using std::exp;
    using std::pow;
    using std::sqrt;
    using Vector3T = Eigen::Matrix<T, 3, 1>;
    if (!(frame_.led.intensity_W_per_sr[channel_] > 0.0)) return T(0.0);
    const Eigen::Map<const Vector3T> position(led);
    Vector3T axis = frame_.led.axis.cast<T>() + led[3] * frame_.tangents[0].cast<T>() +
                    led[4] * frame_.tangents[1].cast<T>();
    axis /= sqrt(axis.squaredNorm());
    const Eigen::Map<const Eigen::Matrix<T, 6, 1>> z(pose);
    const Vector3T shift = shift_.cast<T>() * z;
    T sum(0.0);
    for (const Eigen::Vector3d& point : points_mm_) {
      for (const Eigen::Vector3d& place : ring_mm_) {
        const Vector3T to_led = position + place.cast<T>() - point.cast<T>() - shift;
        const T r2 = to_led.squaredNorm();
        const T r = sqrt(r2);
        const T cosine = normal_.cast<T>().dot(to_led) / r;
        const T lobe = -axis.dot(to_led) / r;
        if (!(cosine > T(0.0)) || !(lobe > T(1e-6))) continue;
        sum += pow(lobe, led[5]) * cosine / r2;
      }
    }
    const double share = 1.0 / static_cast<double>(points_mm_.size() * ring_mm_.size());
    return T(albedo_over_pi_ * share) * (T(1.0) + T(albedo_std_) * albedo[0]) *
           (T(1.0) + T(exposure_std_) * exposure[0]) * exp(led[6 + channel_]) * sum;
  }

 private:
  const Frame& frame_;
  int channel_;
  Eigen::Vector3d normal_;
  double albedo_over_pi_, albedo_std_, exposure_std_;
  std::array<Eigen::Vector3d, kPoints> points_mm_;
  Eigen::Matrix<double, 3, 6> shift_;
  std::vector<Eigen::Vector3d> ring_mm_;
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
    return true;
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
  std::vector<std::array<double, 3>> ambient;  // by plane shot
  std::vector<std::array<double, 6>> pose;
  std::vector<std::array<double, 4>> sphere;
  std::vector<double> exposure;  // one more than settings, for scenes that have none
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

// One solve about the frame's axis.
LedSolution solve_once(const Frame& frame, const LedSolve& what) {
  const LedScene& scene = frame.scene;
  Unknowns x;
  x.led = frame.start();
  x.ambient.assign(scene.plane_shots(), {});
  x.pose.assign(scene.views.size(), {});
  x.sphere.assign(scene.spheres.size(), {});
  x.exposure.assign(scene.exposure_relative_std.size() + 1, 0.0);
  ceres::Problem::Options problem_options;
  problem_options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::CauchyLoss cauchy(1.0);
  ceres::Problem problem(problem_options);
  problem.AddParameterBlock(x.led.data(), kLedParameters);
  problem.SetParameterLowerBound(x.led.data(), kLedExponent, 0.0);
  for (auto& shot : x.ambient) {
    for (double& a : shot) {
      problem.AddParameterBlock(&a, 1);
      problem.SetParameterLowerBound(&a, 0, 0.0);
    }
  }
  double no_ambient = 0.0;
  problem.AddParameterBlock(&no_ambient, 1);
  problem.SetParameterBlockConstant(&no_ambient);
  const auto has_ambient = [&](const ShadedCell& cell) {
    return cell.shot < what.free_ambient.size() && what.free_ambient[cell.shot];
  };
  for (auto& p : x.pose) {
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<UnitPrior<6>, 6, 6>(new UnitPrior<6>),
                             nullptr, p.data());
  }
  for (auto& s : x.sphere) {
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<UnitPrior<4>, 4, 4>(new UnitPrior<4>),
                             nullptr, s.data());
  }
  for (double& e : x.exposure) {
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<UnitPrior<1>, 1, 1>(new UnitPrior<1>),
                             nullptr, &e);
  }
  problem.AddResidualBlock(new ceres::AutoDiffCostFunction<UnitPrior<1>, 1, 1>(new UnitPrior<1>),
                           nullptr, &x.albedo);
  std::vector<ceres::ResidualBlockId> highlights, cells;
  for (std::size_t i = 0; i < scene.highlights.size(); ++i) {
    if (!what.use_highlight[i]) continue;
    const SeenHighlight& h = scene.highlights[i];
    highlights.push_back(problem.AddResidualBlock(
        new ceres::NumericDiffCostFunction<HighlightCost, ceres::CENTRAL, 2, kLedParameters, 6, 4>(
            new HighlightCost{frame, h}),
        nullptr, x.led.data(), x.pose[h.view].data(), x.sphere[h.sphere].data()));
  }
  for (std::size_t i = 0; i < scene.cells.size(); ++i) {
    const ShadedCell& cell = scene.cells[i];
    if (!what.use_cell[i]) continue;
    const double std =
        std::hypot(cell.std_W_per_mm2_sr, what.cell_relative_std * cell.radiance_W_per_mm2_sr);
    cells.push_back(problem.AddResidualBlock(
        new ceres::AutoDiffCostFunction<CellCost, 1, kLedParameters, 6, 1, 1, 1>(
            new CellCost{CellModel(frame, cell), cell.radiance_W_per_mm2_sr, std,
                         frame.ambient_unit[cell.shot][cell.channel]}),
        what.robust ? &cauchy : nullptr, x.led.data(), x.pose[cell.view].data(), &x.albedo,
        &x.exposure.at(cell.setting),
        has_ambient(cell) ? &x.ambient[cell.shot][static_cast<std::size_t>(cell.channel)]
                          : &no_ambient));
  }
  std::vector<int> held;
  for (std::size_t i = 0; i < what.free.size(); ++i) {
    if (!what.free[i]) held.push_back(static_cast<int>(i));
  }
  if (!held.empty()) {
    problem.SetManifold(x.led.data(), new ceres::SubsetManifold(kLedParameters, held));
  }
  const double gradient = ceres::Solver::Options().gradient_tolerance;
  auto options = quiet_solver<ceres::Solver::Options>(
      what.robust ? SolverStop{40, 1e-5, gradient, 1e-6} : SolverStop{100, 1e-9, gradient, 1e-9});
  options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);

  LedSolution out;
  out.converged = summary.IsSolutionUsable();
  out.cost = out.converged ? summary.final_cost : std::numeric_limits<double>::infinity();
  out.led = frame.at(x.led.data());
  out.tangents = frame.tangents;
  for (const SeenHighlight& h : scene.highlights) {
    out.highlight_px.push_back(HighlightCost{frame, h}.predict(x.led.data(), x.pose[h.view].data(),
                                                               x.sphere[h.sphere].data()));
  }
  out.ambient_unit = frame.ambient_unit;
  for (std::size_t s = 0; s < x.ambient.size(); ++s) {
    out.ambient.emplace_back(Eigen::Map<const Eigen::Array3d>(x.ambient[s].data()) *
                             frame.ambient_unit[s]);
  }
  out.nuisances_at = out.ambient_at + static_cast<Eigen::Index>(3 * x.ambient.size());
  for (const ShadedCell& cell : scene.cells) {
    out.cell_radiance.push_back(CellModel(frame, cell)
                                    .radiance(x.led.data(), x.pose[cell.view].data(), &x.albedo,
                                              &x.exposure.at(cell.setting)) +
                                out.ambient[cell.shot][cell.channel]);
  }
  if (what.robust) return out;
  // The held ones count as free for the derivative and are then struck out.
  if (!held.empty()) problem.SetManifold(x.led.data(), nullptr);
  out.highlight_information = information(problem, x, highlights, what.free);
  out.cell_information = information(problem, x, cells, what.free);
  return out;
}

}  // namespace

LedSolution solve_led(const LedScene& scene, const Led& start, const LedSolve& what) {
  // Tangents belong to an axis: once more about the one that was found.
  const LedSolution first = solve_once(Frame(scene, start), what);
  if (!first.converged || what.robust) return first;
  return solve_once(Frame(scene, first.led), what);
}

double cell_radiance(const LedScene& scene, const ShadedCell& cell, const Led& led) {
  const Frame frame(scene, led);
  const std::array<double, kLedParameters> x = frame.start();
  const std::array<double, 6> pose{};
  const double albedo = 0.0;
  const double exposure = 0.0;
  return CellModel(frame, cell).radiance(x.data(), pose.data(), &albedo, &exposure);
}

}  // namespace scattermeter::calib
