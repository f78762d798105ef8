#include "apps/watching/watched_shots.h"

#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/input_error.h"
#include "tests/fixtures/apps/small_rig.h"

namespace scattermeter::apps {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::StartsWith;

// Two shots of a cube, put into a folder under a camera's names.
class WatchedShotsTest : public ::testing::Test {
 protected:
  WatchedShotsTest() {
    files_.keep_shots("PP_cube");
    files_.simulate();
    rig_ = read_rig(files_.rig());
    shots_ = std::make_unique<WatchedShots>(rig_, files_.out(), nullptr);
    fs::create_directory(files_ / "card");
  }
  // The shot of the rig as a file of the camera.
  std::string arrived(const std::string& shot, const std::string& name) {
    const std::string path = files_ / ("card/" + name);
    fs::copy_file(files_.shots() + "/" + shot, path);
    return path;
  }
  bool is_kept(const std::string& name) const {
    return fs::exists(shots_->shots_folder() + "/" + name);
  }

  SmallRig files_;
  Rig rig_;
  std::unique_ptr<WatchedShots> shots_;
};

TEST_F(WatchedShotsTest, TakesFilesInTheRigsOrderAndAnswers) {
  EXPECT_EQ(shots_->next(), "PP_cube_1.dng: cube of PP, lit by led1");
  const auto first = shots_->take(arrived("PP_cube_1.dng", "DSC_1.dng"));
  ASSERT_TRUE(first);
  EXPECT_EQ(first->rig_name, "PP_cube_1.dng");
  EXPECT_TRUE(first->verdict.is_accepted());
  EXPECT_TRUE(is_kept("PP_cube_1.dng"));
  EXPECT_THAT(shots_->next(), StartsWith("PP_cube_2.dng"));
  const RunningAnswer one = shots_->answer("PP_cube_1.dng");
  ASSERT_EQ(one.channels.size(), 3U);
  ASSERT_EQ(one.with_next.size(), 3U);
  EXPECT_EQ(one.next, "PP_cube_2.dng");
  shots_->take(arrived("PP_cube_2.dng", "DSC_2.dng"));
  EXPECT_EQ(shots_->still_awaited(), 0U);
  const RunningAnswer both = shots_->answer("PP_cube_2.dng");
  EXPECT_TRUE(both.with_next.empty());
  for (std::size_t c = 0; c < 3; ++c) {
    // The forecast holds.
    const Quantity& s = both.channels[c].estimate.sigma_s_prime_per_mm;
    EXPECT_NEAR(s.std / s.value, one.with_next[c][0], 0.1 * one.with_next[c][0]);
  }
  EXPECT_THROW(shots_->take(arrived("PP_cube_2.dng", "DSC_3.dng")), InputError);
}

TEST_F(WatchedShotsTest, KnowsTheLightOfAShot) {
  const auto second = shots_->take(arrived("PP_cube_2.dng", "DSC_1.dng"));
  EXPECT_EQ(second->rig_name, "PP_cube_2.dng");
  EXPECT_THAT(shots_->next(), StartsWith("PP_cube_1.dng"));
  // Under the rig's own name it is a mistake.
  const auto wrong = shots_->take(arrived("PP_cube_2.dng", "PP_cube_1.dng"));
  EXPECT_FALSE(wrong->verdict.is_accepted());
  EXPECT_FALSE(is_kept("PP_cube_1.dng"));
  EXPECT_THAT(wrong->verdict.problems.back(), HasSubstr("lit by led2"));
}

TEST_F(WatchedShotsTest, FollowsNamesAndRemovals) {
  const std::string path = arrived("PP_cube_1.dng", "DSC_1.dng");
  shots_->take(path);
  const std::string other = files_ / "card/other.dng";
  fs::rename(path, other);
  shots_->rename(path, other);
  // The card is emptied: what was accepted stays, and the same name may come again.
  fs::remove(other);
  EXPECT_EQ(shots_->keep(path), "");
  EXPECT_EQ(shots_->keep(other), "PP_cube_1.dng");
  EXPECT_EQ(shots_->still_awaited(), 1U);
  EXPECT_TRUE(is_kept("PP_cube_1.dng"));
  const auto second = shots_->take(arrived("PP_cube_2.dng", "other.dng"));
  ASSERT_TRUE(second->verdict.is_accepted());
  EXPECT_EQ(second->rig_name, "PP_cube_2.dng");
  EXPECT_EQ(shots_->answer("PP_cube_2.dng").channels[0].shots.size(), 2U);
  // A file of the rig's name replaces what was kept.
  const auto again = shots_->take(arrived("PP_cube_1.dng", "PP_cube_1.dng"));
  EXPECT_TRUE(again->verdict.is_accepted());
  EXPECT_EQ(shots_->still_awaited(), 0U);
  EXPECT_TRUE(is_kept("PP_cube_1.dng"));
}

// The cube stands elsewhere in its second shot, which comes first.
TEST(WatchedPiece, IsFoundForTheShotThatShowsIt) {
  SmallRig files;
  files.keep_shots("PP_cube");
  const std::string text = files.text();
  const std::string cube = "cube: {mesh: cube.obj, eta: 1.4";
  files.write(replaced(replaced(text, cube + "}",
                                cube + ", pose: {position_mm: [2, -1, 0]}}\n  cube2" +
                                    cube.substr(4) + ", pose: {position_mm: [-1.5, 1, 0]}}"),
                       "PP_cube_2.dng, object: cube", "PP_cube_2.dng, object: cube2"));
  files.simulate();
  files.write(replaced(text, cube + "}",
                       cube + ", pose: {from: silhouette, on_plane: true, per_shot: true}}"));
  const Rig rig = read_rig(files.rig());
  WatchedShots shots(rig, files.out(), nullptr);
  const auto arrived = [&](const std::string& shot, const std::string& name) {
    fs::copy_file(files.shots() + "/" + shot, files / name);
    return shots.take(files / name);
  };
  const auto second = arrived("PP_cube_2.dng", "DSC_1.dng");
  ASSERT_TRUE(second->verdict.is_accepted()) << second->verdict.problems.back();
  EXPECT_EQ(second->rig_name, "PP_cube_2.dng");
  const auto first = arrived("PP_cube_1.dng", "DSC_2.dng");
  ASSERT_TRUE(first->verdict.is_accepted()) << first->verdict.problems.back();
  EXPECT_EQ(first->rig_name, "PP_cube_1.dng");
  for (const ChannelResult& r : shots.answer("PP_cube_1.dng").channels) {
    EXPECT_FALSE(r.refused()) << r.channel;
  }
}

TEST_F(WatchedShotsTest, WhatIsNoShotIsNotTaken) {
  const std::string path = files_ / "card/DSC_1.dng";
  write_file(path, slurp(files_.shots() + "/PP_cube_1.dng").substr(0, 50000));
  EXPECT_THROW(shots_->take(path), InputError);
  EXPECT_EQ(shots_->still_awaited(), 2U);
  EXPECT_FALSE(is_kept("PP_cube_1.dng"));
  // The rest of it arrives.
  write_file(path, slurp(files_.shots() + "/PP_cube_1.dng"));
  EXPECT_TRUE(shots_->take(path)->verdict.is_accepted());
}

}  // namespace
}  // namespace scattermeter::apps
