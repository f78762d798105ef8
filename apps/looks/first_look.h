// Findings of the looks before any fit, in the order of probability, and the results that they
// refuse.
#pragma once

#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "apps/looks/finding.h"
#include "apps/looks/light_look.h"
#include "calib/pose/outline_causes.h"
#include "core/estimation/estimation.h"
#include "core/scene/observed_shot.h"
#include "core/scene/scene.h"

namespace scattermeter::apps {

// What some shots show before any fit.
struct FirstLook {
  std::vector<ObservedShot> shots;     // as opened; they refer to rig and instrument
  std::vector<Finding> findings;       // the most probable first
  std::vector<std::string> notes;      // for the user
  std::vector<ShotLikeness> likeness;  // by shot; empty unless Instrument::look() made it
  // Absent where the camera's pose is each shot's own, and where no outline was seen.
  std::optional<calib::OutlineDiagnosis> outline;
};

// The findings of the outlines, then those of the light that are not their consequences: the light
// of a shot whose outline is wrong is judged only where the lights themselves are at fault.
std::vector<Finding> in_order(std::vector<Finding> of_outlines, std::vector<Finding> of_light);

// The shots that findings are about, as indices into the scene's.
std::set<std::size_t> shots_of(const std::vector<Finding>& findings);

// Adds the findings that concern a channel's shots to the reasons of its result, at most two: the
// first is the most probable.
void refuse(const Scene& scene, const std::vector<Finding>& findings, Estimation& estimation);
// The estimate of all channels but those that the findings refuse.
std::vector<ChannelResult> estimate_others(const Scene& scene, LitObjects& lit,
                                           const std::vector<ObservedShot>& shots,
                                           const std::vector<Finding>& findings,
                                           const EstimateOptions& options, KeptLight& kept,
                                           Stopwatch& watch, Progress* progress);

// Whether the result was refused by its fit, not for being dark or clipped.
bool is_fitted_and_refused(const ChannelResult& result);
// Whether the shot of this name is one of the result's.
bool uses(const ChannelResult& result, const std::string& file);
void add_first_reason(std::string reason, ChannelResult& result);

// Makes a bright background of a result's shots the first reason where the fit refused it.
void tell_of_background(const std::vector<ObservedShot>& shots,
                        std::vector<ChannelResult>& results);

// Makes the outlines' departure (closer_look.h) the first reason of the results that the fit
// refused, unless it is "".
void tell_of_outline(const std::string& departure, std::vector<ChannelResult>& results);

}  // namespace scattermeter::apps
