#include "calib/led/led_scene.h"

#include <cmath>

#include <gtest/gtest.h>

namespace scattermeter::calib {
namespace {

LedScene two_cells_and_spheres() {
  LedScene scene;
  WhitePlane plane;
  plane.origin_mm = {1, 2, 3};
  plane.x_axis = {0, 1, 0};
  plane.y_axis = {0, 0, 1};
  scene.planes = {plane};
  ShadedCell cell;
  cell.on_plane_mm = {10, 20};
  scene.cells.push_back(cell);
  cell.on_plane_mm = {30, 40};
  cell.shot = 4;
  scene.cells.push_back(cell);
  scene.spheres = {{{0, 0, 8}, 8.0}, {{20, 0, 8}, 8.0}};
  for (const std::size_t sphere : {0U, 1U, 1U}) {
    SeenHighlight h;
    h.sphere = sphere;
    scene.highlights.push_back(h);
  }
  return scene;
}

TEST(LedScene, CountsPlaneShots) {
  EXPECT_EQ(LedScene{}.plane_shots(), 0U);
  EXPECT_EQ(two_cells_and_spheres().plane_shots(), 5U);
}

TEST(LedScene, CellsLieOnTheirPlane) {
  const LedScene scene = two_cells_and_spheres();
  EXPECT_EQ(scene.cell_mm(scene.cells[1]), Eigen::Vector3d(1, 32, 43));
}

TEST(LedScene, CenterIsThatOfTheDataInUse) {
  const LedScene scene = two_cells_and_spheres();
  EXPECT_EQ(scene.data_center_mm({true, true}, {true, true, true}), Eigen::Vector3d(1, 22, 33));
  EXPECT_EQ(scene.data_center_mm({true, false}, {true, true, true}), Eigen::Vector3d(1, 12, 23));
  // Without cells: a sphere counts once per highlight.
  EXPECT_TRUE(scene.data_center_mm({false, false}, {true, true, true})
                  .isApprox(Eigen::Vector3d(40.0 / 3.0, 0, 8)));
  EXPECT_TRUE(std::isnan(scene.data_center_mm({false, false}, {false, false, false}).x()));
}

}  // namespace
}  // namespace scattermeter::calib
