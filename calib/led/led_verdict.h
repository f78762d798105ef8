// Verdict on the fit of an LED: its status, warnings and advice to the user.
#pragma once

#include <string>

#include <Eigen/Core>

#include "calib/led/led_fit.h"
#include "calib/led/led_scene.h"
#include "calib/led/led_solver.h"

namespace scattermeter::calib {

// Fills distance_mm, distance_std_mm and distance_power_correlation of a fit whose LED, uncertainty
// and residuals are set, then sets the status to kOk, with warnings, or to kIllConditioned (see
// LedStatus), with a message.
void judge_led(const LedScene& scene, const LedSolve& what, const LedFitOptions& options,
               LedFit& fit);

// Sets the status and its message, and clears the warnings.
void refuse_led(LedFit& fit, LedStatus status, const std::string& message);

// The names, in order, of the unknowns with a share of at least 5 % in a combination `v` (not 0) of
// them: "position, power". v has kLedParameters entries, then any number for ambient light and
// nuisances.
std::string combination_name(const Eigen::VectorXd& v);

// Advice on shots that would determine more: "add spheres, ...".
std::string layout_advice(const LedSolve& what);

}  // namespace scattermeter::calib
