#include "calib/lens/camera_start.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include <opencv2/calib3d.hpp>

#include "calib/board/opencv_quiet.h"
#include "core/base/median.h"

namespace scattermeter::calib {
namespace {

constexpr double kLadder[] = {0.6, 1.0, 1.6, 2.6, 5.0};  // focal length over the frame's width
constexpr int kTried = 3;                                // the best of them, which are adjusted

struct FocalGuess {
  double focal_px;
  double weight;
};

// The focal length from one homography of the board to the image, relative to the frame centre: its
// first two columns are orthogonal and of equal length once the image is scaled by 1 / f. None for
// a board seen frontally, for which the equations vanish.
std::optional<FocalGuess> focal_of(const BoardView& view, const Eigen::Vector2d& middle_px,
                                   double width_px) {
  std::vector<cv::Point2d> board, image;
  for (const PointPair& c : view.corners) {
    board.emplace_back(c.world_mm.x(), c.world_mm.y());
    const Eigen::Vector2d p = (c.image_px - middle_px) / width_px;
    image.emplace_back(p.x(), p.y());
  }
  const cv::Mat found = cv::findHomography(board, image, cv::RANSAC, 0.01);
  if (found.empty()) return std::nullopt;
  cv::Mat_<double> h = found;
  const double size = std::hypot(h(0, 0), h(1, 0)) + std::hypot(h(0, 1), h(1, 1));
  if (!(size > 0)) return std::nullopt;
  h /= size;
  const double a1 = h(0, 0) * h(0, 1) + h(1, 0) * h(1, 1);
  const double b1 = h(2, 0) * h(2, 1);
  const double a2 = h(0, 0) * h(0, 0) + h(1, 0) * h(1, 0) - h(0, 1) * h(0, 1) - h(1, 1) * h(1, 1);
  const double b2 = h(2, 0) * h(2, 0) - h(2, 1) * h(2, 1);
  const double inverse_square = -(a1 * b1 + a2 * b2) / (a1 * a1 + a2 * a2);
  const double across = 1 / std::sqrt(inverse_square);
  if (!(across > 0.1 && across < 30)) return std::nullopt;
  return FocalGuess{across * width_px, std::sqrt(a1 * a1 + a2 * a2)};
}

std::optional<double> middle_focal(std::vector<FocalGuess> guesses) {
  if (guesses.empty()) return std::nullopt;
  std::sort(guesses.begin(), guesses.end(),
            [](const auto& a, const auto& b) { return a.focal_px < b.focal_px; });
  const double half = 0.5 * std::accumulate(guesses.begin(), guesses.end(), 0.0,
                                            [](double s, const auto& g) { return s + g.weight; });
  double sum = 0;
  for (const FocalGuess& g : guesses) {
    sum += g.weight;
    if (sum >= half) return g.focal_px;
  }
  return guesses.back().focal_px;
}

}  // namespace

Rigid3d board_pose(const BoardView& view, const CameraIntrinsics& intrinsics) {
  const OpencvQuiet quiet;
  std::vector<cv::Point3d> board;
  std::vector<cv::Point2d> rays;
  std::vector<Eigen::Vector2d> image;
  for (const PointPair& c : view.corners) image.push_back(c.image_px);
  const std::vector<Eigen::Vector2d> undistorted = undistort(intrinsics, image);
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const PointPair& c : view.corners) {
    middle += c.world_mm / static_cast<double>(view.corners.size());
  }
  for (std::size_t i = 0; i < undistorted.size(); ++i) {
    if (!undistorted[i].allFinite()) continue;
    const Eigen::Vector3d p = view.corners[i].world_mm - middle;
    board.emplace_back(p.x(), p.y(), p.z());
    rays.emplace_back(undistorted[i].x(), undistorted[i].y());
  }
  cv::Mat w, t;
  // In front of the camera and far away, where the board is a dot.
  Rigid3d pose;
  pose.translation_mm = -middle;
  for (const PointPair& c : view.corners) {
    pose.translation_mm.z() += 100 * (c.world_mm - middle).norm();
  }
  try {
    if (board.size() < 4 || !cv::solvePnP(board, rays, cv::Matx33d::eye(), cv::noArray(), w, t,
                                          false, cv::SOLVEPNP_IPPE)) {
      return pose;
    }
  } catch (const cv::Exception&) {
    return pose;  // no homography
  }
  const Eigen::Vector3d turn(w.at<double>(0), w.at<double>(1), w.at<double>(2));
  const double angle = turn.norm();
  if (angle > 0) pose.rotation = Eigen::Quaterniond(Eigen::AngleAxisd(angle, turn / angle));
  pose.translation_mm =
      Eigen::Vector3d(t.at<double>(0), t.at<double>(1), t.at<double>(2)) - pose.rotation * middle;
  return pose;
}

double median_residual_px(const std::vector<BoardView>& views, const CameraBundle& bundle,
                          int width_px, int height_px) {
  const CameraIntrinsics k = intrinsics_of(bundle.lens, width_px, height_px);
  std::vector<double> lengths;
  for (std::size_t i = 0; i < views.size(); ++i) {
    for (const Eigen::Vector2d& r : view_residuals(views[i], bundle.camera_from_board[i], k)) {
      lengths.push_back(r.allFinite() ? r.norm() : std::numeric_limits<double>::infinity());
    }
  }
  return upper_median(std::move(lengths));
}

CameraBundle start_camera(const std::vector<BoardView>& views, int width_px, int height_px) {
  const OpencvQuiet quiet;
  const Eigen::Vector2d middle(0.5 * (width_px - 1), 0.5 * (height_px - 1));
  std::vector<FocalGuess> guesses;
  for (const BoardView& view : views) {
    if (const auto guess = focal_of(view, middle, width_px)) guesses.push_back(*guess);
  }
  std::vector<double> focals;
  if (const auto f = middle_focal(guesses)) focals.push_back(*f);
  for (const double ratio : kLadder) focals.push_back(ratio * width_px);
  std::vector<std::pair<double, CameraBundle>> starts;
  for (const double f : focals) {
    CameraBundle start;
    start.lens.setZero();
    start.lens.head<4>() << f, f, middle;
    for (const BoardView& view : views) {
      start.camera_from_board.push_back(
          board_pose(view, intrinsics_of(start.lens, width_px, height_px)));
    }
    starts.emplace_back(median_residual_px(views, start, width_px, height_px), start);
  }
  std::stable_sort(starts.begin(), starts.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  CameraBundle best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < std::min<std::size_t>(kTried, starts.size()); ++i) {
    CameraBundle fit = starts[i].second;
    for (const DistortionTerms terms : {DistortionTerms::kK1, DistortionTerms::kK1K2}) {
      fit = adjust_bundle(views, {true, terms}, width_px, height_px, fit,
                          terms == DistortionTerms::kK1 ? 0.002 * width_px : 0.5);
    }
    const double median = median_residual_px(views, fit, width_px, height_px);
    if (median < least || best.camera_from_board.empty()) {
      least = median;
      best = fit;
    }
    // A fraction of a pixel: these are real corners.
    if (least < 0.3) break;
  }
  best.converged = std::isfinite(least);
  return best;
}

}  // namespace scattermeter::calib
