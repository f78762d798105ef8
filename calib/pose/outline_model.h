// The joint linear model of where outlines are seen: offsets = A (causes) + noise.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "calib/pose/outline_look.h"
#include "core/camera/camera_model.h"
#include "core/camera/camera_pose.h"

namespace scattermeter::calib {

// The look at one shot of one body.
struct OutlineShot {
  std::string file;
  int body_idx = 0;
  const std::vector<ContourPoint>* contour = nullptr;
  OutlineLook look;
  // Where the body was taken to stand for contour and look, from its place in the rig, world: a
  // second look about the answer of a first, which is linear only nearby.
  Eigen::Vector3d assumed_mm = Eigen::Vector3d::Zero();
};

// With fewer of its points found, an outline is not judged.
inline constexpr std::size_t kLeastOffsets = 30;

// Standard deviations of what is left free.
inline constexpr double kFreePlace_mm = 50.0;
inline constexpr double kFreeTurn_rad = 0.5;
inline constexpr double kFreeScale = 0.3;
inline constexpr double kFreeShift_px = 300.0;

// Columns: the pose's correction (6, as PoseResult::covariance); for each body place (3, mm,
// world), turn about its centre (3, rad, world), scale about its centre (ln), growth of the
// contour (px) and the second to fourth harmonics of the direction of its normal (6, px): an edge
// seen from the lit side lies elsewhere than one in the shade; for each shot the shift of its
// picture (2, px, right and down).
class OutlineModel {
 public:
  static constexpr Eigen::Index kPose = 6;
  static constexpr Eigen::Index kHarmonics = 6;

  // Points off the fit of all columns by more than four robust standard deviations are left out;
  // the others have the scatter of that fit, at least 0.15 cells, and share it with their three
  // neighbours. centers_mm: of the bodies. The pose must outlive it. std::invalid_argument without
  // any offset.
  OutlineModel(const std::vector<OutlineShot>& shots, const CameraIntrinsics& intrinsics,
               const PoseResult& pose, const std::vector<Eigen::Vector3d>& centers_mm);

  Eigen::Index place(std::size_t body) const {
    return kPose + kPerBody * static_cast<Eigen::Index>(body);
  }
  Eigen::Index turn(std::size_t body) const { return place(body) + 3; }
  Eigen::Index scale(std::size_t body) const { return place(body) + 6; }
  Eigen::Index growth(std::size_t body) const { return place(body) + 7; }
  Eigen::Index harmonics(std::size_t body) const { return place(body) + 8; }
  Eigen::Index shift(std::size_t shot) const {
    return kPose + kPerBody * bodies_ + 2 * static_cast<Eigen::Index>(shot);
  }
  Eigen::Index columns() const { return columns_; }
  double cell_px() const { return cell_px_; }
  double independent_points() const;
  // Number of the shot's points that were not left out.
  std::size_t kept(std::size_t shot) const;

  // Share of the shot's offsets within `cells` of a fit of the bodies' places and the contours'
  // errors (std 0.3 cells) alone: whether it is this body that is seen, wherever it stands.
  double share_on_place(std::size_t shot, double cells) const;

  struct Fit {
    Eigen::VectorXd value;       // of all columns
    Eigen::MatrixXd covariance;  // likewise; zero for columns that are fixed at 0
    double chi2 = 0;             // of the points and the priors
  };
  // std: prior standard deviation of each column about 0; 0: fixed at 0. own_pose: the pose has its
  // own covariance as prior, whatever `std` says.
  Fit fit(const Eigen::VectorXd& std, bool own_pose) const;

 private:
  static constexpr Eigen::Index kPerBody = 8 + kHarmonics;

  void fill(const OutlineShot& shot, std::size_t shot_idx, const OutlineOffset& offset,
            const Eigen::Matrix<double, 2, 3>& jacobian, const Eigen::Vector3d& center_mm,
            Eigen::Index row);
  Eigen::VectorXd all_free() const;
  void accumulate();
  void weigh();

  const PoseResult& pose_;
  Eigen::Index bodies_;
  Eigen::Index columns_;
  double cell_px_ = 0;
  Eigen::MatrixXd a_;
  Eigen::VectorXd offset_px_;
  std::vector<std::size_t> shot_of_row_;
  Eigen::VectorXd weight_;
  // Of the weighted points.
  Eigen::MatrixXd normal_;
  Eigen::VectorXd gradient_;
  double squares_ = 0;
};

// Share of the contour's points in the frame that a look found on a body of this contour, wherever
// it stands; 0 with hardly any of them. The pose is that of the contour; center_mm: of the body.
double outline_share(const OutlineLook& look, const std::vector<ContourPoint>& contour,
                     const CameraIntrinsics& intrinsics, const PoseResult& pose,
                     const Eigen::Vector3d& center_mm);

}  // namespace scattermeter::calib
