#include "apps/report/result_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/made_measurement.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

TEST(ResultTable, ShowsValuesWithTheirDeviationsDigits) {
  const std::string table = result_table(two_channels());
  EXPECT_THAT(table, HasSubstr("2.193 ± 0.012"));
  EXPECT_THAT(table, HasSubstr("0.002013 ± 0.000045"));
  EXPECT_THAT(table, HasSubstr("1.23 %"));
  EXPECT_THAT(table, HasSubstr("refused: POM G: a.dng: channel G is dark"));
}

}  // namespace
}  // namespace scattermeter::apps
