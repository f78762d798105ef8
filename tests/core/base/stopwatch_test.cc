#include "core/base/stopwatch.h"

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

TEST(Stopwatch, LapsOfOneNameAddUp) {
  std::vector<std::pair<std::string, double>> timing_s;
  Stopwatch watch(timing_s);
  watch.lap("fit");
  watch.lap("light");
  watch.lap("fit");
  watch.total();
  ASSERT_EQ(timing_s.size(), 3U);
  EXPECT_EQ(timing_s[0].first, "fit");
  EXPECT_EQ(timing_s[1].first, "light");
  EXPECT_EQ(timing_s[2].first, "total");
  EXPECT_LE(timing_s[0].second + timing_s[1].second, timing_s[2].second);
}

}  // namespace
}  // namespace scattermeter
