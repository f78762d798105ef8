#include "capture/files/obj_syntax.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/input_error.h"

namespace scattermeter::capture {
namespace {

const std::string kThreeVertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

std::string refusal(const std::string& text, std::size_t max_triangles = 100,
                    const std::string& path = "a.obj") {
  try {
    check_obj_syntax(path, text, max_triangles);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(ObjSyntax, CountsVerticesFacesAndTriangles) {
  const ObjCounts counts = check_obj_syntax(
      "a.obj",
      "# made by hand\nmtllib a.mtl\no thing\n  v  0 0\t0 # origin\nv 1 0 0 1\nv 0 1e0 0 .1 .2 .3\n"
      "vn 0 0 1\nvt 0 0\ng\ns off\nusemtl red\nf 1/1/1 2//1 3/1\nl 1 2\nf -3 -2 -1",
      100);
  EXPECT_EQ(counts.vertices, 3U);
  EXPECT_EQ(counts.faces, 2U);
  EXPECT_EQ(counts.triangles, 2U);
}

TEST(ObjSyntax, AnyLineEndAndNoneAtTheEnd) {
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    const auto with_ends = [&](std::string text) {
      for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += end.size()) {
        text.replace(at, 1, end);
      }
      return text;
    };
    const ObjCounts counts =
        check_obj_syntax("a.obj", with_ends("v 0 0 0||v 1 0 0|v 0 1 0|f 1 2 3"), 100);
    EXPECT_EQ(counts.vertices, 3U);
    EXPECT_EQ(counts.faces, 1U);
    EXPECT_EQ(refusal(with_ends("v 0 0 0||v 1 0 x")),
              "a.obj:3: coordinate 'x' is not a finite number");
  }
}

TEST(ObjSyntax, NamesLineAndValueOfABadCoordinate) {
  for (const std::string bad :
       {"nan", "inf", "-inf", "1e999", "abc", "1,5", "0x10", "1.5mm", "--1", "+-1", "1e", "."}) {
    EXPECT_EQ(refusal("# one\nv 0 0 " + bad + "\n"),
              "a.obj:2: coordinate '" + bad + "' is not a finite number");
  }
  EXPECT_EQ(refusal("v 1 2\n"), "a.obj:1: a vertex takes three coordinates, got 2 numbers");
  EXPECT_EQ(refusal("v 1 2 3 4 5\n"), "a.obj:1: a vertex takes three coordinates, got 5 numbers");
  EXPECT_EQ(refusal("v +1.5 -2.5e-3 .5\n"), "accepted");
}

TEST(ObjSyntax, NamesLineAndValueOfABadFace) {
  const auto face = [](const std::string& corners) {
    return refusal(kThreeVertices + "f " + corners + "\n");
  };
  EXPECT_EQ(face("1 2 3"), "accepted");
  EXPECT_EQ(face("1 2"), "a.obj:4: a face takes three or more corners, got 2");
  EXPECT_EQ(face("1 2 0"), "a.obj:4: vertex index 0 is out of range, 3 vertices precede it");
  EXPECT_EQ(face("1 2 -4"), "a.obj:4: vertex index -4 is out of range, 3 vertices precede it");
  EXPECT_EQ(face("1 2 4"), "a.obj:4: vertex index 4 is out of range, the file has 3 vertices");
  EXPECT_EQ(face("1 2 4294967297"),
            "a.obj:4: vertex index 4294967297 is out of range, the file has 3 vertices");
  for (const std::string bad :
       {"99999999999999999999", "x", "1.5", "3/", "3/x", "3//", "3/1/", "3/1/1/1", "/3", "3x"}) {
    EXPECT_EQ(face("1 2 " + bad), "a.obj:4: face corner '" + bad + "' is not an index");
  }
}

TEST(ObjSyntax, FacesMayNameLaterVertices) {
  EXPECT_EQ(refusal("f 1 2 3\n" + kThreeVertices), "accepted");
  EXPECT_EQ(refusal("f -1 -2 -3\n" + kThreeVertices),
            "a.obj:1: vertex index -1 is out of range, 0 vertices precede it");
}

TEST(ObjSyntax, RefusesUnknownKeywordsAndContinuedLines) {
  EXPECT_EQ(refusal("Dear diary,\n"), "a.obj:1: 'Dear' is not a keyword of an OBJ file");
  EXPECT_EQ(
      refusal("solid cube\n", 100, "a.stl"),
      "a.stl:1: 'solid' is not a keyword of an OBJ file; a mesh of another kind (STL, PLY) is "
      "to be exported as OBJ");
  // Whatever the file is called.
  EXPECT_THAT(refusal("solid cube\n"), ::testing::EndsWith("is to be exported as OBJ"));
  EXPECT_EQ(refusal("V 0 0 0\n"), "a.obj:1: 'V' is not a keyword of an OBJ file");
  EXPECT_EQ(refusal(std::string("\0a\xff\n", 4)), "a.obj:1: '?a?' is not a keyword of an OBJ file");
  EXPECT_EQ(refusal("f 1 2 \\\n3\n"),
            "a.obj:1: lines continued with a backslash are not supported");
}

TEST(ObjSyntax, CountsTheTrianglesOfPolygons) {
  const std::string text = kThreeVertices + "v 1 1 0\nf 1 2 4 3\nf 1 2 3\n";
  EXPECT_EQ(refusal(text, 3), "accepted");
  EXPECT_EQ(refusal(text, 2), "a.obj:6: more than 2 triangles (limits.mesh_triangles of the rig)");
}

}  // namespace
}  // namespace scattermeter::capture
