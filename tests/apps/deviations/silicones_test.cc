#include "apps/deviations/silicones.h"

#include <stdexcept>

#include <gtest/gtest.h>

namespace scattermeter::apps {
namespace {

TEST(Silicones, AreWithinWhatTheInstrumentMeasures) {
  for (const Silicone& silicone : silicones()) {
    for (const Medium& m : silicone.media) {
      EXPECT_GE(m.sigma_s_prime_per_mm, 0.2);
      EXPECT_LE(m.sigma_s_prime_per_mm, 10.0);
      EXPECT_GT(m.sigma_s_prime_per_mm, 0.5 * m.sigma_t_prime_per_mm());
    }
  }
}

TEST(Silicones, RefuseWhatDoesNotExist) {
  SiliconeOptions options;
  options.bodies = {"teapot"};
  EXPECT_THROW(bench_silicones(options), std::invalid_argument);
  options.bodies = {"cube"};
  options.silicones = {"blue"};
  EXPECT_THROW(bench_silicones(options), std::invalid_argument);
  options.silicones = {};
  options.images = {4};
  EXPECT_THROW(bench_silicones(options), std::invalid_argument);
}

// One image of a cube of each silicone: no answer is wrong. Eta known to 0.04 leaves sigma_s' open
// by 12 to 20 %, and the colours of a picture made of what is answered by some units.
TEST(SiliconesStatistics, NoWrongOkOfACube) {
  SiliconeOptions options;
  options.bodies = {"cube"};
  options.images = {1};
  options.rendered_paths = 1'000'000;
  options.measured_paths = 2'000'000;
  options.image_width_px = 320;
  int answered = 0;
  for (const SiliconeResult& r : bench_silicones(options)) {
    for (const SiliconeAnswer& a : r.channel) {
      EXPECT_NE(a.judged.verdict, DeviationVerdict::kWrongOk) << r.silicone;
      answered += a.judged.verdict == DeviationVerdict::kRight ? 1 : 0;
    }
    EXPECT_FALSE(r.colour_difference > 6.0) << r.silicone;
  }
  EXPECT_GE(answered, 5);
}

}  // namespace
}  // namespace scattermeter::apps
