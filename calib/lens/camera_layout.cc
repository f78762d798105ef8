#include "calib/lens/camera_layout.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <sstream>

namespace scattermeter::calib {
namespace {

constexpr int kFields = 5;
constexpr std::size_t kGoodViews = 8;
constexpr double kGoodAngleRad = 20 * std::numbers::pi / 180;

}  // namespace

CameraLayout camera_layout(const std::vector<BoardView>& views, const CameraBundle& bundle,
                           int width_px, int height_px) {
  CameraLayout out;
  std::vector<Eigen::Vector3d> normals;
  for (const Rigid3d& pose : bundle.camera_from_board) {
    const Eigen::Vector3d n = pose.rotation * Eigen::Vector3d::UnitZ();
    // The sign of the normal is ignored, as some detections number the corners of a board mirrored.
    for (const Eigen::Vector3d& other : normals) {
      const double angle = std::atan2(n.cross(other).norm(), std::abs(n.dot(other)));
      out.widest_angle_rad = std::max(out.widest_angle_rad, angle);
    }
    normals.push_back(n);
  }
  std::array<bool, kFields * kFields> covered{};
  for (const BoardView& view : views) {
    for (const PointPair& c : view.corners) {
      const auto field = [](double at, int size) {
        return std::clamp(static_cast<int>((at + 0.5) / size * kFields), 0, kFields - 1);
      };
      const int i = field(c.image_px.y(), height_px) * kFields + field(c.image_px.x(), width_px);
      covered[static_cast<std::size_t>(i)] = true;
    }
  }
  out.covered_share = static_cast<double>(std::count(covered.begin(), covered.end(), true)) /
                      static_cast<double>(covered.size());
  const std::pair<const char*, std::size_t> corners[] = {{"upper left", 0},
                                                         {"upper right", kFields - 1},
                                                         {"lower left", kFields * (kFields - 1)},
                                                         {"lower right", kFields * kFields - 1}};
  for (const auto& [name, i] : corners) {
    if (!covered[i]) out.bare_corners.emplace_back(name);
  }
  return out;
}

std::vector<std::string> layout_warnings(const CameraLayout& layout, std::size_t n_views) {
  std::vector<std::string> out;
  std::ostringstream text;
  const auto say = [&] {
    out.push_back(text.str());
    text.str("");
  };
  text.precision(2);
  if (n_views < kGoodViews) {
    text << "only " << n_views << " views are used: take " << kGoodViews << " or more";
    say();
  }
  if (layout.widest_angle_rad < kGoodAngleRad) {
    text << "all views see the board at nearly the same tilt ("
         << layout.widest_angle_rad * 180 / std::numbers::pi
         << " degrees apart at most), from which focal length and distance can hardly be "
            "separated: tilt the board by 30 to 45 degrees, each time to another side";
    say();
  }
  if (!layout.bare_corners.empty()) {
    text << "no corner of the board was ever in the frame's ";
    for (std::size_t i = 0; i < layout.bare_corners.size(); ++i) {
      text << (i > 0 ? ", " : "") << layout.bare_corners[i];
    }
    text << " corner: distortion there is extrapolated";
    say();
  }
  return out;
}

}  // namespace scattermeter::calib
