// The camera stands, looks or images otherwise than stated.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "apps/deviations/deviation.h"

namespace scattermeter::apps {
namespace {

const std::vector<std::string> kPoseWords = {"pose",       "camera", "outline", "mesh",
                                             "silhouette", "mark",   "point"};
const std::vector<std::string> kLensWords = {"lens", "focal", "intrinsics", "camera",
                                             "pose", "mark",  "outline",    "mesh"};
const std::vector<std::string> kSharpnessWords = {"blur", "focus",   "sharp",
                                                  "edge", "outline", "motion"};

CameraPlacement& camera(TrueSetup& t) { return *t.rig.truth.pose; }

void knock(TrueSetup& t, const DeviationDraw& d) { camera(t).look_at_mm.x() += d.signed_size(); }
void displace(TrueSetup& t, const DeviationDraw& d) {
  const Eigen::Vector3d shift_mm = d.signed_size() * Eigen::Vector3d(0.6, 0.0, 0.8);
  camera(t).position_mm += shift_mm;
  camera(t).look_at_mm += shift_mm;
}
void step_back(TrueSetup& t, const DeviationDraw& d) {
  CameraPlacement& c = camera(t);
  c.position_mm += d.signed_size() * (c.position_mm - c.look_at_mm).normalized();
}
void roll(TrueSetup& t, const DeviationDraw& d) {
  CameraPlacement& c = camera(t);
  const Eigen::Vector3d forward = (c.look_at_mm - c.position_mm).normalized();
  c.up = Eigen::AngleAxisd(d.signed_size() * std::numbers::pi / 180.0, forward) * c.up;
}

void shift_marks(Rig& rig, const DeviationDraw& d) {
  const Eigen::Vector2d by = d.seed % 2 == 0 ? Eigen::Vector2d::UnitX() : Eigen::Vector2d::UnitY();
  for (PointPair& pair : rig.pose.points) pair.image_px += d.signed_size() * by;
}

// Changes the true lens, through which the marks were taken as well.
template <class Change>
auto true_lens(const Change& change) {
  return [change](TrueSetup& t, const DeviationDraw& d) {
    change(t.rig.scene.camera.intrinsics, d.signed_size());
    t.marks_by_true_camera = true;
  };
}

void move_second(std::vector<ColourFrame>& frames, const DeviationDraw& d) {
  for (std::vector<float>& plane : frames.back().counts) {
    const std::vector<float> old = plane;
    const double whole = std::floor(d.size);
    const auto part = static_cast<float>(d.size - whole);
    const auto shift = static_cast<std::size_t>(whole);
    for (std::size_t i = shift + 1; i < plane.size(); ++i) {
      plane[i] = (1.0F - part) * old[i - shift] + part * old[i - shift - 1];
    }
  }
}

void mirror(std::vector<ColourFrame>& frames, const DeviationDraw&) {
  for (ColourFrame& frame : frames) {
    for (std::vector<float>& plane : frame.counts) {
      for (int y = 0; y < frame.height_px; ++y) {
        const auto row = plane.begin() + static_cast<std::ptrdiff_t>(y) * frame.width_px;
        std::reverse(row, row + frame.width_px);
      }
    }
  }
}

template <class Filter>
auto each_frame(const Filter& filter) {
  return [filter](std::vector<ColourFrame>& frames, const DeviationDraw& d) {
    for (ColourFrame& frame : frames) filter(frame, d.size);
  };
}

std::vector<Deviation> poses() {
  return {
      {.name = "camera knocked",
       .words = kPoseWords,
       .unit = "mm",
       .sizes = {0.05, 0.5, 3},
       .within = 1,
       .truth = knock},
      {.name = "camera displaced",
       .words = kPoseWords,
       .unit = "mm",
       .sizes = {0.05, 0.5, 3},
       .within = 1,
       .truth = displace},
      {.name = "camera farther away",
       .words = kPoseWords,
       .unit = "mm",
       .sizes = {0.2, 2, 10},
       .within = 1,
       .truth = step_back},
      {.name = "camera rolled",
       .words = kPoseWords,
       .unit = "deg",
       .sizes = {0.1, 1, 5},
       .within = 1,
       .truth = roll},
      {.name = "marks shifted",
       .words = kPoseWords,
       .unit = "px",
       .sizes = {0.1, 1, 2, 5},
       .within = 1,
       .stated = shift_marks},
      {.name = "object moved between the shots",
       .words = {"shots", "disagree", "moved", "outline", "mesh", "place"},
       .unit = "px",
       .sizes = {0.2, 1, 5},
       .within = 1,
       .needs = {.two_leds = true},
       .frames = move_second},
      {.name = "picture mirrored", .words = kPoseWords, .unit = "", .sizes = {1}, .frames = mirror},
  };
}

}  // namespace

std::vector<Deviation> camera_deviations() {
  std::vector<Deviation> out = poses();
  const std::vector<Deviation> lenses = {
      {.name = "focal length off",
       .words = kLensWords,
       .unit = "%",
       .sizes = {0.2, 1, 5},
       .within = 1,
       .truth = true_lens([](CameraIntrinsics& k, double size) {
         k.fx_px *= 1.0 + 0.01 * size;
         k.fy_px *= 1.0 + 0.01 * size;
       })},
      {.name = "principal point off",
       .words = kLensWords,
       .unit = "% of width",
       .sizes = {0.2, 1, 5},
       .within = 1,
       .truth = true_lens(
           [](CameraIntrinsics& k, double size) { k.cx_px += 0.01 * size * k.width_px; })},
      {.name = "lens distortion off",
       .words = kLensWords,
       .unit = "of k1",
       .sizes = {0.01, 0.1, 0.5},
       .within = 1,
       .truth =
           true_lens([](CameraIntrinsics& k, double size) { k.distortion[0] += std::abs(size); })},
      {.name = "pixels not square",
       .words = kLensWords,
       .unit = "%",
       .sizes = {0.1, 1, 5},
       .within = 1,
       .truth = true_lens([](CameraIntrinsics& k, double size) { k.fy_px *= 1.0 + 0.01 * size; })},
      {.name = "out of focus",
       .words = kSharpnessWords,
       .unit = "px",
       .sizes = {0.4, 1.5, 5},
       .within = 1,
       .frames = each_frame([](ColourFrame& frame, double size) { blur(frame, size); })},
      {.name = "motion blur",
       .words = kSharpnessWords,
       .unit = "px",
       .sizes = {0.7, 4, 15},
       .within = 1,
       .frames = each_frame([](ColourFrame& frame, double size) { smear(frame, size); })},
  };
  out.insert(out.end(), lenses.begin(), lenses.end());
  return out;
}

}  // namespace scattermeter::apps
