#include "capture/sensor/merged_samples.h"

#include <algorithm>
#include <stdexcept>

namespace scattermeter::capture {
namespace {

constexpr int kReach = 2;  // samples of the same phase, to each side

void check_bracket(const std::vector<CfaSamples>& exposures) {
  if (exposures.empty()) throw std::invalid_argument("merged_samples: no exposure");
  const CfaSamples& first = exposures.front();
  for (const CfaSamples& s : exposures) {
    if (s.x0 != first.x0 || s.y0 != first.y0 || s.width != first.width ||
        s.height != first.height || s.channel_of_phase != first.channel_of_phase) {
      throw std::invalid_argument("merged_samples: the exposures differ in rectangle or filters");
    }
    if (!(s.exposure_s > 0.0)) {
      throw std::invalid_argument("merged_samples: exposure_s is not positive");
    }
  }
}

// 1 where a sample or a neighbour of its phase within kReach is clipped. Rows first, then columns.
std::vector<std::uint8_t> near_clipped(const CfaSamples& s) {
  std::vector<std::uint8_t> along(s.clipped.size(), 0), out(s.clipped.size(), 0);
  const auto width = static_cast<std::ptrdiff_t>(s.width);
  const auto spread = [&](std::ptrdiff_t step, std::ptrdiff_t place, std::ptrdiff_t length,
                          std::size_t i, std::vector<std::uint8_t>& to) {
    for (std::ptrdiff_t k = -kReach; k <= kReach; ++k) {
      if (place + 2 * k < 0 || place + 2 * k >= length) continue;
      to[static_cast<std::size_t>(static_cast<std::ptrdiff_t>(i) + 2 * k * step)] = 1;
    }
  };
  for (std::size_t i = 0; i < along.size(); ++i) {
    if (s.clipped[i] != kSampleClipped) continue;
    spread(1, static_cast<std::ptrdiff_t>(i) % width, width, i, along);
  }
  for (std::size_t i = 0; i < along.size(); ++i) {
    if (along[i] == 0) continue;
    spread(width, static_cast<std::ptrdiff_t>(i) / width, s.height, i, out);
  }
  return out;
}

double growth_of(const CfaSamples& s, std::size_t i) {
  return s.variance_per_count_of.empty() ? s.variance_per_count
                                         : static_cast<double>(s.variance_per_count_of[i]);
}

// The variance that a sample would have for the signal `expected`.
double variance_at(const CfaSamples& s, std::size_t i, double expected_counts) {
  const double growth = growth_of(s, i);
  const auto variance = static_cast<double>(s.variance_counts2[i]);
  const double dark = variance - growth * std::max(0.0, static_cast<double>(s.signal_counts[i]));
  return std::max(dark, 1e-6 * variance) + growth * std::max(0.0, expected_counts);
}

class Merging {
 public:
  explicit Merging(const std::vector<CfaSamples>& exposures)
      : from_(exposures), weight_(exposures.size()) {
    for (const CfaSamples& s : exposures) {
      near_clipped_.push_back(near_clipped(s));
      if (s.exposure_s < from_[shortest_].exposure_s) shortest_ = near_clipped_.size() - 1;
    }
  }

  void merge(std::size_t i, CfaSamples& out) {
    for (const CfaSamples& s : from_) {
      if (s.clipped[i] == kSampleDefect) {
        out.clipped[i] = kSampleDefect;
        out.signal_counts[i] = 0.0F;
        return;
      }
    }
    weigh(i);
    out.clipped[i] = alone_ ? from_[shortest_].clipped[i] : std::uint8_t{0};
    double total = 0.0;
    for (const double w : weight_) total += w;
    double signal = 0.0, variance = 0.0, growth = 0.0;
    for (std::size_t k = 0; k < from_.size(); ++k) {
      if (!(weight_[k] > 0.0)) continue;
      const double a = weight_[k] / total;
      const double up = out.exposure_s / from_[k].exposure_s;
      signal += a * up * static_cast<double>(from_[k].signal_counts[i]);
      variance += a * a * up * up * variance_[k];
      growth += a * a * up * growth_of(from_[k], i);
      out.part_of_exposure[k][i] = static_cast<float>(a);
    }
    out.signal_counts[i] = static_cast<float>(signal);
    out.variance_counts2[i] = static_cast<float>(variance);
    out.variance_per_count_of[i] = static_cast<float>(growth);
  }

 private:
  // t^2 / v of the exposures that contribute to a sample, 0 for the others.
  void weigh(std::size_t i) {
    double counts = 0.0, time_s = 0.0, longest_s = 0.0;
    alone_ = true;
    for (std::size_t k = 0; k < from_.size(); ++k) {
      if (near_clipped_[k][i] != 0) continue;
      alone_ = false;
      counts += static_cast<double>(from_[k].signal_counts[i]);
      time_s += from_[k].exposure_s;
      longest_s = std::max(longest_s, from_[k].exposure_s);
    }
    if (alone_) {
      std::fill(weight_.begin(), weight_.end(), 0.0);
      weight_[shortest_] = 1.0;
      variance_.assign(from_.size(), static_cast<double>(from_[shortest_].variance_counts2[i]));
      return;
    }
    variance_.resize(from_.size());
    for (std::size_t k = 0; k < from_.size(); ++k) {
      const CfaSamples& s = from_[k];
      weight_[k] = 0.0;
      const double expected = counts / time_s * s.exposure_s;
      const bool is_cut =
          s.floor_counts > 0.0 && expected < s.floor_counts && s.exposure_s < longest_s;
      if (near_clipped_[k][i] != 0 || is_cut) continue;
      variance_[k] = variance_at(s, i, expected);
      weight_[k] = s.exposure_s * s.exposure_s / variance_[k];
    }
  }

  const std::vector<CfaSamples>& from_;
  std::vector<std::vector<std::uint8_t>> near_clipped_;
  std::size_t shortest_ = 0;
  std::vector<double> weight_, variance_;
  bool alone_ = false;
};

}  // namespace

CfaSamples merged_samples(const std::vector<CfaSamples>& exposures) {
  check_bracket(exposures);
  CfaSamples out = exposures.front();
  if (exposures.size() == 1) return out;
  const std::size_t n = out.signal_counts.size();
  out.variance_per_count_of.assign(n, 0.0F);
  out.part_of_exposure.assign(exposures.size(), std::vector<float>(n, 0.0F));
  for (const CfaSamples& s : exposures) {
    out.floor_counts = std::min(out.floor_counts, s.floor_counts * out.exposure_s / s.exposure_s);
  }
  Merging merging(exposures);
  double growth = 0.0, good = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    merging.merge(i, out);
    if (out.clipped[i] == kSampleDefect) continue;
    growth += static_cast<double>(out.variance_per_count_of[i]);
    good += 1.0;
  }
  if (good > 0.0) out.variance_per_count = growth / good;
  return out;
}

}  // namespace scattermeter::capture
