#include "core/mesh/triangle_mesh.h"

#include <limits>
#include <stdexcept>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/core/boxes.h"

namespace scattermeter {
namespace {

using ::testing::HasSubstr;

TEST(TriangleMesh, GoodMeshesHaveNoProblem) {
  EXPECT_EQ(mesh_problem(test_support::make_cube()), "");
  EXPECT_EQ(mesh_problem(test_support::make_pyramid(8, 13)), "");
}

TEST(TriangleMesh, VolumeAndBoundsOfTheCube) {
  TriangleMesh cube = test_support::make_cube();
  EXPECT_DOUBLE_EQ(signed_volume_mm3(cube), 8000.0);
  EXPECT_EQ(bounds(cube).size_mm(), Eigen::Vector3d(20, 20, 20));
  EXPECT_EQ(bounds(cube).center_mm(), Eigen::Vector3d(0, 0, 10));
  // A kilometre off, the volume keeps its digits.
  for (auto& v : cube.vertices_mm) v += Eigen::Vector3d(1e6, -1e6, 1e6);
  EXPECT_NEAR(signed_volume_mm3(cube), 8000.0, 1e-6);
}

TEST(TriangleMesh, AreaVectorsOfAClosedMeshCancel) {
  const TriangleMesh mesh = test_support::make_pyramid(8, 13);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) sum += area_vector_mm2(mesh, t);
  EXPECT_LT(sum.norm(), 1e-12);
  EXPECT_EQ(area_vector_mm2(test_support::make_cube(), 0), Eigen::Vector3d(0, 0, -200));
}

TEST(TriangleMesh, VerticesRepeatedPerFaceAreOne) {
  const TriangleMesh cube = test_support::make_cube();
  TriangleMesh soup;
  for (const auto& t : cube.triangles) {
    const int n = static_cast<int>(soup.vertices_mm.size());
    for (int i : t) soup.vertices_mm.push_back(cube.vertices_mm[static_cast<std::size_t>(i)]);
    soup.triangles.push_back({n, n + 1, n + 2});
  }
  EXPECT_EQ(merge_equal_vertices(soup).vertices_mm.size(), 8U);
  EXPECT_EQ(mesh_problem(soup), "");
}

TEST(TriangleMesh, NamesWhatIsWrong) {
  TriangleMesh mesh = test_support::make_cube();
  mesh.triangles.pop_back();
  EXPECT_THAT(mesh_problem(mesh), HasSubstr("open"));

  mesh = test_support::make_cube();
  std::swap(mesh.triangles[0][0], mesh.triangles[0][1]);
  EXPECT_THAT(mesh_problem(mesh), HasSubstr("consistently oriented"));

  mesh = test_support::make_cube();
  for (auto& t : mesh.triangles) std::swap(t[0], t[1]);
  EXPECT_THAT(mesh_problem(mesh), HasSubstr("inwards"));

  mesh = test_support::make_cube();
  for (auto& v : mesh.vertices_mm) v *= 1e-3;
  EXPECT_THAT(mesh_problem(mesh), HasSubstr("metres"));
  for (auto& v : mesh.vertices_mm) v *= 1e6;
  EXPECT_THAT(mesh_problem(mesh), HasSubstr("micrometres"));

  mesh = test_support::make_cube();
  mesh.vertices_mm[3].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(mesh_problem(mesh), HasSubstr("not finite"));

  mesh = test_support::make_cube();
  mesh.triangles[4][1] = 8;
  EXPECT_THAT(mesh_problem(mesh), HasSubstr("vertex 8 of 8"));

  mesh = test_support::make_cube();
  mesh.triangles.push_back({0, 1, 1});
  EXPECT_THAT(mesh_problem(mesh), HasSubstr("no area"));

  mesh = test_support::make_cube();
  const auto same = mesh.triangles;
  mesh.triangles.insert(mesh.triangles.end(), same.begin(), same.end());
  EXPECT_THAT(mesh_problem(mesh), HasSubstr("more than two faces"));

  EXPECT_THAT(mesh_problem({}), HasSubstr("no faces"));
  EXPECT_THROW(bounds({}), std::invalid_argument);
}

TEST(TriangleMesh, CutFinerIsTheSameSurface) {
  const TriangleMesh cube = test_support::make_cube();
  const TriangleMesh fine = cut_finer(cube, 3);
  EXPECT_EQ(fine.triangles.size(), 64 * cube.triangles.size());
  EXPECT_EQ(mesh_problem(fine), "");
  EXPECT_NEAR(signed_volume_mm3(fine), signed_volume_mm3(cube), 1e-9);
}

TEST(Box3d, KnowsLinesBesideIt) {
  const Box3d box{{0, 0, 0}, {1, 2, 3}};
  EXPECT_TRUE(box.is_beside({1.2, 0, 0}, {1.1, 2, 3}, 0.05));
  EXPECT_FALSE(box.is_beside({1.2, 0, 0}, {1.1, 2, 3}, 0.15));
  EXPECT_TRUE(box.is_beside({0.5, 0, -1}, {0.5, 0, -2}, 0.5));
  EXPECT_FALSE(box.is_beside({-1, 1, 1}, {2, 1, 1}, 0.0));
  EXPECT_FALSE(box.is_beside({0.5, 1, 1}, {9, 9, 9}, 0.0));  // one end inside
}

}  // namespace
}  // namespace scattermeter
