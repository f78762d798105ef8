#include "apps/drafting/drafted_body.h"

#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture/files/obj_reader.h"
#include "core/base/input_error.h"
#include "tests/fixtures/apps/small_rig.h"
#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

// Volumes in closed form; round bodies, whose corners lie on the surface, have a little less.
TEST(DraftedBody, HasItsVolumeOnThePlane) {
  const double pi = std::numbers::pi;
  for (const auto& [text, volume, missing] :
       std::initializer_list<std::tuple<const char*, double, double>>{
           {"cube:20", 8000.0, 0.0},
           {"box:30x20x10", 6000.0, 0.0},
           {"slab:40x40x5", 8000.0, 0.0},
           {"pyramid:20x20x15", 2000.0, 0.0},
           {"cylinder:10x10x30", pi * 25.0 * 30.0, 1e-3},
           {"sphere:20", pi * 4000.0 / 3.0, 3e-3}}) {
    const DraftedBody body = drafted_body(text);
    EXPECT_EQ(mesh_problem(body.mesh), "") << text;
    EXPECT_LE(signed_volume_mm3(body.mesh), volume * (1.0 + 1e-9)) << text;
    EXPECT_GE(signed_volume_mm3(body.mesh), volume * (1.0 - missing - 1e-9)) << text;
    EXPECT_NEAR(bounds(body.mesh).min_mm.z(), 0.0, 1e-9) << text;
    EXPECT_NEAR(bounds(body.mesh).center_mm().head<2>().norm(), 0.0, 1e-9) << text;
  }
  const Eigen::Vector3d size = bounds(drafted_body("box:30x20x10").mesh).size_mm();
  EXPECT_LT((size - Eigen::Vector3d(30, 20, 10)).norm(), 1e-12);
}

TEST(DraftedBody, IsReadBackFromItsFile) {
  const TemporaryFolder folder;
  const TriangleMesh mesh = drafted_body("cylinder:12.5x12.5x7").mesh;
  write_file(folder / "a.obj", obj_text(mesh));
  const TriangleMesh read = capture::read_obj(folder / "a.obj");
  ASSERT_EQ(read.triangles, mesh.triangles);
  for (std::size_t i = 0; i < mesh.vertices_mm.size(); ++i) {
    EXPECT_LT((read.vertices_mm[i] - mesh.vertices_mm[i]).norm(), 1e-7);
  }
}

TEST(DraftedBody, SaysWhatItIsNot) {
  const auto message = [](const char* text, const char* part) {
    EXPECT_THAT([&] { drafted_body(text); }, ThrowsMessage<InputError>(HasSubstr(part))) << text;
  };
  message("cuve:20", "did you mean cube?");
  message("cube", "one size or three in mm");
  message("box:3x4", "one size or three in mm");
  message("cube:-3", "one size or three in mm");
  message("cube:0.02", "cube:0.02");  // metres
}

}  // namespace
}  // namespace scattermeter::apps
