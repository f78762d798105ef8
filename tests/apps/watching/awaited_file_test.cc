#include "apps/watching/awaited_file.h"

#include <gtest/gtest.h>

namespace scattermeter::apps {
namespace {

TEST(AwaitedFile, BoardThenEveryExposure) {
  Rig rig;
  rig.scene.shots.resize(2);
  rig.scene.shots[0].file = "a.dng";
  rig.scene.shots[0].more_files = {"a2.dng"};
  rig.scene.shots[1].file = "b.dng";
  EXPECT_EQ(awaited_files(rig).size(), 3U);
  rig.pose.board_shot = "board.dng";
  const std::vector<AwaitedFile> files = awaited_files(rig);
  ASSERT_EQ(files.size(), 4U);
  EXPECT_EQ(files[0].rig_name, "board.dng");
  EXPECT_EQ(files[0].shot_idx, AwaitedFile::kBoard);
  EXPECT_EQ(files[2].rig_name, "a2.dng");
  EXPECT_EQ(files[2].shot_idx, 0U);
  EXPECT_EQ(files[2].exposure_idx, 1U);
  EXPECT_EQ(files[3].rig_name, "b.dng");
  EXPECT_EQ(files[3].shot_idx, 1U);
  for (const AwaitedFile& f : files) EXPECT_EQ(f.taken_from, "");
}

}  // namespace
}  // namespace scattermeter::apps
