#include "apps/bench_transport/lit_body.h"

#include <cmath>

#include <gtest/gtest.h>

namespace scattermeter::apps {
namespace {

// The light of the whole image, from an atlas and from paths of the very medium, at a scattering
// that is that of a node: what is compared is not interpolated. Both have errors of some per mille.
TEST(LitBody, AtlasAndPathsShowTheSameLight) {
  LitBody body("cube", {240, 4.0, 0.3});
  EXPECT_EQ(body.channel().phase, PhaseFunction(0.3));
  EXPECT_GT(body.n_rows(), 10);
  EXPECT_EQ(body.n_rows(), body.area_mm2().size());
  TransportAtlas atlas;
  const ChannelSimulation simulation = body.simulation(atlas);
  const double sigma_s = TransportAtlas::sigma_s_per_mm(-1);
  const Eigen::VectorXd at_node = simulation.light_at_node(-1, 0.05, 64);
  const LitBody::Traced traced = body.traced({sigma_s, 0.05, 1.3}, 7, 64);
  EXPECT_EQ(traced.audit.paths, 64 * 4096);
  EXPECT_GT(traced.audit.connections, traced.audit.paths);
  const Eigen::VectorXd& area = body.area_mm2();
  EXPECT_NEAR(area.dot(at_node) / area.dot(traced.image.l), 1.0, 0.01);
  // The dipole is about right, in the same unit.
  EXPECT_NEAR(area.dot(body.dipole({sigma_s, 0.05, 1.0}).l) / area.dot(traced.image.l), 1.0, 0.5);
  EXPECT_EQ(&body.in(atlas), &body.in(atlas));
}

}  // namespace
}  // namespace scattermeter::apps
