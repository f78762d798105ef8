#include "calib/led/led_solver.h"

#include <cmath>

#include <gtest/gtest.h>

#include "calib/led/cell_model.h"
#include "tests/fixtures/calib/led_scenes.h"

namespace scattermeter::calib {
namespace {

LedSolve everything(const LedScene& scene) {
  LedSolve what;
  what.use_highlight.assign(scene.highlights.size(), true);
  what.use_cell.assign(scene.cells.size(), true);
  what.free.fill(true);
  return what;
}

// The information is J^T S^-1 J: its LED part against central differences of the prediction.
TEST(LedSolver, InformationIsThatOfTheDerivatives) {
  LedSceneOptions options;
  options.spheres = false;
  const LedScene scene = draw_led_scene(true_led(), options, 2);
  const LedSolution solution = solve_led(scene, true_led(), everything(scene));
  ASSERT_TRUE(solution.converged);
  // At the solution the tangents belong to an axis that moved by less than 1e-6 since.
  const auto predict = [&](Eigen::Index k, double step) {
    Led led = solution.led;
    if (k < 3) led.position_mm[k] += step;
    if (k == 3 || k == 4) {
      led.axis =
          (led.axis + step * solution.tangents[static_cast<std::size_t>(k - 3)]).normalized();
    }
    if (k == 5) led.exponent += step;
    if (k > 5) led.intensity_W_per_sr[k - 6] *= std::exp(step);
    Eigen::VectorXd out(static_cast<Eigen::Index>(scene.cells.size()));
    for (std::size_t i = 0; i < scene.cells.size(); ++i) {
      out[static_cast<Eigen::Index>(i)] =
          cell_radiance(scene, scene.cells[i], led) / scene.cells[i].std_W_per_mm2_sr;
    }
    return out;
  };
  Eigen::MatrixXd j(static_cast<Eigen::Index>(scene.cells.size()), kLedParameters);
  for (Eigen::Index k = 0; k < kLedParameters; ++k) {
    const double step = 1e-5;
    j.col(k) = (predict(k, step) - predict(k, -step)) / (2.0 * step);
  }
  const LedMatrix numeric = j.transpose() * j;
  const LedMatrix found = solution.cell_information.topLeftCorner<9, 9>();
  for (Eigen::Index a = 0; a < 9; ++a) {
    for (Eigen::Index b = 0; b < 9; ++b) {
      // The nuisances are at their best there and at 0 here: a part in a thousand.
      EXPECT_NEAR(found(a, b), numeric(a, b), 2e-2 * std::sqrt(numeric(a, a) * numeric(b, b)))
          << a << " " << b;
    }
  }
}

TEST(LedSolver, WhatIsHeldStays) {
  const LedScene scene = draw_led_scene(true_led(), {}, 3);
  LedSolve what = everything(scene);
  what.free[kLedExponent] = false;
  Led start = true_led();
  start.exponent = 1.1;
  const LedSolution solution = solve_led(scene, start, what);
  ASSERT_TRUE(solution.converged);
  EXPECT_DOUBLE_EQ(solution.led.exponent, 1.1);
  EXPECT_EQ(solution.cell_information.row(kLedExponent).norm(), 0.0);
}

}  // namespace
}  // namespace scattermeter::calib
