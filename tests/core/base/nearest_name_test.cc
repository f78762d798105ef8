#include "core/base/nearest_name.h"

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

TEST(EditDistance, CountsEdits) {
  EXPECT_EQ(edit_distance("", ""), 0U);
  EXPECT_EQ(edit_distance("", "abc"), 3U);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);   // two replacements, one insertion
  EXPECT_EQ(edit_distance("measure", "mesaure"), 1U);  // a swap
  EXPECT_EQ(edit_distance("ca", "abc"), 3U);           // a swapped letter is not changed again
  EXPECT_EQ(edit_distance("LED1", "led1"), 0U);
}

TEST(EditDistance, IsSymmetric) {
  const std::vector<std::string> words = {"", "a", "led", "led1", "dle", "position_mm", "axis"};
  for (const std::string& a : words) {
    for (const std::string& b : words) {
      EXPECT_EQ(edit_distance(a, b), edit_distance(b, a)) << a << " " << b;
      EXPECT_EQ(edit_distance(a, b) == 0, a == b) << a << " " << b;
    }
  }
}

TEST(NearestName, IsTheOneThatWasMeant) {
  const std::vector<std::string> keys = {"position_mm", "axis", "exponent", "exponent_std", "eta"};
  EXPECT_EQ(nearest_name("postion_mm", keys), "position_mm");
  EXPECT_EQ(nearest_name("Axis", keys), "axis");
  EXPECT_EQ(nearest_name("position", keys), "position_mm");  // the unit is forgotten
  EXPECT_EQ(nearest_name("eta_int_over_ext", keys), "eta");  // more than the name
  EXPECT_EQ(nearest_name("exponents", keys), "exponent");    // nearer than exponent_std
  EXPECT_EQ(nearest_name("colour", keys), std::nullopt);
  EXPECT_EQ(nearest_name("x", {"y"}), std::nullopt);
  EXPECT_EQ(nearest_name("P", {"PE", "PP"}), "PE");
  EXPECT_EQ(nearest_name("anything", {}), std::nullopt);
}

TEST(NearestName, AsPartOfAMessage) {
  EXPECT_EQ(did_you_mean("led2", {"led1"}), "; did you mean led1?");
  EXPECT_EQ(did_you_mean("sun", {"led1"}), "");
}

}  // namespace
}  // namespace scattermeter
