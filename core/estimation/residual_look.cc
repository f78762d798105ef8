#include "core/estimation/residual_look.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/core.h>

#include "core/base/dense_solve.h"
#include "core/base/position_cells.h"

namespace scattermeter {
namespace {

constexpr double kLeastShare = 0.3;
constexpr double kLeastImage = 1e-3;
constexpr double kLeastChi2 = 50.0;
// The share of the rows that spots cover at most, and the mean square that noise alone leaves in so
// many of the farthest rows, in standard deviations (of a normal distribution: 7.2).
constexpr double kMostSpots = 0.02;
constexpr double kSpotByNoise = 7.2;

// The used rows of all shots.
struct LookedAt {
  Eigen::VectorXd rest, predicted, std_l;
  Eigen::VectorXd right, down;  // of the image's middle, in half its extent
  Eigen::VectorXd off_axis;     // squared tangent of the angle to the optical axis, about its mean
  std::vector<std::size_t> shot;
  std::vector<Eigen::Vector3d> center_mm;
  std::vector<Eigen::Vector3d> normal;
  std::vector<bool> beside_edge;  // some of the patch's samples are left out beside an edge
};

LookedAt look_at(const std::vector<ShotRows>& rows, const MaterialChannel& channel) {
  LookedAt out;
  std::vector<std::array<double, 5>> list;
  for (std::size_t s = 0; s < rows.size(); ++s) {
    const ShotRows& r = rows[s];
    const SeenObject& seen = *channel.shots[s]->seen;
    for (std::size_t j = 0; j < r.observed.size(); ++j) {
      if (r.state[j] != RowState::kUsed || !(r.std[j] > 0.0F)) continue;
      const Eigen::Vector2d at =
          (channel.shots[s]->pose.camera_from_world * seen.sites[j].center_mm).hnormalized();
      list.push_back(
          {double{r.observed[j]} - r.predicted[j], r.predicted[j], r.std[j], at.x(), at.y()});
      out.shot.push_back(s);
      out.center_mm.push_back(seen.sites[j].center_mm);
      out.normal.push_back(seen.patches->normal(seen.map.patch_of_row[j]));
      out.beside_edge.push_back(seen.map.guarded_of_row[j] > 0);
    }
  }
  const auto n = static_cast<Eigen::Index>(list.size());
  const auto column = [&](std::size_t k) -> Eigen::VectorXd {
    return Eigen::VectorXd::NullaryExpr(
        n, [&](Eigen::Index i) { return list[static_cast<std::size_t>(i)][k]; });
  };
  const auto centred = [](const Eigen::VectorXd& v) -> Eigen::VectorXd {
    if (v.size() == 0) return v;
    const double half = 0.5 * (v.maxCoeff() - v.minCoeff());
    return (v.array() - 0.5 * (v.maxCoeff() + v.minCoeff())) / std::max(half, 1e-300);
  };
  out.rest = column(0);
  out.predicted = column(1);
  out.std_l = column(2);
  out.right = centred(column(3));
  out.down = centred(column(4));
  out.off_axis = column(3).cwiseAbs2() + column(4).cwiseAbs2();
  if (n > 0) out.off_axis.array() -= out.off_axis.mean();
  return out;
}

std::string brighter(double relative) {
  return fmt::format("{:.2g} % {} than predicted", 100.0 * std::abs(relative),
                     relative < 0.0 ? "darker" : "brighter");
}

// Keeps the pattern that explains most.
class BestPattern {
 public:
  explicit BestPattern(const LookedAt& image)
      : image_(image), unexplained_(whitened(image.rest).squaredNorm() - count()) {}

  // columns: changes of l; phrase: of their coefficients.
  template <class Phrase>
  void offer(const Eigen::MatrixXd& columns, const Phrase& phrase) {
    const Eigen::MatrixXd b = image_.std_l.cwiseInverse().asDiagonal() * columns;
    const Eigen::VectorXd score = b.transpose() * whitened(image_.rest);
    const Eigen::VectorXd x = SymmetricSolver(Eigen::MatrixXd(b.transpose() * b)).solve(score);
    keep(score.dot(x) - static_cast<double>(columns.cols()), (columns * x).norm(),
         [&] { return phrase(x); });
  }

  // The few rows that are farthest off; phrase: of their number.
  template <class Phrase>
  void offer_spots(const Phrase& phrase) {
    const Eigen::VectorXd off = whitened(image_.rest).cwiseAbs2();
    const auto n = static_cast<std::size_t>(std::max(1.0, kMostSpots * count()));
    std::vector<Eigen::Index> rows(static_cast<std::size_t>(off.size()));
    std::iota(rows.begin(), rows.end(), 0);
    const auto end = rows.begin() + static_cast<std::ptrdiff_t>(n);
    std::nth_element(rows.begin(), end, rows.end(),
                     [&](Eigen::Index a, Eigen::Index b) { return off[a] > off[b]; });
    rows.resize(n);
    const double gain = off(rows).sum() - kSpotByNoise * static_cast<double>(n);
    keep(gain, image_.rest(rows).norm(), [&] { return phrase(n); });
  }

  // What is left where no pattern is: each row on its own, so that means over neighbours are as
  // small as those of independent rows.
  void offer_scatter() {
    constexpr double kLeastOfNoise = 0.5, kMostCommon = 1.5;
    if (best_ || !(unexplained_ > kLeastOfNoise * count())) return;
    const Eigen::VectorXd off = whitened(image_.rest);
    // Of neighbours on the surface, each shot on its own.
    constexpr int kMostLevels = 12, kLeastNeighbours = 6;
    std::vector<int> cell = position_cells(image_.center_mm, kMostLevels, kLeastNeighbours);
    const int cells = *std::max_element(cell.begin(), cell.end()) + 1;
    for (std::size_t i = 0; i < cell.size(); ++i)
      cell[i] += static_cast<int>(image_.shot[i]) * cells;
    const CellSquares common = squares_of_sums(cell, off);
    if (common.squares > kMostCommon * off.squaredNorm() * common.cells / count()) return;
    keep(unexplained_, image_.rest.norm(), [] {
      return std::string(
          "scatter from patch to patch: more noise than the camera's file states, or hot pixels");
    });
  }

  std::optional<ResidualLook> take() { return std::move(best_); }

 private:
  // gain: of chi-square; change: of l, its norm.
  template <class Phrase>
  void keep(double gain, double change, const Phrase& phrase) {
    const double share = gain / std::max(unexplained_, gain);
    if (!(gain > kLeastChi2) || !(share > kLeastShare)) return;
    if (!(change > kLeastImage * image_.predicted.norm())) return;
    if (best_ && best_->share >= share) return;
    best_ = {phrase(), share};
  }
  double count() const { return static_cast<double>(image_.rest.size()); }
  Eigen::VectorXd whitened(const Eigen::VectorXd& v) const { return v.cwiseQuotient(image_.std_l); }
  const LookedAt& image_;
  double unexplained_;
  std::optional<ResidualLook> best_;
};

// The predicted light of the rows for which `is_one` holds, 0 elsewhere.
template <class IsOne>
Eigen::VectorXd part_of(const LookedAt& image, const IsOne& is_one) {
  return Eigen::VectorXd::NullaryExpr(image.rest.size(), [&](Eigen::Index i) {
    return is_one(static_cast<std::size_t>(i)) ? image.predicted[i] : 0.0;
  });
}

// The directions of a body's faces; empty for a round body.
std::vector<Eigen::Vector3d> faces(const std::vector<Eigen::Vector3d>& normals) {
  constexpr double kSameFace = 0.99;
  constexpr std::size_t kMostFaces = 12;
  std::vector<Eigen::Vector3d> out;
  for (const Eigen::Vector3d& n : normals) {
    if (std::any_of(out.begin(), out.end(),
                    [&](const Eigen::Vector3d& f) { return f.dot(n) > kSameFace; })) {
      continue;
    }
    if (out.size() == kMostFaces) return {};
    out.push_back(n);
  }
  return out;
}

}  // namespace

std::optional<ResidualLook> residual_look(const std::vector<ShotRows>& rows,
                                          const MaterialChannel& channel) {
  const LookedAt image = look_at(rows, channel);
  constexpr Eigen::Index kLeastRows = 50;
  if (image.rest.size() < kLeastRows) return std::nullopt;
  BestPattern best(image);
  best.offer(Eigen::VectorXd::Ones(image.rest.size()), [&](const Eigen::VectorXd& x) {
    return fmt::format("an equal amount of light everywhere, {:.2g} % of the mean, {}",
                       100.0 * std::abs(x[0]) / image.predicted.mean(),
                       x[0] < 0.0 ? "too little" : "too much");
  });
  Eigen::MatrixXd across(image.rest.size(), 2);
  across << image.predicted.cwiseProduct(image.right), image.predicted.cwiseProduct(image.down);
  best.offer(across, [](const Eigen::VectorXd& x) {
    const bool is_across = std::abs(x[0]) > std::abs(x[1]);
    const char* side =
        is_across ? (x[0] > 0.0 ? "right" : "left") : (x[1] > 0.0 ? "lower side" : "upper side");
    return fmt::format(
        "a gradient over the image: towards the {} {}, as by light from elsewhere or an LED in "
        "another position or direction",
        side, brighter(x.norm()));
  });
  best.offer(image.predicted.cwiseProduct(image.off_axis), [](const Eigen::VectorXd& x) {
    return fmt::format("light that {} towards the picture's corners, as by the lens's vignetting",
                       x[0] < 0.0 ? "falls off" : "rises");
  });
  best.offer(
      image.predicted.cwiseProduct((image.predicted.array() - image.predicted.mean()).matrix()),
      [](const Eigen::VectorXd& x) {
        return fmt::format(
            "bright parts too {}: the camera's response is not linear, or "
            "the medium lies outside what the rig allows",
            x[0] < 0.0 ? "dark" : "bright");
      });
  best.offer_spots([&](std::size_t n) {
    return fmt::format(
        "a few spots, {} of {} patches: dust, hot pixels, scratches, or damage "
        "that the mesh does not have",
        n, image.rest.size());
  });
  for (std::size_t s = 0; s < rows.size() && rows.size() > 1; ++s) {
    best.offer(part_of(image, [&](std::size_t i) { return image.shot[i] == s; }),
               [&](const Eigen::VectorXd& x) {
                 return fmt::format("one shot, {}, {}", rows[s].file, brighter(x[0]));
               });
  }
  for (const Eigen::Vector3d& face : faces(image.normal)) {
    best.offer(part_of(image, [&](std::size_t i) { return image.normal[i].dot(face) > 0.99; }),
               [&](const Eigen::VectorXd& x) {
                 return fmt::format(
                     "one face (normal [{:.2f}, {:.2f}, {:.2f}]), {}, as by a lamp that is not "
                     "listed or a face that differs from its mesh",
                     face.x(), face.y(), face.z(), brighter(x[0]));
               });
  }
  const Eigen::VectorXd band =
      part_of(image, [&](std::size_t i) { return bool{image.beside_edge[i]}; });
  if (band.norm() > 0.0) {
    // An outline that is shifted is too bright on one side and too dark on the other.
    Eigen::MatrixXd edges(image.rest.size(), 3);
    edges << band, band.cwiseProduct(image.right), band.cwiseProduct(image.down);
    best.offer(edges, [](const Eigen::VectorXd& x) {
      return fmt::format("a band along outline and edges, {:.2g} % off", 100.0 * x.norm());
    });
  }
  best.offer_scatter();
  return best.take();
}

}  // namespace scattermeter
