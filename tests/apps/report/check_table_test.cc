#include "apps/report/check_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/made_check.h"

namespace scattermeter::apps {
namespace {

TEST(CheckTable, IsThisText) {
  EXPECT_EQ(check_table(made_check()),
            "check              rms  worst  limit  unit         verdict  worst at\n"
            "pose             0.354   -0.4      1  px           pass     b.dng\n"
            "brightest patch     12     12  >= 30  x its noise  FAIL     a.dng <R>\n"
            "LED drift            -      -      5  %            -\n"
            "FAIL brightest patch: a.dng <R>: expose longer\n"
            "note: c.dng: skipped\n"
            "1 of 3 checks FAILED\n");
}

TEST(CheckTable, AllPassed) {
  CheckReport report = made_check();
  report.items.erase(report.items.begin() + 1);
  EXPECT_THAT(check_table(report), ::testing::EndsWith("all 2 checks passed\n"));
}

}  // namespace
}  // namespace scattermeter::apps
