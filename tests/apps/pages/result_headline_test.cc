#include "apps/pages/result_headline.h"

#include <gtest/gtest.h>

#include "tests/fixtures/apps/made_measurement.h"

namespace scattermeter::apps {
namespace {

TEST(ResultHeadline, OneOfTwoIsRefused) {
  // 0.0123 of 2.1934 and 0.000045 of 0.002013.
  EXPECT_EQ(precision_sentence(two_channels()),
            "sigma_s' is known to 0.56 %, sigma_a to 2.2 % (one standard deviation).");
  EXPECT_EQ(next_sentence(two_channels()),
            "Next: see to the reasons of the refusals, in their order.");
}

TEST(ResultHeadline, RangesAndTheLargestCause) {
  Measurement m = two_channels();
  m.results[0].estimate.budget = {{"noise", 0.01, 1e-5}, {"mesh scale", 0.02, 4e-5}};
  m.results[1] = m.results[0];
  m.results[1].estimate.sigma_s_prime_per_mm.std *= 2.0;
  // An upper limit is not known to some percent.
  m.results[1].estimate.sigma_a_per_mm = {0.0001, 0.0002, 0.0, 0.0005};
  m.results[1].estimate.budget[0].std_sigma_a_per_mm = 1e-4;
  EXPECT_EQ(precision_sentence(m),
            "sigma_s' is known to 0.56 … 1.1 %, sigma_a to 2.2 % (one standard deviation).");
  EXPECT_EQ(next_sentence(m),
            "The largest cause of uncertainty in 3 of 4 coefficients is mesh scale; knowing it "
            "better would help most.");
}

TEST(ResultHeadline, WhatTheValuesRestOn) {
  Measurement m = two_channels();
  EXPECT_EQ(rests_on_sentence(m), "");
  PriorPull scale{"scale", "scale"}, eta{"eta", "eta"};
  scale.unseen_sigma_s_prime_per_mm = 0.2;
  eta.unseen_sigma_a_per_mm = 0.001;
  m.results[0].estimate.pulls = {scale, eta};
  m.results[1].estimate.pulls = {scale};
  m.results.push_back(m.results[0]);
  m.results[2].channel = 'B';
  m.results[2].estimate.pulls = {scale};
  EXPECT_EQ(rests_on_sentence(m),
            "2 of 3 values rest on what the rig states and these shots cannot test: eta (POM R); "
            "scale (POM R, POM B).");
}

TEST(ResultHeadline, NothingMeasured) {
  Measurement m = two_channels();
  m.results.erase(m.results.begin());
  EXPECT_EQ(precision_sentence(m), "");
}

}  // namespace
}  // namespace scattermeter::apps
