#include "capture/raw/curve_levels.h"

#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture/raw/tone_curve.h"

namespace scattermeter::capture {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using Table = std::vector<std::uint16_t>;

Table identity() {
  Table table(65536);
  std::iota(table.begin(), table.end(), std::uint16_t{0});
  return table;
}

// As LibRaw leaves its table after a NEF: the curve's codes, then what was there before.
Table with_identity_tail(const Table& curve) {
  Table table = identity();
  std::copy(curve.begin(), curve.end(), table.begin());
  return table;
}

// ... after a DNG with a LinearizationTable.
Table with_constant_tail(const Table& curve) {
  Table table(65536, curve.back());
  std::copy(curve.begin(), curve.end(), table.begin());
  return table;
}

TEST(CurveLevels, IdentityHasNone) { EXPECT_THAT(curve_levels(identity(), 12, {5}), IsEmpty()); }

TEST(CurveLevels, TailOfEitherKindIsNoLevel) {
  const Table curve = nef_lossy_curve();
  EXPECT_EQ(curve_levels(with_identity_tail(curve), 12, curve), curve);
  EXPECT_EQ(curve_levels(with_constant_tail(curve), 12, curve), curve);
}

TEST(CurveLevels, OnlyCodesThatTheFileCanHold) {
  Table table(65536);
  for (std::size_t code = 0; code < table.size(); ++code) {
    table[code] = static_cast<std::uint16_t>(std::min<std::size_t>(3 * code + 5, 65535));
  }
  const Table levels = curve_levels(table, 12, {5, 8, 3 * 4095 + 5});
  EXPECT_EQ(levels.size(), 4096U);
  EXPECT_EQ(levels.back(), 3 * 4095 + 5);
}

TEST(CurveLevels, CurveThatIsOnlyCutAtTheTop) {
  Table table = identity();
  std::fill(table.begin() + 3881, table.end(), std::uint16_t{3880});
  const Table levels = curve_levels(table, 12, {17});
  EXPECT_EQ(levels.size(), 3881U);
  EXPECT_EQ(levels.back(), 3880);
}

TEST(CurveLevels, UpperPartOfTheCurveMayBeTheIdentity) {
  // Bent below 4, straight above: the samples tell that the straight part is in use.
  const Table table = with_identity_tail({0, 0, 3, 3});
  EXPECT_THAT(curve_levels(table, 4, {0, 3, 9}),
              ElementsAre(0, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15));
}

TEST(CurveLevels, NoneWhenTheyDoNotExplainASample) {
  const Table curve = {0, 10, 20, 30};
  EXPECT_EQ(curve_levels(with_constant_tail(curve), 12, {0, 20, 30}), curve);
  EXPECT_THAT(curve_levels(with_constant_tail(curve), 12, {0, 20, 15}), IsEmpty());
}

}  // namespace
}  // namespace scattermeter::capture
