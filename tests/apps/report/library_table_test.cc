#include "apps/report/library_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

LibraryMatch made(const std::string& name, double p_value) {
  ReadChannel a, b;
  a.channel = b.channel = 'G';
  a.sigma_s_prime_per_mm.value = 1.0;
  a.sigma_a_per_mm.value = 0.004;
  return {"Jensen et al. 2001",
          {"PP", name, {{a, b, {0.1, 0.025}, {-0.001, 0.0005}, p_value}}, p_value},
          0.1};
}

TEST(LibraryTable, NamesTheLikest) {
  const std::string text = library_table("PP", {made("marble", 0.3), made("skin1", 1e-9)}, 1);
  EXPECT_THAT(text, HasSubstr("like PP"));
  EXPECT_THAT(text, HasSubstr("- +10 -"));
  EXPECT_THAT(text, HasSubstr("- -25 -"));
  EXPECT_THAT(text, HasSubstr("no difference found"));
  EXPECT_THAT(text, HasSubstr("PP: may be marble"));
  EXPECT_THAT(text, Not(HasSubstr("skin1")));
  EXPECT_THAT(library_table("PP", {made("skin1", 1e-9)}),
              HasSubstr("PP: likest is skin1, but it is another material"));
  EXPECT_THAT(library_table("PP", {}), HasSubstr("no known material"));
}

}  // namespace
}  // namespace scattermeter::apps
