// Whether a shot that was just taken will do, or must be taken again.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "apps/looks/first_look.h"
#include "core/scene/observed_shot.h"

namespace scattermeter::apps {

struct ShotVerdict {
  // Sentences with the next step, the most probable cause first. Empty: the shot will do.
  std::vector<std::string> problems;
  // Exposure, sharpness and outline in figures.
  std::vector<std::string> remarks;
  // The lights that the image looks like, if not those of the rig; sorted.
  std::vector<std::string> seen_lights;
  bool is_accepted() const { return problems.empty(); }
};

// What a shot of one object is judged by.
struct LookedAtShot {
  const FirstLook& look;      // of this shot alone
  double range_counts = 0;    // above black, at which the sensor clips
  double fx_px = 0;           // focal length of the camera
  std::string earlier;        // an accepted shot of the same object; "": none
  double earlier_off_px = 0;  // how far its outline was off
};

// How far the outline is off, px; 0 where it is not looked at.
double outline_off_px(const FirstLook& look);

// Exposure alone, which does not depend on where exactly the object stands.
ShotVerdict judge_exposure(const ObservedShot& shot, double range_counts);

// What is too bright or too dark shows nothing else, and is judged by that alone.
ShotVerdict judge(const LookedAtShot& shot);

}  // namespace scattermeter::apps
