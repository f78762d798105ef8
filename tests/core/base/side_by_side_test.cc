#include "core/base/side_by_side.h"

#include <stdexcept>

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

TEST(SideBySide, BothEndAndErrorsArrive) {
  int a = 0, b = 0;
  side_by_side([&] { a = 1; }, [&] { b = 2; });
  EXPECT_EQ(a + b, 3);
  EXPECT_THROW(side_by_side([] {}, [] { throw std::runtime_error("of one"); }), std::runtime_error);
}

}  // namespace
}  // namespace scattermeter
