#include "apps/instrument/fitted_view.h"

#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "apps/instrument/instrument.h"
#include "apps/instrument/open_objects.h"
#include "apps/simulation/virtual_shots.h"
#include "core/mesh/bodies.h"
#include "core/scene/default_uncertainty.h"
#include "tests/fixtures/apps/body_rig.h"

namespace scattermeter::apps {
namespace {

// The piece lies a little off its mesh in every way that the rig allows for: the answer holds, and
// names how large the piece is.
TEST(ShiftedInstrument, PieceOffItsMeshWithinWhatTheRigStates) {
  const Rig rig = body_rig("cube", 2);
  const ObjectScenes moved = open_objects(rig, [&](const SceneObject& object) {
    TriangleMesh mesh = body_mesh(object.name);
    const Eigen::Vector3d center = bounds(mesh).center_mm();
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(0.005, Eigen::Vector3d(1, -1, 2).normalized()).toRotationMatrix();
    for (Eigen::Vector3d& v : mesh.vertices_mm) {
      v = center + 1.003 * (turn * (v - center)) + Eigen::Vector3d(0.15, -0.12, 0.1);
    }
    return mesh;
  });
  Rig uncertain = rig;
  uncertain.scene.camera.responsivity_relative_std = 0.01;
  default_uncertainty::take_where_none(uncertain.scene);
  const ObjectScenes stated = bodies_scenes(uncertain);
  const VirtualShots shots(rig, moved, {.noise = true});
  MeasureOptions options;
  options.estimate.model = "dipole";
  Instrument instrument(uncertain, stated, options);
  const Measurement m = instrument.measure(shots.source(3));
  ASSERT_EQ(m.results.size(), 3U);
  for (std::size_t c = 0; c < 3; ++c) {
    const Estimate& e = m.results[c].estimate;
    ASSERT_TRUE(e.reasons.empty()) << e.reasons.front();
    const Medium truth = plastic()[c];
    EXPECT_LT(std::abs(e.sigma_s_prime_per_mm.value - truth.sigma_s_prime_per_mm),
              2.5 * e.sigma_s_prime_per_mm.std);
    EXPECT_LT(std::abs(e.sigma_a_per_mm.value - truth.sigma_a_per_mm), 2.5 * e.sigma_a_per_mm.std);
    EXPECT_LT(e.sigma_s_prime_per_mm.std, 0.05 * truth.sigma_s_prime_per_mm);
    EXPECT_LT(e.reduced_chi2, 1.3);
  }
}

}  // namespace
}  // namespace scattermeter::apps
