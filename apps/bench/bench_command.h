// The subcommands of bench, and the options and files that they share.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <ostream>
#include <string>

#include "apps/commands/commands.h"
#include "apps/report/plot.h"

namespace scattermeter::apps {

// Options of every bench.
struct BenchOptions {
  std::string out = "bench";
  std::uint64_t seed = 1;
  std::optional<int> image_width_px;  // absent: the default of the bench
};

// Sets what a bench shares with the others.
template <class Options>
void take_common(const BenchOptions& common, const CommandContext& context, Options& options) {
  options.seed = common.seed;
  options.image_width_px = common.image_width_px.value_or(options.image_width_px);
  options.progress = context.progress;
}

// Adds an option whose value is given by its name in `values`; --help lists the names alone.
// `value` must outlive the command.
template <class Value>
void add_named_option(CLI::App& command, const std::string& option, Value& value,
                      const std::map<std::string, Value>& values, const std::string& description) {
  command
      .add_option_function<std::string>(
          option, [&value, values](const std::string& name) { value = values.at(name); },
          description)
      ->check(CLI::IsMember(values));
}

// Prints tables and writes CSV files and plots (PNG and SVG) to a folder.
class BenchFiles {
 public:
  BenchFiles(const BenchOptions& options, CommandContext& context);
  void table(const std::string& text);
  void csv(const std::string& name, const std::string& text);
  // To be called after csv(): if gnuplot is missing, the tables are written nevertheless.
  void plot(const std::string& name, const Plot& plot);

 private:
  std::string path(const std::string& name);
  std::string out_;
  CommandContext& context_;
};

using SharedBenchOptions = std::shared_ptr<BenchOptions>;
void add_noise_bench(CLI::App& bench, CommandContext& context, const SharedBenchOptions& common);
void add_rig_bench(CLI::App& bench, CommandContext& context, const SharedBenchOptions& common);
void add_plan_bench(CLI::App& bench, CommandContext& context, const SharedBenchOptions& common);
void add_paper_bench(CLI::App& bench, CommandContext& context, const SharedBenchOptions& common);
void add_patches_bench(CLI::App& bench, CommandContext& context, const SharedBenchOptions& common);
void add_transport_bench(CLI::App& bench, CommandContext& context,
                         const SharedBenchOptions& common);
void add_atlas_bench(CLI::App& bench, CommandContext& context, const SharedBenchOptions& common);
void add_models_bench(CLI::App& bench, CommandContext& context, const SharedBenchOptions& common);
void add_materials_bench(CLI::App& bench, CommandContext& context,
                         const SharedBenchOptions& common);
void add_shots_bench(CLI::App& bench, CommandContext& context, const SharedBenchOptions& common);
void add_deviations_bench(CLI::App& bench, CommandContext& context,
                          const SharedBenchOptions& common);
void add_silicones_bench(CLI::App& bench, CommandContext& context,
                         const SharedBenchOptions& common);
void add_sums_bench(CLI::App& bench, CommandContext& context, const SharedBenchOptions& common);

}  // namespace scattermeter::apps
