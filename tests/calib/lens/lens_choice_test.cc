#include "calib/lens/lens_choice.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/fixtures/calib/board_scene.h"

namespace scattermeter::calib {
namespace {

LensChoice choice_for(const CameraIntrinsics& lens, std::uint64_t seed) {
  const BoardScene scene = board_scene(lens, 10, seed);
  return choose_lens(with_noise(scene.views, 0.05, seed), 640, 480, true_bundle(lens, scene), {});
}

// Terms that are there are taken; ones that are not come in by chance, but not as a rule.
TEST(LensChoice, TakesTheTermsThatAreThere) {
  CameraIntrinsics plain = board_lens();
  plain.distortion = {};
  CameraIntrinsics wide = board_lens();
  wide.fy_px = 707;
  wide.distortion = {-0.2, 0.1, 2e-3, -1e-3, 0};
  int plain_right = 0, mild_right = 0;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const LensChoice a = choice_for(plain, seed);
    plain_right +=
        a.candidates.at(a.chosen.value()).model == LensModel{true, DistortionTerms::kNone};
    const LensChoice b = choice_for(board_lens(), seed);
    const LensModel mild = b.candidates.at(b.chosen.value()).model;
    EXPECT_GE(parameter_names(mild).size(), 5U);
    mild_right += mild == LensModel{true, DistortionTerms::kK1K2};
    const LensChoice c = choice_for(wide, seed);
    const LensModel rich = c.candidates.at(c.chosen.value()).model;
    EXPECT_FALSE(rich.one_focal_length);
    EXPECT_GE(static_cast<int>(rich.terms), static_cast<int>(DistortionTerms::kK1K2P1P2));
  }
  EXPECT_GE(plain_right, 3);
  EXPECT_GE(mild_right, 3);
}

// One step is the refit: against fitting without each view and then its best pose.
TEST(LensChoice, LeftOutSquaresAreThoseOfARefit) {
  const BoardScene scene = board_scene(board_lens(), 6, 3);
  const std::vector<BoardView> views = with_noise(scene.views, 0.1, 4);
  const LensModel model{true, DistortionTerms::kK1K2};
  const LensChoice choice = choose_lens(views, 640, 480, true_bundle(board_lens(), scene), model);
  double sum = 0;
  std::size_t n = 0;
  for (std::size_t i = 0; i < views.size(); ++i) {
    std::vector<BoardView> others = views;
    CameraBundle start = choice.bundle;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    start.camera_from_board.erase(start.camera_from_board.begin() + static_cast<std::ptrdiff_t>(i));
    const CameraBundle fit = adjust_bundle(others, model, 640, 480, start);
    const ViewEquations e = view_equations(views[i], choice.bundle.camera_from_board[i],
                                           intrinsics_of(fit.lens, 640, 480), model);
    sum += e.sum_squares_px2;  // the pose's share is taken out
    n += views[i].corners.size();
  }
  EXPECT_NEAR(choice.candidates.at(0).left_out_rms_px, std::sqrt(sum / static_cast<double>(n)),
              2e-4);
}

TEST(LensChoice, FewViewsAreNotJudged) {
  const BoardScene scene = board_scene(board_lens(), 3, 5);
  const LensChoice choice =
      choose_lens(with_noise(scene.views, 0.05, 6), 640, 480, true_bundle(board_lens(), scene), {});
  ASSERT_EQ(choice.candidates.size(), 1U);
  EXPECT_EQ(choice.candidates[0].model, (LensModel{true, DistortionTerms::kK1K2}));
}

}  // namespace
}  // namespace scattermeter::calib
