#include "core/estimation/far_eta.h"

#include <vector>

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

ChannelResult with_eta_at(double offset) {
  ChannelResult r;
  r.estimate.converged = true;
  PriorPull pull;
  pull.name = pull.group = "eta";
  pull.offset = offset;
  r.estimate.pulls = {pull};
  return r;
}

TEST(FarEta, IsTakenByEachChannelUntilItStays) {
  EtaOffsets offsets;
  EXPECT_EQ(take_far_etas({with_eta_at(0.007), with_eta_at(-0.073), with_eta_at(0.0)}, offsets),
            (std::vector<bool>{false, true, false}));
  EXPECT_EQ(offsets[0], 0.0);
  EXPECT_NEAR(offsets[1], -0.075, 1e-12);
  EXPECT_EQ(take_far_etas({with_eta_at(0.007), with_eta_at(-0.08), with_eta_at(0.0)}, offsets),
            (std::vector<bool>{false, false, false}));
  EXPECT_EQ(take_far_etas({with_eta_at(0.02), with_eta_at(-0.001), with_eta_at(1.0)}, offsets),
            (std::vector<bool>{true, true, true}));
  EXPECT_NEAR(offsets[0], 0.02, 1e-12);
  EXPECT_EQ(offsets[1], 0.0);
  EXPECT_NEAR(offsets[2], 0.2, 1e-12);
}

TEST(FarEta, WhatItChangesDependsOnTheMediumWhereItIsFound) {
  EXPECT_TRUE(finds_other_eta(with_eta_at(-0.02).estimate));
  EXPECT_FALSE(finds_other_eta(with_eta_at(0.002).estimate));
  EXPECT_FALSE(finds_other_eta(ChannelResult().estimate));
  ChannelResult missed = with_eta_at(-0.02);
  missed.estimate.misfit_p_value = 1e-9;
  missed.estimate.misfit_relative = 0.01;
  EXPECT_FALSE(finds_other_eta(missed.estimate));
}

// Where the dipole does not describe the image, eta takes up what it misses.
TEST(FarEta, IsNotTakenFromAPoorFit) {
  EtaOffsets offsets;
  ChannelResult missed = with_eta_at(0.1);
  missed.estimate.misfit_p_value = 1e-9;
  missed.estimate.misfit_relative = 0.01;
  ChannelResult failed = with_eta_at(0.1);
  failed.estimate.converged = false;
  EXPECT_EQ(take_far_etas({missed, failed, ChannelResult()}, offsets),
            (std::vector<bool>{false, false, false}));
  EXPECT_EQ(offsets, (EtaOffsets{0.0, 0.0, 0.0}));
}

}  // namespace
}  // namespace scattermeter
