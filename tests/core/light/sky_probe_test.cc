#include "core/light/sky_probe.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

TEST(SkyProbe, HasSunSkyAndGround) {
  const SkyProbe sky;
  const Environment probe = make_sky_probe(sky);
  EXPECT_EQ(probe.width_px, 1024);
  EXPECT_EQ(probe.height_px, 512);
  EXPECT_EQ(probe_problem(probe.width_px, probe.height_px, probe.radiance), "");
  const Eigen::Array3f zenith = probe.radiance_toward({0, 0, 1});
  const Eigen::Array3f horizon = probe.radiance_toward(Eigen::Vector3d(-1, 0.3, 0.02).normalized());
  const Eigen::Array3f ground = probe.radiance_toward({0.1, 0.1, -0.9});
  EXPECT_NEAR(zenith[1], 1.0, 0.01);
  EXPECT_GT(zenith[2], 2.0 * zenith[1]);  // blue
  EXPECT_GT(horizon[1], 2.5 * zenith[1]);
  EXPECT_LT(ground[2], ground[0]);
  const float peak = *std::max_element(probe.radiance.begin(), probe.radiance.end());
  EXPECT_GT(peak, 1e5F);
  EXPECT_EQ(probe.radiance_toward(sky.sun_direction.normalized())[0], peak);
}

// The sun's flux is radiance times the solid angle of its disc, 2 pi (1 - cos radius).
TEST(SkyProbe, SunHasItsSolidAngle) {
  SkyProbe sky;
  sky.sun_radius_rad = 0.03;
  const Environment with = make_sky_probe(sky);
  sky.sun_radiance = 0.0;
  const Environment without = make_sky_probe(sky);
  const ProbeMap map(with.projection, with.width_px, with.height_px);
  double flux = 0.0;
  for (int y = 0; y < with.height_px; ++y) {
    for (int x = 0; x < with.width_px; ++x) {
      const std::size_t i = 3 * static_cast<std::size_t>(y * with.width_px + x) + 1;
      flux += (static_cast<double>(with.radiance[i]) - without.radiance[i]) *
              map.solid_angle_sr({x + 0.0, y + 0.0, x + 1.0, y + 1.0});
    }
  }
  const double expected = 1e5 * 2.0 * std::numbers::pi * (1.0 - std::cos(0.03));
  EXPECT_NEAR(flux, expected, 0.003 * expected);
}

TEST(SkyProbe, IsTheSameEveryTime) {
  SkyProbe sky;
  sky.width_px = 64;
  EXPECT_EQ(make_sky_probe(sky).radiance, make_sky_probe(sky).radiance);
}

TEST(SkyProbe, RefusesASunBelowTheHorizon) {
  SkyProbe sky;
  sky.sun_direction = {1, 0, -0.1};
  EXPECT_THROW(make_sky_probe(sky), std::invalid_argument);
  sky.sun_direction = {1, 0, 0.1};
  sky.width_px = 101;
  EXPECT_THROW(make_sky_probe(sky), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter
