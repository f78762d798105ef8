#include "apps/instrument/seen_shots.h"

#include <filesystem>

#include <gtest/gtest.h>

#include "apps/instrument/instrument.h"
#include "capture/files/digest.h"
#include "capture/shots/shot_cache.h"
#include "core/base/input_error.h"
#include "tests/fixtures/apps/lit_shots.h"

namespace scattermeter::apps {
namespace {

class SeenShotsTest : public ::testing::Test {
 protected:
  SeenShotsTest() : setup_("cube"), virtual_shots_(setup_.rig, setup_.scenes, {.noise = true}) {}
  capture::ShotSource source() const { return virtual_shots_.source(1); }
  std::unique_ptr<SeenShots> seen(std::optional<SharedView> view) {
    return std::make_unique<SeenShots>(setup_.rig, setup_.scenes, *setup_.lit, source(),
                                       std::move(view), true, std::nullopt, kept_, nullptr);
  }

  LitShots setup_;
  VirtualShots virtual_shots_;
  KeptLight kept_;
};

TEST_F(SeenShotsTest, OpensWithTheLightOfTheView) {
  const auto shots = seen(setup_.view);
  shots->open();
  ASSERT_EQ(shots->shots().size(), setup_.shots.size());
  EXPECT_EQ(shots->shots()[0].observation.channel[1].l, setup_.shots[0].observation.channel[1].l);
  EXPECT_EQ(&shots->kept(), &kept_);
  EXPECT_EQ(kept_.weights.size(), 2U);  // of both LEDs
}

// 1 mm to the side: other samples for each patch, the same pose, and light of its own.
TEST_F(SeenShotsTest, OpensFromWhereTheObjectIsSeen) {
  const auto shots = seen(setup_.view);
  shots->open();
  const std::vector<int> before = shots->shots()[0].seen->map.patch_of_row;
  const std::vector<double> l = shots->shots()[0].observation.channel[1].l;
  PoseShift shift = PoseShift::Zero();
  shift[3] = 1.0;
  shots->open_from({{"cube", shift}});
  const ObservedShot& shot = shots->shots()[0];
  EXPECT_EQ(shot.seen->shift, shift);
  EXPECT_EQ(shot.pose.camera_from_world.translation_mm,
            setup_.view->pose.camera_from_world.translation_mm);
  EXPECT_NE(shot.observation.channel[1].l, l);
  EXPECT_NE(&shots->kept(), &kept_);
  EXPECT_TRUE(shots->kept().weights.contains({shot.seen.get(), shot.stated->lights.at(0), 0}));
}

TEST_F(SeenShotsTest, SizesStayOpenWhenShotsAreOpenedAgain) {
  const auto shots = seen(setup_.view);
  shots->open();
  EXPECT_EQ(shots->shots()[0].size_open_relative, 0.0);
  shots->leave_sizes_open({{"cube", 0.004}});
  EXPECT_EQ(shots->shots()[0].size_open_relative, 0.004);
  PoseShift shift = PoseShift::Zero();
  shift[3] = 0.1;
  shots->open_from({{"cube", shift}});
  for (const ObservedShot& shot : shots->shots()) EXPECT_EQ(shot.size_open_relative, 0.004);
}

// Each from its own pose, of which only the shift changes.
TEST_F(SeenShotsTest, OpensShotsWithTheirOwnPosesFromElsewhere) {
  setup_.rig.pose.refine_by_silhouette = setup_.rig.pose.per_shot = true;
  const auto shots = seen(std::nullopt);
  shots->open();
  const std::vector<ObservedShot> before = shots->shots();
  PoseShift shift = PoseShift::Zero();
  shift[3] = 1.0;
  shots->open_from({{before[0].stated->file, shift}});
  for (std::size_t i = 0; i < before.size(); ++i) {
    const ObservedShot& shot = shots->shots()[i];
    EXPECT_TRUE(shot.has_own_pose);
    EXPECT_EQ(shot.pose.camera_from_world.translation_mm,
              before[i].pose.camera_from_world.translation_mm);
    EXPECT_EQ(shot.seen->shift, i == 0 ? shift : PoseShift(PoseShift::Zero()));
    EXPECT_EQ(shot.observation.channel[1].l == before[i].observation.channel[1].l, i != 0);
  }
}

// The light of the view is whole after a shot that could not be read, for the next one.
TEST_F(SeenShotsTest, AnUnreadableShotLeavesNoHalfLight) {
  seen(setup_.view)->open();
  const Weights whole = kept_.weights;
  for (int round = 0; round < 5; ++round) {
    kept_.weights.clear();
    capture::ShotSource broken = source();
    broken.open = capture::FrameSource([](std::size_t, std::size_t) -> capture::RawFrame {
      throw InputError("a.dng", "is cut off");
    });
    SeenShots shots(setup_.rig, setup_.scenes, *setup_.lit, broken, setup_.view, true, std::nullopt,
                    kept_, nullptr);
    EXPECT_THROW(shots.open(), InputError);
    ASSERT_EQ(kept_.weights.size(), whole.size());
    for (const auto& [key, weights] : whole) EXPECT_EQ(kept_.weights.at(key), weights);
  }
}

TEST_F(SeenShotsTest, ForgetsAndKeepsNothingFromThenOn) {
  const std::filesystem::path folder =
      std::filesystem::path(::testing::TempDir()) / "seen_shots_cache";
  capture::ShotCache cache(folder.string());
  capture::FileDigests digests;
  capture::ShotSource cached = source();
  cached.cache = &cache;
  cached.digests = &digests;
  SeenShots shots(setup_.rig, setup_.scenes, *setup_.lit, cached, setup_.view, true, std::nullopt,
                  kept_, nullptr);
  shots.forget();
  shots.open();
  EXPECT_TRUE(!std::filesystem::exists(folder) || std::filesystem::is_empty(folder));
  EXPECT_EQ(cache.problem(), "");
}

}  // namespace
}  // namespace scattermeter::apps
