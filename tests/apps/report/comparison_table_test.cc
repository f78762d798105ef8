#include "apps/report/comparison_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scattermeter::apps {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

MaterialComparison made(const char* second, double p_value) {
  ReadChannel a, b;
  a.channel = b.channel = 'G';
  a.sigma_s_prime_per_mm = {1.0, 0.02, 0.96, 1.04};
  b.sigma_s_prime_per_mm = {1.1, 0.03, 1.04, 1.16};
  a.sigma_a_per_mm = b.sigma_a_per_mm = {0.004, 0.0004, 0.003, 0.005};
  return {"PP", second, {{a, b, {0.1, 0.025}, {0.0, 0.0005}, p_value}}, p_value};
}

TEST(ComparisonTable, HoldsDifferencesAndAVerdict) {
  const std::string text = comparison_table({made("PE", 1e-4)});
  EXPECT_THAT(text, AllOf(HasSubstr("PP and PE"), HasSubstr("1.000 ± 0.020"),
                          HasSubstr("1.100 ± 0.030"), HasSubstr("+10 % (+4.0 std)"),
                          HasSubstr("+0.0 std"), HasSubstr("PP and PE: different (p = 0.0001)")));
}

TEST(ComparisonTable, SaysWhatWouldHaveBeenSeen) {
  EXPECT_THAT(comparison_table({made("PP", 0.3)}),
              HasSubstr("PP: no difference found (p = 0.3); a difference of 7.5 % in sigma_s' or "
                        "0.0015 /mm in sigma_a would have been seen in every channel"));
  MaterialComparison none = made("PP", 1.0);
  none.channels.clear();
  EXPECT_THAT(comparison_table({none}), HasSubstr("PP: no channel is measured in both"));
}

LibraryMatch match(const std::string& name, double p_value) {
  ReadChannel a, b;
  a.channel = b.channel = 'G';
  a.sigma_s_prime_per_mm.value = 1.0;
  a.sigma_a_per_mm.value = 0.004;
  return {"Jensen et al. 2001",
          {"PP", name, {{a, b, {0.1, 0.025}, {-0.001, 0.0005}, p_value}}, p_value},
          0.1};
}

TEST(LibraryTable, NamesTheLikest) {
  const std::string text = library_table("PP", {match("marble", 0.3), match("skin1", 1e-9)}, 1);
  EXPECT_THAT(text, HasSubstr("like PP"));
  EXPECT_THAT(text, HasSubstr("- +10 -"));
  EXPECT_THAT(text, HasSubstr("- -25 -"));
  EXPECT_THAT(text, HasSubstr("no difference found"));
  EXPECT_THAT(text, HasSubstr("PP: may be marble"));
  EXPECT_THAT(text, Not(HasSubstr("skin1")));
  EXPECT_THAT(library_table("PP", {match("skin1", 1e-9)}),
              HasSubstr("PP: likest is skin1, but it is another material"));
  EXPECT_THAT(library_table("PP", {}), HasSubstr("no known material"));
}

}  // namespace
}  // namespace scattermeter::apps
