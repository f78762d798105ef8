#include "apps/rig/rig_surroundings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/yaml_text.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

SceneSurroundings read(const std::string& text) {
  return read_surroundings(yaml_text("s: " + text + "\n").at("s"));
}

TEST(RigSurroundings, ReadsThePlane) {
  const ScenePlane plane = *read(
                                "{plane: {z_mm: -2.5, albedo: [0.1, 0.2, 0.9], "
                                "albedo_std: 0.01}, contact: optical}")
                                .plane;
  EXPECT_EQ(plane.z_mm, -2.5);
  EXPECT_EQ(plane.albedo[2], 0.9);
  EXPECT_TRUE((plane.albedo_std == 0.01).all());
  EXPECT_EQ(plane.contact, PlaneContact::kOptical);
  EXPECT_EQ(plane.line, 1);
  EXPECT_EQ(plane.in(1).albedo, 0.2);
  EXPECT_EQ(plane.in(1).contact, PlaneContact::kOptical);
}

// Unless stated, an albedo is known to a tenth and to no better than 0.02.
TEST(RigSurroundings, AlbedoIsNotExactByDefault) {
  const ScenePlane plane = *read("{plane: {z_mm: 0, albedo: [0.1, 0.5, 0]}}").plane;
  EXPECT_EQ(plane.albedo_std[0], 0.02);
  EXPECT_EQ(plane.albedo_std[1], 0.05);
  EXPECT_EQ(plane.albedo_std[2], 0.02);
  EXPECT_EQ(plane.contact, PlaneContact::kAir);
}

TEST(RigSurroundings, NamesMistakes) {
  const auto refusal = [](const std::string& text) { return refusal_of([&] { read(text); }); };
  EXPECT_THAT(refusal("{contact: air}"), HasSubstr("s.plane"));
  EXPECT_THAT(refusal("{plane: {albedo: 0.1}}"), HasSubstr("s.plane.z_mm"));
  EXPECT_THAT(refusal("{plane: {z_mm: 0}}"), HasSubstr("s.plane.albedo"));
  EXPECT_THAT(refusal("{plane: {z_mm: 0, albedo: 1.1}}"), HasSubstr("s.plane.albedo"));
  EXPECT_THAT(refusal("{plane: {z_mm: 0, albedo: [0, 0, 1.1]}}"), HasSubstr("from 0 to 1"));
  EXPECT_THAT(refusal("{plane: {z_mm: 0, albedo: 1}, contact: glue}"),
              HasSubstr("expected air, optical or black"));
  EXPECT_THAT(refusal("{plane: {z_mm: 0, albedo: 1}, table: 1}"), HasSubstr("s.table"));
}

}  // namespace
}  // namespace scattermeter::apps
