// A quadtree over the picture of a light probe.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "core/light/environment.h"
#include "core/light/image_rect.h"

namespace scattermeter {

// A square of the picture, 2^level pixels wide: at level 0 one pixel, below that a part of one.
struct ProbeCell {
  int level = 0;
  int x = 0;  // in widths of a cell
  int y = 0;
};

// The light of a cell, per channel: its integral over the cell's solid angle, and that of radiance
// times direction (in the probe's frame).
struct ProbeLight {
  Eigen::Array3d flux = Eigen::Array3d::Zero();
  Eigen::Matrix3d first = Eigen::Matrix3d::Zero();  // columns: channels

  ProbeLight& operator+=(const ProbeLight& o) {
    flux += o.flux;
    first += o.first;
    return *this;
  }
};

// Pixels so bright that each outshines a share of all the rest (the sun, a lamp) are kept
// separately: they cast shadow edges that are worth finding one by one. The remaining pixels are
// the sky.
class ProbeTree {
 public:
  struct Options {
    // A pixel is bright when its flux, in any channel, exceeds this share of the flux of all pixels
    // that are not bright, and its radiance four times the mean.
    double bright_share = 3e-3;
    // The radiance is a constant plus a multiple of the direction's cosine to an axis, in each
    // channel: what an open facet receives is linear in its normal.
    bool is_linear = false;
  };
  // Throws std::invalid_argument unless probe_problem() is empty.
  explicit ProbeTree(Environment environment);
  ProbeTree(Environment environment, const Options& options);

  const Environment& environment() const { return environment_; }
  const ProbeMap& map() const { return map_; }
  // The whole picture: one cell.
  ProbeCell root() const { return {static_cast<int>(levels_.size()), 0, 0}; }
  const std::vector<ProbeCell>& bright() const { return bright_; }
  // Flux from the whole sphere, W/mm^2 per unit of the probe, of sky and bright pixels.
  const Eigen::Array3d& sky_flux() const { return sky_flux_; }
  const Eigen::Array3d& bright_flux() const { return bright_flux_; }
  // Whether every direction has the same radiance.
  bool is_even() const { return is_even_; }
  // As the options say, or even.
  bool is_linear() const { return is_linear_; }

  // The rectangle of the picture that a cell covers; empty if the cell lies outside the picture.
  ImageRect rect(const ProbeCell& cell) const;
  // Light of the sky in a cell of any level, also <= 0.
  ProbeLight sky(const ProbeCell& cell) const;
  // Light of a bright pixel, or of a part of one: level <= 0.
  ProbeLight pixel(const ProbeCell& cell) const;

 private:
  struct Node {
    std::array<float, 3> flux;
    std::array<float, 9> first;
  };
  struct Level {
    int width;
    int height;
    std::vector<Node> nodes;
  };
  void find_bright(double share);
  void build();
  bool is_bright(int x, int y) const;

  Environment environment_;
  ProbeMap map_;
  bool is_even_, is_linear_;
  std::vector<ProbeCell> bright_;      // by row, then column
  std::vector<bool> bright_by_pixel_;  // empty: none is
  std::vector<Level> levels_;          // level 1 first
  Eigen::Array3d sky_flux_ = Eigen::Array3d::Zero();
  Eigen::Array3d bright_flux_ = Eigen::Array3d::Zero();
};

inline std::array<ProbeCell, 4> children(const ProbeCell& c) {
  return {{{c.level - 1, 2 * c.x, 2 * c.y},
           {c.level - 1, 2 * c.x + 1, 2 * c.y},
           {c.level - 1, 2 * c.x, 2 * c.y + 1},
           {c.level - 1, 2 * c.x + 1, 2 * c.y + 1}}};
}

}  // namespace scattermeter
