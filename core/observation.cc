#include "core/observation.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <Eigen/Cholesky>

namespace scattermeter {
namespace {

struct Mean {
  double l = 0;
  double variance = 0;
  double spread = 1;  // of the variance against that of the plain mean
};

// Monomials up to degree 2 of a sample's place, in units that keep their squares near one.
using Basis = Eigen::Matrix<double, 6, 1>;
Basis basis_at(const Eigen::Vector2i& from_origin_px) {
  constexpr double kUnit = 1.0 / 16.0;
  const double x = kUnit * from_origin_px.x();
  const double y = kUnit * from_origin_px.y();
  return (Basis() << 1.0, x, y, x * x, x * y, y * y).finished();
}

// Running sums of one channel over one patch. Samples of the three colours stand at different
// places, so their plain means belong to different parts of the patch; a quadratic through the
// channel's own samples (where they are too few, a plane) is averaged over the samples of all
// colours, which is what the row's site stands for.
struct Sum {
  double n = 0, counts = 0, factor = 0;
  std::size_t clipped = 0;
  double l = 0, variance = 0;
  Basis lb = Basis::Zero();                                              // sum of l times the basis
  Eigen::Matrix<double, 6, 6> bb = Eigen::Matrix<double, 6, 6>::Zero();  // of basis times basis

  void add(const Basis& basis, double factor_, double signal, double signal_variance) {
    n += 1.0;
    counts += signal;
    factor += factor_;
    l += factor_ * signal;
    variance += factor_ * factor_ * signal_variance;
    lb += factor_ * signal * basis;
    bb += basis * basis.transpose();
  }

  // Mean of l over samples whose mean basis is `target`, and its variance: the weights of the own
  // samples are target^T bb^-1 basis, and their squares add up to target^T bb^-1 target.
  Mean mean_over(const Basis& target) const {
    const Mean plain{l / n, variance / (n * n), 1.0};
    for (const Eigen::Index terms : {Eigen::Index{6}, Eigen::Index{3}}) {
      // Twice as many samples as terms at least, not all nearly on a line, and no more than half as
      // much noise again.
      constexpr double kMostSpread = 1.5;
      if (n < 2.0 * static_cast<double>(terms)) continue;
      const Eigen::LDLT<Eigen::MatrixXd> gram(bb.topLeftCorner(terms, terms));
      if (!(gram.rcond() > 1e-10)) continue;
      const Eigen::VectorXd weight = gram.solve(target.head(terms));
      const double spread = n * weight.dot(target.head(terms));
      if (!(spread < kMostSpread)) continue;
      return {weight.dot(lb.head(terms)), plain.variance * spread, spread};
    }
    return plain;
  }
};

}  // namespace

Observation observe(const CfaSamples& samples, const SampleMap& map,
                    const std::array<double, kRgb>& responsivity) {
  if (samples.x0 != map.x0 || samples.y0 != map.y0 || samples.width != map.width ||
      samples.height != map.height) {
    throw std::invalid_argument("observe: the samples' rectangle is not the map's");
  }
  if (!(samples.exposure_s > 0.0))
    throw std::invalid_argument("observe: exposure_s is not positive");
  const std::size_t n_rows = map.patch_of_row.size();
  std::array<std::vector<Sum>, kRgb> sums;
  for (auto& s : sums) s.resize(n_rows);
  std::vector<Basis> place(n_rows, Basis::Zero());  // sum over all samples of a row
  std::vector<Eigen::Vector2i> origin(n_rows);      // its first sample, px
  std::vector<double> count(n_rows, 0.0);
  struct Scatter {
    double squared = 0, expected = 0;
  };
  std::array<Scatter, kRgb> scatter;
  Observation out;
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) +
                            static_cast<std::size_t>(x);
      if (map.row_of_sample[i] < 0) continue;
      const auto row = static_cast<std::size_t>(map.row_of_sample[i]);
      const auto c = static_cast<std::size_t>(samples.channel(map.x0 + x, map.y0 + y));
      if (count[row] == 0.0) origin[row] = {x, y};
      const Basis basis = basis_at(Eigen::Vector2i(x, y) - origin[row]);
      place[row] += basis;
      count[row] += 1.0;
      Sum& s = sums[c][row];
      ++out.channel[c].samples;
      if (samples.clipped[i] != 0) {
        ++s.clipped;
        ++out.channel[c].samples_clipped;
        continue;
      }
      s.add(basis, static_cast<double>(map.pi_over_transmittance[i]),
            static_cast<double>(samples.signal_counts[i]),
            static_cast<double>(samples.variance_counts2[i]));
      // Three samples of one phase in line on one patch: the second difference is free of the
      // slope.
      const bool in_line = x + 4 < map.width && map.row_of_sample[i + 2] == map.row_of_sample[i] &&
                           map.row_of_sample[i + 4] == map.row_of_sample[i];
      if (in_line && samples.clipped[i + 2] == 0 && samples.clipped[i + 4] == 0) {
        const double d =
            static_cast<double>(samples.signal_counts[i] - 2.0F * samples.signal_counts[i + 2] +
                                samples.signal_counts[i + 4]);
        scatter[c].squared += d * d;
        scatter[c].expected += static_cast<double>(samples.variance_counts2[i]) +
                               4.0 * static_cast<double>(samples.variance_counts2[i + 2]) +
                               static_cast<double>(samples.variance_counts2[i + 4]);
      }
    }
  }
  for (std::size_t c = 0; c < kRgb; ++c) {
    ChannelObservation& channel = out.channel[c];
    channel.l.assign(n_rows, 0.0);
    channel.variance.assign(n_rows, 0.0);
    channel.variance_per_l.assign(n_rows, 0.0);
    channel.state.assign(n_rows, RowState::kNoSamples);
    if (scatter[c].expected > 0.0) channel.noise_ratio = scatter[c].squared / scatter[c].expected;
    const double unit = 1.0 / (responsivity[c] * samples.exposure_s);
    for (std::size_t row = 0; row < n_rows; ++row) {
      const Sum& s = sums[c][row];
      if (s.n == 0.0 && s.clipped == 0) continue;
      // A clipped sample is a lower bound; leaving only it out would pull the mean down.
      if (s.clipped > 0) {
        channel.state[row] = RowState::kClipped;
        ++channel.rows_clipped;
        continue;
      }
      channel.brightest_counts = std::max(channel.brightest_counts, s.counts / s.n);
      if (s.counts / s.n < samples.floor_counts) {
        channel.state[row] = RowState::kFloor;
        ++channel.rows_floor;
        continue;
      }
      const Mean mean = s.mean_over(place[row] / count[row]);
      channel.l[row] = unit * mean.l;
      channel.variance[row] = unit * unit * mean.variance;
      // Samples of l / (unit factor) counts: sum of factor^2 variance_per_count l / (unit factor).
      channel.variance_per_l[row] =
          unit * samples.variance_per_count * s.factor / (s.n * s.n) * mean.spread;
      channel.state[row] = RowState::kUsed;
      channel.brightest_snr =
          std::max(channel.brightest_snr, channel.l[row] / std::sqrt(channel.variance[row]));
      ++channel.rows_used;
    }
  }
  return out;
}

}  // namespace scattermeter
