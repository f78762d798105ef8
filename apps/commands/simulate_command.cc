#include <algorithm>
#include <cstdint>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "apps/commands/commands.h"
#include "apps/simulation/simulate.h"

namespace scattermeter::apps {
namespace {

// What would make a shot useless is told as soon as it is made.
std::string level_notes(const std::vector<SimulatedLevel>& levels) {
  constexpr double kDark = 0.01;
  std::string out;
  for (const SimulatedLevel& level : levels) {
    if (level.brightest_share > 1.0) {
      out += fmt::format(
          "note: {}: clips: the object's brightest sample is at {:.3g} times the range, exposed "
          "for {:.2g} s\n",
          level.file, level.brightest_share, level.exposure_s);
    } else if (level.brightest_share < kDark) {
      out += fmt::format(
          "note: {}: is dark: the object's brightest sample is at {:.2g} % of the range, exposed "
          "for {:.2g} s; see the lights' positions, axes and intensities, and the exposure time\n",
          level.file, 100.0 * level.brightest_share, level.exposure_s);
    }
  }
  return out;
}

std::string exposure_text(const std::vector<SimulatedLevel>& levels) {
  if (levels.empty()) return "";
  const auto [least, most] = std::minmax_element(
      levels.begin(), levels.end(),
      [](const SimulatedLevel& a, const SimulatedLevel& b) { return a.exposure_s < b.exposure_s; });
  return least->exposure_s < most->exposure_s
             ? fmt::format(", exposed for {:.2g} to {:.2g} s", least->exposure_s, most->exposure_s)
             : fmt::format(", exposed for {:.2g} s", least->exposure_s);
}

}  // namespace

void add_simulate_command(CLI::App& app, CommandContext& context) {
  struct Options {
    std::string rig, out, transport = "dipole", noise = "on", what = "all", format = "dng";
    SimulateOptions simulate;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "simulate",
      "Make the raw shots that a rig would have taken of its truth materials.\n"
      "The rig needs truth.materials; the exposure time is chosen if the rig has none.\n"
      "Started as `mpirun -n N scattermeter simulate ... --transport volume` (if built with Open "
      "MPI), N processes share the light paths; the digits are the same for any N.");
  command->add_option("RIG", options->rig, "rig file (YAML)")->required();
  command->add_option("--out", options->out, "folder for the raws; created if missing")->required();
  command
      ->add_option("--transport", options->transport,
                   "how light propagates in the material: dipole, or volume (Monte Carlo in the "
                   "actual shape of the body)")
      ->check(CLI::IsMember({"dipole", "volume"}))
      ->capture_default_str();
  command->add_option("--seed", options->simulate.seed, "seed of the noise and of the Monte Carlo")
      ->capture_default_str();
  command
      ->add_option("--paths", options->simulate.transport.paths,
                   "volume: light paths for each light of a shot and channel")
      ->check(CLI::Range(std::int64_t{64}, std::int64_t{1'000'000'000'000}))
      ->capture_default_str();
  command->add_option("--noise", options->noise, "on: photon and read noise; off: rounding only")
      ->check(CLI::IsMember({"on", "off"}))
      ->capture_default_str();
  command
      ->add_option("--what", options->what,
                   "scene: the shots of the objects; calibration: those of the rig's calibration")
      ->check(CLI::IsMember({"all", "scene", "calibration"}))
      ->capture_default_str();
  command
      ->add_option("--raw-format", options->format,
                   "dng: 12-bit DNG; nef: compressed NEF as of a Nikon D80, with its lossy tone "
                   "curve. The files have the names in the rig")
      ->check(CLI::IsMember({"dng", "nef"}))
      ->capture_default_str();
  run_if_named(
      *command, context,
      [options, &context] {
        capture::require_output_folder(options->out);
        options->simulate.noise = options->noise == "on";
        options->simulate.format =
            options->format == "nef" ? capture::RawFormat::kNef : capture::RawFormat::kDng;
        options->simulate.scene = options->what != "calibration";
        options->simulate.calibration = options->what != "scene";
        options->simulate.transport.peers = context.peers;
        options->simulate.transport.volume = options->transport == "volume";
        const bool is_first = context.peers == nullptr || context.peers->rank() == 0;
        const SimulatedShots made =
            simulate(read_rig(options->rig), options->out, options->simulate, context.progress);
        if (made.paths.empty() && is_first) {
          throw InputError(options->rig, "names no shots of --what " + options->what);
        }
        context.err << level_notes(made.levels);
        if (!context.quiet) {
          context.out << made.paths.size() << " shots written to " << options->out
                      << exposure_text(made.levels) << "\n";
          if (options->simulate.transport.volume) {
            context.out << fmt::format(
                "Monte Carlo error of the light of a patch: {:.2g} % (median over the patches, of "
                "the "
                "worst shot and channel)\n",
                100.0 * made.monte_carlo_std);
          }
        }
        return 0;
      },
      true);
}

}  // namespace scattermeter::apps
