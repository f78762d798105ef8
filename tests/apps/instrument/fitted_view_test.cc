#include "apps/instrument/fitted_view.h"

#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "apps/instrument/instrument.h"
#include "apps/rig/open_objects.h"
#include "apps/simulation/virtual_shots.h"
#include "calib/pose/shot_pose.h"
#include "core/mesh/bodies.h"
#include "core/mesh/round_bodies.h"
#include "core/nuisances/view_shift.h"
#include "core/scene/default_uncertainty.h"
#include "tests/fixtures/apps/body_rig.h"

namespace scattermeter::apps {
namespace {

// A piece that is moved, turned about its centre and scaled against its mesh: the answer holds.
void expect_right_answers(const std::string& body, const TriangleMesh& stated_mesh,
                          const Eigen::Vector3d& off_mm, double turn_rad, double scale,
                          const std::string& model, double position_std_mm = 0.0) {
  const Rig rig = body_rig(body, 2);
  const Eigen::Vector3d center = bounds(stated_mesh).center_mm();
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(turn_rad, Eigen::Vector3d(1, -1, 2).normalized()).toRotationMatrix();
  TriangleMesh mesh = stated_mesh;
  for (Eigen::Vector3d& v : mesh.vertices_mm) v = center + scale * (turn * (v - center)) + off_mm;
  const ObjectScenes moved = open_objects(rig, [&](const SceneObject&) { return mesh; });
  Rig uncertain = rig;
  uncertain.scene.camera.responsivity_relative_std = 0.01;
  default_uncertainty::take_where_none(uncertain.scene);
  if (position_std_mm > 0.0) {
    for (SceneObject& o : uncertain.scene.objects) o.position_std_mm = position_std_mm;
  }
  const ObjectScenes stated =
      open_objects(uncertain, [&](const SceneObject&) { return stated_mesh; });
  const VirtualShots shots(rig, moved, {.noise = true});
  MeasureOptions options;
  options.estimate.model = model;
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
    EXPECT_EQ(m.results[c].model, "dipole");
  }
}

// In every way that the rig allows for.
TEST(ShiftedInstrument, PieceOffItsMeshWithinWhatTheRigStates) {
  expect_right_answers("cube", body_mesh("cube"), {0.15, -0.12, 0.1}, 0.005, 1.003, "dipole");
}

// So far that derivatives no longer describe its light: it is moved to where its outline shows it.
TEST(ShiftedInstrument, PieceFarOffWithinAWideStatement) {
  expect_right_answers("cube", body_mesh("cube"), {1.5, -1.2, 1.0}, 0.05, 1.0, "dipole", 1.0);
}

// Its first fits miss the image; the views end where the dipole explains it.
TEST(ShiftedInstrument, RoundBodyOffItsPosition) {
  expect_right_answers("sphere", sphere_mesh(6), {0.2, -0.15, 0.2}, 0.0, 1.0, "auto");
}

// What fitted_from_where_seen() does with fits by the dipole that are made up: of one channel, by
// the number of the fit, from 1.
struct MadeUp {
  double size_off = 0;         // standard deviations
  double misfit_relative = 0;  // 0: the dipole explains the image
  bool has_enough_paths = true;
};
struct Fits {
  std::vector<double> moved;  // of the views of the fits
  std::vector<bool> looking;  // whether they were to trace few paths
  std::vector<ChannelResult> results;
};
Fits fits_of(const std::string& body, const std::function<MadeUp(std::size_t)>& made_up,
             bool finds_elsewhere = false, bool finds_leds = false) {
  const Rig rig = body_rig(body, 1);
  const ObjectScenes objects = bodies_scenes(rig);
  const VirtualShots shots(rig, objects, {});
  LitObjects lit(rig.scene, objects, 1.0, 0.0);
  KeptLight kept;
  const capture::ShotSource source = shots.source(3);
  const SharedView view =
      see_all(rig.scene, objects, lit, calib::pose_from_points(rig.scene, rig.pose));
  SeenShots seen(rig, objects, lit, source, view, false, {}, kept, nullptr);
  seen.open();
  Fits out;
  const auto fit = [&](const EstimateOptions& options) {
    out.moved.push_back(seen.shots().front().seen->shift.norm());
    out.looking.push_back(options.looking_paths.has_value());
    const MadeUp now = made_up(out.moved.size());
    ChannelResult r;
    r.material = "plastic";
    r.channel = 'G';
    r.model = "dipole";
    r.estimate.converged = true;
    r.estimate.misfit_relative = now.misfit_relative;
    r.estimate.misfit_p_value = now.misfit_relative > 0.0 ? 0.0 : 0.5;
    constexpr double kKnown = 1e6;
    r.evidence = {{{"mesh scale", 0.01, true, body + ".size"}},
                  Eigen::MatrixXd::Constant(1, 1, kKnown),
                  Eigen::VectorXd::Constant(1, now.size_off * kKnown),
                  Eigen::VectorXd::Constant(1, 0.01),
                  100.0};
    if (options.goes_on_from_dipole({r})) {
      r.model = "transport";
      r.has_enough_paths = now.has_enough_paths;
      r.evidence = {};
    }
    return std::vector<ChannelResult>{r};
  };
  std::vector<std::pair<std::string, double>> timing_s;
  Stopwatch watch(timing_s);
  EstimateOptions options;
  out.results = fitted_from_where_seen(
      rig.scene, seen, options, fit, [&] { return finds_elsewhere; },
      [&](const std::vector<ChannelResult>&) { return finds_leds; }, watch);
  return out;
}

// The caller places the pieces where it finds them, before a second fit.
TEST(ShiftedInstrument, EndsWhereTheCallerFindsThePieces) {
  const auto off = [](std::size_t) { return MadeUp{2.0, 0.0}; };
  EXPECT_EQ(fits_of("cube", off, true).moved.size(), 1U);
  EXPECT_GT(fits_of("cube", off, false).moved.size(), 1U);
}

// The caller puts the LEDs where it finds them, before transport.
TEST(ShiftedInstrument, EndsWhereTheCallerFindsTheLeds) {
  const auto good = [](std::size_t) { return MadeUp{}; };
  const Fits found = fits_of("cube", good, false, true);
  EXPECT_EQ(found.moved.size(), 1U);
  EXPECT_EQ(found.results.front().model, "dipole");
  EXPECT_EQ(fits_of("cube", good).results.front().model, "transport");
}

// A first look with few paths is the last where more would not tell more, as with an atlas.
TEST(ShiftedInstrument, TransportLooksAgainWhereMorePathsTellMore) {
  const auto few = fits_of("cube", [](std::size_t) { return MadeUp{0.0, 0.01, false}; });
  EXPECT_EQ(few.looking, (std::vector<bool>{true, false}));
  const auto enough = fits_of("cube", [](std::size_t) { return MadeUp{0.0, 0.01, true}; });
  EXPECT_EQ(enough.looking, (std::vector<bool>{true}));
  EXPECT_EQ(enough.results.front().model, "transport");
}

void expect_transport_from_stated(const Fits& fits, std::size_t n) {
  ASSERT_EQ(fits.moved.size(), n);
  EXPECT_EQ(fits.moved.front(), 0.0);
  for (std::size_t i = 1; i + 1 < n; ++i) EXPECT_GT(fits.moved[i], 0.0);
  EXPECT_EQ(fits.moved.back(), 0.0);
  ASSERT_EQ(fits.results.size(), 1U);
  EXPECT_EQ(fits.results.front().model, "transport");
  EXPECT_TRUE(fits.results.front().estimate.reasons.empty());
}

// The size of the piece changes sides from view to view, as where the dipole does not hold: after
// so many, transport looks from the stated position, and its answers stand.
TEST(ShiftedInstrument, PieceThatTheDipoleKeepsMovingIsLeftToTransport) {
  expect_transport_from_stated(fits_of("cube",
                                       [](std::size_t i) {
                                         return MadeUp{i % 2 == 0 ? -1.0 : 0.5, 0.0};
                                       }),
                               kMostViews + 1);
}

// A round body whose image the dipole misses moves once: that brings it nearer, or not.
TEST(ShiftedInstrument, RoundBodyIsSeenFromWhereItsMisfitFalls) {
  expect_transport_from_stated(fits_of("sphere",
                                       [](std::size_t i) {
                                         return MadeUp{3.0, i == 1 ? 0.01 : 0.008};
                                       }),
                               3);
  const Fits nearer = fits_of("sphere", [](std::size_t i) {
    return MadeUp{3.0, i == 1 ? 0.01 : 0.0};
  });
  ASSERT_EQ(nearer.moved.size(), 2U);
  EXPECT_GT(nearer.moved.back(), 0.0);
  EXPECT_EQ(nearer.results.front().model, "transport");
  // Outlines have told where a cube stands.
  EXPECT_EQ(fits_of("cube", [](std::size_t) { return MadeUp{3.0, 0.01}; }).moved.size(), 1U);
}

}  // namespace
}  // namespace scattermeter::apps
