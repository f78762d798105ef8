#include "apps/report/result_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/made_measurement.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(ResultTable, ShowsValuesWithTheirDeviationsDigits) {
  const std::string table = result_table(two_channels());
  EXPECT_THAT(table, HasSubstr("2.193 ± 0.012"));
  EXPECT_THAT(table, HasSubstr("0.002013 ± 0.000045"));
  EXPECT_THAT(table, HasSubstr("1.23 %"));
  EXPECT_THAT(table, HasSubstr("refused: POM G: a.dng: channel G is dark"));
}

// Of values that are given; a refused one rests on nothing.
TEST(ResultTable, NotesWhatAValueRestsOn) {
  Measurement m = two_channels();
  PriorPull scale{"scale", "scale"};
  scale.least_seen_in_std = 20.0;
  scale.unseen_sigma_s_prime_per_mm = 0.2;
  for (ChannelResult& r : m.results) r.estimate.pulls = {scale};
  const std::string table = result_table(m);
  EXPECT_THAT(table, HasSubstr("note: POM R: rests on the stated scale: an error of scale of up to "
                               "20 stated deviations would not show"));
  EXPECT_THAT(table, Not(HasSubstr("POM G: rests")));
}

}  // namespace
}  // namespace scattermeter::apps
