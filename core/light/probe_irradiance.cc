#include "core/light/probe_irradiance.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/light/visible_share.h"

namespace scattermeter {
namespace {

// Cells wider than the picture / 64 (5.6 degrees) are always subdivided before their visibility is
// judged.
constexpr int kProbesAcross = 64;
// Corners of the occluding mesh are considered only if there are at most this many.
constexpr std::size_t kMostCorners = 256;
// Cells and pixels are cut for the sum over open sky until flux times angular variance falls below
// this times the tolerance and the flux of all. Measured:
// tests/core/light/probe_irradiance_test.cc.
constexpr double kSpread = 5e-4;
// On the horizon, where cos * Ft has a kink, flux times angular radius.
constexpr double kHorizonSpread = 2e-3;
// An edge of shadow runs straight through cells of this share of the tolerance. The error of one is
// some 0.035 of its energy and differs from cell to cell; a horizon's worth of cells has 400.
constexpr double kEdgeShare = 1.0;
// A pixel is cut at most into 2^n parts across.
constexpr int kPixelCuts = 5;
constexpr int kSumCuts = 8;
// Directions below the horizon are tested just above it.
constexpr double kLowestCosine = 1e-3;
constexpr std::size_t kMostLattice = 2'000'000;

}  // namespace

struct SkyEmitter {
  using Cell = ProbeCell;
  ProbeIrradiance& p;
  Eigen::Array3d energy(const Cell& c) { return p.sky_energy(c); }
  ImageRect rect(const Cell& c) const { return p.tree_.rect(c); }
  std::array<Cell, 4> children(const Cell& c) const { return scattermeter::children(c); }
  bool wide(const Cell& c) const { return c.level > p.wide_level_; }
  bool last(const Cell& c, const Eigen::Array3d& energy) const {
    return c.level <= -kPixelCuts || p.dim(energy);
  }
  bool visible(double x, double y) { return p.visible(x, y); }
};

struct BrightEmitter : SkyEmitter {
  std::size_t pixel = 0;
  Eigen::Array3d energy(const Cell& c) {
    return c.level == 0 ? p.bright_energy_[pixel] : p.cut_energy(c, true, kSumCuts);
  }
};

ProbeIrradiance::ProbeIrradiance(const ProbeTree& tree, const RayScene* scene,
                                 const TransmittedCosine& transmitted, double tolerance)
    : tree_(tree),
      scene_(scene),
      transmitted_(transmitted),
      tolerance_(tolerance),
      world_from_probe_(tree.environment().world_from_probe) {
  const int across = std::max(tree.map().width_px(), tree.map().height_px());
  wide_level_ =
      static_cast<int>(std::floor(std::log2(static_cast<double>(across) / kProbesAcross)));
  const int levels = tree.root().level;
  for (int level = 1; level <= levels; ++level) {
    const auto w = static_cast<std::size_t>((tree.map().width_px() >> level) + 1);
    const auto h = static_cast<std::size_t>((tree.map().height_px() >> level) + 1);
    known_.emplace_back(w * h);
  }
  shift_ = 0;
  const auto lattice_size = [&] {
    lattice_width_ = static_cast<std::size_t>((tree.map().width_px() >> shift_) + 1);
    return lattice_width_ * static_cast<std::size_t>((tree.map().height_px() >> shift_) + 1);
  };
  while (lattice_size() > kMostLattice) ++shift_;
  lattice_.assign(lattice_size(), 0U);
  if (tree_.is_linear()) find_linear_sky();
}

void ProbeIrradiance::set_facet(const Eigen::Vector3d& normal,
                                std::vector<Eigen::Vector3d> in_front_mm) {
  normal_ = normal;
  normal_in_probe_ = world_from_probe_.conjugate() * normal;
  in_front_mm_ = std::move(in_front_mm);
  ++facet_;
  open_bright_.setZero();
  bright_energy_.clear();
  for (const ProbeCell& pixel : tree_.bright()) {
    bright_energy_.push_back(cut_energy(pixel, true, kSumCuts));
    open_bright_ += bright_energy_.back();
  }
  open_sky_ = linear_sky_ ? (linear_sky_->level + (linear_sky_->per_normal * normal).array()).eval()
                          : sky_energy(tree_.root());
}

// From the facets towards the axes and away from them.
void ProbeIrradiance::find_linear_sky() {
  LinearSky found;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d axis = Eigen::Vector3d::Unit(k);
    set_facet(axis, {});
    const Eigen::Array3d towards = open_sky_;
    set_facet(-axis, {});
    found.level += (towards + open_sky_) / 6.0;
    if (!tree_.is_even()) found.per_normal.col(k) = 0.5 * (towards - open_sky_).matrix();
  }
  linear_sky_ = found;
}

// Light of a small cell: its directions' cosines are spread about the mean by the standard
// deviation s; two points at +- s have the same mean and variance.
Eigen::Array3d ProbeIrradiance::arriving(const ProbeLight& light) const {
  Eigen::Array3d out = Eigen::Array3d::Zero();
  for (int c = 0; c < 3; ++c) {
    const double flux = light.flux[c];
    if (!(flux > 0.0)) continue;
    const Eigen::Vector3d mean = light.first.col(c) / flux;
    const double cosine = normal_in_probe_.dot(mean);
    const double variance = std::max(0.0, 1.0 - mean.squaredNorm());
    const double s = std::sqrt(0.5 * variance * std::max(0.0, 1.0 - cosine * cosine));
    out[c] = 0.5 * flux * (transmitted_(cosine - s) + transmitted_(cosine + s));
  }
  return out;
}

bool ProbeIrradiance::is_fine(const ProbeLight& light, bool bright) const {
  const Eigen::Array3d all = tree_.sky_flux() + (bright ? tree_.bright_flux() : tree_.sky_flux());
  for (int c = 0; c < 3; ++c) {
    const double flux = light.flux[c];
    if (!(flux > 0.0)) continue;
    const Eigen::Vector3d mean = light.first.col(c) / flux;
    // Rounding of the stored sums leaves a variance of 1e-7 to a single direction.
    const double variance = std::max(0.0, 1.0 - mean.squaredNorm());
    // A ball's rim spreads one-sidedly, 2.83 deviations far. (What lies behind is held to the same:
    // a cell's mean may be behind the horizon and a small part of its light before it.)
    const double radius = 3.0 * std::sqrt(variance);
    const double cosine = normal_in_probe_.dot(mean);
    if (flux * variance > kSpread * tolerance_ * all[c]) return false;
    if (std::abs(cosine) < radius && flux * radius > kHorizonSpread * tolerance_ * all[c])
      return false;
  }
  return true;
}

Eigen::Array3d ProbeIrradiance::cut_energy(const ProbeCell& cell, bool bright, int cuts) const {
  const ProbeLight light = bright ? tree_.pixel(cell) : tree_.sky(cell);
  if (cuts == 0 || is_fine(light, bright)) return arriving(light);
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  for (const ProbeCell& child : children(cell)) sum += cut_energy(child, bright, cuts - 1);
  return sum;
}

Eigen::Array3d ProbeIrradiance::sky_energy(const ProbeCell& cell) {
  if (cell.level <= 0) return cut_energy(cell, false, kSumCuts);
  const ImageRect r = tree_.rect(cell);
  if (!(r.x1 > r.x0) || !(r.y1 > r.y0)) return Eigen::Array3d::Zero();
  const auto width = static_cast<std::size_t>((tree_.map().width_px() >> cell.level) + 1);
  Known& known =
      known_[static_cast<std::size_t>(cell.level - 1)]
            [static_cast<std::size_t>(cell.y) * width + static_cast<std::size_t>(cell.x)];
  if (known.facet == facet_) return known.energy.cast<double>();
  const ProbeLight light = tree_.sky(cell);
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  if (is_fine(light, false)) {
    sum = arriving(light);
  } else {
    for (const ProbeCell& child : children(cell)) sum += sky_energy(child);
  }
  known.facet = facet_;
  known.energy = sum.cast<float>();
  return sum;
}

bool ProbeIrradiance::dim(const Eigen::Array3d& energy) const {
  return (energy <= kEdgeShare * tolerance_ * (open_sky_ + open_bright_)).all();
}

bool ProbeIrradiance::trace(double x_px, double y_px) {
  Eigen::Vector3d w = world_from_probe_ * tree_.map().direction(x_px, y_px);
  const double cosine = w.dot(normal_);
  if (cosine < kLowestCosine) {
    w = (w + (kLowestCosine - cosine) * normal_).eval();
    if (!(w.squaredNorm() > 1e-4)) w = normal_;  // straight down
  }
  ++rays_;
  return !scene_->occluded_toward(point_mm_, normal_, w);
}

bool ProbeIrradiance::visible(double x_px, double y_px) {
  const double at_x = std::ldexp(x_px, -shift_);
  const double at_y = std::ldexp(y_px, -shift_);
  if (at_x != std::floor(at_x) || at_y != std::floor(at_y)) return trace(x_px, y_px);
  std::uint32_t& known =
      lattice_[static_cast<std::size_t>(at_y) * lattice_width_ + static_cast<std::size_t>(at_x)];
  if (known / 2 != point_) known = 2 * point_ + (trace(x_px, y_px) ? 1U : 0U);
  return (known & 1U) != 0U;
}

Eigen::Array3d ProbeIrradiance::at(const Eigen::Vector3d& point_mm, Part part) {
  if (in_front_mm_.empty()) return open(part);
  if ((open(part) == 0.0).all()) return Eigen::Array3d::Zero();
  if (++point_ == 1U << 31U) {
    std::fill(lattice_.begin(), lattice_.end(), 0U);
    point_ = 1;
  }
  point_mm_ = point_mm;
  std::vector<Eigen::Vector2d> corners;
  if (in_front_mm_.size() <= kMostCorners) {
    for (const Eigen::Vector3d& v : in_front_mm_) {
      corners.push_back(tree_.map().position_px(world_from_probe_.conjugate() * (v - point_mm)));
    }
  }
  if (part == Part::kSky) {
    SkyEmitter emitter{*this};
    return VisibleShare(emitter).sum(tree_.root(), corners);
  }
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  BrightEmitter emitter{{*this}};
  for (std::size_t i = 0; i < tree_.bright().size(); ++i) {
    emitter.pixel = i;
    sum += VisibleShare(emitter).sum(tree_.bright()[i], corners);
  }
  return sum;
}

}  // namespace scattermeter
