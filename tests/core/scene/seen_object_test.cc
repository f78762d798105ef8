#include "core/scene/seen_object.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/base/input_error.h"
#include "tests/fixtures/core/cube_scene.h"

namespace scattermeter {
namespace {

TEST(SeenObject, RowsLieOnFacetsThatFaceTheCamera) {
  const Scene scene = test_support::cube_scene();
  const ObjectScenes objects = test_support::cube_objects(scene);
  const LitObjects lit(scene, objects, 2.0, 0.0);
  const SharedView view = see_all(scene, objects, lit, test_support::cube_pose());
  const SeenObject& seen = *view.objects.at("cube");
  EXPECT_LT((seen.camera_center_mm - Eigen::Vector3d(0, -120, 120)).norm(), 1e-9);
  // The top and the front of the cube: two faces of 100 patches of 2 mm, cut in triangles.
  ASSERT_GT(seen.map.patch_of_row.size(), 100U);
  ASSERT_EQ(seen.sites.size(), seen.map.patch_of_row.size());
  for (std::size_t row = 0; row < seen.sites.size(); ++row) {
    const Eigen::Vector3d& normal = seen.patches->normal(seen.map.patch_of_row[row]);
    const Eigen::Vector3d& site_mm = seen.sites[row].center_mm;
    EXPECT_GT(normal.dot(seen.camera_center_mm - site_mm), 0.0);
    const bool on_top = std::abs(site_mm.z() - 20.0) < 1e-4;
    const bool in_front = std::abs(site_mm.y() + 10.0) < 1e-4;
    EXPECT_TRUE(on_top || in_front) << site_mm.transpose();
  }
}

// The front is seen at a cosine of 0.1, the top at 0.99. Displaced by 0.5 mm, what is seen of the
// front moves by 5 mm, more than two patches of 2 mm; by 0.2 mm, by 2 mm.
TEST(SeenObject, FacesWhoseSeenPointsAreUncertainHaveNoRows) {
  const auto sees_front = [](double position_std_mm) {
    Scene scene = test_support::cube_scene();
    scene.objects.at(0).position_std_mm = position_std_mm;
    const ObjectScenes objects = test_support::cube_objects(scene);
    const LitObjects lit(scene, objects, 2.0, 0.0);
    PoseResult pose = test_support::cube_pose();
    pose.camera_from_world = look_at({0, -27, 180}, {0, 0, 10}, {0, 1, 0});
    const SharedView view = see_all(scene, objects, lit, pose);
    const SeenObject& seen = *view.objects.at("cube");
    EXPECT_GT(seen.sites.size(), 50U);
    return std::any_of(seen.sites.begin(), seen.sites.end(), [](const ExitSite& site) {
      return std::abs(site.center_mm.y() + 10.0) < 1e-4;
    });
  };
  EXPECT_TRUE(sees_front(0.0));
  EXPECT_TRUE(sees_front(0.2));
  EXPECT_FALSE(sees_front(0.5));
}

TEST(SeenObject, RefusesAnObjectOutOfView) {
  const Scene scene = test_support::cube_scene();
  const ObjectScenes objects = test_support::cube_objects(scene);
  const LitObjects lit(scene, objects, 2.0, 0.0);
  PoseResult away = test_support::cube_pose();
  away.camera_from_world = look_at({0, -120, 120}, {0, -240, 230}, {0, 0, 1});
  EXPECT_THROW(see_all(scene, objects, lit, away), InputError);
}

}  // namespace
}  // namespace scattermeter
