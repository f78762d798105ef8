#include "apps/report/text_table.h"

#include <stdexcept>

#include <gtest/gtest.h>

namespace scattermeter::apps {
namespace {

TEST(TextTable, AlignsByCodePoints) {
  TextTable table({{"name", TextTable::Align::kLeft}, {"value"}, {"", TextTable::Align::kLeft}});
  table.add_row({"a", "1.0 ± 0.1", ""});
  table.add_row({"longer", "2", "note"});
  EXPECT_EQ(table.text(),
            "name        value\n"
            "a       1.0 ± 0.1\n"
            "longer          2  note\n");
}

TEST(TextTable, RefusesARowOfAnotherLength) {
  TextTable table({{"a"}, {"b"}});
  EXPECT_THROW(table.add_row({"1"}), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter::apps
