#include "apps/pages/swatches.h"

#include <cmath>

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/simulation/standard_body.h"
#include "core/material/slab_reflectance.h"
#include "tests/fixtures/apps/html_check.h"
#include "tests/fixtures/apps/made_measurement.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

ChannelResult pom() { return two_channels().results[0]; }

// Against the spread of draws of both coefficients with their correlation, by a rule of nine points
// (Gauss and Hermite) that is exact for the linear part.
TEST(Swatches, DeviationIsThatOfTheCoefficients) {
  ChannelResult r = pom();
  r.estimate.correlation = 0.6;
  const Quantity q = plate_reflectance(r, 10.0, 0.0);
  const Quantity& s = r.estimate.sigma_s_prime_per_mm;
  const Quantity& a = r.estimate.sigma_a_per_mm;
  EXPECT_EQ(q.value, slab_reflectance({s.value, a.value, 1.48}, 10.0, 0.0));
  double sum = 0.0, squares = 0.0;
  for (const int i : {-1, 0, 1}) {
    for (const int k : {-1, 0, 1}) {
      const double u = std::sqrt(3.0) * i, v = std::sqrt(3.0) * k;
      const double weight = (i == 0 ? 2.0 / 3.0 : 1.0 / 6.0) * (k == 0 ? 2.0 / 3.0 : 1.0 / 6.0);
      const double value = slab_reflectance(
          {s.value + s.std * u, a.value + a.std * (0.6 * u + 0.8 * v), 1.48}, 10.0, 0.0);
      sum += weight * value;
      squares += weight * value * value;
    }
  }
  EXPECT_NEAR(q.std, std::sqrt(squares - sum * sum), 0.03 * q.std);
}

TEST(Swatches, AllChannelsMakeAColour) {
  ChannelResult r = pom();
  const std::vector<const ChannelResult*> channels = {&r, &r, &r};
  const std::optional<MaterialLook> look = material_look(channels);
  ASSERT_TRUE(look.has_value());
  const Html html = swatches(channels, look);
  EXPECT_EQ(html_problem(html_document("t", html)), "");
  EXPECT_THAT(html.markup, HasSubstr("10 mm over white"));
  // The approximation's 1 % beside the little that the coefficients leave.
  const Quantity white = plate_reflectance(r, kSwatchThickness_mm, 1.0);
  ASSERT_LT(white.std, 0.004);
  EXPECT_THAT(html.markup, HasSubstr(fmt::format("{:.1f} ± 1.0", 100.0 * white.value)));
  // The same in all channels: a grey.
  const std::size_t at = html.markup.find("background: #");
  ASSERT_NE(at, std::string::npos);
  const std::string code = html.markup.substr(at + 13, 6);
  EXPECT_EQ(code.substr(0, 2), code.substr(2, 2));
  EXPECT_EQ(code.substr(0, 2), code.substr(4, 2));
}

// Against pictures of media a quarter of a deviation to either side, along both coefficients.
TEST(Swatches, TheLooksDeviationIsThatOfTheCoefficients) {
  ChannelResult r = pom();
  r.estimate.correlation = -0.4;
  const MaterialLook look = material_look({&r, &r, &r}).value();
  const Estimate& e = r.estimate;
  const auto shadow = [&](double by_s, double by_a) {
    std::array<Medium, 3> media;
    media.fill({e.sigma_s_prime_per_mm.value + by_s * e.sigma_s_prime_per_mm.std,
                e.sigma_a_per_mm.value + by_a * e.sigma_a_per_mm.std, r.eta_int_over_ext});
    return standard_bodies({media})[0].at(StandardPlace::kShadow)[1];
  };
  const double by_s = 2.0 * (shadow(0.25, 0) - shadow(-0.25, 0));
  const double by_a = 2.0 * (shadow(0, 0.25) - shadow(0, -0.25));
  EXPECT_NEAR(look.shadow[1].value, shadow(0, 0), 1e-6);
  EXPECT_NEAR(look.shadow[1].std, std::sqrt(by_s * by_s + by_a * by_a - 2.0 * 0.4 * by_s * by_a),
              0.03 * look.shadow[1].std);
}

TEST(Swatches, NoneWhereAChannelIsMissing) {
  ChannelResult r = pom();
  ChannelResult refused = r;
  refused.estimate.reasons = {"dark"};
  EXPECT_FALSE(material_look({&r, &r}));
  EXPECT_FALSE(material_look({&r, &refused, &r}));
  EXPECT_EQ(swatches({&r, &r}, std::nullopt).markup, "");
  EXPECT_EQ(swatches({&r, &refused, &r}, std::nullopt).markup, "");
}

// The cube is not shown by a model that does not know its edges; plates are.
TEST(Swatches, NoCubeOfAMaterialThatItIsTooSmallFor) {
  ChannelResult r = pom();
  ChannelResult denser = r, clear = r;
  denser.eta_int_over_ext = 1.6;
  clear.estimate.sigma_s_prime_per_mm.value = 0.3;
  for (const ChannelResult* other : {&denser, &clear}) {
    EXPECT_FALSE(material_look({&r, other, &r}));
    const Html html = swatches({&r, other, &r}, std::nullopt);
    EXPECT_THAT(html.markup, HasSubstr("10 mm over white"));
    EXPECT_THAT(html.markup, ::testing::Not(HasSubstr("cube")));
  }
}

}  // namespace
}  // namespace scattermeter::apps
