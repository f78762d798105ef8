#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/made_checked_rig.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

Finding finding(const std::string& cause, std::vector<std::size_t> shots) {
  return {cause, cause + ": by 3 mm", "put it back", std::move(shots)};
}

TEST(CheckFirstLook, NothingFoundPasses) {
  MadeCheckedRig made(2);
  const std::vector<CheckItem> items = check_first_look(made.checked);
  ASSERT_EQ(items.size(), 1U);
  EXPECT_TRUE(items[0].passed);
  EXPECT_FALSE(items[0].details.empty());
  EXPECT_EQ(probable_cause(made.checked, items), "");
}

// What is refused by `measure` fails here, and is the cause of whatever else fails.
TEST(CheckFirstLook, FindingsFailAndComeFirst) {
  MadeCheckedRig made(2);
  made.checked.looks.emplace().findings = {finding("mesh displaced", {0, 1})};
  made.checked.fit.findings = {finding("image not explained", {1}),
                               finding("LEDs exchanged", {0, 1})};
  const CheckItem item = check_first_look(made.checked)[0];
  EXPECT_FALSE(item.passed);
  EXPECT_THAT(item.where, StartsWith("mesh displaced"));
  EXPECT_EQ(item.advice, "put it back");
  // An image that nothing explains follows from the mesh; exchanged LEDs do not.
  EXPECT_EQ(item.details.size(), 2U);
  const CheckReport report = check_report(made.checked);
  EXPECT_FALSE(report.passed());
  EXPECT_FALSE(report.items.front().passed);
  EXPECT_EQ(report.cause, "mesh displaced: by 3 mm; put it back");
  for (std::size_t i = 1; i < report.items.size(); ++i) {
    EXPECT_LE(static_cast<int>(report.items[i - 1].passed),
              static_cast<int>(report.items[i].passed));
  }
}

// Without findings, one change that explains most of the images' misfit.
TEST(CheckFirstLook, CauseOfTheImages) {
  MadeCheckedRig made(2);
  CheckedChannel& fitted = made.add_channel(1, {0, 1});
  fitted.departures->even_relative = {{0.2, 0.001}, {0.2, 0.001}};
  ImageCause led{"led1 displaced", "measure it again", 3, 3000.0, 0.9};
  ImageCause even{"light from elsewhere", "switch off every other lamp", 2, 4000.0, 0.95};
  fitted.causes = {led, even};
  const CheckReport report = check_report(made.checked);
  EXPECT_THAT(report.cause, HasSubstr("light from elsewhere, which explains 95 %"));
  EXPECT_THAT(report.cause, HasSubstr("switch off"));
  fitted.causes = {{"led1 displaced", "measure it again", 3, 3000.0, 0.3}};
  EXPECT_EQ(check_report(made.checked).cause, "");
  // Nothing that the images judge fails: nothing needs a cause.
  fitted.causes = {even};
  fitted.departures->even_relative = {{0.0, 0.001}, {0.0, 0.001}};
  EXPECT_EQ(check_report(made.checked).cause, "");
}

}  // namespace
}  // namespace scattermeter::apps
