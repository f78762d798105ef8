// The visible part of an extended light as seen from a point.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "core/light/image_rect.h"

namespace scattermeter {

// Sums the light of the visible parts of an emitter. The emitter is a quadtree over a picture of
// itself; Emitter provides
//   Cell                              a square of the picture
//   Eigen::Array3d energy(cell)       what the cell would contribute if it were seen
//   ImageRect rect(cell)
//   std::array<Cell, 4> children(cell)
//   bool wide(cell)                   too wide to be judged from its corners and centre
//   bool last(cell, energy)           too small or too dim to be cut further
//   bool visible(x, y)                whether the point sees that position in the picture
// A cell whose corners and centre agree, and which contains none of the given positions, counts as
// wholly visible or wholly hidden; others are subdivided. In a cell that is not subdivided the edge
// is taken as straight between its crossings with the cell's sides, which are located to an eighth
// of a side.
template <class Emitter>
class VisibleShare {
 public:
  using Cell = typename Emitter::Cell;
  using Positions = std::vector<Eigen::Vector2d>;

  explicit VisibleShare(Emitter& emitter) : emitter_(emitter) {}

  // `corners`: positions in the picture at which the edge of the visible part may have a corner, so
  // that a tip that reaches between the probes is not missed.
  Eigen::Array3d sum(const Cell& cell, const Positions& corners) {
    const Eigen::Array3d energy = emitter_.energy(cell);
    if ((energy == 0.0).all()) return energy;
    const ImageRect r = emitter_.rect(cell);
    Positions inside;
    for (const Eigen::Vector2d& p : corners) {
      if (p.x() > r.x0 && p.x() < r.x1 && p.y() > r.y0 && p.y() < r.y1) inside.push_back(p);
    }
    const bool last = emitter_.last(cell, energy);
    if (!last && emitter_.wide(cell)) return sum_children(cell, inside);
    const std::array<bool, 4> seen = {emitter_.visible(r.x0, r.y0), emitter_.visible(r.x1, r.y0),
                                      emitter_.visible(r.x1, r.y1), emitter_.visible(r.x0, r.y1)};
    const int n = seen[0] + seen[1] + seen[2] + seen[3];
    if (inside.empty() && (n == 0 || n == 4) &&
        emitter_.visible(0.5 * (r.x0 + r.x1), 0.5 * (r.y0 + r.y1)) == seen[0]) {
      return seen[0] ? energy : Eigen::Array3d::Zero();
    }
    if (!last) return sum_children(cell, inside);
    return share(r, seen, n) * energy;
  }

 private:
  Eigen::Array3d sum_children(const Cell& cell, const Positions& corners) {
    Eigen::Array3d total = Eigen::Array3d::Zero();
    for (const Cell& child : emitter_.children(cell)) total += sum(child, corners);
    return total;
  }

  // Corners in the order (x0, y0), (x1, y0), (x1, y1), (x0, y1).
  double share(const ImageRect& r, const std::array<bool, 4>& seen, int n) {
    if (n == 0 || n == 4 || (n == 2 && seen[0] == seen[2])) return counted(r);
    const std::array<Eigen::Vector2d, 4> at = {
        {{r.x0, r.y0}, {r.x1, r.y0}, {r.x1, r.y1}, {r.x0, r.y1}}};
    if (n == 2) {
      // A trapezoid on the side between the two seen corners, p and the next.
      int p = 0;
      while (!seen[p] || !seen[(p + 1) % 4]) ++p;
      return 0.5 * (crossing(at[p], at[(p + 3) % 4], true) +
                    crossing(at[(p + 1) % 4], at[(p + 2) % 4], true));
    }
    // A triangle at the odd corner.
    int odd = 0;
    while (seen[odd] != (n == 1)) ++odd;
    const double triangle = 0.5 * crossing(at[odd], at[(odd + 1) % 4], seen[odd]) *
                            crossing(at[odd], at[(odd + 3) % 4], seen[odd]);
    return n == 1 ? triangle : 1.0 - triangle;
  }

  // Where between a (0) and b (1) the visibility changes; `seen`: that at a.
  double crossing(const Eigen::Vector2d& a, const Eigen::Vector2d& b, bool seen) {
    double lo = 0.0;
    double hi = 1.0;
    for (int i = 0; i < 3; ++i) {
      const double middle = 0.5 * (lo + hi);
      const Eigen::Vector2d p = a + middle * (b - a);
      (emitter_.visible(p.x(), p.y()) == seen ? lo : hi) = middle;
    }
    return 0.5 * (lo + hi);
  }

  double counted(const ImageRect& r) {
    constexpr int kSide = 4;
    int seen = 0;
    for (int i = 0; i < kSide; ++i) {
      for (int j = 0; j < kSide; ++j) {
        seen += emitter_.visible(r.x0 + (i + 0.5) / kSide * (r.x1 - r.x0),
                                 r.y0 + (j + 0.5) / kSide * (r.y1 - r.y0))
                    ? 1
                    : 0;
      }
    }
    return static_cast<double>(seen) / (kSide * kSide);
  }

  Emitter& emitter_;
};

}  // namespace scattermeter
