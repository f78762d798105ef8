// Every mistake gets its own message naming file, field and value, exit status 2, and leaves
// nothing behind.
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/fixtures/apps/small_rig.h"

namespace scattermeter::apps {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using Json = nlohmann::json;

class BadInput : public ::testing::Test {
 protected:
  // One shot, made once for all tests of the fixture.
  void SetUp() override {
    rig_.keep_shots("POM_cube_1");
    rig_.simulate();
  }
  // Measuring must fail with a message that holds all of these, and write nothing.
  void expect_refused(const std::vector<std::string>& holds) {
    const Answer r = rig_.measure();
    EXPECT_EQ(r.status, 2) << r.out << r.err;
    for (const std::string& text : holds) EXPECT_THAT(r.err, HasSubstr(text));
    EXPECT_EQ(r.out, "");
    EXPECT_FALSE(std::filesystem::exists(rig_.out()));
  }
  void change(const std::string& from, const std::string& to) {
    rig_.write(replaced(rig_.text(), from, to));
  }
  std::string mesh(const std::string& text) {
    write_file(rig_ / "cube.obj", text);
    return text;
  }
  SmallRig rig_;
};

TEST_F(BadInput, MissingFolder) {
  std::filesystem::remove_all(rig_.shots());
  expect_refused({rig_.shots(), "does not exist"});
}

TEST_F(BadInput, ResultsInTheWrongPlace) {
  const auto told = [&](const std::string& out) {
    const Answer r = run({"measure", rig_.shots(), "--rig", rig_ / "nowhere.yaml", "--out", out});
    EXPECT_EQ(r.status, 2);
    return r.err;  // before the rig is even opened
  };
  EXPECT_THAT(told(rig_.shots() + "/"), HasSubstr("--out: is the folder of the shots"));
  EXPECT_THAT(told(rig_.rig()), HasSubstr("rig.yaml: is a file, a folder is needed"));
  EXPECT_THAT(told(rig_.rig() + "/deep"), HasSubstr("cannot be created"));
}

TEST_F(BadInput, JpegAmongTheRaws) {
  write_file(rig_.shots() + "/POM_cube_1.dng", std::string("\xff\xd8\xff\xe0 JFIF and more of it"));
  expect_refused({"POM_cube_1.dng", "is a JPEG picture, a raw file is needed"});
}

TEST_F(BadInput, NamesThatWereMeant) {
  change("object: cube, material: POM", "object: cbue, material: POM");
  expect_refused(
      {rig_.rig(), "shots[0].object: no such object in objects, got cbue;", "did you mean cube?"});
  change("cbue", "cube");
  change("lights: [led1]", "lights: [lde1]");
  expect_refused({"shots[0].lights[0]: no such light in lights, got lde1; did you mean led1?"});
  change("[lde1]", "[led1]");
  const Answer r = rig_.measure({"--material", "PQM"});
  EXPECT_THAT(r.err, HasSubstr("no shot is of material PQM; did you mean POM? (there are: POM)"));
}

TEST_F(BadInput, LengthsInMetres) {
  const std::string good = rig_.text();
  change("position_mm: [30, -60, 80]", "position_mm: [0.03, -0.06, 0.08]");
  expect_refused(
      {"lights.led1.position_mm: lengths are in mm, and this one looks like metres", "0.08"});
  std::string metres = good;
  for (std::size_t at = 0; (at = metres.find("world_mm: [", at)) != std::string::npos;) {
    const std::size_t end = metres.find(']', at);
    std::istringstream numbers(metres.substr(at + 11, end - at - 11));
    std::string list;
    for (std::string number; std::getline(numbers, number, ',');) {
      list += (list.empty() ? "" : ", ") + std::to_string(1e-3 * std::stod(number));
    }
    metres.replace(at + 11, end - at - 11, list);
    at += 11;
  }
  rig_.write(metres);
  expect_refused({"pose.points: lengths are in mm, and this one looks like metres"});
}

TEST_F(BadInput, TwoShotsOfOneName) {
  change("shots:\n",
         "shots:\n  - {file: POM_cube_1.dng, object: cube, material: PE, lights: [led2]}\n");
  expect_refused(
      {"shots[1].file: two shots of the same name: POM_cube_1.dng is also that of line"});
}

// The pose is that of the other points; the user is told which one is left out.
TEST_F(BadInput, MistypedPointIsNamed) {
  const std::string& text = rig_.text();
  const std::size_t third =
      text.find("image_px: [", text.find("image_px: [", text.find("image_px: [") + 1) + 1);
  std::string wrong = text;
  const std::size_t first_digit = third + std::string("image_px: [").size();
  wrong.insert(first_digit, "9");  // 9241.8 for 241.8
  rig_.write(wrong);
  const Answer r = rig_.measure({"--model", "dipole"});
  EXPECT_EQ(r.status, 0) << r.out << r.err;
  EXPECT_THAT(r.err, ::testing::ContainsRegex(
                         "note: .*rig.yaml:[0-9]+: pose: left out, because the other points "
                         "contradict them: points\\[2\\] \\([^)]* px off\\); check their numbers"));
}

// What a file may claim can be raised, and lowered; the message says by which key.
TEST_F(BadInput, Limits) {
  const std::string head = "scattermeter_rig: 1\n";
  const std::string rig = rig_.text();
  const auto with = [&](const std::string& limits) {
    rig_.write(replaced(rig, head, head + "limits: {" + limits + "}\n"));
  };
  with("raw_megapixels: 0.1");  // 484 x 324 are 0.157
  expect_refused({rig_.rig(), "camera.image_size_px: more than the allowed 0.1 megapixels",
                  "limits.raw_megapixels"});
  with("mesh_triangles: 11");
  expect_refused({"cube.obj", "more than 11 triangles", "limits.mesh_triangles"});
  with("mesh_triangles: 0");
  expect_refused({"limits.mesh_triangles", "got 0"});
  with("raw_megapixels: 1e9");
  expect_refused({"limits.raw_megapixels: expected a number", "got 1e9"});
  with("raw: 5");
  expect_refused({"limits.raw", "unknown"});
  // Before anything is allocated: 10^10 samples.
  rig_.write(replaced(rig, "image_size_px: [484, 324]", "image_size_px: [100000, 100000]"));
  expect_refused({"camera.image_size_px", "400 megapixels"});
  with("raw_megapixels: 0.2, mesh_triangles: 1000, probe_megapixels: 1000");
  EXPECT_NE(rig_.measure().status, 2);
}

// A list of lists of lists ... that are one another: 10^9 values where they were counted out.
TEST_F(BadInput, AliasesThatExplode) {
  std::string text = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 9; ++i) {
    const std::string last = "*a" + std::to_string(i - 1);
    text += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [" + last;
    for (int k = 1; k < 10; ++k) text += ", " + last;
    text += "]\n";
  }
  const std::string rig = rig_.text();
  rig_.write(text + rig);
  expect_refused({rig_.rig() + ":1", "a0"});
  rig_.write(replaced(text + rig, "a0: &a0", "objects: &a0"));
  expect_refused({rig_.rig()});
}

TEST_F(BadInput, ALensOfBillions) {
  rig_.write(
      replaced(rig_.text(), "image_size_px: [484, 324]",
               "image_size_px: [&a [1, 1, 1, 1, 1, 1, 1, 1], &b [*a, *a, *a, *a, *a, *a, *a], "
               "&c [*b, *b, *b, *b, *b, *b, *b], &d [*c, *c, *c, *c, *c, *c, *c], &e [*d, *d, "
               "*d, *d, *d, *d, *d], &f [*e, *e, *e, *e, *e, *e, *e], &g [*f, *f, *f, *f, *f, "
               "*f, *f], &h [*g, *g, *g, *g, *g, *g, *g], [*h, *h, *h, *h, *h, *h]]"));
  expect_refused({"camera.image_size_px"});
}

TEST_F(BadInput, EmptyFolder) {
  std::filesystem::remove(rig_.shots() + "/POM_cube_1.dng");
  expect_refused({rig_.shots(), "empty"});
}

TEST_F(BadInput, FolderThatIsAFile) {
  const Answer r = run({"measure", rig_.rig(), "--rig", rig_.rig(), "--out", rig_.out()});
  EXPECT_EQ(r.status, 2);
  EXPECT_THAT(r.err, HasSubstr("not a folder"));
}

TEST_F(BadInput, FileThatIsNoRaw) {
  write_file(rig_.shots() + "/POM_cube_1.dng", std::string("hello, I am text\n"));
  expect_refused({"POM_cube_1.dng"});
}

TEST_F(BadInput, RawCutOffHalfWay) {
  const std::string path = rig_.shots() + "/POM_cube_1.dng";
  std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
  expect_refused({"POM_cube_1.dng"});
}

TEST_F(BadInput, ShotNotListedIsSaidAndSkipped) {
  write_file(rig_.shots() + "/notes.txt", std::string("x"));
  const Answer r = rig_.measure();
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.err, AllOf(HasSubstr("notes.txt"), HasSubstr("skipped")));
  EXPECT_THAT(Json::parse(rig_.result())["notes"].dump(), HasSubstr("notes.txt"));
}

TEST_F(BadInput, ListedShotThatIsNotThere) {
  change("shots:\n", "shots:\n  - {file: gone.dng, object: cube, material: POM, lights: [led1]}\n");
  expect_refused({"rig.yaml:", "gone.dng"});
}

TEST_F(BadInput, WrongCamera) {
  change("model: NIKON D80", "model: Canon EOS 5D");
  expect_refused({"POM_cube_1.dng", "camera.model", "D80", "Canon EOS 5D"});
}

TEST_F(BadInput, WrongSize) {
  change("image_size_px: [484, 324]", "image_size_px: [484, 326]");
  expect_refused({"POM_cube_1.dng", "camera.image_size_px", "484 x 324", "484 x 326"});
}

TEST_F(BadInput, MissingMesh) {
  std::filesystem::remove(rig_ / "cube.obj");
  expect_refused({"rig.yaml:", "objects.cube.mesh", "cube.obj"});
}

TEST_F(BadInput, OpenMesh) {
  const std::string text = slurp(rig_ / "cube.obj");
  mesh(replaced(text, "f 5 6 7 8\n", ""));
  expect_refused({"objects.cube.mesh", "cube.obj", "open"});
}

TEST_F(BadInput, EmptyMesh) {
  mesh("# nothing\n");
  expect_refused({"objects.cube.mesh", "cube.obj"});
}

TEST_F(BadInput, MeshInMetres) {
  std::string text;
  for (const char* v : {"-.01 -.01 0", ".01 -.01 0", ".01 .01 0", "-.01 .01 0", "-.01 -.01 .02",
                        ".01 -.01 .02", ".01 .01 .02", "-.01 .01 .02"}) {
    text += std::string("v ") + v + "\n";
  }
  mesh(text + "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
  expect_refused({"objects.cube.mesh", "metres"});
}

TEST_F(BadInput, MeshBehindTheCamera) {
  std::string text = slurp(rig_ / "cube.obj");
  // The cube far up behind the camera, which looks down.
  std::string moved;
  for (const auto& xy : {"-10 -210", "10 -210", "10 -190", "-10 -190"}) {
    moved += std::string("v ") + xy + " 300\n";
  }
  for (const auto& xy : {"-10 -210", "10 -210", "10 -190", "-10 -190"}) {
    moved += std::string("v ") + xy + " 320\n";
  }
  mesh(moved + text.substr(text.find("f ")));
  expect_refused({"objects.cube", "behind the camera"});
}

TEST_F(BadInput, LedInsideTheObject) {
  change("led1: {type: led, position_mm: [30, -60, 80]",
         "led1: {type: led, position_mm: [3, -6, 8]");
  expect_refused({"lights.led1.position_mm", "inside object cube", "[3, -6, 8]"});
}

TEST_F(BadInput, Probe) {
  const std::string led = rig_.text();
  const auto environment = [&](const std::string& fields) {
    rig_.write(
        replaced(replaced(led, "lights:\n",
                          "lights:\n  sky: {type: environment, image: sky.hdr, " + fields + "}\n"),
                 "lights: [led1]}", "lights: [led1, sky]}"));
  };
  environment("projection: equirectangular");
  expect_refused({"rig.yaml:", "lights.sky.image", "sky.hdr", "no such file"});
  write_file(rig_ / "sky.hdr",
             std::string("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 8\nabcd"));
  expect_refused({"lights.sky.image", "sky.hdr", "truncated"});
  environment("projection: cube");
  expect_refused({"lights.sky.projection", "angular_map"});
  environment("projection: mirror_ball, up: [0, 1, 0]");
  expect_refused({"lights.sky", "parallel"});
  environment("projection: mirror_ball, radiance_W_per_mm2_sr: [0, 0, 0]");
  expect_refused({"lights.sky.radiance_W_per_mm2_sr", "at least one channel"});
  environment("projection: mirror_ball, exponent: 1");
  expect_refused({"lights.sky", "exponent"});
}

TEST_F(BadInput, LedThatShinesAway) {
  change("axis: [-30, 60, -70]", "axis: [30, -60, 70]");
  expect_refused({"lights.led1", "cube", "axis"});
}

TEST_F(BadInput, PosePointsOnALine) {
  const std::size_t begin = rig_.text().find("    - {world_mm");
  const std::size_t end = rig_.text().find("objects:");
  std::string points;
  for (int i = 0; i < 6; ++i) {
    points += "    - {world_mm: [" + std::to_string(4 * i - 10) + ", 0, 0], image_px: [" +
              std::to_string(150 + 30 * i) + ", 160]}\n";
  }
  rig_.write(rig_.text().substr(0, begin) + points + rig_.text().substr(end));
  expect_refused({"rig.yaml:", "pose.points", "line"});
}

TEST_F(BadInput, TooFewPosePoints) {
  std::size_t at = rig_.text().find("    - {world_mm");
  for (int i = 0; i < 3; ++i) at = rig_.text().find("    - {world_mm", at + 1);
  rig_.write(rig_.text().substr(0, at) + rig_.text().substr(rig_.text().find("objects:")));
  expect_refused({"rig.yaml:", "pose.points", "four"});
}

// One dark or one clipped shot refuses its material and leaves the others alone.
TEST(BadShot, DarkAndClippedShotsRefuseTheirMaterialOnly) {
  SmallRig rig;
  rig.keep_shots("_cube_1");
  rig.write(replaced(rig.text(), "material: PP, lights: [led1]}",
                     "material: PP, lights: [led1], exposure_s: 1.0e-9}"));
  rig.write(replaced(rig.text(), "material: PE, lights: [led1]}",
                     "material: PE, lights: [led1], exposure_s: 5.0}"));
  rig.simulate();
  const Answer r = rig.measure();
  EXPECT_EQ(r.status, 1) << r.out << r.err;
  const Json result = Json::parse(rig.result());
  ASSERT_EQ(result["results"].size(), 9U);
  for (const Json& x : result["results"]) {
    const std::string reasons = x["reasons"].dump();
    if (x["material"] == "POM") {
      EXPECT_EQ(x["verdict"], "ok") << reasons;
      continue;
    }
    EXPECT_EQ(x["verdict"], "refused");
    EXPECT_TRUE(x["sigma_s_prime_per_mm"]["value"].is_null());
    EXPECT_THAT(reasons, HasSubstr(x["material"] == "PP" ? "PP_cube_1.dng: channel" : "clipped"));
    EXPECT_EQ(x["material"] == "PP", reasons.find("dark") != std::string::npos);
  }
}

TEST(BadRig, ResultFolderThatCannotBeMade) {
  SmallRig rig;
  rig.keep_shots("POM_cube_1");
  rig.simulate();
  write_file(rig / "out", std::string("a file"));
  EXPECT_EQ(rig.measure().status, 2);
  EXPECT_EQ(slurp(rig / "out"), "a file");
}

}  // namespace
}  // namespace scattermeter::apps
