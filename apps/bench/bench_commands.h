// What the benches of the command line share; one declaration per bench.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <ostream>
#include <string>

#include "apps/commands/commands.h"
#include "apps/report/plot.h"

namespace scattermeter::apps {

// What every bench takes.
struct BenchOptions {
  std::string out = "bench";
  std::uint64_t seed = 1;
  std::optional<int> image_width_px;  // absent: the bench's own
};

// Prints tables, writes CSV and pictures (PNG and SVG) to the folder.
class BenchFiles {
 public:
  BenchFiles(const BenchOptions& options, CommandContext& context);
  void table(const std::string& text);
  void csv(const std::string& name, const std::string& text);
  // Tables come first: they are there even where no picture can be drawn.
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
void add_models_bench(CLI::App& bench, CommandContext& context, const SharedBenchOptions& common);
void add_materials_bench(CLI::App& bench, CommandContext& context,
                         const SharedBenchOptions& common);
void add_shots_bench(CLI::App& bench, CommandContext& context, const SharedBenchOptions& common);
void add_sums_bench(CLI::App& bench, CommandContext& context, const SharedBenchOptions& common);

}  // namespace scattermeter::apps
