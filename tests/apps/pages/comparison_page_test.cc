#include "apps/pages/comparison_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/html_check.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

TEST(ComparisonPage, VerdictsFirstThenDifferences) {
  ReadChannel a, b;
  a.channel = b.channel = 'G';
  a.sigma_s_prime_per_mm = {1.0, 0.02, 0.96, 1.04};
  b.sigma_s_prime_per_mm = {1.1, 0.03, 1.04, 1.16};
  a.sigma_a_per_mm = b.sigma_a_per_mm = {0.004, 0.0004, 0.003, 0.005};
  const MaterialComparison pair = {"PP", "PE", {{a, b, {0.1, 0.025}, {0.0, 0.0005}, 1e-4}}, 1e-4};
  const std::string page = comparison_page({pair}, "a.json", "b.json", "rigs", "compare");
  EXPECT_EQ(html_problem(page), "");
  for (const char* text : {"<p class=\"fail\">PP and PE: different (p = 0.0001).</p>",
                           "1.100 ± 0.030", "+4.0 std", "First: a.json; second: b.json; rigs.",
                           // 0.1 of 1.0 is 10 %, at the second channel.
                           "\"x\":[1.94],\"y\":[10.0],\"std\":[2.5]"}) {
    EXPECT_THAT(page, HasSubstr(text));
  }
}

}  // namespace
}  // namespace scattermeter::apps
