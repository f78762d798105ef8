#include "apps/simulation/pyramid_rig.h"

#include <stdexcept>

#include <gtest/gtest.h>

#include "core/mesh/bodies.h"

namespace scattermeter::apps {
namespace {

TEST(PyramidRig, IsThePapers) {
  EXPECT_EQ(mesh_problem(pyramid_mesh()), "");
  EXPECT_NEAR(signed_volume_mm3(pyramid_mesh()), 20.0 * 20.0 * 20.0 / 3.0, 1e-9);
  EXPECT_THROW(pyramid_rig(968, nullptr), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter::apps
