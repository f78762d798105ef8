#include "capture/files/obj_reader.h"

#include <array>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/input_error.h"
#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::capture {
namespace {

using testing::StartsWith;

const std::string kCubeVertices =
    "v -10 -10 0\nv 10 -10 0\nv 10 10 0\nv -10 10 0\nv -10 -10 20\nv 10 -10 20\nv 10 10 20\n"
    "v -10 10 20\n";
const std::string kCubeFaces = "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

class ObjReader : public testing::Test {
 protected:
  TriangleMesh read(const std::string& text) const {
    write_file(path_, text);
    return read_obj(path_);
  }
  std::string refusal(const std::string& text) const {
    try {
      read(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  }

  TemporaryFolder folder_;
  std::string path_ = folder_ / "body.obj";
};

TEST_F(ObjReader, CubeOfQuadrilaterals) {
  const TriangleMesh cube = read(kCubeVertices + kCubeFaces);
  EXPECT_EQ(cube.vertices_mm.size(), 8U);
  EXPECT_EQ(cube.triangles.size(), 12U);
  EXPECT_EQ(mesh_problem(cube), "");
  EXPECT_NEAR(signed_volume_mm3(cube), 8000, 1e-9);
}

TEST_F(ObjReader, SameCubeWhateverTheIndicesAndLineEnds) {
  const TriangleMesh cube = read(kCubeVertices + kCubeFaces);
  const std::string negative =
      "f -8 -5 -6 -7\nf -4 -3 -2 -1\nf -8 -7 -3 -4\nf -7 -6 -2 -3\nf -6 -5 -1 -2\nf -5 -8 -4 -1";
  std::string with_returns = kCubeVertices + kCubeFaces;
  for (std::size_t at = 0; (at = with_returns.find('\n', at)) != std::string::npos; at += 2) {
    with_returns.replace(at, 1, "\r\n");
  }
  std::string with_texture = "vt 0 0\nvn 0 0 1\n" + kCubeVertices + kCubeFaces;
  for (std::size_t at = 0; (at = with_texture.find("f ", at)) != std::string::npos; ++at) {
    const std::size_t end = with_texture.find('\n', at);
    std::string face = with_texture.substr(at + 2, end - at - 2) + " ";
    for (std::size_t i = 0; (i = face.find(' ', i)) != std::string::npos; i += 5) {
      face.replace(i, 1, "/1/1 ");
    }
    with_texture.replace(at + 2, end - at - 2, face);
  }
  for (const std::string& text :
       {kCubeVertices + negative, with_returns, with_texture, kCubeFaces + kCubeVertices}) {
    const TriangleMesh other = read(text);
    EXPECT_EQ(other.vertices_mm, cube.vertices_mm) << text;
    EXPECT_EQ(other.triangles, cube.triangles) << text;
  }
}

TEST_F(ObjReader, ShapesAndMaterialsBecomeOneMesh) {
  const TriangleMesh mesh = read("mtllib nowhere.mtl\no lower\nusemtl red\n" + kCubeVertices +
                                 "f 1 4 3 2\nf 5 6 7 8\no upper\ng side\nusemtl blue\ns 1\n" +
                                 "f 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
  EXPECT_EQ(mesh_problem(mesh), "");
}

// Weights, colours, textures, normals, lines and comments, which may follow on any line.
TEST_F(ObjReader, KeepsVerticesAndFacesAlone) {
  const TriangleMesh mesh = read(
      "# made by hand\nmtllib a.mtl\no thing\n  v  0 0\t0 # origin\nv 1 0 0 1\n"
      "v 0 1e0 0 .1 .2 .3\nvn 0 0 1\nvt 0 0\ng\ns off\nusemtl red\nf 1/1/1 2//1 3/1\nl 1 2\n"
      "f 1 2 3 # 1 2\nf 1 2 3 #1 2\nf -3 -2 -1");
  const std::array<int, 3> triangle = {0, 1, 2};
  EXPECT_EQ(mesh.vertices_mm, (std::vector<Eigen::Vector3d>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(mesh.triangles, std::vector(4, triangle));
  EXPECT_THAT(refusal(kCubeVertices + "f 1 2 3#4 5\n"),
              StartsWith(path_ + ":9: face corner '3#4' is not an index"));
}

TEST_F(ObjReader, MergesVerticesThatEveryFaceRepeats) {
  std::string text;
  for (const std::string face : {"0 0 0\nv 0 1 0\nv 1 0 0", "0 0 0\nv 1 0 0\nv 0 0 1",
                                 "0 0 0\nv 0 0 1\nv 0 1 0", "1 0 0\nv 0 1 0\nv 0 0 1"}) {
    text += "v " + face + "\nf -3 -2 -1\n";
  }
  const TriangleMesh mesh = read(text);
  EXPECT_EQ(mesh.vertices_mm.size(), 4U);
  EXPECT_EQ(mesh_problem(mesh), "");
  EXPECT_NEAR(signed_volume_mm3(mesh), 1.0 / 6, 1e-12);
}

// A prism over an arrow head: both ends concave, where the wrong diagonal lies outside.
TEST_F(ObjReader, ConcavePolygonsKeepTheirShape) {
  const std::string vertices =
      "v 0 0 0\nv 4 1 0\nv 0 2 0\nv 1 1 0\nv 0 0 5\nv 4 1 5\nv 0 2 5\nv 1 1 5\n";
  for (const std::string ends : {"f 4 3 2 1\nf 5 6 7 8\n", "f 1 4 3 2\nf 6 7 8 5\n"}) {
    const TriangleMesh mesh =
        read(vertices + ends + "f 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
    EXPECT_EQ(mesh_problem(mesh), "");
    EXPECT_NEAR(signed_volume_mm3(mesh), 15, 1e-12);  // area 3 by the shoelace formula, height 5
    double surface = 0;
    for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
      surface += area_vector_mm2(mesh, t).norm();
    }
    EXPECT_NEAR(surface, 2 * 3 + 5 * (2 * std::sqrt(17) + 2 * std::sqrt(2)), 1e-12);
  }
}

TEST_F(ObjReader, PolygonOfMoreThan255Corners) {
  std::ostringstream text;
  std::ostringstream top;
  std::ostringstream bottom;
  text.precision(17);
  for (int i = 0; i < 400; ++i) {
    const double angle = 2 * std::numbers::pi * i / 400;
    const int at = 2 * i + 1;  // the lower vertex, from 1; the upper one follows
    const int next = i < 399 ? at + 2 : 1;
    for (const int z : {0, 5}) {
      text << "v " << 10 * std::cos(angle) << " " << 10 * std::sin(angle) << " " << z << "\n";
    }
    text << "f " << at << " " << next << " " << next + 1 << " " << at + 1 << "\n";
    bottom << " " << 799 - 2 * i;
    top << " " << at + 1;
  }
  text << "f" << bottom.str() << "\nf" << top.str() << "\n";
  const TriangleMesh mesh = read(text.str());
  EXPECT_EQ(mesh.triangles.size(), 2 * 398U + 800U);
  EXPECT_EQ(mesh_problem(mesh), "");
  // A regular polygon of n corners has the area n r^2 sin(2 pi / n) / 2.
  EXPECT_NEAR(signed_volume_mm3(mesh), 5 * 400 * 100 * std::sin(2 * std::numbers::pi / 400) / 2,
              1e-9);
}

TEST_F(ObjReader, CoordinatesInDoublePrecision) {
  const TriangleMesh mesh = read("v 1234.5678901234 0 0\nv 1e-7 1 0\nv -.5 +2.25 3\nf 1 2 3\n");
  EXPECT_NEAR(mesh.vertices_mm[0].x(), 1234.5678901234, 1e-12);
  EXPECT_NEAR(mesh.vertices_mm[1].x(), 1e-7, 1e-21);
  EXPECT_EQ(mesh.vertices_mm[2], Eigen::Vector3d(-0.5, 2.25, 3));
}

TEST_F(ObjReader, NamesTheFileItCannotUse) {
  const std::string missing = folder_ / "nowhere.obj";
  EXPECT_THROW(read_obj(missing), InputError);
  EXPECT_THROW(read_obj(folder_.path()), InputError);
  EXPECT_EQ(refusal(""), path_ + ": contains no faces");
  EXPECT_EQ(refusal(kCubeVertices), path_ + ": contains no faces");
  EXPECT_THAT(refusal("v 0 0 nan\n"), StartsWith(path_ + ":1: coordinate 'nan'"));
  EXPECT_THAT(refusal("v 0 0 0\nf 1 1 7\n"), StartsWith(path_ + ":2: vertex index 7"));
  write_file(path_, kCubeVertices + kCubeFaces);
  EXPECT_THROW(read_obj(path_, 11), InputError);
  EXPECT_NO_THROW(read_obj(path_, 12));
}

}  // namespace
}  // namespace scattermeter::capture
