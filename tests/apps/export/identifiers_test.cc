#include "apps/export/identifiers.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace scattermeter::apps {
namespace {

// Two names that no file can tell apart after escaping stay two materials.
TEST(Identifiers, AreUnique) {
  EXPECT_EQ(identifiers({"a b", "a_b", "2 mm", "", "a b"}),
            (std::vector<std::string>{"a_b", "a_b_2", "m_2_mm", "m_", "a_b_3"}));
}

}  // namespace
}  // namespace scattermeter::apps
