#include "apps/instrument/piece_places.h"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/instrument/measure.h"
#include "core/base/input_error.h"
#include "tests/fixtures/apps/small_rig.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;
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

}  // namespace
}  // namespace scattermeter::apps
