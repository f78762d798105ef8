#include "calib/lens/view_selection.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include <opencv2/calib3d.hpp>

#include "calib/board/opencv_quiet.h"
#include "calib/lens/camera_start.h"
#include "calib/pose/pose_layout.h"
#include "core/base/median.h"

namespace scattermeter::calib {
namespace {

constexpr std::size_t kMinCorners = 8;
constexpr double kSameShotPx = 1e-3;
constexpr double kPerspectiveShare = 0.7;
constexpr double kPerspectiveTolerance = 0.02;
constexpr double kBadView = 4;
constexpr double kBadCorner = 6;              // standard deviations
constexpr double kMedianOfRayleigh = 1.1774;  // sqrt(2 ln 2), in standard deviations
constexpr double kFloorPx = 0.01;             // smaller residuals are not distinguished

template <class... Values>
std::string say(const char* format, Values... values) {
  char text[300];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

double middle_or_none(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::infinity();
  return upper_median(std::move(values));
}

bool same_corners(const BoardView& a, const BoardView& b) {
  if (a.corners.size() != b.corners.size()) return false;
  for (std::size_t i = 0; i < a.corners.size(); ++i) {
    if (!((a.corners[i].image_px - b.corners[i].image_px).norm() < kSameShotPx)) return false;
  }
  return true;
}

// Share of the corners that one perspective explains to 2 % of the frame width: lens distortion is
// smaller than that, the errors of wrongly numbered corners are not.
double perspective_share(const BoardView& view, double width_px) {
  const OpencvQuiet quiet;
  std::vector<cv::Point2d> board, image;
  for (const PointPair& c : view.corners) {
    board.emplace_back(c.world_mm.x(), c.world_mm.y());
    image.emplace_back(c.image_px.x(), c.image_px.y());
  }
  cv::Mat mask;
  const cv::Mat h =
      cv::findHomography(board, image, cv::RANSAC, kPerspectiveTolerance * width_px, mask);
  if (h.empty()) return 0;
  return cv::countNonZero(mask) / static_cast<double>(board.size());
}

// Why a view is unusable whatever the camera, or "".
std::string own_fault(const BoardView& view, const std::vector<BoardView>& before,
                      double width_px) {
  if (view.corners.size() < kMinCorners) {
    return say("only %zu corners of the board are seen, %zu are needed", view.corners.size(),
               kMinCorners);
  }
  if (const auto fault =
          layout_fault(view.corners, std::vector<bool>(view.corners.size(), true), 0.3)) {
    return fault->message;
  }
  for (const BoardView& other : before) {
    if (same_corners(view, other)) return "the same shot as " + other.name;
  }
  if (perspective_share(view, width_px) < kPerspectiveShare) {
    return "its corners are not a perspective image of those of this board";
  }
  return "";
}

struct ViewState {
  const BoardView* all;  // all corners found
  BoardView used;        // those kept
  Rigid3d camera_from_board;
};

class Selection {
 public:
  Selection(int width_px, int height_px) : width_px_(width_px), height_px_(height_px) {}

  ViewSelection run(const std::vector<BoardView>& views);

 private:
  void fit(double cauchy_px);
  std::vector<double> residuals(const BoardView& view, const Rigid3d& pose) const;
  std::vector<double> view_medians() const;
  void leave_out_views();
  void readmit(const std::vector<BoardView>& views);
  bool leave_out_corners();

  int width_px_;
  int height_px_;
  std::vector<ViewState> states_;
  LensParameters lens_;
  double typical_px_ = 0;
  bool converged_ = false;
  ViewSelection out_;
};

void Selection::fit(double cauchy_px) {
  std::vector<BoardView> views;
  CameraBundle bundle;
  bundle.lens = lens_;
  for (const ViewState& s : states_) {
    views.push_back(s.used);
    bundle.camera_from_board.push_back(s.camera_from_board);
  }
  // With few views a rich model would diverge.
  const LensModel model = views.size() < 4 ? LensModel{true, DistortionTerms::kK1K2}
                                           : LensModel{false, DistortionTerms::kK1K2P1P2K3};
  bundle = adjust_bundle(views, model, width_px_, height_px_, bundle, cauchy_px);
  lens_ = bundle.lens;
  converged_ = bundle.converged;
  for (std::size_t i = 0; i < states_.size(); ++i) {
    states_[i].camera_from_board = bundle.camera_from_board[i];
  }
  typical_px_ = std::max(kFloorPx, middle_or_none(view_medians()));
}

std::vector<double> Selection::residuals(const BoardView& view, const Rigid3d& pose) const {
  std::vector<double> out;
  for (const Eigen::Vector2d& r :
       view_residuals(view, pose, intrinsics_of(lens_, width_px_, height_px_))) {
    out.push_back(r.allFinite() ? r.norm() : std::numeric_limits<double>::infinity());
  }
  return out;
}

std::vector<double> Selection::view_medians() const {
  std::vector<double> medians;
  for (const ViewState& s : states_)
    medians.push_back(middle_or_none(residuals(s.used, s.camera_from_board)));
  return medians;
}

void Selection::leave_out_views() {
  while (states_.size() > 2) {
    const std::vector<double> medians = view_medians();
    const auto worst = std::max_element(medians.begin(), medians.end());
    if (!(*worst > kBadView * typical_px_)) return;
    const auto at = states_.begin() + (worst - medians.begin());
    out_.left_out.push_back(
        {at->all->name, say("its corners are %.2f px (median) from where the other views put "
                            "them, which are off by %.2f px themselves",
                            *worst, typical_px_)});
    states_.erase(at);
    fit(2 * typical_px_);
  }
}

void Selection::readmit(const std::vector<BoardView>& views) {
  const CameraIntrinsics k = intrinsics_of(lens_, width_px_, height_px_);
  if (!intrinsics_problem(k).empty()) return;
  for (std::size_t i = 0; i < out_.left_out.size();) {
    const auto view = std::find_if(views.begin(), views.end(), [&](const BoardView& v) {
      return v.name == out_.left_out[i].name;
    });
    const PoseResult pose = estimate_pose(k, view->corners);
    const bool fits = pose.rms_px > 0 && middle_or_none(residuals(*view, pose.camera_from_world)) <
                                             0.7 * kBadView * typical_px_;
    if (!fits) {
      ++i;
      continue;
    }
    states_.push_back({&*view, *view, pose.camera_from_world});
    out_.left_out.erase(out_.left_out.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

// Repeats the choice among all corners and returns whether anything changed.
bool Selection::leave_out_corners() {
  out_.corners_left_out.clear();
  bool changed = false;
  for (std::size_t i = 0; i < states_.size();) {
    ViewState& s = states_[i];
    const std::vector<double> r = residuals(*s.all, s.camera_from_board);
    const double limit_px =
        kBadCorner * std::max(middle_or_none(r), typical_px_) / kMedianOfRayleigh;
    BoardView kept{s.all->name, {}};
    std::vector<LeftOutCorner> bad;
    for (std::size_t c = 0; c < r.size(); ++c) {
      if (r[c] <= limit_px) {
        kept.corners.push_back(s.all->corners[c]);
      } else {
        bad.push_back({s.all->name, s.all->corners[c].image_px, r[c]});
      }
    }
    if (4 * bad.size() > r.size() || kept.corners.size() < kMinCorners) {
      out_.left_out.push_back(
          {s.all->name, say("%zu of its %zu corners are wrong", bad.size(), r.size())});
      states_.erase(states_.begin() + static_cast<std::ptrdiff_t>(i));
      changed = true;
      continue;
    }
    changed = changed || kept.corners.size() != s.used.corners.size();
    s.used = std::move(kept);
    out_.corners_left_out.insert(out_.corners_left_out.end(), bad.begin(), bad.end());
    ++i;
  }
  return changed;
}

ViewSelection Selection::run(const std::vector<BoardView>& views) {
  std::vector<BoardView> usable;
  for (const BoardView& view : views) {
    const std::string fault = own_fault(view, usable, width_px_);
    if (fault.empty()) {
      usable.push_back(view);
    } else {
      out_.left_out.push_back({view.name, fault});
    }
  }
  if (usable.size() < 2) return out_;
  const std::size_t left_out_by_themselves = out_.left_out.size();
  const CameraBundle start = start_camera(usable, width_px_, height_px_);
  lens_ = start.lens;
  for (std::size_t i = 0; i < usable.size(); ++i) {
    states_.push_back({&usable[i], usable[i], start.camera_from_board[i]});
  }
  fit(0.5);
  fit(2 * typical_px_);
  leave_out_views();
  const double limit_px = std::max(2.0, 1e-3 * width_px_);
  if (typical_px_ > limit_px) {
    out_.fault =
        say("the corners of the %zu views are not consistent with any camera (they are %.1f px off "
            "with a common lens): check the board's squares, and that all shots are of one camera",
            states_.size(), typical_px_);
    return out_;
  }
  const std::vector<LeftOutView> by_themselves(
      out_.left_out.begin(),
      out_.left_out.begin() + static_cast<std::ptrdiff_t>(left_out_by_themselves));
  out_.left_out.erase(out_.left_out.begin(),
                      out_.left_out.begin() + static_cast<std::ptrdiff_t>(left_out_by_themselves));
  if (!out_.left_out.empty()) {
    readmit(usable);
    fit(2 * typical_px_);
  }
  out_.left_out.insert(out_.left_out.begin(), by_themselves.begin(), by_themselves.end());
  for (int i = 0; i < 4 && leave_out_corners(); ++i) {
    if (states_.size() < 2) break;
    fit(2 * typical_px_);
  }
  out_.bundle.lens = lens_;
  out_.bundle.converged = converged_;
  // In the order of the shots, whenever a view was taken back.
  for (const BoardView& view : views) {
    for (const ViewState& s : states_) {
      if (s.all->name != view.name) continue;
      out_.views.push_back(s.used);
      out_.bundle.camera_from_board.push_back(s.camera_from_board);
    }
  }
  return out_;
}

}  // namespace

ViewSelection select_views(const std::vector<BoardView>& views, int width_px, int height_px) {
  return Selection(width_px, height_px).run(views);
}

}  // namespace scattermeter::calib
