#include "core/estimation/channel_simulation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

namespace scattermeter {
namespace {

// A node of the atlas in the interpolation at a point.
struct Share {
  int node = 0;
  double weight = 0;           // Lagrange's, of the cubic through four nodes
  double per_log_sigma_s = 0;  // its derivative
  int levels = 0;
};

// Enough paths at each node for errors as of `blocks` blocks at the point itself, as few as
// possible in total: in proportion to the weights.
std::array<Share, 4> shares(double sigma_s_per_mm, int blocks) {
  const double x = std::log(sigma_s_per_mm) / TransportAtlas::kSpacing;
  const double floor = std::floor(x);
  std::array<Share, 4> out;
  double sum = 0.0;
  for (int i = 0; i < 4; ++i) {
    Share& share = out[static_cast<std::size_t>(i)];
    share.node = static_cast<int>(floor) - 1 + i;
    share.weight = 1.0;
    for (int j = 0; j < 4; ++j) {
      if (j == i) continue;
      double slope = 1.0 / (i - j);
      for (int k = 0; k < 4; ++k) {
        if (k != i && k != j) slope *= (x - (floor - 1 + k)) / (i - k);
      }
      share.per_log_sigma_s += slope / TransportAtlas::kSpacing;
      share.weight *= (x - (floor - 1 + j)) / (i - j);
    }
    sum += std::abs(share.weight);
  }
  for (Share& share : out) {
    share.levels = WhiteRows::levels_for(ChannelSimulation::kBlockPaths * blocks *
                                         std::abs(share.weight) * sum);
  }
  return out;
}

// The light of `share`'s node, carried to the point by the control.
struct Carried {
  Eigen::VectorXd factor, per_log_sigma_s, per_sigma_a;  // by row of the control
};
Carried carried(const ScatteringImage& here, const ScatteringImage& there) {
  // Without light of the control: as it is.
  const auto known = here.l.array() > 0.0 && there.l.array() > 0.0;
  const Eigen::ArrayXd factor = known.select(here.l.array() / there.l.array(), 1.0);
  return {
      factor, known.select(here.per_log_sigma_s.array() / there.l.array(), 0.0),
      known.select(
          (here.per_sigma_a.array() - factor * there.per_sigma_a.array()) / there.l.array(), 0.0)};
}

using RowPairs = std::vector<std::pair<Eigen::Index, Eigen::Index>>;

// Adds the light of a node, of some power, carried to the point. rows: those of the point's image
// and of the light, for each of the sum's rows.
void add_carried(const WhiteRows::Light& light, double power, const Share& share,
                 const Carried& to_here, const RowPairs& rows, ScatteringImage& sum) {
  for (Eigen::Index k = 0; k < sum.l.size(); ++k) {
    const auto [row, at_view] = rows[static_cast<std::size_t>(k)];
    const double l = power * light.l[at_view];
    const double factor = share.weight * to_here.factor[row];
    sum.l[k] += factor * l;
    sum.per_log_sigma_s[k] += l * (share.weight * to_here.per_log_sigma_s[row] +
                                   share.per_log_sigma_s * to_here.factor[row]);
    sum.per_sigma_a[k] +=
        factor * power * light.per_sigma_a[at_view] + share.weight * l * to_here.per_sigma_a[row];
  }
}

// What the nodes of one light add to a look, on the rows that it lights.
struct OfLight {
  explicit OfLight(std::size_t n_rows) {
    image.l = image.per_log_sigma_s = image.per_sigma_a = image.variance =
        Eigen::VectorXd::Zero(static_cast<Eigen::Index>(n_rows));
    off = {image.l, image.l, image.l, {}};
    per_eta = image.l;
  }
  void add(const RowPairs& rows, double power, const WhiteRows& node, const Share& share,
           const Carried& to_here, double sigma_a_per_mm,
           const ChannelSimulation::Projections& projections) {
    constexpr Eigen::Index kHalf = WhiteRows::kBatches / 2;
    const WhiteRows::Departures departures = node.departures(sigma_a_per_mm);
    add_carried(node.light(sigma_a_per_mm), power, share, to_here, rows, image);
    add_carried(departures.second_half, power, share, to_here, rows, off);
    for (std::size_t half = 0; half < 2; ++half) {
      projected[half] = Eigen::MatrixXd::Zero(kHalf, projections[half].rows());
    }
    const Eigen::VectorXd by_eta = node.per_eta(sigma_a_per_mm);
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const auto [row, at_view] = rows[k];
      const double factor = share.weight * to_here.factor[row] * power;
      per_eta[static_cast<Eigen::Index>(k)] += factor * by_eta[at_view];
      const auto batches = departures.of_batch.col(at_view);
      image.variance[static_cast<Eigen::Index>(k)] += factor * factor * batches.squaredNorm();
      for (std::size_t half = 0; half < 2; ++half) {
        for (Eigen::SparseMatrix<double>::InnerIterator it(projections[half], row); it; ++it) {
          projected[half].col(it.row()) +=
              factor * it.value() * batches.segment(static_cast<Eigen::Index>(half) * kHalf, kHalf);
        }
      }
    }
    const double own = share.weight * share.weight * ChannelSimulation::kBlockPaths /
                       static_cast<double>(node.paths());
    error += own;
    squares += own * own;
  }

  ScatteringImage image, off;  // off: of the second half of the batches
  Eigen::VectorXd per_eta;
  // Of the share that came last: departures of either half's batches.
  std::array<Eigen::MatrixXd, 2> projected;
  // 1 / blocks, and the sum of the nodes' squares of it.
  double error = 0, squares = 0;
};

void add_rows(const ScatteringImage& some, const RowPairs& rows, ScatteringImage& image) {
  for (const auto part : {&ScatteringImage::l, &ScatteringImage::per_log_sigma_s,
                          &ScatteringImage::per_sigma_a, &ScatteringImage::variance}) {
    const Eigen::VectorXd& from = some.*part;
    for (Eigen::Index k = 0; k < from.size(); ++k) {
      (image.*part)[rows[static_cast<std::size_t>(k)].first] += from[k];
    }
  }
}

}  // namespace

ChannelSimulation::ChannelSimulation(const Scene& scene, const MaterialChannel& channel,
                                     TransportAtlas& atlas, bool may_trace)
    : scene_(scene), channel_(channel), may_trace_(may_trace) {
  for (std::size_t s = 0; s < channel.shots.size(); ++s) {
    const ObservedShot& shot = *channel.shots[s];
    for (const std::string& name : shot.stated->lights) {
      const SceneLight& light = scene.light(name);
      const double power = light->power()[static_cast<Eigen::Index>(channel.channel)];
      if (!(power > 0.0)) continue;
      TransportAtlas::LitView* in_atlas = &atlas.lit_view(
          scene, *shot.seen, light, channel.channel,
          {channel.eta_int_over_ext, channel.phase, shot.seen->object->stated->surface_alpha});
      auto known = std::find_if(lit_.begin(), lit_.end(),
                                [&](const Lit& v) { return v.in_atlas == in_atlas; });
      if (known == lit_.end()) {
        lit_.push_back({in_atlas, power, {}, {}, {}});
        known = std::prev(lit_.end());
      }
      known->shots.push_back(s);
    }
  }
}

double ChannelSimulation::largest_size_mm() const {
  double out = 0.0;
  for (const Lit& v : lit_) out = std::max(out, v.in_atlas->size_mm());
  return out;
}

void ChannelSimulation::set_rows(const ChannelRows& rows) {
  area_mm2_.clear();
  center_mm_.clear();
  for (Lit& v : lit_) v.rows.clear();
  std::vector<RoughSurfaces::Rows> of_shots;
  Eigen::Index at = 0;
  for (std::size_t s = 0; s < channel_.shots.size(); ++s) {
    const SeenObject& seen = *channel_.shots[s]->seen;
    std::vector<std::pair<Eigen::Index, int>> used;  // row and patch
    of_shots.push_back({channel_.shots[s]->stated, &seen, {}});
    for (std::size_t j = 0; j < rows[s].state.size(); ++j) {
      if (rows[s].state[j] != RowState::kUsed) continue;
      const int patch = seen.map.patch_of_row[j];
      used.emplace_back(at++, patch);
      of_shots.back().rows.push_back(j);
      area_mm2_.push_back(seen.patches->area_mm2(patch));
      center_mm_.push_back(seen.patches->center_mm(patch));
    }
    for (Lit& v : lit_) {
      if (std::find(v.shots.begin(), v.shots.end(), s) == v.shots.end()) continue;
      for (const auto& [row, patch] : used) {
        v.rows.emplace_back(row, v.in_atlas->row_of_patch(patch));
      }
    }
  }
  surfaces_ = RoughSurfaces(scene_, channel_.channel, of_shots);
}

std::int64_t ChannelSimulation::missing_paths(const ScatteringPoint& at, int blocks) const {
  std::int64_t paths = 0;
  for (const Share& share : shares(at.sigma_s_per_mm, blocks)) {
    for (const Lit& v : lit_) paths += v.in_atlas->missing_paths(share.node, share.levels);
  }
  return paths;
}

std::shared_ptr<const WhiteRows> ChannelSimulation::node_of(const Lit& lit, int idx,
                                                            int levels) const {
  if (!may_trace_ && lit.in_atlas->missing_paths(idx, levels) > 0) throw PathsMissing();
  return lit.in_atlas->node(idx, levels);
}

Eigen::VectorXd ChannelSimulation::light_at_node(int node, double sigma_a_per_mm,
                                                 int blocks) const {
  Eigen::VectorXd l = surfaces_.gloss();
  const int levels = WhiteRows::levels_for(kBlockPaths * blocks);
  for (const Lit& v : lit_) {
    const Eigen::VectorXd of_view = node_of(v, node, levels)->light(sigma_a_per_mm).l;
    for (const auto& [row, at_view] : v.rows) l[row] += v.power * of_view[at_view];
  }
  return l;
}

ChannelSimulation::Look ChannelSimulation::look(const ScatteringPoint& at, int blocks,
                                                const Projections& projections,
                                                const Control& control) const {
  Look out;
  ScatteringImage& image = out.image;
  image.l = image.per_log_sigma_s = image.per_sigma_a = image.variance =
      Eigen::VectorXd::Zero(n_rows());
  ScatteringImage off{image.l, image.l, image.l, {}};  // of the second half
  out.per_eta = image.l;
  for (Eigen::MatrixXd& c : out.by_half) {
    c = Eigen::MatrixXd::Zero(projections[0].rows(), projections[0].rows());
  }
  std::vector<OfLight> of_light;
  for (const Lit& v : lit_) of_light.emplace_back(v.rows.size());
  const ScatteringImage here = control(at);
  std::vector<std::vector<std::shared_ptr<const WhiteRows>>> held(lit_.size());
  for (const Share& share : shares(at.sigma_s_per_mm, blocks)) {
    const Carried to_here = carried(
        here, control({TransportAtlas::sigma_s_per_mm(share.node), at.sigma_a_per_mm, at.scale}));
    // Tracing is not for several threads; what the nodes say is.
    for (std::size_t i = 0; i < lit_.size(); ++i) {
      held[i].push_back(node_of(lit_[i], share.node, share.levels));
    }
    tbb::this_task_arena::isolate([&] {
      tbb::parallel_for(std::size_t{0}, lit_.size(), [&](std::size_t i) {
        of_light[i].add(lit_[i].rows, lit_[i].power, *held[i].back(), share, to_here,
                        at.sigma_a_per_mm, projections);
      });
    });
    for (const OfLight& light : of_light) {
      for (std::size_t half = 0; half < 2; ++half) {
        out.by_half[half] += 2.0 * light.projected[half].transpose() * light.projected[half];
      }
    }
  }
  for (std::size_t i = 0; i < lit_.size(); ++i) {
    lit_[i].held = std::move(held[i]);
    add_rows(of_light[i].image, lit_[i].rows, image);
    add_rows(of_light[i].off, lit_[i].rows, off);
    for (std::size_t k = 0; k < lit_[i].rows.size(); ++k) {
      out.per_eta[lit_[i].rows[k].first] += of_light[i].per_eta[static_cast<Eigen::Index>(k)];
    }
  }
  image.l += surfaces_.gloss();
  out.covariance = 0.5 * (out.by_half[0] + out.by_half[1]);
  for (const std::size_t half : {std::size_t{0}, std::size_t{1}}) {
    const double sign = half == 0 ? -1.0 : 1.0;
    out.halves[half] = {image.l + sign * off.l,
                        image.per_log_sigma_s + sign * off.per_log_sigma_s,
                        image.per_sigma_a + sign * off.per_sigma_a,
                        {}};
  }
  const OfLight& most =
      *std::max_element(of_light.begin(), of_light.end(),
                        [](const OfLight& x, const OfLight& y) { return x.error < y.error; });
  out.blocks = static_cast<int>(std::lround(1.0 / most.error));
  out.freedom = (WhiteRows::kBatches - 2.0) * most.error * most.error / most.squares;
  return out;
}

}  // namespace scattermeter
