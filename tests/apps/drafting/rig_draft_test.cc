#include "apps/drafting/rig_draft.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/rig/rig_placeholders.h"
#include "core/base/input_error.h"

namespace scattermeter::apps {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::ThrowsMessage;

RigDraft two_pieces() {
  RigDraft out;
  out.listing = {"NIKON D80", 3872, 2592, {}, {}};
  for (const char* file : {"a.nef", "b's.nef", "c.nef", "d.nef"}) {
    out.listing.shots.push_back({file, 0.25, 100, 11});
  }
  const Box3d box{{-10, -10, 0}, {10, 10, 20}};
  out.objects = {{"cube", "cube.obj", box}, {"pyramid", "pyramid.obj", box}};
  out.leds = {{"left", Eigen::Vector3d(-60, -80, 120)}, {"right", {}}};
  return out;
}

TEST(RigDraft, GivesShotsToLedsAndPiecesInTurn) {
  const std::string yaml = drafted_rig(two_pieces()).yaml;
  const std::string shot = ", material: material, lights: ";
  EXPECT_THAT(yaml, HasSubstr("{file: 'a.nef', object: cube" + shot +
                              "[left]}   # 0.25 s, ISO 100, "
                              "f/11"));
  EXPECT_THAT(yaml, HasSubstr("{file: 'b''s.nef', object: cube" + shot + "[right]}"));
  EXPECT_THAT(yaml, HasSubstr("{file: 'c.nef', object: pyramid" + shot + "[left]}"));
  EXPECT_THAT(yaml, HasSubstr("{file: 'd.nef', object: pyramid" + shot + "[right]}"));
}

TEST(RigDraft, NamesItsSchemaForEditors) {
  RigDraft draft = two_pieces();
  EXPECT_THAT(drafted_rig(draft).yaml, Not(HasSubstr("$schema")));
  draft.schema_path = "/usr/share/scattermeter/rig.schema.json";
  EXPECT_THAT(drafted_rig(draft).yaml,
              ::testing::StartsWith("# yaml-language-server: "
                                    "$schema=/usr/share/scattermeter/rig.schema.json\n"));
}

// As `print` draws it.
TEST(RigDraft, TheBoardLiesInFrontOfThePiece) {
  EXPECT_THAT(
      drafted_rig(two_pieces()).yaml,
      HasSubstr("charuco: {squares: [10, 7], square_mm: 6, marker_mm: 4.5, origin_mm: [-30, "
                "-60, 0]}"));
}

TEST(RigDraft, ListsWhatIsAPlaceholder) {
  const DraftedRig rig = drafted_rig(two_pieces());
  EXPECT_THAT(rig.to_measure, Contains("axis, exponent and intensity of left"));
  EXPECT_THAT(rig.to_measure, Contains("position, axis, exponent and intensity of right"));
  EXPECT_THAT(rig.to_measure, Contains(HasSubstr("eta of pyramid")));
  for (const std::string& what : rig.to_measure) {
    EXPECT_THAT(rig.yaml, HasSubstr(kPlaceholder + (": " + what)));
  }
}

TEST(RigDraft, AnExampleHasATruthAndNothingToMeasure) {
  RigDraft draft = two_pieces();
  draft.is_example = true;
  draft.listing = example_listing(draft.leds);
  const DraftedRig rig = drafted_rig(draft);
  EXPECT_TRUE(rig.to_measure.empty());
  EXPECT_THAT(rig.yaml, HasSubstr("\ntruth:"));
  EXPECT_THAT(rig.yaml, HasSubstr("file: 'left.dng'"));
  EXPECT_THAT(rig.yaml, Not(HasSubstr(kPlaceholder)));
}

TEST(RigDraft, OptionsAreReadOrNamed) {
  EXPECT_FALSE(drafted_led("left").position_mm.has_value());
  EXPECT_EQ(*drafted_led("left:-60,-80,120").position_mm, Eigen::Vector3d(-60, -80, 120));
  const calib::CharucoBoard board = drafted_board("12x9:5:3.5");
  EXPECT_EQ(board.squares_x, 12);
  EXPECT_EQ(board.squares_y, 9);
  EXPECT_EQ(board.square_mm, 5.0);
  EXPECT_EQ(board.marker_mm, 3.5);
  for (const char* text : {"left:1,2", "left:1,2,x", "2left", "", "a b:1,2,3"}) {
    EXPECT_THAT([&] { drafted_led(text); }, ThrowsMessage<InputError>(HasSubstr("--led"))) << text;
  }
  for (const char* text : {"10x7", "10x7:6", "10x7:4.5:6", "10:6:4.5", "10.5x7:6:4.5", "1x7:6:4"}) {
    EXPECT_THAT([&] { drafted_board(text); }, ThrowsMessage<InputError>(HasSubstr("--board")))
        << text;
  }
  const auto refused = [](const char* text, const char* why) {
    EXPECT_THAT([&] { drafted_board(text); }, ThrowsMessage<InputError>(HasSubstr(why))) << text;
  };
  refused("10x7:4.5:6", "markers that are smaller than the squares, got 10x7:4.5:6");
  refused("10x7:0.006:0.0045", "lengths in mm");
}

}  // namespace
}  // namespace scattermeter::apps
