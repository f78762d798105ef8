#include "apps/checking/checked_rig.h"

#include <algorithm>
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/drafting/drafted_body.h"
#include "core/base/input_error.h"
#include "core/mesh/round_bodies.h"
#include "core/scene/default_uncertainty.h"
#include "tests/fixtures/apps/charuco_rig.h"

namespace scattermeter::apps {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// Rewrites the entry CFAPattern of a DNG: four bytes, 0 for red, 1 green, 2 blue.
void label_as_rggb(const std::string& path) {
  const std::string entry("\x8e\x82\x01\x00\x04\x00\x00\x00", 8);
  std::string bytes = slurp(path);
  const std::size_t at = bytes.find(entry);
  ASSERT_NE(at, std::string::npos);
  write_file(path, bytes.replace(at + entry.size(), 4, std::string("\x00\x01\x01\x02", 4)));
}

TEST(CheckedRig, OpensTheShotsAndFitsThem) {
  SmallRig files;
  files.keep_shots("PE_cube");
  files.simulate();
  write_file(files.shots() + "/notes.txt", std::string("x"));
  const Rig rig = read_rig(files.rig());
  CheckOptions options;
  options.draw_shot = [](const capture::RawFrame& frame, const CameraView& view, const RayScene&,
                         const SampleMap& map) {
    return std::to_string(frame.width_px) + " " + std::to_string(view.intrinsics.width_px) + " " +
           std::to_string(map.width > 100);
  };
  const CheckedRig checked = open_checked_rig(rig, files.shots(), options);
  EXPECT_THAT(checked.notes, ElementsAre("notes.txt: not in the rig's list of shots, skipped"));
  EXPECT_EQ(checked.folder, files.shots());
  ASSERT_EQ(checked.shots.size(), 2U);
  EXPECT_EQ(checked.shots[1].stated->file, "PE_cube_2.dng");
  ASSERT_TRUE(checked.shared_pose.has_value());
  EXPECT_EQ(checked.shared_pose->inlier.size(), 8U);
  EXPECT_FALSE(checked.lens.has_value());
  EXPECT_TRUE(checked.leds.empty());
  ASSERT_TRUE(checked.outline.has_value());
  EXPECT_EQ(checked.outline->shots_found, 2U);
  ASSERT_EQ(checked.frames.size(), 2U);
  for (const CheckedFrame& frame : checked.frames) {
    EXPECT_EQ(frame.black_counts, (std::array<double, 4>{64, 64, 64, 64}));
    EXPECT_GT(frame.background.blocks, 50U);
    EXPECT_NEAR(frame.background.median_counts[1], 0.0, 0.5);  // nothing is lit but the cube
    EXPECT_FALSE(frame.noise[0].empty());
    EXPECT_EQ(frame.png, "484 484 1");
  }
  EXPECT_EQ(checked.fit.channels.size(), 3U);
  EXPECT_EQ(checked.fit.likeness.size(), 2U);
  // The shots shall say where the LEDs are: within 2 mm, whatever the rig says.
  EXPECT_EQ(checked.rig.scene.light("led1").led()->position_std_mm,
            default_uncertainty::kLedPosition_mm);
  EXPECT_EQ(checked.geometry->rig.scene.light("led1").led()->position_std_mm, 2.0);
}

// The piece stands 0.2 mm from where the rig puts it, which states 0.1 mm for each coordinate.
TEST(CheckedRig, LooksFromWhereAPieceBesideABoardStands) {
  CharucoRig files("POM_pyramid");
  files.simulate();
  const auto checked_at = [&](const Rig& rig) {
    const CheckedRig checked = open_checked_rig(rig, files.shots(), {});
    EXPECT_TRUE(checked.findings().empty());
    EXPECT_EQ(checked.fit.channels.size(), 3U);
    double worst = 0.0;
    for (const CheckedChannel& c : checked.fit.channels) {
      EXPECT_TRUE(c.departures.has_value());
      if (!c.departures) continue;
      for (const double r : c.departures->residual_relative) worst = std::max(worst, r);
    }
    return worst;
  };
  const double exact = checked_at(read_rig(files.rig()));
  files.write(replaced(files.text(), "pyramid.obj, eta: 1.4}",
                       "pyramid.obj, eta: 1.4, pose: {position_mm: [0.2, 0, 0]}}"));
  EXPECT_LT(checked_at(read_rig(files.rig())), 1.5 * exact);
}

// The outline of a sphere beside a board tells that it is displaced, not covered, to check as to
// measure.
TEST(CheckedRig, TellsThatARoundPieceBesideABoardIsDisplaced) {
  CharucoRig files("POM_pyramid");
  write_file(files / "pyramid.obj", obj_text(sphere_mesh(5)));
  files.simulate();
  EXPECT_TRUE(open_checked_rig(read_rig(files.rig()), files.shots(), {}).findings().empty());
  files.write(replaced(files.text(), "pyramid.obj, eta: 1.4}",
                       "pyramid.obj, eta: 1.4, pose: {position_mm: [-3, 0, 0]}}"));
  const std::vector<Finding> findings =
      open_checked_rig(read_rig(files.rig()), files.shots(), {}).findings();
  ASSERT_FALSE(findings.empty());
  EXPECT_THAT(findings.front().text,
              HasSubstr("mesh of pyramid displaced: the object is offset from it by "));
  EXPECT_THAT(files.measure().out, HasSubstr("mesh of pyramid displaced: "));
}

// Of the filters' pattern: with pose points and with a board beside the piece.
TEST(CheckedRig, SeesExchangedColourFilters) {
  SmallRig files;
  files.keep_shots("PE_cube");
  CharucoRig beside_a_board("POM_pyramid");
  for (SmallRig* one : {&files, static_cast<SmallRig*>(&beside_a_board)}) {
    const std::string stated = one->text();
    one->write(replaced(stated, "black_counts: 64", "black_counts: 64, cfa: GRBG"));
    one->simulate();
    for (const auto& entry : std::filesystem::directory_iterator(one->shots())) {
      label_as_rggb(entry.path());
    }
    one->write(stated);
    const std::vector<Finding> findings =
        open_checked_rig(read_rig(one->rig()), one->shots(), {}).findings();
    ASSERT_FALSE(findings.empty());
    EXPECT_EQ(findings.front().cause, "colour filters");
    EXPECT_THAT(one->measure().out, HasSubstr("colour filters exchanged"));
  }
}

// A piece 3 mm from where it is stated to begin the search.
TEST(CheckedRig, FindsAPieceByItsOutline) {
  SmallRig files;
  files.keep_shots("PE_cube");
  files.simulate();
  files.write(replaced(files.text(), "cube: {mesh: cube.obj, eta: 1.4}",
                       "cube: {mesh: cube.obj, eta: 1.4, pose: {position_mm: [3, 0, 0], "
                       "from: silhouette}}"));
  const CheckedRig checked = open_checked_rig(read_rig(files.rig()), files.shots(), {});
  EXPECT_TRUE(checked.findings().empty());
  ASSERT_FALSE(checked.notes.empty());
  EXPECT_THAT(checked.notes.front(), HasSubstr("cube"));
  EXPECT_LT(checked.rig.scene.objects.front().world_from_mesh.translation_mm.norm(), 0.2);
}

TEST(CheckedRig, RefusesWhatMeasureRefuses) {
  SmallRig files;
  files.keep_shots("PE_cube");
  std::filesystem::create_directories(files.shots());
  const Rig rig = read_rig(files.rig());
  EXPECT_THROW(open_checked_rig(rig, files.shots(), {}), InputError);
}

TEST(CheckedRig, NamesAShotAndItsChannel) {
  Rig rig;
  rig.scene.shots.resize(2);
  rig.scene.shots[1].file = "b.dng";
  const CheckedRig checked{rig, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}};
  EXPECT_EQ(checked.of_shot(1, 2.5).where, "b.dng");
  EXPECT_EQ(checked.of_shot(1, 2.5).value, 2.5);
  EXPECT_EQ(checked.of_shot(1, 2.5).shot_idx, 1U);
  EXPECT_EQ(checked.of_channel(1, 2, 2.5).where, "b.dng B");
  EXPECT_THROW(checked.of_shot(2, 0.0), std::out_of_range);
}

}  // namespace
}  // namespace scattermeter::apps
