#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/exported.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

TEST(ExportCsv, HoldsValuesAndUncertainties) {
  const std::string text = Exported(made_result({{"P,O\"M", kExported.at("POM")}})).text("csv");
  EXPECT_THAT(text, HasSubstr("material,channel,verdict,model,eta,sigma_s_prime_per_mm,"
                              "sigma_s_prime_per_mm_std,sigma_s_prime_per_mm_low95,"
                              "sigma_s_prime_per_mm_high95,sigma_a_per_mm,"));
  EXPECT_THAT(
      text,
      HasSubstr("\n\"P,O\"\"M\",G,ok,dipole,1.4,1.6,0.4,0.8,3.2,0.004,0.001,0.002,0.008,0.5,"));
}

}  // namespace
}  // namespace scattermeter::apps
