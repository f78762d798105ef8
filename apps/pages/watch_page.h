// The page of a session of shots being taken, which reloads itself.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "apps/watching/watched_shots.h"

namespace scattermeter::apps {

// What happened, in the order of time.
struct WatchLine {
  std::string text;
  std::string css_class;  // "pass", "fail" or "dim"
};

struct WatchState {
  std::string title;  // folder and rig
  std::vector<AwaitedFile> files;
  std::string next;                        // as WatchedShots::next()
  std::map<std::string, TakenShot> taken;  // accepted, by the rig's name
  std::vector<TakenShot> rejected;
  std::map<std::string, RunningAnswer> answers;  // by material
  std::vector<WatchLine> lines;
};

// "R 0.617 ± 0.006, 0.00118 ± 0.00009", a line for each channel: sigma_s' and sigma_a, 1/mm; or why
// the channel is refused so far. With what the next shot would leave of the relative deviations.
std::vector<std::string> answer_lines(const RunningAnswer& answer);

// Reloads every two seconds as long as something is awaited.
std::string watch_page(const WatchState& state);

}  // namespace scattermeter::apps
