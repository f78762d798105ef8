// The image of one view under one light in a medium of given sigma_s', for any absorption.
#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "core/transport/absorption_tilts.h"
#include "core/transport/packed_batches.h"
#include "core/transport/path_tracer.h"
#include "core/transport/scattering_view.h"

namespace scattermeter {

// Scores of the paths so far.
struct WhiteSums {
  int levels = 0;
  Eigen::MatrixXd sum;      // tilts x rows: scores of all paths
  Eigen::MatrixXf per_eta;  // kept tilts x rows: of their changes by eta
  PackedBatches batches;    // kBatches parts of the scores, by kept tilt
};

// White Monte Carlo (Alerstam, Svensson & Andersson-Engels 2008): paths are traced without
// absorption, and those of length L count exp(-sigma_a L). The same levels give the same digits on
// any number of threads.
class WhiteRows {
 public:
  // Independent parts of the paths, whose spread is the Monte Carlo error.
  static constexpr int kBatches = 64;
  // Of level 1; four further levels double them.
  static constexpr std::int64_t kFirstPaths = 16'384;
  // Of so many levels; a multiple of kBatches.
  static std::int64_t paths_of(int levels);
  // The fewest levels that have so many paths.
  static int levels_for(double paths);

  // sigma_s_per_mm: sigma_s', of the phase function of the worlds to come. The view must outlive
  // the object. size_mm: of the body.
  WhiteRows(const ScatteringView& view, double sigma_s_per_mm, double size_mm);

  double sigma_s_per_mm() const { return sigma_s_per_mm_; }
  int levels() const { return sums_.levels; }
  std::int64_t paths() const { return paths_of(levels()); }
  // Traces the paths of one more level, in the world with its medium's coefficients replaced by
  // these.
  void refine(const PathWorld& world, std::uint64_t seed);

  const WhiteSums& sums() const { return sums_; }
  // Takes the paths of an equal object in place of its own, unless it has as many: then, or where
  // their shapes do not fit the view and the tilts, it returns false and changes nothing.
  bool take(WhiteSums sums);

  struct Light {
    Eigen::VectorXd l;            // of every row, as ScatteringImage::l
    Eigen::VectorXd per_sigma_a;  // dl / d sigma_a, times mm
  };
  // Precondition: levels() > 0.
  Light light(double sigma_a_per_mm) const;
  // dl / d eta of every row, at the same sigma_s' and sigma_a. Precondition: levels() > 0.
  Eigen::VectorXd per_eta(double sigma_a_per_mm) const;
  struct Departures {
    // D, kBatches x rows: D^T D estimates the covariance of light().l; those of the first half of
    // the batches and those of the second each have a mean of 0.
    Eigen::MatrixXd of_batch;
    Light second_half;  // light() of the second half of the batches minus that of all
  };
  // Precondition: levels() > 0.
  Departures departures(double sigma_a_per_mm) const;

 private:
  // Every second tilt is kept for each batch and for the change by eta: these need to be known to
  // some per cent only.
  static constexpr Eigen::Index kBatchStep = 2;
  std::size_t kept_tilts() const {
    return static_cast<std::size_t>((tilts_.count() - 1) / kBatchStep + 1);
  }
  // Their indices.
  auto kept() const { return Eigen::seqN(0, static_cast<Eigen::Index>(kept_tilts()), kBatchStep); }

  const ScatteringView& view_;
  double sigma_s_per_mm_;
  AbsorptionTilts tilts_;
  WhiteSums sums_;
};

}  // namespace scattermeter
