#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "apps/bench/bench_command.h"
#include "apps/bench/bench_models.h"
#include "apps/bench_transport/atlas_interpolation.h"
#include "apps/bench_transport/atlas_size.h"
#include "apps/bench_transport/tracer_efficiency.h"
#include "core/base/input_error.h"
#include "core/mesh/bodies.h"

namespace scattermeter::apps {
namespace {

const std::vector<std::string>& part_names() {
  static const std::vector<std::string> names = {"interpolation", "answers", "tracer", "size"};
  return names;
}

struct AtlasArguments {
  AtlasInterpolationOptions interpolation;
  TracerEfficiencyOptions tracer;
  AtlasSizeOptions size;
  ModelsBenchOptions answers;
  std::vector<std::string> parts = part_names();
  std::vector<double> scale_std = {0.0, 0.02};
  bool has(const std::string& part) const {
    return std::find(parts.begin(), parts.end(), part) != parts.end();
  }
};

// Three plastics, from one that is nearly opaque to one that is nearly clear.
std::vector<ListedMaterial> plastics() {
  return {{"2.6", 'G', {2.6, 0.004, 1.3}},
          {"1.3", 'G', {1.3, 0.004, 1.3}},
          {"0.7", 'G', {0.7, 0.03, 1.3}}};
}

void declare_options(CLI::App& command, AtlasArguments& a) {
  command.add_option("--parts", a.parts, "only these tables")
      ->check(CLI::IsMember(part_names()))
      ->capture_default_str();
  command
      .add_option("--bodies", a.interpolation.bodies,
                  "only these bodies (the tracer's table has all)")
      ->check(CLI::IsMember(body_names()))
      ->capture_default_str();
  command.add_option("--media", a.interpolation.media, "interpolation: random media of a body")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  command.add_option("--paths", a.interpolation.paths, "interpolation: paths of each medium")
      ->check(CLI::Range(std::int64_t{32768}, std::int64_t{1'000'000'000'000}))
      ->capture_default_str();
  command.add_option("--g", a.interpolation.g, "interpolation: mean cosine of scattering")
      ->check(CLI::Range(-0.95, 0.95))
      ->capture_default_str();
  command
      .add_option("--shot-paths", a.answers.paths,
                  "answers: paths of the rendered shots for each light")
      ->check(CLI::Range(std::int64_t{512}, std::int64_t{1'000'000'000'000}))
      ->capture_default_str();
  command.add_option("--time-limit", a.answers.time_limit_s, "answers: seconds of a search")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command
      .add_option("--scale-std", a.scale_std,
                  "answers: relative standard deviations of the scale: stated, and its error "
                  "drawn from it")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command.add_option("--seconds", a.tracer.seconds, "tracer: processor time of a row, about")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command.add_option("--rows", a.size.rows, "size: patches that face the camera, about")
      ->check(CLI::Range(100, 10'000'000))
      ->capture_default_str();
}

void bench_answers(AtlasArguments& a, const BenchOptions& common, BenchFiles& files) {
  a.answers.bodies = a.interpolation.bodies;
  a.answers.models = {"transport"};
  a.answers.atlas_folder = common.out + "/answers_atlas";
  for (const double scale_std : a.scale_std) {
    a.answers.scale_std = scale_std;
    const std::vector<ModelsBenchRow> rows = bench_models(plastics(), a.answers);
    files.table(fmt::format("\nAnswers, scale known to {:g} %\n", 100.0 * scale_std));
    files.table(models_bench_table(rows));
    files.csv(fmt::format("atlas_answers_{:g}", 100.0 * scale_std), models_bench_csv(rows));
  }
}

int run_atlas_bench(AtlasArguments& a, const BenchOptions& common, CommandContext& context) {
  for (auto* seed : {&a.interpolation.seed, &a.tracer.seed}) *seed = common.seed;
  a.interpolation.progress = a.tracer.progress = a.size.progress = context.progress;
  take_common(common, context, a.answers);
  for (int* width :
       {&a.interpolation.image_width_px, &a.tracer.image_width_px, &a.size.image_width_px}) {
    *width = common.image_width_px.value_or(*width);
  }
  for (const char* folder : {"answers_atlas", "size_atlas"}) {
    if (const std::string path = common.out + "/" + folder; std::filesystem::exists(path)) {
      throw InputError(path, "is there already: times and sizes are those of a new atlas");
    }
  }
  BenchFiles files(common, context);
  if (a.has("size")) {
    a.size.bodies = a.interpolation.bodies;
    a.size.folder = common.out + "/size_atlas";
    const std::vector<AtlasSizeRow> rows = atlas_size(a.size);
    files.table("Size\n" + atlas_size_table(rows));
    files.csv("atlas_size", atlas_size_csv(rows));
  }
  if (a.has("tracer")) {
    const std::vector<TracerEfficiencyRow> rows = tracer_efficiency(a.tracer);
    files.table("\nTracer\n" + tracer_efficiency_table(rows));
    files.csv("atlas_tracer", tracer_efficiency_csv(rows));
  }
  if (a.has("interpolation")) {
    const std::vector<AtlasInterpolationRow> rows = atlas_interpolation(a.interpolation);
    files.table("\nInterpolation\n" + atlas_interpolation_table(rows));
    files.csv("atlas_interpolation", atlas_interpolation_csv(rows));
    const std::vector<AtlasInterpolationRow> nodes = atlas_interpolation_of_nodes(a.interpolation);
    files.table("\nInterpolation at twice the spacing, over 2^4\n" +
                atlas_interpolation_table(nodes));
    files.csv("atlas_nodes", atlas_interpolation_csv(nodes));
  }
  if (a.has("answers")) bench_answers(a, common, files);
  return 0;
}

}  // namespace

void add_atlas_bench(CLI::App& bench, CommandContext& context, const SharedBenchOptions& common) {
  CLI::App* command = bench.add_subcommand(
      "atlas",
      "What measure --atlas keeps: its size, the tracer that makes it, the error of its "
      "interpolation, and the answers from it.\n"
      "Size: of the nodes for sigma_s' of 0.2 to 10 per mm, one light and view. Tracer: variance "
      "of a patch's light, relative to the square of the mean, times processor time. "
      "Interpolation: light at random media against paths of the very medium, relative to the "
      "image's mean, without the Monte Carlo error (±) of either; and at nodes, from others at "
      "twice "
      "the spacing, divided by the 2^4 by which that is worse. Answers: shots rendered by "
      "volumetric Monte Carlo, measured from one atlas in OUT/answers_atlas.\n"
      "atlas_size.csv: body, rows, nodes, disk_bytes, medium_bytes and all_bytes (in memory, of "
      "the nodes of one medium and of all). atlas_tracer.csv: body, sigma_s_prime_per_mm, "
      "patches, paths, cpu_seconds, scatterings_per_s, connections_per_s, variance_seconds. "
      "atlas_interpolation.csv: body, sigma_s_prime_per_mm, sigma_a_per_mm, paths, atlas_paths, "
      "then of patches and of cells (dozens of patches) their number, mean_square (of the "
      "interpolation error), monte_carlo (deviation), largest; atlas_nodes.csv the same at nodes. "
      "atlas_answers_*.csv: as "
      "models.csv of bench models.");
  const auto arguments = std::make_shared<AtlasArguments>();
  arguments->answers.time_limit_s = 20;
  declare_options(*command, *arguments);
  run_if_named(*command, context, [arguments, common, &context] {
    return run_atlas_bench(*arguments, *common, context);
  });
}

}  // namespace scattermeter::apps
