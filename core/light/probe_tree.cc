#include "core/light/probe_tree.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <oneapi/tbb/parallel_for.h>

namespace scattermeter {
namespace {

// At most this many bright pixels are kept separately.
constexpr std::size_t kMostBright = 4096;
// A bright pixel's radiance exceeds the mean of the whole by this factor.
constexpr double kBrighter = 4.0;

Environment checked(Environment environment) {
  if (const std::string problem =
          probe_problem(environment.width_px, environment.height_px, environment.radiance);
      !problem.empty()) {
    throw std::invalid_argument("ProbeTree: " + problem);
  }
  return environment;
}

}  // namespace

ProbeTree::ProbeTree(Environment environment) : ProbeTree(std::move(environment), Options()) {}

ProbeTree::ProbeTree(Environment environment, const Options& options)
    : environment_(checked(std::move(environment))),
      map_(environment_.projection, environment_.width_px, environment_.height_px),
      is_even_(std::equal(environment_.radiance.begin() + 3, environment_.radiance.end(),
                          environment_.radiance.begin())),
      is_linear_(is_even_ || options.is_linear) {
  find_bright(options.bright_share);
  build();
}

bool ProbeTree::is_bright(int x, int y) const {
  return !bright_by_pixel_.empty() &&
         bright_by_pixel_[static_cast<std::size_t>(y) *
                              static_cast<std::size_t>(environment_.width_px) +
                          static_cast<std::size_t>(x)];
}

ImageRect ProbeTree::rect(const ProbeCell& cell) const {
  const double size = std::ldexp(1.0, cell.level);
  const double w = environment_.width_px;
  const double h = environment_.height_px;
  return {std::min(cell.x * size, w), std::min(cell.y * size, h), std::min((cell.x + 1) * size, w),
          std::min((cell.y + 1) * size, h)};
}

ProbeLight ProbeTree::pixel(const ProbeCell& cell) const {
  const int x = cell.x >> -cell.level;
  const int y = cell.y >> -cell.level;
  ProbeLight light;
  if (x >= environment_.width_px || y >= environment_.height_px) return light;
  const float* l = &environment_.radiance[3 * (static_cast<std::size_t>(y) *
                                                   static_cast<std::size_t>(environment_.width_px) +
                                               static_cast<std::size_t>(x))];
  if (l[0] == 0.0F && l[1] == 0.0F && l[2] == 0.0F) return light;
  const ImageRect r = rect(cell);
  light.flux = map_.solid_angle_sr(r) * Eigen::Array3d(l[0], l[1], l[2]);
  light.first = map_.mean_direction(r) * light.flux.matrix().transpose();
  return light;
}

ProbeLight ProbeTree::sky(const ProbeCell& cell) const {
  if (cell.level <= 0) {
    if (is_bright(cell.x >> -cell.level, cell.y >> -cell.level)) return {};
    return pixel(cell);
  }
  const Level& level = levels_[static_cast<std::size_t>(cell.level - 1)];
  ProbeLight light;
  if (cell.x >= level.width || cell.y >= level.height) return light;
  const Node& node =
      level.nodes[static_cast<std::size_t>(cell.y) * static_cast<std::size_t>(level.width) +
                  static_cast<std::size_t>(cell.x)];
  light.flux = Eigen::Map<const Eigen::Array3f>(node.flux.data()).cast<double>();
  light.first = Eigen::Map<const Eigen::Matrix3f>(node.first.data()).cast<double>();
  return light;
}

void ProbeTree::find_bright(double share) {
  const int width = environment_.width_px;
  const int height = environment_.height_px;
  const auto columns = static_cast<std::size_t>(width);
  std::vector<Eigen::Array3f> flux(columns * static_cast<std::size_t>(height));
  tbb::parallel_for(0, height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * columns + static_cast<std::size_t>(x);
      const double sr = map_.solid_angle_sr(rect({0, x, y}));
      flux[i] =
          static_cast<float>(sr) * Eigen::Map<const Eigen::Array3f>(&environment_.radiance[3 * i]);
    }
  });
  Eigen::Array3d total = Eigen::Array3d::Zero();
  for (const Eigen::Array3f& f : flux) total += f.cast<double>();
  // The brightest first, by the channel in which a pixel is most of the whole.
  const Eigen::Array3f one_over_total =
      (total > 0.0).select(1.0 / total, Eigen::Array3d::Zero()).cast<float>();
  std::vector<std::pair<float, std::size_t>> order(flux.size());
  for (std::size_t i = 0; i < flux.size(); ++i) {
    order[i] = {-(flux[i] * one_over_total).maxCoeff(), i};
  }
  const std::size_t most = std::min(kMostBright, order.size());
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(most), order.end());
  Eigen::Array3d rest = total;
  std::vector<std::size_t> bright;
  for (std::size_t i = 0; i < most; ++i) {
    const Eigen::Array3d f = flux[order[i].second].cast<double>();
    if (!(f > share * (rest - f).max(0.0)).any()) break;
    // In a picture of few pixels each is a large share; that alone makes none bright.
    const Eigen::Array3d radiance =
        Eigen::Map<const Eigen::Array3f>(&environment_.radiance[3 * order[i].second])
            .cast<double>();
    if (!(radiance > kBrighter * total / (4.0 * std::numbers::pi)).any()) continue;
    rest -= f;
    bright.push_back(order[i].second);
  }
  if (bright.empty()) return;
  std::sort(bright.begin(), bright.end());
  bright_by_pixel_.assign(flux.size(), false);
  for (const std::size_t i : bright) {
    bright_by_pixel_[i] = true;
    bright_.push_back({0, static_cast<int>(i % columns), static_cast<int>(i / columns)});
    bright_flux_ += pixel(bright_.back()).flux;
  }
}

void ProbeTree::build() {
  int width = environment_.width_px;
  int height = environment_.height_px;
  do {
    width = (width + 1) / 2;
    height = (height + 1) / 2;
    Level level{width, height, {}};
    level.nodes.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    const int number = static_cast<int>(levels_.size()) + 1;
    tbb::parallel_for(0, height, [&](int y) {
      for (int x = 0; x < width; ++x) {
        ProbeLight sum;
        for (const ProbeCell& child : children({number, x, y})) sum += sky(child);
        Node& node = level.nodes[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                                 static_cast<std::size_t>(x)];
        Eigen::Map<Eigen::Array3f>(node.flux.data()) = sum.flux.cast<float>();
        Eigen::Map<Eigen::Matrix3f>(node.first.data()) = sum.first.cast<float>();
      }
    });
    levels_.push_back(std::move(level));
  } while (width > 1 || height > 1);
  sky_flux_ = sky(root()).flux;
}

}  // namespace scattermeter
