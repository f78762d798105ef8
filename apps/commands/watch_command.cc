#include <chrono>
#include <filesystem>
#include <memory>
#include <ostream>
#include <thread>

#include <fmt/core.h>
#include <fmt/format.h>

#include "apps/commands/commands.h"
#include "apps/pages/watch_page.h"
#include "apps/report/shot_picture.h"
#include "apps/rig/rig.h"
#include "apps/rig/rig_led_agreement.h"
#include "apps/watching/watched_folder.h"
#include "apps/watching/watched_shots.h"
#include "capture/files/pending_file.h"

namespace scattermeter::apps {
namespace {

namespace fs = std::filesystem;

struct WatchArguments {
  std::string folder, rig, out = "watched";
  double interval_s = 0.5;
  bool once = false;
};

class Watching {
 public:
  Watching(const WatchArguments& a, const Rig& rig, CommandContext& context)
      : a_(a), context_(context), folder_(a.folder), shots_(rig, a.out, shot_thumbnail) {
    state_.title = fmt::format("{}, rig {}; this page reloads itself", a.folder, rig.path);
  }

  int run() {
    say("watching " + a_.folder + ", page: " + page(), "dim");
    say_next();
    for (int idle_looks = 0;;) {
      const std::vector<FolderNews> news = folder_.look();
      for (const FolderNews& n : news) tell(n);
      if (shots_.still_awaited() == 0) break;
      // A file is complete with the second look that finds it.
      idle_looks = news.empty() ? idle_looks + 1 : 0;
      if (a_.once && idle_looks > 2) break;
      std::this_thread::sleep_for(std::chrono::duration<double>(a_.interval_s));
    }
    if (shots_.still_awaited() > 0) {
      const std::size_t n = shots_.still_awaited();
      say(fmt::format("{} still awaited", n == 1 ? "1 shot is" : fmt::format("{} shots are", n)),
          "dim");
      return 1;
    }
    say(fmt::format("all shots are there; next: scattermeter measure {} --rig {} --out {}",
                    shots_.shots_folder(), a_.rig, a_.out),
        "pass");
    return 0;
  }

 private:
  std::string page() const { return (fs::path(a_.out) / "watch.html").string(); }

  void say(const std::string& text, const std::string& css_class) {
    state_.lines.push_back({text, css_class});
    state_.files = shots_.files();
    state_.next = shots_.next();
    capture::write_text_file(page(), watch_page(state_));
    if (!context_.quiet) context_.out << text << std::endl;
  }

  void say_next() {
    if (shots_.still_awaited() > 0) say("next: " + shots_.next(), "");
  }

  // Whether the rig awaits a file of this name, and the same contents were not accepted before.
  bool is_to_be_taken(const std::string& name, const std::string& same_contents) const {
    bool is_awaited = false;
    for (const AwaitedFile& f : shots_.files()) {
      if (f.taken_from == same_contents) return false;
      is_awaited = is_awaited || (f.rig_name == name && f.taken_from.empty());
    }
    return is_awaited;
  }

  void tell(const FolderNews& n) {
    const std::string path = folder_.path_of(n.name);
    if (n.event == FolderEvent::kComplete) {
      take(n.name, path);
    } else if (n.event == FolderEvent::kRenamed) {
      shots_.rename(folder_.path_of(n.other), path);
      say(fmt::format("{}: {} under another name", n.name, n.other), "dim");
      if (is_to_be_taken(n.name, path)) take(n.name, path);
    } else if (n.event == FolderEvent::kDoubled) {
      // A rejected file may be given its right name by copying it.
      if (is_to_be_taken(n.name, folder_.path_of(n.other))) return take(n.name, path);
      say(fmt::format("{}: the same as {}, left out", n.name, n.other), "dim");
    } else if (const std::string shot = shots_.keep(path); !shot.empty()) {
      say(fmt::format("{}: has been removed; the copy accepted as {} is kept (to replace it, put a "
                      "file of that name into the folder)",
                      n.name, shot),
          "dim");
    }
  }

  void take(const std::string& name, const std::string& path) {
    const auto start = std::chrono::steady_clock::now();
    std::optional<TakenShot> taken;
    try {
      taken = shots_.take(path);
    } catch (const InputError& e) {
      // Half-written files are complete again when they change.
      say(fmt::format("{}: not taken: {}", name, e.what()), "fail");
      return;
    }
    if (!taken) {
      say(name + ": of the calibrations, not looked at", "dim");
      return;
    }
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const ShotVerdict& verdict = taken->verdict;
    if (!verdict.is_accepted()) {
      for (const std::string& problem : verdict.problems) {
        say(fmt::format("{}: TAKE AGAIN: {}", name, problem), "fail");
      }
      state_.rejected.push_back(*taken);
    } else {
      say(fmt::format("{}: taken as {} ({:.1f} s){}{}", name, taken->rig_name, seconds,
                      verdict.remarks.empty() ? "" : ": ",
                      fmt::format("{}", fmt::join(verdict.remarks, "; "))),
          "pass");
      state_.taken[taken->rig_name] = *taken;
      if (taken->completes_shot) answer(taken->rig_name);
    }
    say_next();
  }

  void answer(const std::string& rig_name) {
    std::optional<std::string> material = shots_.material_of(rig_name);
    if (!material) return;
    try {
      const RunningAnswer& running = state_.answers[*material] = shots_.answer(rig_name);
      for (const std::string& line : answer_lines(running)) say("  " + *material + " " + line, "");
    } catch (const InputError& e) {
      say(fmt::format("  {}: {}", *material, e.what()), "fail");
    }
  }

  const WatchArguments& a_;
  CommandContext& context_;
  WatchedFolder folder_;
  WatchedShots shots_;
  WatchState state_;
};

}  // namespace

void add_watch_command(CLI::App& app, CommandContext& context) {
  const auto a = std::make_shared<WatchArguments>();
  CLI::App* command = app.add_subcommand(
      "watch",
      "Check shots while they are being taken.\n"
      "Follows a folder that a tethering program or a card reader fills, says which shot of the "
      "rig comes next, and reports for each one that arrives whether it is usable: exposure, "
      "focus, outline, light. Files whose names are not in the rig are taken in the rig's order. "
      "Accepted shots are kept in DIR/shots under the rig's names; DIR/watch.html shows the state "
      "and reloads itself. After each shot, the result so far is printed, and what the next shot "
      "would add.\n"
      "Exit status: 0 all shots are there, 1 some are missing (--once), 2 bad input.");
  command->add_option("FOLDER", a->folder, "folder into which the shots are put")->required();
  command->add_option("--rig", a->rig, "rig file (YAML)")->required();
  command->add_option("--out", a->out, "folder for accepted shots and the page")
      ->capture_default_str();
  command->add_option("--interval", a->interval_s, "seconds between two looks at the folder")
      ->capture_default_str()
      ->check(CLI::Range(0.05, 60.0));
  command->add_flag("--once", a->once, "end when nothing new is in the folder");
  run_if_named(*command, context, [a, &context] {
    require_results_folder(a->out, a->folder);
    const Rig rig = read_rig(a->rig);
    require_radiance_of_leds(rig);
    return Watching(*a, rig, context).run();
  });
}

}  // namespace scattermeter::apps
