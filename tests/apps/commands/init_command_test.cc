#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/rig/rig.h"
#include "tests/fixtures/apps/small_rig.h"
#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

// At a quarter of its size.
TEST(InitCommand, TheExampleIsMeasured) {
  const TemporaryFolder folder;
  const std::string rig = folder / "rig/rig.yaml", shots = folder / "shots";
  const Answer made = run({"init", "--example", "--out", rig});
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("written: " + (folder / "rig/cube.obj")));
  std::string text = replaced(slurp(rig), "[3872, 2592]", "[968, 648]");
  text = replaced(text, "fx_px: 9680, fy_px: 9680, cx_px: 1935.5, cy_px: 1295.5",
                  "fx_px: 2420, fy_px: 2420, cx_px: 483.5, cy_px: 323.5");
  write_file(rig, text);
  const Answer simulated = run({"simulate", rig, "--out", shots});
  ASSERT_EQ(simulated.status, 0) << simulated.err;
  const Answer measured = run({"measure", shots, "--rig", rig, "--out", folder / "out"});
  EXPECT_EQ(measured.status, 0) << measured.out << measured.err;
}

TEST(InitCommand, BeginsARigFromShots) {
  SmallRig small;
  small.keep_shots("PE_cube_1");
  ASSERT_EQ(run({"simulate", small.rig(), "--out", small.shots(), "--quiet"}).status, 0);
  const TemporaryFolder folder;
  const Answer made = run({"init", small.shots(), "--out", folder / "rig.yaml", "--body",
                           "sphere:25", "--led", "lamp:10,-60,80", "--material", "wax"});
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("still to be measured"));
  const Rig rig = read_rig(folder / "rig.yaml");
  ASSERT_EQ(rig.scene.shots.size(), 1U);
  EXPECT_EQ(rig.scene.shots[0].object, "sphere");
  EXPECT_EQ(rig.scene.shots[0].material, "wax");
  EXPECT_EQ(rig.scene.light("lamp").led()->led.position_mm, Eigen::Vector3d(10, -60, 80));
}

// A rig that cannot be measured with is not left in the way of the next attempt.
TEST(InitCommand, KeepsNoRigThatIsRefused) {
  const TemporaryFolder folder;
  const std::string rig = folder / "a/rig.yaml";
  const auto refused = [&](const std::string& option, const std::string& value) {
    const Answer made = run({"init", "--example", "--out", rig, option, value});
    EXPECT_EQ(made.status, 2);
    EXPECT_FALSE(std::filesystem::exists(rig));
    EXPECT_FALSE(std::filesystem::exists(folder / "a/cube.obj"));
    return made.err;
  };
  EXPECT_THAT(refused("--led", "left:-0.06,-0.08,12"), HasSubstr("lies inside object cube"));
  EXPECT_THAT(refused("--led", "left:0,0,10"), HasSubstr("nothing is written"));
  write_file(folder / "open.obj", std::string("v 0 0 0\nv 20 0 0\nv 0 20 0\nv 0 0 20\n"
                                              "f 1 3 2\nf 1 2 4\nf 1 4 3\n"));
  EXPECT_THAT(refused("--body", folder / "open.obj"), HasSubstr("the mesh is open"));
}

// Of a mesh beside the folder that is to be made.
TEST(InitCommand, NamesAMeshFromANewFolder) {
  const TemporaryFolder folder;
  ASSERT_EQ(run({"init", "--example", "--out", folder / "rig.yaml"}).status, 0);
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  const Answer made = run({"init", "--example", "--out", "new/rig.yaml", "--body", "cube.obj"});
  std::filesystem::current_path(before);
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_THAT(slurp(folder / "new/rig.yaml"), HasSubstr("../cube.obj"));
}

TEST(InitCommand, ReplacesNoFile) {
  const TemporaryFolder folder;
  write_file(folder / "cube.obj", std::string("mine"));
  const Answer mesh = run({"init", "--example", "--out", folder / "rig.yaml"});
  EXPECT_EQ(mesh.status, 2);
  EXPECT_THAT(mesh.err, HasSubstr("cube.obj"));
  EXPECT_FALSE(std::filesystem::exists(folder / "rig.yaml"));
  EXPECT_EQ(slurp(folder / "cube.obj"), "mine");
  EXPECT_EQ(run({"init"}).status, 2);
  EXPECT_THAT(run({"init", "--example", "--out", folder / "b/rig.yaml", "--body", "cube:20",
                   "--body", "cube:30"})
                  .err,
              HasSubstr("--body: names cube twice"));
  EXPECT_FALSE(std::filesystem::exists(folder / "b"));
  EXPECT_EQ(run({"init", folder.path(), "--example"}).status, 2);
}

}  // namespace
}  // namespace scattermeter::apps
