#include "apps/report/overlay_picture.h"

#include <gtest/gtest.h>

#include "apps/rig/open_objects.h"
#include "apps/simulation/bodies_rig.h"
#include "apps/simulation/plastics_rig.h"
#include "apps/simulation/virtual_shots.h"
#include "calib/pose/shot_pose.h"
#include "capture/files/pending_file.h"
#include "tests/fixtures/apps/small_rig.h"
#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::apps {
namespace {

// The edges lie where the picture changes: a line's inner side is lit, its outer side dark.
TEST(OverlayPicture, ShowsTheEdgesOfTheShot) {
  SmallRig files;
  files.keep_shots("PE_pyramid_1");
  const Rig rig = read_rig(files.rig());
  const ObjectScenes scenes = open_objects(rig);
  const VirtualShots shots(rig, scenes, {.noise = true});
  const CameraView view{rig.scene.camera.intrinsics,
                        calib::pose_from_points(rig.scene, rig.pose).camera_from_world};
  const RayScene& scene = *scenes.at("pyramid").rays;
  const std::vector<OverlayLine> lines = edge_lines(view, scene);
  ASSERT_GT(lines.size(), 20U);
  const capture::RawFrame frame = shots.frame(0, 1);
  OverlayOptions options;
  options.crop = crop_around(lines, frame.width_px, frame.height_px);
  EXPECT_GT(options.crop.x0, 100);
  EXPECT_LT(options.crop.x1, 400);
  const auto png = overlay_png(frame, lines, {{{241.8, 161.2}, {255, 0, 0}}}, options);
  ASSERT_GT(png.size(), 1000U);
  EXPECT_EQ(png[1], 'P');
  const TemporaryFolder folder;
  capture::write_text_file(folder / "overlay.png",
                           {reinterpret_cast<const char*>(png.data()), png.size()});
  EXPECT_EQ(slurp(folder / "overlay.png").size(), png.size());
  // The whole shot, made smaller.
  options.crop = {0, 0, 0, 0};
  options.max_width_px = 100;
  EXPECT_LT(overlay_png(frame, lines, {}, options).size(), png.size());
}

}  // namespace
}  // namespace scattermeter::apps
