#include "capture/shots/shot_source.h"

#include <atomic>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture/raw/dng_writer.h"
#include "core/base/input_error.h"
#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::capture {
namespace {

using ::testing::ElementsAre;

Scene two_shots() {
  Scene scene;
  scene.camera.intrinsics.width_px = 32;
  scene.camera.intrinsics.height_px = 24;
  scene.shots.resize(2);
  scene.shots[0].file = "a.dng";
  scene.shots[1].file = "b.dng";
  scene.shots[1].more_files = {"b2.dng"};
  return scene;
}

TEST(ShotSource, OpensEachExposureFromItsFile) {
  const TemporaryFolder folder;
  const Scene scene = two_shots();
  std::uint16_t code = 100;
  for (const char* name : {"a.dng", "b.dng", "b2.dng"}) {
    write_dng(folder / name, 32, 24, std::vector<std::uint16_t>(32 * 24, code++), {});
  }
  const ShotDecoding decoding;
  const ShotSource source =
      shots_in_files(scene, decoding, {{folder / "a.dng"}, {folder / "b.dng", folder / "b2.dng"}});
  EXPECT_THAT(source.shot_idxs, ElementsAre(0, 1));
  EXPECT_THAT(source.names[1], ElementsAre(folder / "b.dng", folder / "b2.dng"));
  const auto& open = std::get<FrameSource>(source.open);
  EXPECT_EQ(open(0, 0).at(3, 3), 100);
  EXPECT_EQ(open(1, 0).at(3, 3), 101);
  EXPECT_EQ(open(1, 1).at(3, 3), 102);
  EXPECT_THROW(open(0, 1), std::out_of_range);
}

TEST(ShotSource, SomeShotsAreNamedAsInTheScene) {
  const Scene scene = two_shots();
  const ShotSource source =
      shots_from(scene, {1}, FrameSource([](std::size_t, std::size_t) { return RawFrame{}; }));
  EXPECT_THAT(source.shot_idxs, ElementsAre(1));
  EXPECT_THAT(source.names, ElementsAre(ElementsAre("b.dng", "b2.dng")));
  EXPECT_EQ(source.cache, nullptr);
  EXPECT_THROW(
      shots_from(scene, {2}, FrameSource([](std::size_t, std::size_t) { return RawFrame{}; })),
      std::out_of_range);
}

TEST(ShotSource, FramesOfAShotComeInTheOrderOfItsFiles) {
  const Scene scene = two_shots();
  std::vector<std::pair<std::size_t, std::size_t>> asked;
  const std::vector<RawFrame> frames =
      frames_of(scene.shots[1], 1, [&](std::size_t shot, std::size_t exposure) {
        asked.emplace_back(shot, exposure);
        RawFrame frame;
        frame.iso = 100.0 * static_cast<double>(exposure + 1);
        return frame;
      });
  EXPECT_THAT(asked, ElementsAre(std::pair(1U, 0U), std::pair(1U, 1U)));
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_EQ(frames[1].iso, 200.0);
}

// A frame that is being decoded is handed over once; what its decoding throws, too.
TEST(ShotSource, FirstFramesAreDecodedAhead) {
  const Scene scene = two_shots();
  std::atomic<int> decoded = 0;
  const auto frames = [&](std::size_t shot, std::size_t) {
    ++decoded;
    if (shot == 1) throw InputError("b.dng", "is damaged");
    RawFrame frame;
    frame.iso = 100.0 * static_cast<double>(shot + 1);
    return frame;
  };
  const ShotSource source = begun(shots_from(scene, {0, 1}, FrameSource(frames)), {0});
  const auto& open = std::get<FrameSource>(source.open);
  EXPECT_EQ(open(0, 0).iso, 100.0);
  EXPECT_EQ(decoded, 1);
  EXPECT_EQ(open(0, 0).iso, 100.0);
  EXPECT_EQ(decoded, 2);
  EXPECT_THROW(open(1, 0), InputError);
  const ShotSource bad = begun(shots_from(scene, {1}, FrameSource(frames)), {1});
  EXPECT_THROW(std::get<FrameSource>(bad.open)(1, 0), InputError);
  EXPECT_EQ(decoded, 4);
}

// Only the first of a bracket's frames; samples without frames pass unseen.
TEST(ShotSource, FirstFramesAreShown) {
  const Scene scene = two_shots();
  const ShotSource source = shots_from(scene, {1}, FrameSource([](std::size_t, std::size_t k) {
                                         RawFrame frame;
                                         frame.exposure_s = 0.1 * static_cast<double>(k + 1);
                                         return frame;
                                       }));
  std::vector<std::pair<std::size_t, double>> seen;
  const ShotSource shown =
      shown_to([&](std::size_t shot_idx,
                   const RawFrame& frame) { seen.emplace_back(shot_idx, frame.exposure_s); },
               source);
  EXPECT_EQ(std::get<FrameSource>(shown.open)(1, 0).exposure_s, 0.1);
  EXPECT_EQ(std::get<FrameSource>(shown.open)(1, 1).exposure_s, 0.2);
  EXPECT_THAT(seen, ElementsAre(std::pair<std::size_t, double>(1, 0.1)));
}

TEST(ShotSource, AllShotsAreCountedFromZero) {
  EXPECT_THAT(all_shots(two_shots()), ElementsAre(0, 1));
  EXPECT_TRUE(all_shots(Scene{}).empty());
}

}  // namespace
}  // namespace scattermeter::capture
