#include "core/estimation/channel_rows.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/scene/rough_surfaces.h"
#include "tests/fixtures/core/dipole_cube.h"

namespace scattermeter {
namespace {

// The LED is where the top face mirrors the camera: rows there are left out if and only if the
// reflected view direction passes the LED within 0.17 rad.
TEST(ChannelRows, RowsThatMirrorTheLightAreLeftOut) {
  test_support::DipoleCube cube;
  cube.scene.lights[0].led()->led.position_mm = {0, 120, 120};
  cube.scene.lights[0].led()->led.axis = Eigen::Vector3d(0, -120, -100).normalized();
  cube.show(test_support::kCubeMedium);
  const auto channel = material_channels(cube.scene, cube.shots, "G").front();
  const ChannelRows rows = channel_rows(cube.scene, channel);
  const ChannelObservation& before = cube.shots[0].observation.channel[1];
  ASSERT_EQ(rows.size(), 1U);
  const SeenObject& seen = *cube.shots[0].seen;
  std::size_t mirrored = 0;
  for (std::size_t j = 0; j < before.l.size(); ++j) {
    const Eigen::Vector3d& n = seen.patches->normal(seen.map.patch_of_row[j]);
    const Eigen::Vector3d out = (seen.camera_center_mm - seen.sites[j].center_mm).normalized();
    const Eigen::Vector3d to_led =
        (Eigen::Vector3d(0, 120, 120) - seen.sites[j].center_mm).normalized();
    const Eigen::Vector3d reflected = 2.0 * n.dot(out) * n - out;
    const bool mirrors =
        to_led.dot(n) > 0.0 && std::acos(std::min(1.0, reflected.dot(to_led))) < 0.17;
    if (before.state[j] != RowState::kUsed) continue;
    EXPECT_EQ(rows[0].state[j], mirrors ? RowState::kMirror : RowState::kUsed);
    EXPECT_EQ(rows[0].l[j], before.l[j]);
    mirrored += mirrors ? 1 : 0;
  }
  EXPECT_GT(mirrored, 10U);
  EXPECT_EQ(rows[0].rows_used, before.rows_used - mirrored);
}

// Where a surface that is stated as smooth may be glossy, rows are left out farther off.
TEST(ChannelRows, RowsThatMayBeGlossyAreLeftOut) {
  test_support::DipoleCube cube;
  cube.scene.lights[0].led()->led.position_mm = {28, 120, 120};
  cube.scene.lights[0].led()->led.axis = Eigen::Vector3d(-28, -120, -100).normalized();
  cube.show(test_support::kCubeMedium);
  const auto rows = [&] {
    return channel_rows(cube.scene, material_channels(cube.scene, cube.shots, "G").front())[0];
  };
  const ChannelObservation exact = rows();
  cube.scene.objects[0].surface_alpha_std = 0.03;
  const ChannelObservation open = rows();
  const RowGloss gloss = row_gloss(cube.scene, cube.scene.shots[0], *cube.shots[0].seen, 1, 0.03);
  EXPECT_LT(open.rows_used, exact.rows_used);
  for (std::size_t j = 0; j < exact.l.size(); ++j) {
    if (exact.state[j] != RowState::kUsed) continue;
    EXPECT_EQ(open.state[j], is_glossy(gloss, j) ? RowState::kMirror : RowState::kUsed);
  }
}

class TwoShots : public ::testing::Test {
 protected:
  TwoShots() {
    cube_.scene.lights[1].led()->led.intensity_W_per_sr = {1.0, 2.5, 1.0};
    cube_.show(test_support::kCubeMedium, 0.01);
    channel_ = material_channels(cube_.scene, cube_.shots, "G").front();
    rows_ = channel_rows(cube_.scene, channel_);
  }

  test_support::DipoleCube cube_{2};
  MaterialChannel channel_;
  ChannelRows rows_;
};

TEST_F(TwoShots, SystemHoldsTheUsedRowsShotByShot) {
  const DenseSystem system = channel_system(cube_.scene, channel_, rows_, cube_.weights, 0.0);
  ASSERT_EQ(system.shot_rows.size(), 2U);
  Eigen::Index at = 0;
  for (std::size_t s = 0; s < 2; ++s) {
    EXPECT_EQ(system.shot_rows[s], static_cast<Eigen::Index>(rows_[s].rows_used));
    const DenseSystem own = channel_system(cube_.scene, channel_, s, rows_[s], cube_.weights, 0.0);
    const WeightMatrix& w =
        cube_.weights.at({cube_.shots[s].seen.get(), s == 0 ? "led" : "led2", 0});
    Eigen::Index in_shot = 0;
    for (std::size_t j = 0; j < rows_[s].l.size(); ++j) {
      if (rows_[s].state[j] != RowState::kUsed) continue;
      EXPECT_EQ(system.l[at], rows_[s].l[j]);
      // Noise of 1 %, and the 5e-4 that predictions err by while the material is unknown.
      EXPECT_NEAR(system.std_l[at], std::hypot(0.01, 5e-4) * rows_[s].l[j], 1e-12 * rows_[s].l[j]);
      EXPECT_EQ(
          (system.weights.row(at) - (s == 0 ? 1.0 : 2.5) * w.row(static_cast<Eigen::Index>(j)))
              .norm(),
          0.0);
      EXPECT_EQ(own.l[in_shot++], system.l[at++]);
    }
    EXPECT_EQ(own.l.size(), in_shot);
  }
  EXPECT_EQ(system.l.size(), at);
}

// A mean free path a fifth of the patch's width: 16 (the limit) times 1e-4 of l.
// The count goes on from shot to shot; what is not in use stays as it is.
TEST_F(TwoShots, EveryThirdOfTheUsedRows) {
  const ChannelRows some = every_nth(3, rows_);
  std::size_t seen = 0;
  for (std::size_t s = 0; s < 2; ++s) {
    std::size_t used = 0;
    for (std::size_t j = 0; j < rows_[s].l.size(); ++j) {
      const bool is_used = rows_[s].state[j] == RowState::kUsed;
      const RowState expected = is_used && seen++ % 3 != 0 ? RowState::kOutlier : rows_[s].state[j];
      EXPECT_EQ(some[s].state[j], expected);
      used += expected == RowState::kUsed ? 1 : 0;
    }
    EXPECT_EQ(some[s].rows_used, used);
  }
  EXPECT_GT(seen, 30U);
}

TEST_F(TwoShots, LeavesOutWhatIsFarFromItsPrediction) {
  const auto n = static_cast<Eigen::Index>(rows_[0].rows_used + rows_[1].rows_used);
  ComparedImage image;
  image.l = image.predicted = Eigen::VectorXd::Ones(n);
  image.std_l = Eigen::VectorXd::Constant(n, 0.01);
  for (Eigen::Index k = 0; k < n; ++k) image.l[k] += k % 2 == 0 ? 0.01 : -0.01;
  ChannelRows rows = rows_;
  EXPECT_FALSE(leave_outliers_out(image, rows));
  // The first used row of the second shot.
  image.l[static_cast<Eigen::Index>(rows_[0].rows_used)] = 0.5;
  EXPECT_TRUE(leave_outliers_out(image, rows));
  EXPECT_EQ(rows[0].rows_used, rows_[0].rows_used);
  EXPECT_EQ(rows[1].rows_used, rows_[1].rows_used - 1);
  std::size_t first = 0;
  while (rows_[1].state[first] != RowState::kUsed) ++first;
  EXPECT_EQ(rows[1].state[first], RowState::kOutlier);
}

TEST_F(TwoShots, CoarsePatchesWidenTheRows) {
  const DenseSystem system = channel_system(cube_.scene, channel_, 0, rows_[0], cube_.weights, 0.5);
  EXPECT_NEAR(system.std_l[0], std::hypot(0.01, 1.6e-3) * system.l[0], 1e-12 * system.l[0]);
  const DenseSystem finer =
      channel_system(cube_.scene, channel_, 0, rows_[0], cube_.weights, 0.5, 0.5);
  EXPECT_NEAR(finer.std_l[0], std::hypot(0.01, 1e-4) * finer.l[0], 1e-12 * finer.l[0]);
}

TEST_F(TwoShots, ReportCountsEveryRowOnce) {
  ChannelResult result;
  report_rows(channel_, rows_, result);
  std::size_t sum = 0;
  for (const std::size_t n : result.patches_by_state) sum += n;
  EXPECT_EQ(sum, rows_[0].l.size() + rows_[1].l.size());
  EXPECT_EQ(result.patches_by_state[static_cast<std::size_t>(RowState::kUsed)],
            rows_[0].rows_used + rows_[1].rows_used);
  EXPECT_EQ(result.patches_partly_seen, 2 * cube_.shots[0].seen->map.patches_partly_seen);
}

TEST_F(TwoShots, PredictionsAreAtTheUsedRowsOfTheirShots) {
  const auto n = static_cast<Eigen::Index>(rows_[0].rows_used + rows_[1].rows_used);
  const Eigen::VectorXd predicted = Eigen::VectorXd::LinSpaced(n, 1.0, static_cast<double>(n));
  const std::vector<ShotRows> out = shot_rows(channel_, rows_, predicted, 0.5 * predicted);
  ASSERT_EQ(out.size(), 2U);
  float next = 1.0F;
  for (std::size_t s = 0; s < 2; ++s) {
    EXPECT_EQ(out[s].file, s == 0 ? "a.dng" : "b.dng");
    EXPECT_EQ(out[s].map.get(), &cube_.shots[s].seen->map);
    for (std::size_t j = 0; j < rows_[s].l.size(); ++j) {
      EXPECT_EQ(out[s].observed[j], static_cast<float>(rows_[s].l[j]));
      if (rows_[s].state[j] != RowState::kUsed) {
        EXPECT_TRUE(std::isnan(out[s].predicted[j]) && std::isnan(out[s].std[j]));
        continue;
      }
      EXPECT_FLOAT_EQ(out[s].predicted[j], next);
      EXPECT_FLOAT_EQ(out[s].std[j], 0.5F * next);
      next += 1.0F;
    }
  }
  EXPECT_EQ(next, static_cast<float>(n + 1));
}

}  // namespace
}  // namespace scattermeter
