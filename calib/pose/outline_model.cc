#include "calib/pose/outline_model.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <Eigen/Geometry>

#include "core/base/dense_solve.h"
#include "core/base/median.h"
#include "core/camera/lens.h"

namespace scattermeter::calib {
namespace {

constexpr double kCorrelated = 4.0;      // neighbouring points that share an error
constexpr double kLeastScatter = 0.15;   // cells
constexpr double kOutlineOutlier = 4.0;  // robust standard deviations
// Standard deviations in the fit that finds outliers, cells.
constexpr double kFreeGrowth = 0.5;
constexpr double kFreeShift = 5.0;
constexpr double kAbsolute =
    0.3;  // below which the sum of absolute values is one of squares, cells
constexpr int kRounds = 16;

}  // namespace

OutlineModel::OutlineModel(const std::vector<OutlineShot>& shots,
                           const CameraIntrinsics& intrinsics, const PoseResult& pose,
                           const std::vector<Eigen::Vector3d>& centers_mm)
    : pose_(pose),
      bodies_(static_cast<Eigen::Index>(centers_mm.size())),
      columns_(kPose + kPerBody * bodies_ + 2 * static_cast<Eigen::Index>(shots.size())) {
  const Lens lens(intrinsics);
  Eigen::Index rows = 0;
  for (const OutlineShot& shot : shots) {
    rows += static_cast<Eigen::Index>(shot.look.offsets.size());
    cell_px_ = std::max(cell_px_, shot.look.cell_px);
  }
  if (rows == 0) throw std::invalid_argument("OutlineModel: no offsets");
  a_ = Eigen::MatrixXd::Zero(rows, columns_);
  offset_px_.resize(rows);
  Eigen::Index row = 0;
  for (std::size_t s = 0; s < shots.size(); ++s) {
    for (const OutlineOffset& o : shots[s].look.offsets) {
      Eigen::Matrix<double, 2, 3> jacobian;
      lens.project(pose.camera_from_world *
                       ((*shots[s].contour)[o.point_idx].point_mm + shots[s].assumed_mm),
                   &jacobian);
      fill(shots[s], s, o, jacobian, centers_mm[static_cast<std::size_t>(shots[s].body_idx)],
           row++);
    }
  }
  weigh();
}

void OutlineModel::fill(const OutlineShot& shot, std::size_t shot_idx, const OutlineOffset& offset,
                        const Eigen::Matrix<double, 2, 3>& jacobian,
                        const Eigen::Vector3d& center_mm, Eigen::Index row) {
  const ContourPoint& p = (*shot.contour)[offset.point_idx];
  const Eigen::Matrix3d r = pose_.camera_from_world.rotation.toRotationMatrix();
  const auto body = static_cast<std::size_t>(shot.body_idx);
  const Eigen::Vector3d by_camera = jacobian.transpose() * p.outward;
  const Eigen::Vector3d by_world = r.transpose() * by_camera;
  const Eigen::Vector3d arm = p.point_mm - center_mm;
  a_.block<1, 3>(row, 0) = (r * (p.point_mm + shot.assumed_mm)).cross(by_camera).transpose();
  a_.block<1, 3>(row, 3) = by_camera.transpose();
  a_.block<1, 3>(row, place(body)) = by_world.transpose();
  a_.block<1, 3>(row, turn(body)) = arm.cross(by_world).transpose();
  a_(row, scale(body)) = by_world.dot(arm);
  a_(row, growth(body)) = 1.0;
  const double direction = std::atan2(p.outward.y(), p.outward.x());
  for (Eigen::Index k = 0; k < kHarmonics / 2; ++k) {
    a_(row, harmonics(body) + 2 * k) = std::cos(static_cast<double>(k + 2) * direction);
    a_(row, harmonics(body) + 2 * k + 1) = std::sin(static_cast<double>(k + 2) * direction);
  }
  a_.block<1, 2>(row, shift(shot_idx)) = p.outward.transpose();
  // Of the body's place in the rig.
  offset_px_[row] = offset.px + by_world.dot(shot.assumed_mm);
  shot_of_row_.push_back(shot_idx);
}

double OutlineModel::independent_points() const {
  return static_cast<double>((weight_.array() > 0).count()) / kCorrelated;
}

std::size_t OutlineModel::kept(std::size_t shot) const {
  std::size_t n = 0;
  for (std::size_t i = 0; i < shot_of_row_.size(); ++i) {
    n += shot_of_row_[i] == shot && weight_[static_cast<Eigen::Index>(i)] > 0 ? 1 : 0;
  }
  return n;
}

double OutlineModel::share_on_place(std::size_t shot, double cells) const {
  Eigen::VectorXd deviation = Eigen::VectorXd::Zero(columns_);
  for (std::size_t b = 0; b < static_cast<std::size_t>(bodies_); ++b) {
    deviation.segment<3>(place(b)).setConstant(kFreePlace_mm);
    deviation.segment(growth(b), 1 + kHarmonics).setConstant(kAbsolute * cell_px_);
  }
  const Eigen::VectorXd residual = offset_px_ - a_ * fit(deviation, false).value;
  double all = 0.0;
  double within = 0.0;
  for (std::size_t i = 0; i < shot_of_row_.size(); ++i) {
    if (shot_of_row_[i] != shot) continue;
    all += 1.0;
    within += std::abs(residual[static_cast<Eigen::Index>(i)]) < cells * cell_px_ ? 1.0 : 0.0;
  }
  return all > 0.0 ? within / all : 0.0;
}

OutlineModel::Fit OutlineModel::fit(const Eigen::VectorXd& std, bool own_pose) const {
  std::vector<Eigen::Index> used;
  for (Eigen::Index i = 0; i < columns_; ++i) {
    if (std[i] > 0 || (own_pose && i < kPose)) used.push_back(i);
  }
  Eigen::MatrixXd information = normal_(used, used);
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (own_pose && used[i] < kPose) continue;
    const auto at = static_cast<Eigen::Index>(i);
    information(at, at) += 1 / (std[used[i]] * std[used[i]]);
  }
  if (own_pose) {
    information.topLeftCorner<kPose, kPose>() += SymmetricSolver(pose_.covariance).inverse();
  }
  // Scaled first, as radians and millimetres differ by orders of magnitude.
  const Eigen::VectorXd unit = information.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd covariance =
      unit.asDiagonal() *
      SymmetricSolver(unit.asDiagonal() * information * unit.asDiagonal()).inverse() *
      unit.asDiagonal();
  const Eigen::VectorXd gradient = gradient_(used);
  const Eigen::VectorXd value = covariance * gradient;
  Fit out;
  out.chi2 = std::max(0.0, squares_ - gradient.dot(value));
  out.value = Eigen::VectorXd::Zero(columns_);
  out.covariance = Eigen::MatrixXd::Zero(columns_, columns_);
  out.value(used) = value;
  out.covariance(used, used) = covariance;
  return out;
}

Eigen::VectorXd OutlineModel::all_free() const {
  Eigen::VectorXd std = Eigen::VectorXd::Constant(columns_, kFreeShift * cell_px_);
  std.head<kPose>().setZero();
  for (std::size_t b = 0; b < static_cast<std::size_t>(bodies_); ++b) {
    std.segment<3>(place(b)).setConstant(kFreePlace_mm);
    std.segment<3>(turn(b)).setConstant(kFreeTurn_rad);
    std[scale(b)] = kFreeScale;
    std[growth(b)] = kFreeGrowth * cell_px_;
    std.segment(harmonics(b), kHarmonics).setConstant(kFreeGrowth * cell_px_);
  }
  return std;
}

void OutlineModel::accumulate() {
  normal_ = a_.transpose() * weight_.asDiagonal() * a_;
  gradient_ = a_.transpose() * weight_.cwiseProduct(offset_px_);
  squares_ = offset_px_.dot(weight_.cwiseProduct(offset_px_));
}

// First the sum of absolute values, then Cauchy's loss, then equal weights without outliers.
void OutlineModel::weigh() {
  const Eigen::VectorXd free = all_free();
  const double one = 1 / (cell_px_ * cell_px_);
  weight_ = Eigen::VectorXd::Constant(offset_px_.size(), one);
  Eigen::VectorXd residual;
  for (int round = 0; round < kRounds; ++round) {
    accumulate();
    residual = offset_px_ - a_ * fit(free, false).value;
    for (Eigen::Index i = 0; i < residual.size(); ++i) {
      const double r = std::abs(residual[i]) / cell_px_;
      weight_[i] = one / (round < kRounds / 2 ? r + kAbsolute : 1 + r * r);
    }
  }
  const double scatter_px =
      std::max(kLeastScatter * cell_px_,
               kStdPerMad * median_absolute_deviation(
                                std::vector<double>(residual.begin(), residual.end()), 0.0));
  for (Eigen::Index i = 0; i < residual.size(); ++i) {
    const bool far = std::abs(residual[i]) > kOutlineOutlier * scatter_px;
    weight_[i] = far ? 0.0 : 1 / (kCorrelated * scatter_px * scatter_px);
  }
  accumulate();
}

double outline_share(const OutlineLook& look, const std::vector<ContourPoint>& contour,
                     const CameraIntrinsics& intrinsics, const PoseResult& pose,
                     const Eigen::Vector3d& center_mm) {
  constexpr double kOnPlace_cells = 1.5;
  if (look.offsets.size() < kLeastOffsets) return 0.0;
  const OutlineModel model({{"", 0, &contour, look, Eigen::Vector3d::Zero()}}, intrinsics, pose,
                           {center_mm});
  return model.share_on_place(0, kOnPlace_cells) * look.found_share();
}

}  // namespace scattermeter::calib
