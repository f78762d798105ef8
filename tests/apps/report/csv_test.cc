#include "apps/report/csv.h"

#include <cstdlib>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>

namespace scattermeter::apps {
namespace {

// RFC 4180, section 2, rules 5 to 7.
TEST(Csv, QuotesWhatNeedsQuotes) {
  EXPECT_EQ(csv_field("plain text"), "plain text");
  EXPECT_EQ(csv_field("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_field("the \"best\""), "\"the \"\"best\"\"\"");
  EXPECT_EQ(csv_field("two\nlines"), "\"two\nlines\"");
  EXPECT_EQ(csv_field(""), "");
}

TEST(Csv, NumbersReadBackExactly) {
  for (double value : {std::numbers::pi, 1.0 / 3.0, 1e-300, -0.1, 2.4e10,
                       std::numeric_limits<double>::denorm_min()}) {
    EXPECT_EQ(std::strtod(csv_number(value).c_str(), nullptr), value);
  }
  EXPECT_EQ(csv_number(0.1), "0.1");
  EXPECT_EQ(csv_number(std::numeric_limits<double>::quiet_NaN()), "");
  EXPECT_EQ(csv_number(-std::numeric_limits<double>::infinity()), "");
}

TEST(Csv, HeaderAndRows) {
  Csv csv({"what", "value [1/mm]"});
  csv.add_row({"a,b", csv_number(2.5)});
  EXPECT_EQ(csv.text(), "what,value [1/mm]\n\"a,b\",2.5\n");
  EXPECT_THROW(csv.add_row({"a"}), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter::apps
