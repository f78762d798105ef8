#include "apps/looks/other_size.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <fmt/core.h>
#include <oneapi/tbb/parallel_for.h>

#include "calib/pose/outline_contour.h"
#include "calib/pose/outline_look.h"
#include "calib/pose/outline_model.h"

namespace scattermeter::apps {
namespace {

constexpr double kOfItsSize = 0.9;
constexpr double kAsWell = 0.02;
constexpr double kOfThisSize = 0.05;
constexpr double kStep = 0.03;  // of the logarithm of the size
constexpr int kSteps = 23;      // to each side

// An object of `size` times its mesh, about its centre, looks as its mesh does from here.
PoseResult with_size(PoseResult pose, const Eigen::Vector3d& center_mm, double size) {
  Rigid3d& p = pose.camera_from_world;
  p.translation_mm = ((1.0 - size) * (p.rotation * center_mm) + p.translation_mm) / size;
  return pose;
}

}  // namespace

std::optional<Finding> other_size(const ObjectScene& object, const CameraIntrinsics& intrinsics,
                                  const PoseResult& pose, const capture::RawFrame& frame,
                                  const SensorNoise& noise) {
  const Eigen::Vector3d center_mm = object.box.center_mm();
  std::vector<double> share(2 * kSteps + 1, 0.0);
  const auto size_of = [](std::size_t i) {
    return std::exp(kStep * (static_cast<double>(i) - kSteps));
  };
  tbb::parallel_for(std::size_t{0}, share.size(), [&](std::size_t i) {
    const PoseResult seen_from = with_size(pose, center_mm, size_of(i));
    const auto contour =
        calib::contour_points(*object.rays, intrinsics, seen_from.camera_from_world,
                              calib::outline_cell_px(intrinsics.width_px));
    share[i] = calib::outline_share(calib::look_at_outline(contour, frame, noise), contour,
                                    intrinsics, seen_from, center_mm);
  });
  const double best = *std::max_element(share.begin(), share.end());
  // The middle of those that fit as well.
  double sum = 0.0, n = 0.0;
  for (std::size_t i = 0; i < share.size(); ++i) {
    if (share[i] < best - kAsWell) continue;
    sum += std::log(size_of(i));
    n += 1.0;
  }
  const double size = std::exp(sum / n);
  if (best < kOfItsSize || std::abs(std::log(size)) < kOfThisSize) return std::nullopt;
  const std::string& name = object.stated->name;
  return Finding{
      "mesh scaled",
      fmt::format("mesh scaled: {} has the outline of a body about {:.2g} times the size of "
                  "its mesh ({:.0f} % of it fits)",
                  name, size, 100.0 * best),
      fmt::format("measure the object, and scale the mesh of objects.{} or state that "
                  "of the object",
                  name),
      {}};
}

}  // namespace scattermeter::apps
