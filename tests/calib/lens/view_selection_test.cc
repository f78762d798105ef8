#include "calib/lens/view_selection.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/random_stream.h"
#include "tests/fixtures/calib/board_scene.h"

namespace scattermeter::calib {
namespace {

using ::testing::HasSubstr;

std::vector<BoardView> good_views(int count) {
  return with_noise(board_scene(board_lens(), count, 1).views, 0.1, 2);
}

std::string reason_of(const ViewSelection& s, const std::string& name) {
  for (const LeftOutView& view : s.left_out) {
    if (view.name == name) return view.reason;
  }
  return "";
}

TEST(ViewSelection, KeepsWhatIsGood) {
  const ViewSelection s = select_views(good_views(10), 640, 480);
  EXPECT_EQ(s.fault, "");
  EXPECT_EQ(s.views.size(), 10U);
  EXPECT_TRUE(s.left_out.empty());
  EXPECT_TRUE(s.corners_left_out.empty());
  EXPECT_TRUE(s.bundle.converged);
}

TEST(ViewSelection, NamesWhatIsBad) {
  std::vector<BoardView> views = good_views(12);
  views[0].corners.resize(5);
  views[2].corners = views[1].corners;  // the same shot again
  RandomStream random(3, 3);
  for (PointPair& c : views[4].corners) {  // another picture
    c.image_px = {640 * random.uniform(), 480 * random.uniform()};
  }
  for (PointPair& c : views[6].corners) {  // a bent or shaken one
    c.image_px += 3 * Eigen::Vector2d(random.uniform() - 0.5, random.uniform() - 0.5);
  }
  views[8].corners.resize(9);  // one row
  views[10].corners[17].image_px.y() += 4;
  const ViewSelection s = select_views(views, 640, 480);
  EXPECT_EQ(s.fault, "");
  EXPECT_THAT(reason_of(s, "view0"), HasSubstr("only 5 corners"));
  EXPECT_EQ(reason_of(s, "view2"), "the same shot as view1");
  EXPECT_THAT(reason_of(s, "view4"),
              HasSubstr("are not a perspective image of those of this board"));
  EXPECT_THAT(reason_of(s, "view6"), HasSubstr("px (median) from where the other views"));
  EXPECT_NE(reason_of(s, "view8"), "");
  EXPECT_EQ(s.views.size(), 7U);
  ASSERT_EQ(s.corners_left_out.size(), 1U);
  EXPECT_EQ(s.corners_left_out[0].view, "view10");
  EXPECT_NEAR(s.corners_left_out[0].distance_px, 4, 0.5);
  // In the shots' order.
  EXPECT_TRUE(std::is_sorted(s.views.begin(), s.views.end(), [](const auto& a, const auto& b) {
    return std::stoi(a.name.substr(4)) < std::stoi(b.name.substr(4));
  }));
}

}  // namespace
}  // namespace scattermeter::calib
