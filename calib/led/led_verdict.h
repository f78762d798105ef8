// Whether an LED's fit may be trusted, and what to tell whoever took its shots.
#pragma once

#include <string>

#include <Eigen/Core>

#include "calib/led/led_fit.h"
#include "calib/led/led_scene.h"
#include "calib/led/led_solver.h"

namespace scattermeter::calib {

// Fills distance_mm, distance_std_mm and distance_power_correlation of a fit that has its LED, its
// uncertainty and its residuals, then sets status kOk, with warnings, or kIllConditioned (see
// LedStatus), with a message.
void judge_led(const LedScene& scene, const LedSolve& what, const LedFitOptions& options,
               LedFit& fit);

// Sets the status and its message, and clears the warnings.
void refuse_led(LedFit& fit, LedStatus status, const std::string& message);

// The unknowns that carry at least 5 % of a combination `v` (not 0) of them, by name and in order:
// "position, power". v has kLedParameters entries, then any number for ambient light and nuisances.
std::string combination_name(const Eigen::VectorXd& v);

// Shots that would determine more: "add spheres, ...".
std::string layout_advice(const LedSolve& what);

}  // namespace scattermeter::calib
