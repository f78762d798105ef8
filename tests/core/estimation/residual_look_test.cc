#include "core/estimation/residual_look.h"

#include <functional>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/core/dipole_cube.h"

namespace scattermeter {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

// Two shots of a cube in which the observed light departs from the predicted one.
class ResidualLookTest : public ::testing::Test {
 protected:
  static constexpr double kNoise = 2e-3;

  ResidualLookTest() {
    cube_.show(test_support::kCubeMedium, kNoise);
    channel_ = material_channels(cube_.scene, cube_.shots).front();
  }
  // departure: by shot and row, relative to the predicted l, besides `everywhere` in l.
  std::optional<ResidualLook> look(const std::function<double(std::size_t, std::size_t)>& departure,
                                   double everywhere = 0.0) {
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    std::vector<ShotRows> rows;
    for (std::size_t s = 0; s < cube_.shots.size(); ++s) {
      const ChannelObservation& o = cube_.shots[s].observation.channel[0];
      ShotRows& r = rows.emplace_back();
      r.file = cube_.shots[s].stated->file;
      r.state = o.state;
      for (std::size_t j = 0; j < o.l.size(); ++j) {
        r.predicted.push_back(static_cast<float>(o.l[j]));
        r.std.push_back(static_cast<float>(kNoise * o.l[j]));
        r.observed.push_back(static_cast<float>(
            o.l[j] * (1.0 + departure(s, j) + kNoise * normal(random)) + everywhere));
      }
    }
    return residual_look(rows, channel_);
  }
  const SeenObject& seen() const { return *cube_.shots[0].seen; }
  Eigen::Vector3d normal_of(std::size_t row) const {
    return seen().patches->normal(seen().map.patch_of_row[row]);
  }
  Eigen::Vector2d in_image(std::size_t row) const {
    return (cube_.shots[0].pose.camera_from_world * seen().sites[row].center_mm).hnormalized();
  }

  test_support::DipoleCube cube_{2, 1.5};
  MaterialChannel channel_;
};

TEST_F(ResidualLookTest, NoiseLooksLikeNothing) {
  EXPECT_FALSE(look([](std::size_t, std::size_t) { return 0.0; }));
}

TEST_F(ResidualLookTest, OneShot) {
  const auto found = look([](std::size_t s, std::size_t) { return s == 1 ? -0.03 : 0.0; });
  ASSERT_TRUE(found);
  EXPECT_EQ(found->phrase, "one shot, b.dng, 3 % darker than predicted");
  EXPECT_GT(found->share, 0.9);
}

TEST_F(ResidualLookTest, OneFace) {
  const auto found =
      look([&](std::size_t, std::size_t row) { return normal_of(row).z() > 0.9 ? 0.02 : 0.0; });
  ASSERT_TRUE(found);
  EXPECT_EQ(
      found->phrase,
      "one face (normal [0.00, 0.00, 1.00]), 2 % brighter than predicted, as by a lamp that is "
      "not listed or a face that differs from its mesh");
}

TEST_F(ResidualLookTest, Pedestal) {
  const std::vector<double>& l = cube_.shots[0].observation.channel[0].l;
  const double most = *std::max_element(l.begin(), l.end());
  const auto found = look([](std::size_t, std::size_t) { return 0.0; }, -0.01 * most);
  ASSERT_TRUE(found);
  EXPECT_THAT(found->phrase, StartsWith("an equal amount of light everywhere, "));
  EXPECT_THAT(found->phrase, HasSubstr("too little"));
}

TEST_F(ResidualLookTest, Gradient) {
  const auto found = look([&](std::size_t, std::size_t row) { return 0.5 * in_image(row).x(); });
  ASSERT_TRUE(found);
  EXPECT_THAT(found->phrase, StartsWith("a gradient over the image: towards the right "));
  EXPECT_THAT(found->phrase, HasSubstr("brighter than predicted"));
}

// A picture that is shifted: too bright at one outline, too dark at the other.
TEST_F(ResidualLookTest, BandAlongTheOutline) {
  const auto found = look([&](std::size_t, std::size_t row) {
    if (seen().map.guarded_of_row[row] == 0) return 0.0;
    return in_image(row).x() > 0.0 ? 0.03 : -0.03;
  });
  ASSERT_TRUE(found);
  EXPECT_THAT(found->phrase, StartsWith("a band along outline and edges, "));
}

TEST_F(ResidualLookTest, Vignetting) {
  const std::size_t rows = seen().sites.size();
  double mean = 0.0;
  for (std::size_t j = 0; j < rows; ++j) {
    mean += in_image(j).squaredNorm() / static_cast<double>(rows);
  }
  const auto found = look(
      [&](std::size_t, std::size_t row) { return 8.0 * (mean - in_image(row).squaredNorm()); });
  ASSERT_TRUE(found);
  EXPECT_THAT(found->phrase, StartsWith("light that falls off towards the picture's corners"));
}

TEST_F(ResidualLookTest, Response) {
  const std::vector<double>& l = cube_.shots[0].observation.channel[0].l;
  const double most = *std::max_element(l.begin(), l.end());
  const auto found = look([&](std::size_t s, std::size_t row) {
    const double own = cube_.shots[s].observation.channel[0].l[row] / most;
    return 0.05 * (0.5 - own);
  });
  ASSERT_TRUE(found);
  EXPECT_THAT(found->phrase, StartsWith("bright parts too dark: the camera's response"));
}

TEST_F(ResidualLookTest, Spots) {
  const auto found = look([](std::size_t, std::size_t row) { return row % 100 == 0 ? -0.1 : 0.0; });
  ASSERT_TRUE(found);
  EXPECT_THAT(found->phrase, StartsWith("a few spots, "));
}

// Each patch on its own.
TEST_F(ResidualLookTest, Scatter) {
  const auto found = look([](std::size_t s, std::size_t row) {
    return 0.03 * std::sin(static_cast<double>((row * 7919 + s) % 1000));
  });
  ASSERT_TRUE(found);
  EXPECT_THAT(found->phrase, StartsWith("scatter from patch to patch: more noise than "));
}

// A departure that is smooth over the surface, but in no pattern, is not given a name.
TEST_F(ResidualLookTest, Anything) {
  EXPECT_FALSE(look([&](std::size_t, std::size_t row) {
    const Eigen::Vector3d& p = seen().sites[row].center_mm;
    return 0.02 * std::sin(0.7 * p.x()) * std::cos(0.7 * p.y()) * std::cos(0.7 * p.z());
  }));
}

}  // namespace
}  // namespace scattermeter
