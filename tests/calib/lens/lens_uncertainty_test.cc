#include "calib/lens/lens_uncertainty.h"

#include <random>

#include <gtest/gtest.h>

#include "core/base/random_stream.h"
#include "tests/fixtures/calib/board_scene.h"

namespace scattermeter::calib {
namespace {

const LensModel kRefined{true, DistortionTerms::kK1K2};

LensUncertainty uncertainty_of(const std::vector<BoardView>& views, const CameraBundle& start,
                               double board_std_mm = 0, CameraBundle* fitted = nullptr) {
  const CameraBundle fit = adjust_bundle(views, kRefined, 640, 480, start);
  if (fitted != nullptr) *fitted = fit;
  std::vector<ViewEquations> equations;
  for (std::size_t i = 0; i < views.size(); ++i) {
    equations.push_back(view_equations(views[i], fit.camera_from_board[i],
                                       intrinsics_of(fit.lens, 640, 480), kRefined));
  }
  return lens_uncertainty(views, equations, board_std_mm);
}

// Independent noise: the views' scatter is 1 in the mean and seldom called too large; the noise
// comes back.
TEST(LensUncertainty, IndependentNoiseIsNotWidened) {
  const BoardScene scene = board_scene(board_lens(), 8, 1);
  const CameraBundle start = true_bundle(board_lens(), scene);
  double scatter = 0, noise = 0;
  int widened = 0;
  constexpr int kSeeds = 100;
  for (int seed = 0; seed < kSeeds; ++seed) {
    const LensUncertainty u = uncertainty_of(with_noise(scene.views, 0.1, 10 + seed), start);
    ASSERT_TRUE(u.determined);
    scatter += u.view_scatter / kSeeds;
    noise += u.noise_std_px / kSeeds;
    widened += u.widened ? 1 : 0;
  }
  // Its own deviation is about sqrt(2 / 35) per seed.
  EXPECT_NEAR(scatter, 1, 4 * 0.24 / 10);
  EXPECT_NEAR(noise, 0.1, 0.001);
  EXPECT_LE(widened, 2);
}

// Errors that a view's corners share (here a bend of the board, other in each view): widened at
// least to what the focal length really scatters by. The factor is one for all parameters, the mean
// over them, so that those that such errors hardly touch are stated too wide.
TEST(LensUncertainty, SharedErrorsWiden) {
  const BoardScene scene = board_scene(board_lens(), 8, 1);
  const CameraBundle start = true_bundle(board_lens(), scene);
  constexpr int kSeeds = 100;
  double predicted = 0, sampled = 0;
  int widened = 0;
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  for (int seed = 0; seed < kSeeds; ++seed) {
    std::vector<BoardView> views = with_noise(scene.views, 0.1, 200 + seed);
    for (BoardView& view : views) {
      const double bend_px = 0.6 * normal(random);
      for (PointPair& c : view.corners) {
        const double across = (c.world_mm.x() - 150) / 150;
        c.image_px.y() += bend_px * across * across;
      }
    }
    CameraBundle fit;
    const LensUncertainty u = uncertainty_of(views, start, 0, &fit);
    widened += u.widened ? 1 : 0;
    predicted += u.covariance(0, 0) / kSeeds;
    sampled += (fit.lens[0] - 700) * (fit.lens[0] - 700) / kSeeds;
  }
  EXPECT_GE(widened, 90);
  EXPECT_GT(predicted, 0.5 * sampled);
  EXPECT_LT(predicted, 10 * sampled);
}

// A print with errors that all views share: the lens scatters by what board_std_mm says.
TEST(LensUncertainty, PrintErrorsAreStated) {
  const BoardScene scene = board_scene(board_lens(), 8, 1);
  const CameraBundle start = true_bundle(board_lens(), scene);
  constexpr int kSeeds = 200;
  constexpr double kBoardMm = 0.05;
  const LensUncertainty stated = uncertainty_of(with_noise(scene.views, 1e-4, 1), start, kBoardMm);
  double sampled = 0;
  std::mt19937_64 random(8);
  std::normal_distribution<double> normal(0, kBoardMm);
  for (int seed = 0; seed < kSeeds; ++seed) {
    std::vector<Eigen::Vector3d> errors;
    for (int i = 0; i < 54; ++i)
      errors.emplace_back(normal(random), normal(random), normal(random));
    std::vector<BoardView> views = scene.views;
    for (BoardView& view : views) {
      for (PointPair& c : view.corners) {
        const auto i = static_cast<std::size_t>(
            std::lround((c.world_mm.y() / 30 - 1) * 9 + c.world_mm.x() / 30 - 1));
        c.world_mm += errors[i];
      }
    }
    const CameraBundle fit = adjust_bundle(views, kRefined, 640, 480, start);
    sampled += (fit.lens[0] - 700) * (fit.lens[0] - 700) / kSeeds;
  }
  EXPECT_NEAR(std::sqrt(stated.covariance(0, 0) / sampled), 1, 0.2);
}

TEST(LensUncertainty, SingularIsSaid) {
  const BoardScene scene = board_scene(board_lens(), 1, 1);
  ViewEquations nothing;
  nothing.information = Eigen::MatrixXd::Zero(5, 5);
  nothing.gradient = Eigen::VectorXd::Zero(5);
  nothing.n_corners = 54;
  nothing.gradient_per_mm.assign(54, Eigen::MatrixXd::Zero(5, 3));
  EXPECT_FALSE(lens_uncertainty(scene.views, {nothing}, 0).determined);
  EXPECT_FALSE(lens_uncertainty({}, {}, 0).determined);
}

}  // namespace
}  // namespace scattermeter::calib
