#include "apps/instrument/fitted_view.h"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "apps/instrument/instrument.h"
#include "apps/instrument/open_objects.h"
#include "apps/simulation/virtual_shots.h"
#include "calib/pose/shot_pose.h"
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

// Fits by the dipole whose size of the piece changes sides from view to view, as where the dipole
// does not hold: after a few, transport looks from the stated place, and its answers stand.
TEST(ShiftedInstrument, PieceThatTheDipoleKeepsMovingIsLeftToTransport) {
  const Rig rig = body_rig("cube", 1);
  const ObjectScenes objects = bodies_scenes(rig);
  const VirtualShots shots(rig, objects, {});
  LitObjects lit(rig.scene, objects, 2.0, 0.0);
  KeptLight kept;
  const capture::ShotSource source = shots.source(3);
  const SharedView view =
      see_all(rig.scene, objects, lit, calib::pose_from_points(rig.scene, rig.pose));
  SeenShots seen(rig, objects, lit, source, view, false, {}, kept, nullptr);
  seen.open();
  std::vector<double> size_off;  // of the views of the fits
  const auto fit = [&](const EstimateOptions& options) {
    size_off.push_back(seen.shots().front().seen->shift.norm());
    ChannelResult r;
    r.material = "plastic";
    r.channel = 'G';
    r.model = "dipole";
    r.estimate.converged = true;
    const double side = size_off.size() % 2 == 0 ? -1.0 : 0.5;
    constexpr double kKnown = 1e6;
    r.evidence = {{{"mesh scale", 0.01, true, "cube.size"}},
                  Eigen::MatrixXd::Constant(1, 1, kKnown),
                  Eigen::VectorXd::Constant(1, side * kKnown),
                  Eigen::VectorXd::Constant(1, 0.01),
                  100.0};
    if (options.goes_on_from_dipole({r})) {
      r.model = "transport";
      r.evidence = {};
    }
    return std::vector<ChannelResult>{r};
  };
  std::vector<std::pair<std::string, double>> timing_s;
  Stopwatch watch(timing_s);
  EstimateOptions options;
  options.paths = 0;
  const std::vector<ChannelResult> results =
      fitted_from_where_seen(rig.scene, seen, options, fit, watch);
  ASSERT_EQ(size_off.size(), 5U);
  EXPECT_EQ(size_off.front(), 0.0);
  for (std::size_t i = 1; i < 4; ++i) EXPECT_GT(size_off[i], 0.0);
  EXPECT_EQ(size_off.back(), 0.0);
  ASSERT_EQ(results.size(), 1U);
  EXPECT_EQ(results.front().model, "transport");
  EXPECT_TRUE(results.front().estimate.reasons.empty());
}

}  // namespace
}  // namespace scattermeter::apps
