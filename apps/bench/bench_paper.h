// bench paper: the paper's simulation (its table 2, figures 5 and 6) by its method and by ours.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "apps/report/plot.h"
#include "core/base/progress.h"
#include "core/fit/estimate.h"
#include "core/fit/paper_estimator.h"
#include "core/fit/smooth_reflectance.h"
#include "core/light/environment.h"
#include "core/material/medium.h"

namespace scattermeter::apps {

struct PaperBenchOptions {
  int image_width_px = 3872;
  std::shared_ptr<const Environment> probe;  // null: core's clear sky with sun and ground
  // Off: ideal samples without noise and rounding; on: one 12-bit exposure.
  bool noise = false;
  std::uint64_t seed = 1;
  Progress* progress = nullptr;
};

// A row of the paper's table 2.
struct PublishedRow {
  double width_mm;
  double sigma_s_per_mm;
  double sigma_a_per_mm;
  double psnr_db;
};
// Mukaigawa, Suzuki and Yagi, "Measurement of Subsurface Scattering under Generic Illumination"
// (in Japanese), table 2: a pyramid of 2.19 / 0.002 per mm under a light probe, ten widths.
const std::vector<PublishedRow>& published_table2();

// One quantisation width, channel G.
struct PaperBenchRow {
  PublishedRow published;
  PaperEstimate paper;  // the paper's method on this image
  Estimate ours;        // the dipole fitted to r on the same knots (core/fit/quantised_system.h)
  double ours_psnr_db = 0;  // of the image re-rendered
};

struct PaperBench {
  Medium truth;
  double patch_mm = 0;
  std::size_t rows = 0;  // patches used
  std::vector<PaperBenchRow> widths;
  Estimate dipole;           // of the whole image without quantisation, as by `measure`
  SmoothReflectance smooth;  // r without a model
};

// Renders pyramid_rig() and measures it. Throws InputError as Instrument does.
PaperBench bench_paper(const PaperBenchOptions& options);

// Largest minus smallest estimate over the widths, relative to the truth.
struct WidthSpread {
  double sigma_s = 0;
  double sigma_a = 0;
};
WidthSpread paper_spread(const PaperBench& bench);
WidthSpread our_spread(const PaperBench& bench);
WidthSpread published_spread(const PaperBench& bench);

std::string paper_bench_table(const PaperBench& bench);
std::string paper_bench_csv(const PaperBench& bench);
// r on every knot: by the paper's method at its best width, and the smooth one.
std::string paper_reflectance_csv(const PaperBench& bench);
Plot paper_psnr_plot(const PaperBench& bench);
Plot paper_reflectance_plot(const PaperBench& bench);
Plot paper_reflectance_ratio_plot(const PaperBench& bench);
Plot paper_absorption_plot(const PaperBench& bench);

}  // namespace scattermeter::apps
