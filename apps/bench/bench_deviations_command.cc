#include <memory>
#include <string>

#include "apps/bench/bench_command.h"
#include "apps/deviations/deviation_report.h"
#include "apps/deviations/deviation_runs.h"
#include "capture/files/pending_file.h"

namespace scattermeter::apps {
namespace {

struct DeviationArguments {
  DeviationOptions options;
  bool all = false, list = false, each = false;
  std::string csv;
};

void declare(CLI::App& command, DeviationArguments& a) {
  DeviationOptions& o = a.options;
  command.add_option("--runs", o.runs, "number of rigs drawn, evenly from the kinds and sizes")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  command.add_flag("--all", a.all,
                   "every kind, size, body, number of LEDs and rendering once (takes hours)");
  command.add_option("--kind", o.kinds, "only this kind of deviation (may be repeated)")
      ->check([](const std::string& name) {
        try {
          deviation_named(name);
          return std::string();
        } catch (const std::invalid_argument& e) {
          return std::string(e.what());
        }
      });
  add_named_option(command, "--rendering", o.rendering,
                   {{"dipole", DeviationRendering::kDipole},
                    {"volume", DeviationRendering::kVolume},
                    {"both", DeviationRendering::kBoth}},
                   "shots rendered by the dipole and measured by it, by volume and transport, or "
                   "both");
  command
      .add_option("--rendered-paths", o.rendered_paths,
                  "light paths of a volume rendering, for each light and channel")
      ->check(CLI::Range(std::int64_t{10'000}, std::int64_t{1'000'000'000'000}))
      ->capture_default_str();
  command
      .add_option("--measured-paths", o.measured_paths,
                  "most light paths of measuring by transport, for each light and view")
      ->check(CLI::Range(std::int64_t{300'000}, std::int64_t{1'000'000'000'000}))
      ->capture_default_str();
  command.add_option("--csv", a.csv, "file for the answers one by one (default: none)");
  command.add_option("--body", o.bodies, "only this body (may be repeated)")
      ->check(CLI::IsMember({"cube", "pyramid", "sphere"}));
  command.add_option("--size", o.sizes, "only this size, from 0 (may be repeated)")
      ->check(CLI::Range(0, 9));
  command.add_option("--leds", o.leds, "only this number of LEDs")->check(CLI::Range(1, 2));
  command
      .add_option("--run-seed", o.run_seed,
                  "of every run, as in the CSV: to repeat one. Each of the rigs selected runs once")
      ->excludes("--runs");
  command.add_flag("--each", a.each, "print every answer, not only those that are wrong");
  command.add_flag("--list", a.list, "only list the kinds of deviation");
}

}  // namespace

void add_deviations_bench(CLI::App& bench, CommandContext& context,
                          const SharedBenchOptions& common) {
  const auto a = std::make_shared<DeviationArguments>();
  CLI::App* command = bench.add_subcommand(
      "deviations",
      "Shots of rigs that deviate in one thing from what their file says: displaced meshes, stray "
      "light, LEDs elsewhere, ...\n"
      "Prints for each kind and size how many answers are wrong and yet given as ok (off by more "
      "than three stated deviations and by 1 % in sigma_s' or 5 % in sigma_a), how many of these "
      "say that they rest on the cause (rests_on in result.json), how many are given, how many "
      "refusals name the cause, and how many 95 % intervals hold the truth; and, for rigs within "
      "what is stated, what widens the stated deviations. The kind \"rig drawn as stated\" "
      "deviates in everything at once, by draws from the stated deviations.");
  declare(*command, *a);
  run_if_named(*command, context, [a, common, &context] {
    if (a->list) {
      context.out << deviation_list();
      return 0;
    }
    take_common(*common, context, a->options);
    if (a->all || a->options.run_seed) a->options.runs = 0;
    a->options.on_result = [&](const DeviationResult& result) {
      const bool wrong = result.judged.verdict == DeviationVerdict::kWrongOk;
      if (!context.quiet && (wrong || a->each)) context.out << deviation_line(result) << std::flush;
    };
    const std::vector<DeviationResult> results = bench_deviations(a->options);
    if (!context.quiet) context.out << deviation_table(results) << deviation_budget_table(results);
    if (!a->csv.empty()) capture::write_text_file(a->csv, deviation_csv(results));
    return 0;
  });
}

}  // namespace scattermeter::apps
