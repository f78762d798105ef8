#include "apps/bench/bench_paper.h"

#include <algorithm>
#include <cmath>

#include "apps/instrument/instrument.h"
#include "apps/instrument/open_shots.h"
#include "apps/simulation/pyramid_rig.h"
#include "apps/simulation/virtual_shots.h"
#include "calib/pose/shot_pose.h"
#include "core/base/progress.h"
#include "core/diffusion/dipole_curve.h"
#include "core/estimation/estimation.h"
#include "core/fit/dipole_fit.h"
#include "core/fit/method_errors.h"
#include "core/fit/quantised_system.h"
#include "core/fit/recovered_reflectance.h"
#include "core/fit/residual.h"
#include "core/light/sky_probe.h"

namespace scattermeter::apps {
namespace {

constexpr std::size_t kChannel = 1;  // G: half of the samples

// scale * R on the knots.
Eigen::VectorXd curve_of(const Estimate& e, const DistanceKnots& knots, double eta) {
  const double sigma_t = e.sigma_s_prime_per_mm.value + e.sigma_a_per_mm.value;
  return e.scale.value *
         dipole_curve(knots, std::log(sigma_t), e.sigma_a_per_mm.value / sigma_t, eta).r;
}

template <class Value>
double range(const PaperBench& bench, const Value& value) {
  double low = value(bench.widths.front());
  double high = low;
  for (const PaperBenchRow& row : bench.widths) {
    low = std::min(low, value(row));
    high = std::max(high, value(row));
  }
  return high - low;
}

}  // namespace

const std::vector<PublishedRow>& published_table2() {
  static const std::vector<PublishedRow> rows = {
      {0.05, 2.14, 0.000, 26.47}, {0.10, 2.20, 0.007, 42.12}, {0.15, 2.19, 0.004, 30.58},
      {0.20, 2.19, 0.009, 33.47}, {0.25, 2.19, 0.005, 28.69}, {0.30, 2.32, 0.009, 29.78},
      {0.35, 2.34, 0.009, 47.93}, {0.40, 2.22, 0.009, 25.76}, {0.45, 2.18, 0.009, 20.35},
      {0.50, 2.40, 0.009, 23.43}};
  return rows;
}

PaperBench bench_paper(const PaperBenchOptions& options) {
  const Rig rig = pyramid_rig(
      options.image_width_px,
      options.probe ? options.probe : std::make_shared<const Environment>(make_sky_probe()));
  const ObjectScenes objects = pyramid_scenes(rig);
  const VirtualShots shots(rig, objects, {.noise = options.noise, .progress = options.progress});
  const capture::ShotSource source =
      options.noise ? shots.source(options.seed) : shots.ideal_source();
  PaperBench bench;
  bench.truth = rig.truth.materials.begin()->second[kChannel];
  {
    Instrument instrument(rig, objects, {}, options.progress);
    const Measurement m = instrument.measure(source);
    bench.patch_mm = m.patch_size_mm.begin()->second;
    bench.dipole = m.results.at(kChannel).estimate;
  }
  const PoseResult pose = calib::pose_from_points(rig.scene, rig.pose);
  LitObjects lit(rig.scene, objects, bench.patch_mm, 0.0);
  const std::vector<ObservedShot> opened = open_shots(
      rig, source, objects, lit,
      see_all(rig.scene, objects, lit, pose, {}, rig.scene.objects_in_shots()), options.progress);
  const std::vector<MaterialChannel> channels = material_channels(rig.scene, opened);
  const MaterialChannel& green = channels.at(kChannel);
  const DistanceKnots knots = smooth_knots(lit);
  Weights smooth;
  add_smooth_weights(rig.scene, opened, lit, options.progress, smooth);
  const ChannelRows rows = channel_rows(rig.scene, green);
  const double mean_free_path_mm =
      1.0 / (bench.dipole.sigma_s_prime_per_mm.value + bench.dipole.sigma_a_per_mm.value);
  DenseSystem system = channel_system(rig.scene, green, rows, smooth, mean_free_path_mm);
  bench.rows = static_cast<std::size_t>(system.l.size());
  add_method_errors(knots, curve_of(bench.dipole, knots, green.eta_int_over_ext),
                    patch_size_mm(green),
                    {bench.dipole.sigma_s_prime_per_mm.value, bench.dipole.sigma_a_per_mm.value,
                     green.eta_int_over_ext},
                    system);
  bench.smooth = smooth_reflectance(recover_reflectance(system), system.nuisances, knots);
  DipoleFitOptions fit;
  fit.eta_int_over_ext = green.eta_int_over_ext;
  ProgressStage stage(options.progress, "widths", published_table2().size());
  for (const PublishedRow& published : published_table2()) {
    PaperBenchRow row;
    row.published = published;
    const UniformBins bins(published.width_mm, lit.longest_distance_mm());
    Weights uniform;
    add_weights(
        rig.scene, opened, lit, nullptr,
        [&](const SeenObject& seen, const SourceCloud& sources) {
          return uniform_weights(seen.sites, sources, bins, pair_options(knots));
        },
        uniform);
    const DenseSystem quantised =
        channel_system(rig.scene, green, rows, uniform, mean_free_path_mm);
    row.paper = solve_paper(quantised, published.width_mm, green.eta_int_over_ext);
    row.ours = fit_dipole(quantise(system, quantised.weights), knots, fit).estimate;
    row.ours_psnr_db =
        residual(system.l, system.weights * curve_of(row.ours, knots, green.eta_int_over_ext),
                 system.std_l)
            .psnr_db;
    bench.widths.push_back(std::move(row));
    stage.step();
  }
  return bench;
}

WidthSpread paper_spread(const PaperBench& b) {
  return {range(b, [](const PaperBenchRow& r) { return r.paper.sigma_s_prime_per_mm; }) /
              b.truth.sigma_s_prime_per_mm,
          range(b, [](const PaperBenchRow& r) { return r.paper.sigma_a_per_mm; }) /
              b.truth.sigma_a_per_mm};
}

WidthSpread our_spread(const PaperBench& b) {
  return {range(b, [](const PaperBenchRow& r) { return r.ours.sigma_s_prime_per_mm.value; }) /
              b.truth.sigma_s_prime_per_mm,
          range(b, [](const PaperBenchRow& r) { return r.ours.sigma_a_per_mm.value; }) /
              b.truth.sigma_a_per_mm};
}

WidthSpread published_spread(const PaperBench& b) {
  return {range(b, [](const PaperBenchRow& r) { return r.published.sigma_s_per_mm; }) /
              b.truth.sigma_s_prime_per_mm,
          range(b, [](const PaperBenchRow& r) { return r.published.sigma_a_per_mm; }) /
              b.truth.sigma_a_per_mm};
}

}  // namespace scattermeter::apps
