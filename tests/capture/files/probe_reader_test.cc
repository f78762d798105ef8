#include "capture/files/probe_reader.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/input_error.h"
#include "core/light/environment_light.h"
#include "core/light/sky_probe.h"
#include "tests/fixtures/capture/probe_bytes.h"
#include "tests/fixtures/core/boxes.h"
#include "tests/fixtures/shared_file.h"
#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::capture {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class ProbeReader : public ::testing::Test {
 protected:
  std::string refusal(const std::string& bytes) {
    write_file(folder_ / "p", bytes);
    return refusal_of(folder_ / "p");
  }
  static std::string refusal_of(const std::string& path) {
    try {
      read_probe(path);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }
  ProbeImage read(const std::string& bytes) {
    write_file(folder_ / "p", bytes);
    return read_probe(folder_ / "p");
  }
  TemporaryFolder folder_;
};

ProbeTree tree_of(const ProbeImage& image) {
  Environment environment;
  environment.width_px = image.width_px;
  environment.height_px = image.height_px;
  environment.radiance = image.radiance;
  return ProbeTree(environment);
}

// A notch in a block: some facets are shaded.
std::array<IncidentLight, 3> light_of(const ProbeImage& image) {
  TriangleMesh mesh = test_support::make_box({-5, -5, -1}, {5, 5, 0});
  const TriangleMesh tower = test_support::make_box({-1, -1, 1}, {1, 1, 6});
  for (auto t : tower.triangles) {
    for (int& i : t) i += static_cast<int>(mesh.vertices_mm.size());
    mesh.triangles.push_back(t);
  }
  mesh.vertices_mm.insert(mesh.vertices_mm.end(), tower.vertices_mm.begin(),
                          tower.vertices_mm.end());
  const RayScene scene(mesh);
  return illuminate(PatchMesh(mesh, 1.5), scene, tree_of(image), 1.4);
}

TEST_F(ProbeReader, HdrAndExrGiveTheSameLight) {
  SkyProbe sky;
  sky.width_px = 128;
  const Environment made = make_sky_probe(sky);
  const ProbeImage image{made.width_px, made.height_px, made.radiance};
  const ProbeImage hdr = read(hdr_bytes(image));
  // What the Radiance file holds, as OpenEXR float: the same digits throughout.
  const ProbeImage exr = read(exr_bytes(hdr, ExrType::kFloat));
  EXPECT_EQ(exr.radiance, hdr.radiance);
  const auto from_hdr = light_of(hdr);
  const auto from_exr = light_of(exr);
  const auto exact = light_of(read(exr_bytes(image, ExrType::kFloat)));
  for (std::size_t c = 0; c < 3; ++c) {
    ASSERT_GT(from_hdr[c].shadow_rays, 0U);
    EXPECT_EQ(from_hdr[c].patch_power_sr, from_exr[c].patch_power_sr);
    for (std::size_t k = 0; k < exact[c].patch_power_sr.size(); ++k) {
      // RGBE rounds down by 1/256 of a pixel's brightest channel on average, 1/128 at most; red is
      // a fifth of the brightest at the zenith.
      EXPECT_LE(from_hdr[c].patch_power_sr[k], 1.001 * exact[c].patch_power_sr[k]);
      EXPECT_GE(from_hdr[c].patch_power_sr[k], (1.0 - 5.0 / 128) * exact[c].patch_power_sr[k]);
    }
  }
}

TEST_F(ProbeReader, NamesTheBadPixel) {
  ProbeImage image{6, 4, std::vector<float>(72, 1.0F)};
  for (const auto& [value, text] : {std::pair{-0.25F, "-0.25"},
                                    {std::numeric_limits<float>::quiet_NaN(), "nan"},
                                    {std::numeric_limits<float>::infinity(), "inf"}}) {
    image.radiance[3 * (3 * 6 + 4) + 2] = value;
    for (const ExrType type : {ExrType::kHalf, ExrType::kFloat}) {
      EXPECT_THAT(refusal(exr_bytes(image, type)),
                  AllOf(HasSubstr("/p: "), HasSubstr("pixel (4, 3), channel B"), HasSubstr(text)));
    }
  }
}

TEST_F(ProbeReader, RefusesOtherFiles) {
  EXPECT_THAT(refusal_of(folder_ / "gone.hdr"), HasSubstr("gone.hdr: no such file"));
  EXPECT_THAT(refusal_of(folder_.path()), HasSubstr("is a folder, the image"));
  EXPECT_THAT(refusal("hello"), HasSubstr("neither"));
  EXPECT_THAT(refusal(""), HasSubstr("neither"));
  EXPECT_THAT(refusal(hdr_bytes({8, 8, std::vector<float>(192, 0.0F)})), HasSubstr("black"));
}

TEST_F(ProbeReader, PhotographedProbe) {
  const std::string path = shared_file("data/probes/pedestrian_overpass_1k.hdr");
  if (!std::filesystem::exists(path)) GTEST_SKIP() << shared_file_missing(path);
  const ProbeImage image = read_probe(path);
  EXPECT_EQ(image.width_px, 1024);
  EXPECT_EQ(image.height_px, 512);
  EXPECT_EQ(*std::max_element(image.radiance.begin(), image.radiance.end()), 118272.0F);
  const ProbeTree tree = tree_of(image);
  // The sun stands apart, and the light from above is more than that from below.
  EXPECT_GT(tree.bright().size(), 0U);
  EXPECT_LT(tree.bright().size(), 100U);
  EXPECT_GT(open_irradiance(tree, {0, 0, 1}, 1.49)[1],
            2.0 * open_irradiance(tree, {0, 0, -1}, 1.49)[1]);
  EXPECT_GT(light_of(image)[1].shadow_rays, 0U);
}

}  // namespace
}  // namespace scattermeter::capture
