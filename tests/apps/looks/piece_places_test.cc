#include "apps/looks/piece_places.h"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/instrument/measure.h"
#include "core/base/input_error.h"
#include "tests/fixtures/apps/charuco_rig.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::SizeIs;

// A cube that stands 4 mm and 5 degrees from where the measuring rig has it.
class PiecePlacesTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    files_ = new SmallRig;
    files_->keep_shots("POM_cube");
    files_->write(with("position_mm: [3, -2.5, 0], turn_deg: [0, 0, 5]"));
    files_->simulate();
  }
  static void TearDownTestSuite() { delete files_; }
  static std::string with(const std::string& pose) {
    static const std::string kWithout = files_->text();
    return replaced(kWithout, "{mesh: cube.obj, eta: 1.4}",
                    "{mesh: cube.obj, eta: 1.4, pose: {" + pose + "}}");
  }
  static Rig rig_with(const std::string& pose) {
    files_->write(with(pose));
    return read_rig(files_->rig());
  }
  static SmallRig* files_;
};
SmallRig* PiecePlacesTest::files_ = nullptr;

TEST_F(PiecePlacesTest, FindsThePieceAndMeasuresIt) {
  for (const char* pose : {"from: silhouette", "from: silhouette, on_plane: true"}) {
    Rig rig = rig_with(pose);
    const Measurement m = measure(rig, files_->shots(), {});
    ASSERT_THAT(m.results, SizeIs(3));
    for (std::size_t c = 0; c < 3; ++c) {
      const ChannelResult& r = m.results[c];
      const Medium& truth = rig.truth.materials.at("POM")[c];
      EXPECT_FALSE(r.refused()) << pose << r.channel;
      EXPECT_NEAR(r.estimate.sigma_s_prime_per_mm.value, truth.sigma_s_prime_per_mm,
                  4.0 * r.estimate.sigma_s_prime_per_mm.std)
          << pose << r.channel;
      EXPECT_NEAR(r.estimate.sigma_a_per_mm.value, truth.sigma_a_per_mm,
                  4.0 * r.estimate.sigma_a_per_mm.std)
          << pose << r.channel;
    }
    ASSERT_FALSE(m.notes.empty());
    EXPECT_THAT(m.notes[0], HasSubstr("cube was found by its outline [3.0"));
    const std::vector<std::string> notes = place_pieces(rig, files_->shots());
    EXPECT_THAT(notes, SizeIs(1));
    const SceneObject& cube = rig.scene.object("cube");
    const Eigen::Vector3d off_mm =
        cube.world_from_mesh.translation_mm - Eigen::Vector3d(3, -2.5, 0);
    EXPECT_LT(off_mm.norm(), 4.0 * cube.position_std_mm);
    EXPECT_LT(cube.position_std_mm, 1.0);
    const Eigen::AngleAxisd turn(cube.world_from_mesh.rotation);
    EXPECT_NEAR(turn.angle(), 5.0 * std::numbers::pi / 180.0, 0.02);
  }
}

TEST_F(PiecePlacesTest, NothingToBeFoundOrNothingThere) {
  Rig stated = rig_with("position_mm: [3, -2.5, 0]");
  EXPECT_TRUE(place_pieces(stated, files_->shots()).empty());
  Rig lost = rig_with("position_mm: [30, 20, 0], from: silhouette");
  try {
    place_pieces(lost, files_->shots());
    ADD_FAILURE() << "found";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("objects.cube.pose.from"));
    EXPECT_THAT(e.what(), HasSubstr("POM_cube_1.dng, POM_cube_2.dng"));
  }
  Rig found = rig_with("from: silhouette");
  EXPECT_THROW(place_pieces(found, files_->out()), InputError);
}

// The cube was displaced and turned between its two shots.
TEST(PieceMoved, BetweenItsShots) {
  SmallRig files;
  files.keep_shots("POM_cube");
  const std::string text = files.text();
  const std::string cube = "cube: {mesh: cube.obj, eta: 1.4";
  const auto moved = [&](const std::string& to) {
    return replaced(text, cube + "}", cube + ", pose: " + to);
  };
  files.write(
      replaced(moved("{position_mm: [2, -1, 0], turn_deg: [0, 0, 4]}}\n  " + cube.substr(0, 4) +
                     "2" + cube.substr(4) + ", pose: {position_mm: [-1.5, 1, 0]}}"),
               "POM_cube_2.dng, object: cube", "POM_cube_2.dng, object: cube2"));
  files.simulate();
  files.write(moved("{from: silhouette, on_plane: true}}"));
  for (const ChannelResult& r : measure(read_rig(files.rig()), files.shots(), {}).results) {
    ASSERT_TRUE(r.refused()) << r.channel;
    EXPECT_THAT(r.estimate.reasons.front(), HasSubstr("moved in POM_cube_"));
    EXPECT_THAT(r.estimate.reasons.front(), HasSubstr("per_shot: true"));
  }
  files.write(moved("{from: silhouette, on_plane: true, per_shot: true}}"));
  const Rig rig = read_rig(files.rig());
  const Measurement m = measure(rig, files.shots(), {});
  ASSERT_THAT(m.results, SizeIs(3));
  for (std::size_t c = 0; c < 3; ++c) {
    const ChannelResult& r = m.results[c];
    const Medium& truth = rig.truth.materials.at("POM")[c];
    EXPECT_FALSE(r.refused()) << r.channel;
    const auto& s = r.estimate.sigma_s_prime_per_mm;
    EXPECT_NEAR(s.value, truth.sigma_s_prime_per_mm, 4.0 * s.std) << r.channel;
    const auto& a = r.estimate.sigma_a_per_mm;
    EXPECT_NEAR(a.value, truth.sigma_a_per_mm, 4.0 * a.std) << r.channel;
  }
  ASSERT_GE(m.notes.size(), 2U);
  EXPECT_THAT(m.notes[0], HasSubstr("cube in POM_cube_1.dng was found by its outline [2.0"));
  EXPECT_THAT(m.notes[1], HasSubstr("cube in POM_cube_2.dng was found by its outline [-1.5"));
}

// A board in every shot tells where the camera is, and the outline where the piece is.
class PieceBesideBoardTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    files_ = new CharucoRig("POM_pyramid");
    // In front of the pyramid, not below it.
    files_->write(replaced(replaced(files_->text(), "squares: [10, 8]", "squares: [10, 7]"),
                           "origin_mm: [-30, -22, 0]", "origin_mm: [-30, -60, 0]"));
    files_->write(replaced(files_->text(), "[0, -100, 150], look_at_mm: [0, 0, 9]",
                           "[-14, -256, 173], look_at_mm: [0, -25, 5]"));
    text_ = new std::string(files_->text());
    files_->simulate();
  }
  static void TearDownTestSuite() {
    delete files_;
    delete text_;
  }
  static Measurement measured_at(const std::string& position_mm) {
    files_->write(replaced(*text_, "pyramid.obj, eta: 1.4}",
                           "pyramid.obj, eta: 1.4, pose: {position_mm: " + position_mm + "}}"));
    return measure(read_rig(files_->rig()), files_->shots(), {});
  }
  static CharucoRig* files_;
  static std::string* text_;
};
CharucoRig* PieceBesideBoardTest::files_ = nullptr;
std::string* PieceBesideBoardTest::text_ = nullptr;

// 0.25 mm off, where the rig states 0.1 mm for each coordinate.
TEST_F(PieceBesideBoardTest, IsSeenWhereItStands) {
  const Measurement off = measured_at("[0.15, -0.2, 0]");
  const Measurement exact = measured_at("[0, 0, 0]");
  const auto& truth = read_rig(files_->rig()).truth.materials.at("POM");
  ASSERT_THAT(off.results, SizeIs(3));
  for (std::size_t c = 0; c < 3; ++c) {
    const Estimate& e = off.results[c].estimate;
    EXPECT_FALSE(off.results[c].refused()) << ::testing::PrintToString(e.reasons);
    const Quantity& s = e.sigma_s_prime_per_mm;
    EXPECT_NEAR(s.value, truth[c].sigma_s_prime_per_mm, 3.0 * s.std);
    EXPECT_NEAR(e.sigma_a_per_mm.value, truth[c].sigma_a_per_mm, 3.0 * e.sigma_a_per_mm.std);
    // The other view has other patches beside the edges.
    const Quantity& of_exact = exact.results[c].estimate.sigma_s_prime_per_mm;
    EXPECT_NEAR(s.value, of_exact.value, 1.5 * s.std);
    EXPECT_LT(s.std, 1.3 * of_exact.std);
  }
}

TEST_F(PieceBesideBoardTest, IsRefusedByNameFartherOff) {
  for (const ChannelResult& r : measured_at("[2, 0, 0]").results) {
    ASSERT_TRUE(r.refused());
    EXPECT_THAT(r.estimate.reasons.front(),
                HasSubstr("mesh displaced: by its outline, pyramid stands [-"));
    EXPECT_THAT(r.estimate.reasons.front(), Not(HasSubstr("than its mesh")));
    EXPECT_EQ(r.estimate.sigma_s_prime_per_mm.value, 0.0);  // before any fit
  }
}

// 10 mm farther from the camera, which is 305 mm away, than stated: so would a smaller one look.
TEST_F(PieceBesideBoardTest, MayBeOfAnotherSize) {
  const Measurement nearer = measured_at("[-0.46, -8.4, 5.4]");
  EXPECT_THAT(nearer.results.front().estimate.reasons.front(),
              HasSubstr("or is 3.3 % smaller than its mesh"));
}

}  // namespace
}  // namespace scattermeter::apps
