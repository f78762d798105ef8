#include "core/base/disjoint_sets.h"

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

TEST(DisjointSets, GrowTogether) {
  DisjointSets sets(6);
  EXPECT_EQ(sets.sets(), 6U);
  sets.join(4, 5);
  sets.join(3, 4);
  sets.join(5, 3);
  EXPECT_EQ(sets.sets(), 4U);
  sets.join(0, 2);
  EXPECT_EQ(sets.set_of(5), 3);
  EXPECT_EQ(sets.set_of(2), 0);
  EXPECT_EQ(sets.set_of(1), 1);
  sets.join(5, 2);
  EXPECT_EQ(sets.set_of(4), 0);
  EXPECT_EQ(sets.sets(), 2U);
}

}  // namespace
}  // namespace scattermeter
