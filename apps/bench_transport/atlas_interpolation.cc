#include "apps/bench_transport/atlas_interpolation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <Eigen/SparseCore>
#include <fmt/core.h>

#include "apps/bench_transport/lit_body.h"
#include "apps/report/csv.h"
#include "apps/report/text_table.h"
#include "core/base/random_stream.h"
#include "core/fit/shot_parts.h"

namespace scattermeter::apps {
namespace {

// Seeds of the atlas are below this.
constexpr std::uint64_t kOwnSeeds = 1'000'000'000;

// Evenly in its logarithm.
double between(double low, double high, RandomStream& random) {
  return low * std::pow(high / low, random.uniform());
}

double random_absorbed(RandomStream& random) { return between(3e-4, 0.5, random); }

Medium random_medium(RandomStream& random) {
  const double sigma_s = between(0.2, 10.0, random);
  const double absorbed = random_absorbed(random);
  return {sigma_s, sigma_s * absorbed / (1.0 - absorbed), LitBody::kEta};
}

// halves: differences in the light of groups.
AtlasDifference difference(const std::array<Eigen::VectorXd, 2>& halves) {
  AtlasDifference out;
  out.groups = static_cast<int>(halves[0].size());
  out.mean_square = halves[0].dot(halves[1]) / out.groups;
  out.monte_carlo = std::sqrt((halves[0] - halves[1]).squaredNorm() / out.groups) / 2.0;
  for (std::size_t half = 0; half < 2; ++half) {
    Eigen::Index at = 0;
    halves[half].cwiseAbs().maxCoeff(&at);
    out.largest += 0.5 * halves[1 - half][at] * (halves[half][at] < 0.0 ? -1.0 : 1.0);
  }
  return out;
}

// differences: of the rows' light, by half; l: the light that they are of.
AtlasInterpolationRow row_from(const LitBody& body, const Medium& medium,
                               std::array<Eigen::VectorXd, 2> differences,
                               const Eigen::VectorXd& l) {
  const Eigen::VectorXd& area = body.area_mm2();
  const double mean = area.dot(l) / area.sum();
  for (Eigen::VectorXd& d : differences) d /= mean;
  AtlasInterpolationRow row;
  row.medium = medium;
  row.patches = difference(differences);
  const std::vector<double> areas(area.begin(), area.end());
  const ShotParts parts({l.size()}, body.center_mm(), areas, Eigen::VectorXd::Ones(l.size()));
  row.cells = difference({parts.cells() * differences[0], parts.cells() * differences[1]});
  return row;
}

AtlasInterpolationRow compared(LitBody& body, const ChannelSimulation& simulation,
                               const Medium& medium, std::uint64_t seed, int blocks) {
  const ScatteringPoint at{medium.sigma_s_prime_per_mm, medium.sigma_a_per_mm, 1.0};
  const Eigen::SparseMatrix<double> none(0, body.n_rows());
  const ChannelSimulation::Look look = simulation.look(
      at, blocks, {none, none}, [&](const ScatteringPoint& p) { return body.dipole(p); });
  std::array<Eigen::VectorXd, 2> traced, differences;
  for (std::uint64_t half = 0; half < 2; ++half) {
    traced[half] = body.traced(medium, seed + half, blocks / 2).image.l;
    differences[half] = look.halves[half].l - traced[half];
  }
  AtlasInterpolationRow row = row_from(body, medium, differences, 0.5 * (traced[0] + traced[1]));
  row.paths = static_cast<std::int64_t>(ChannelSimulation::kBlockPaths) * 2 * (blocks / 2);
  row.atlas_paths = static_cast<std::int64_t>(ChannelSimulation::kBlockPaths) * look.blocks;
  return row;
}

// At a node, from the first and third on either side of it.
AtlasInterpolationRow compared_with_node(LitBody& body, TransportAtlas& atlas, int node,
                                         double absorbed, std::int64_t paths) {
  constexpr std::array<std::pair<int, double>, 4> kWeights{
      {{-3, -1.0 / 16.0}, {-1, 9.0 / 16.0}, {1, 9.0 / 16.0}, {3, -1.0 / 16.0}}};
  // A cubic's error grows with the fourth power of the spacing.
  constexpr double kFiner = 16.0;
  const double sigma_s = TransportAtlas::sigma_s_per_mm(node);
  const double sigma_a = sigma_s * absorbed / (1.0 - absorbed);
  const auto control = [&](int at) {
    return body.dipole({TransportAtlas::sigma_s_per_mm(at), sigma_a, 1.0}).l;
  };
  const Eigen::VectorXd here = control(node);
  const std::array<Eigen::VectorXd, 2> light = body.halves_at_node(atlas, node, sigma_a, paths);
  std::array<Eigen::VectorXd, 2> differences{-light[0], -light[1]};
  for (const auto& [offset, weight] : kWeights) {
    const Eigen::VectorXd carried = weight * here.cwiseQuotient(control(node + offset));
    const auto there = body.halves_at_node(atlas, node + offset, sigma_a, paths);
    for (std::size_t half = 0; half < 2; ++half) {
      differences[half] += carried.cwiseProduct(there[half]);
    }
  }
  for (Eigen::VectorXd& d : differences) d /= kFiner;
  AtlasInterpolationRow row =
      row_from(body, {sigma_s, sigma_a, LitBody::kEta}, differences, 0.5 * (light[0] + light[1]));
  row.paths = row.atlas_paths = paths;
  return row;
}

}  // namespace

std::vector<AtlasInterpolationRow> atlas_interpolation(const AtlasInterpolationOptions& options) {
  const int blocks =
      static_cast<int>(static_cast<double>(options.paths) / ChannelSimulation::kBlockPaths);
  if (options.media < 1 || blocks < 8) {
    throw std::invalid_argument("atlas_interpolation: media " + std::to_string(options.media) +
                                ", paths " + std::to_string(options.paths));
  }
  std::vector<AtlasInterpolationRow> rows;
  ProgressStage stage(options.progress, "media of the atlas",
                      options.bodies.size() * static_cast<std::size_t>(options.media));
  for (const std::string& name : options.bodies) {
    LitBody body(name, {.image_width_px = options.image_width_px, .g = options.g});
    TransportAtlas atlas;
    const ChannelSimulation simulation = body.simulation(atlas);
    RandomStream random(options.seed, 0);
    for (int i = 0; i < options.media; ++i) {
      const Medium medium = random_medium(random);
      const std::uint64_t seed = kOwnSeeds * (options.seed + 1) + 2 * static_cast<std::uint64_t>(i);
      rows.push_back(compared(body, simulation, medium, seed, blocks));
      rows.back().body = name;
      stage.step();
    }
  }
  return rows;
}

std::vector<AtlasInterpolationRow> atlas_interpolation_of_nodes(
    const AtlasInterpolationOptions& options) {
  constexpr std::array<int, 5> kNodes = {-3, -1, 1, 3, 5};
  std::vector<AtlasInterpolationRow> rows;
  ProgressStage stage(options.progress, "nodes of the atlas",
                      options.bodies.size() * kNodes.size());
  for (const std::string& name : options.bodies) {
    LitBody body(name, {.image_width_px = options.image_width_px, .g = options.g});
    TransportAtlas atlas;
    RandomStream random(options.seed, 1);
    for (const int node : kNodes) {
      rows.push_back(compared_with_node(body, atlas, node, random_absorbed(random), options.paths));
      rows.back().body = name;
      stage.step();
    }
  }
  return rows;
}

AtlasInterpolationError interpolation_error(const std::vector<double>& mean_squares) {
  constexpr double kOneSided = 1.645;  // deviations of a normal 95 %
  const Eigen::Map<const Eigen::ArrayXd> v(mean_squares.data(),
                                           static_cast<Eigen::Index>(mean_squares.size()));
  const auto n = static_cast<double>(v.size());
  const double mean = v.mean();
  const double std = std::sqrt((v - mean).square().sum() / (n * std::max(1.0, n - 1.0)));
  return {std::sqrt(std::max(0.0, mean)), std::sqrt(std::max(0.0, mean + kOneSided * std))};
}

std::string atlas_interpolation_table(const std::vector<AtlasInterpolationRow>& rows) {
  using Align = TextTable::Align;
  TextTable table({{"body", Align::kLeft},
                   {"sigma_s' /mm"},
                   {"sigma_a /mm"},
                   {"patches"},
                   {"rms %"},
                   {"largest %"},
                   {"± %"},
                   {"cells"},
                   {"rms %"},
                   {"largest %"},
                   {"± %"}});
  std::vector<std::string> bodies;
  for (const AtlasInterpolationRow& r : rows) {
    std::vector<std::string> cells = {r.body, fmt::format("{:.3f}", r.medium.sigma_s_prime_per_mm),
                                      fmt::format("{:.3g}", r.medium.sigma_a_per_mm)};
    for (const AtlasDifference* d : {&r.patches, &r.cells}) {
      cells.push_back(std::to_string(d->groups));
      cells.push_back(fmt::format("{:.2f}", 100.0 * std::sqrt(std::max(0.0, d->mean_square))));
      cells.push_back(fmt::format("{:.2f}", 100.0 * d->largest));
      cells.push_back(fmt::format("{:.2f}", 100.0 * d->monte_carlo));
    }
    table.add_row(cells);
    if (bodies.empty() || bodies.back() != r.body) bodies.push_back(r.body);
  }
  std::string text = table.text();
  for (const std::string& body : bodies) {
    std::vector<double> patches, cells;
    for (const AtlasInterpolationRow& r : rows) {
      if (r.body != body) continue;
      patches.push_back(r.patches.mean_square);
      cells.push_back(r.cells.mean_square);
    }
    const AtlasInterpolationError p = interpolation_error(patches), c = interpolation_error(cells);
    text += fmt::format(
        "\n{}, {} media: interpolation is off by {:.3f} % of the image's mean (rms over patches; "
        "95 %: below {:.3f} %), {:.3f} % over cells (below {:.3f} %)\n",
        body, patches.size(), 100.0 * p.rms, 100.0 * p.below, 100.0 * c.rms, 100.0 * c.below);
  }
  return text;
}

std::string atlas_interpolation_csv(const std::vector<AtlasInterpolationRow>& rows) {
  Csv csv({"body", "sigma_s_prime_per_mm", "sigma_a_per_mm", "paths", "atlas_paths", "patches",
           "patches_mean_square", "patches_monte_carlo", "patches_largest", "cells",
           "cells_mean_square", "cells_monte_carlo", "cells_largest"});
  for (const AtlasInterpolationRow& r : rows) {
    std::vector<std::string> fields = {r.body, csv_number(r.medium.sigma_s_prime_per_mm),
                                       csv_number(r.medium.sigma_a_per_mm), std::to_string(r.paths),
                                       std::to_string(r.atlas_paths)};
    for (const AtlasDifference* d : {&r.patches, &r.cells}) {
      fields.push_back(std::to_string(d->groups));
      for (const double x : {d->mean_square, d->monte_carlo, d->largest}) {
        fields.push_back(csv_number(x));
      }
    }
    csv.add_row(fields);
  }
  return csv.text();
}

}  // namespace scattermeter::apps
