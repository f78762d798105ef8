#include "core/estimation/edge_width.h"

#include <vector>

#include <gtest/gtest.h>

#include "core/nuisances/edge_light.h"

namespace scattermeter {
namespace {

ChannelResult channel(const std::string& material, double width_mm, double image_relative) {
  ChannelResult r;
  r.material = material;
  r.estimate.converged = true;
  PriorPull pull;
  pull.name = "cube.edges";
  pull.group = "edges";
  pull.offset = width_mm;
  pull.image_relative = image_relative;
  r.estimate.pulls = {pull};
  return r;
}

class EdgeWidth : public ::testing::Test {
 protected:
  EdgeWidth() {
    SceneObject cube;
    cube.name = "cube";
    cube.edge_std_mm = 0.1;
    scene_.objects = {cube};
    first_mm_ = chamfer_width_mm(cube);
  }
  Scene scene_;
  double first_mm_ = 0;
};

// Each material is a piece of its own; its width is the median over its channels.
TEST_F(EdgeWidth, IsThatOfEachPiece) {
  EdgeWidths widths;
  const std::vector<ChannelResult> results = {channel("PP", 0.2, 0.01), channel("PP", 0.21, 0.01),
                                              channel("PP", 0.4, 0.01), channel("PE", 0.05, 0.01)};
  EXPECT_EQ(take_edge_widths(scene_, results, widths), (std::vector<bool>{true, true, true, true}));
  EXPECT_DOUBLE_EQ(widths.at({"PP", "cube"}), 0.21);
  EXPECT_DOUBLE_EQ(widths.at({"PE", "cube"}), 0.05);
  // Once they have been taken, nothing is new.
  EXPECT_EQ(take_edge_widths(scene_, results, widths),
            (std::vector<bool>{false, false, false, false}));
}

TEST_F(EdgeWidth, StaysWhereNothingIsVisibleOrNew) {
  EdgeWidths widths;
  EXPECT_EQ(take_edge_widths(scene_, {channel("PP", 0.4, 1e-4)}, widths),
            (std::vector<bool>{false}));
  EXPECT_EQ(take_edge_widths(scene_, {channel("PP", 1.09 * first_mm_, 0.01)}, widths),
            (std::vector<bool>{false}));
  EXPECT_EQ(take_edge_widths(scene_, {channel("PP", 1.2 * first_mm_, 0.01)}, widths),
            (std::vector<bool>{true}));
  EXPECT_TRUE(take_edge_widths(scene_, {}, widths).empty());
}

// A chamfer cannot be negative, and one far beyond what is stated is not one.
TEST_F(EdgeWidth, StaysWithinReason) {
  EdgeWidths widths;
  EXPECT_EQ(take_edge_widths(scene_, {channel("PP", -0.3, 0.01), channel("PE", 5.0, 0.01)}, widths),
            (std::vector<bool>{true, true}));
  EXPECT_DOUBLE_EQ(widths.at({"PP", "cube"}), 0.1 * first_mm_);
  EXPECT_DOUBLE_EQ(widths.at({"PE", "cube"}), 3.0 * first_mm_);
}

// Only the pieces with another width are fitted again.
TEST_F(EdgeWidth, LeavesOtherPiecesAlone) {
  EdgeWidths widths;
  EXPECT_EQ(
      take_edge_widths(scene_, {channel("PP", 0.3, 0.01), channel("PE", first_mm_, 0.01)}, widths),
      (std::vector<bool>{true, false}));
}

}  // namespace
}  // namespace scattermeter
