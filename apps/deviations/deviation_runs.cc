#include "apps/deviations/deviation_runs.h"

#include <algorithm>
#include <random>
#include <stdexcept>
#include <utility>

#include "apps/deviations/true_shots.h"
#include "apps/deviations/unit_pictures.h"
#include "apps/instrument/instrument.h"
#include "apps/simulation/bodies_rig.h"
#include "apps/simulation/shot_renderer.h"
#include "core/base/input_error.h"
#include "core/base/stopwatch.h"
#include "core/camera/camera_model.h"
#include "core/mesh/bodies.h"
#include "core/mesh/round_bodies.h"
#include "core/scene/default_uncertainty.h"

namespace scattermeter::apps {
namespace {

constexpr double kEta = 1.49;
// A run by volume takes as long as so many by the dipole; a draw spends the same time on both.
constexpr std::size_t kDipolePerVolume = 29;

const std::vector<std::string> kBodies = {"cube", "pyramid", "sphere"};
const std::vector<std::string> kPatterns = {"RGGB", "GRBG", "GBRG", "BGGR"};

template <class T>
bool allowed(const std::vector<T>& list, const T& value) {
  return list.empty() || std::find(list.begin(), list.end(), value) != list.end();
}

bool fits(const DeviationRun& run, const DeviationOptions& options) {
  const DeviationNeeds& needs = run.kind->needs;
  if (needs.two_leds && run.leds < 2) return false;
  if (needs.edges && run.body == "sphere") return false;
  if (needs.volume && !run.volume) return false;
  return allowed(options.bodies, run.body) &&
         allowed(options.sizes, static_cast<int>(run.size_idx)) &&
         (options.leds == 0 || options.leds == run.leds) &&
         (options.rendering == DeviationRendering::kBoth ||
          run.volume == (options.rendering == DeviationRendering::kVolume));
}

// All bodies, numbers of LEDs and renderings of a kind and size.
std::vector<DeviationRun> combinations(const Deviation& kind, std::size_t size_idx,
                                       const DeviationOptions& options) {
  std::vector<DeviationRun> out;
  for (bool volume : {false, true}) {
    for (const std::string& body : kBodies) {
      for (int leds : {1, 2}) {
        const DeviationRun run{&kind, size_idx, body, leds, volume, 1};
        if (fits(run, options)) out.push_back(run);
      }
    }
  }
  return out;
}

// In random order, with the volume's runs spread among the others.
void shuffle_runs(std::vector<DeviationRun>& runs, std::mt19937_64& random) {
  std::shuffle(runs.begin(), runs.end(), random);
  std::vector<DeviationRun> dipole, volume, out;
  for (const DeviationRun& run : runs) (run.volume ? volume : dipole).push_back(run);
  if (dipole.empty() || volume.empty()) return;
  std::size_t v = 0;
  for (std::size_t i = 0; i < runs.size() * kDipolePerVolume; ++i) {
    const bool now = random() % (kDipolePerVolume + 1) == 0;
    out.push_back(now ? volume[v++ % volume.size()] : dipole[i % dipole.size()]);
  }
  runs = out;
}

// A pose from marks that were imaged by this camera.
void take_marks(Rig& stated, const Rig& by) {
  const CameraView view = true_view(by);
  std::vector<Eigen::Vector3d> marks_mm;
  for (const PointPair& pair : stated.pose.points) marks_mm.push_back(pair.world_mm);
  const auto marks_px = project(view.intrinsics, view.camera_from_world, marks_mm);
  for (std::size_t i = 0; i < marks_px.size(); ++i) stated.pose.points[i].image_px = marks_px[i];
}

TrueCoefficients truth_of(const TrueSetup& setup, std::size_t channel) {
  std::vector<Medium> media;
  for (const TrueShot& shot : setup.shots) {
    media.push_back(shot.media[channel]);
    if (shot.right_half) media.push_back((*shot.right_half)[channel]);
  }
  return true_coefficients(media);
}

// The estimates of R, G and B; a rig that is refused as a whole gives three refusals.
std::array<Estimate, 3> measured(const Rig& stated, const TriangleMesh& mesh,
                                 const std::vector<capture::RawFrame>& frames, bool volume,
                                 const DeviationOptions& options) {
  std::array<Estimate, 3> out;
  try {
    const ObjectScenes objects = open_objects(stated, [&](const SceneObject&) { return mesh; });
    MeasureOptions measure;
    measure.estimate.model = volume ? "transport" : "dipole";
    measure.estimate.paths = options.measured_paths;
    measure.estimate.time_limit_s = options.time_limit_s;
    Instrument instrument(stated, objects, measure);
    const Measurement m = instrument.measure(capture::shots_from(
        stated.scene, capture::all_shots(stated.scene),
        capture::FrameSource([&](std::size_t i, std::size_t) { return frames.at(i); })));
    for (std::size_t c = 0; c < 3; ++c) out[c] = m.results.at(c).estimate;
  } catch (const InputError& e) {
    for (Estimate& estimate : out) estimate.reasons = {e.what()};
  }
  return out;
}

std::array<DeviationResult, 3> run_one(const DeviationRun& run, const DeviationOptions& options,
                                       UnitPictures& pictures) {
  const Rig stated = stated_rig(run, options.image_width_px);
  const MeasuredSetup measured =
      measure_deviating(stated, true_setup(stated, stated_mesh(run.body)), run, options, pictures);
  std::array<DeviationResult, 3> results;
  for (std::size_t c = 0; c < 3; ++c) {
    const TrueCoefficients truth = truth_of(measured.setup, c);
    results[c] = {run,
                  c,
                  truth,
                  measured.estimates[c],
                  judge_answer(measured.estimates[c], truth, run.kind->words),
                  measured.seconds};
  }
  return results;
}

}  // namespace

const std::array<DeviationMedium, 3>& deviation_media() {
  static const std::array<DeviationMedium, 3> media = {
      {{"faint", {0.6, 0.001, 1.0}}, {"plain", {1.3, 0.005, 1.0}}, {"dense", {2.5, 0.05, 1.0}}}};
  return media;
}

TriangleMesh stated_mesh(const std::string& body) {
  if (body == "cube") return cube_mesh();
  if (body == "pyramid") return pyramid_mesh();
  if (body == "sphere") return sphere_mesh();
  throw std::invalid_argument("stated_mesh: " + body);
}

Rig stated_rig(const DeviationRun& run, int image_width_px) {
  std::array<Medium, 3> media;
  for (std::size_t c = 0; c < 3; ++c) media[c] = deviation_media()[c].medium;
  Rig rig = bodies_rig(image_width_px, kEta, {{"drawn", media}}, {run.body});
  rig.path = "rig.yaml";
  rig.scene.shots.resize(static_cast<std::size_t>(run.leds));
  rig.scene.camera.responsivity_relative_std = 0.02;
  rig.scene.camera.sensor.cfa = cfa_pattern_from_name(kPatterns[run.seed / 2 % kPatterns.size()]);
  rig.pose.options = {};
  for (SceneLight& light : rig.scene.lights) light.led()->position_std_mm = 0.2;
  default_uncertainty::take_where_none(rig.scene);
  return rig;
}

TrueSetup true_setup(const Rig& stated, const TriangleMesh& mesh) {
  TrueSetup setup;
  setup.rig = stated;
  setup.mesh = mesh;
  for (const SceneShot& shot : stated.scene.shots) {
    TrueShot& true_shot = setup.shots.emplace_back();
    true_shot.media = stated.truth.materials.at(shot.material);
    for (const std::string& name : shot.lights) {
      true_shot.lights.push_back(stated.scene.light(name));
    }
  }
  return setup;
}

MeasuredSetup measure_deviating(Rig stated, TrueSetup setup, const DeviationRun& run,
                                const DeviationOptions& options, UnitPictures& pictures) {
  const Deviation& kind = *run.kind;
  const DeviationDraw draw{kind.sizes[run.size_idx], run.seed % 2 == 0 ? 1.0 : -1.0, run.seed / 2};
  const TriangleMesh mesh = setup.mesh;
  if (kind.truth) kind.truth(setup, draw);
  // A body that is displaced or turned stands on a table as much lower.
  if (auto& plane = setup.rig.scene.surroundings.plane) {
    plane->z_mm = std::min(plane->z_mm, bounds(setup.mesh).min_mm.z());
  }
  if (setup.marks_by_true_camera) take_marks(stated, setup.rig);
  ExpectedShots expected = expected_shots(setup, stated, run.volume, pictures);
  if (kind.frames) kind.frames(expected.frames, draw);
  const std::vector<capture::RawFrame> frames = exposed_frames(expected, setup, stated, run.seed);
  // The noise of the rendering is known to the user as if it were the sensor's.
  double& gain_e_per_count = stated.scene.camera.sensor.noise.gain_e_per_count;
  gain_e_per_count /= 1.0 + gain_e_per_count * expected.rendering_counts2_per_count;
  if (kind.stated) kind.stated(stated, draw);
  std::vector<std::pair<std::string, double>> timing_s;
  Stopwatch watch(timing_s);
  MeasuredSetup out{std::move(setup), measured(stated, mesh, frames, run.volume, options)};
  watch.total();
  out.seconds = timing_s.back().second;
  return out;
}

std::vector<DeviationRun> planned_runs(const DeviationOptions& options) {
  std::vector<const Deviation*> kinds;
  for (const std::string& name : options.kinds) kinds.push_back(&deviation_named(name));
  if (kinds.empty()) {
    for (const Deviation& kind : all_deviations()) kinds.push_back(&kind);
  }
  std::mt19937_64 random(options.seed);
  std::vector<std::vector<DeviationRun>> strata;
  for (const Deviation* kind : kinds) {
    for (std::size_t s = 0; s < kind->sizes.size(); ++s) {
      strata.push_back(combinations(*kind, s, options));
      if (strata.back().empty()) strata.pop_back();
    }
  }
  std::vector<DeviationRun> out;
  if (options.runs == 0) {
    for (const auto& stratum : strata) out.insert(out.end(), stratum.begin(), stratum.end());
  } else if (!strata.empty()) {
    for (auto& stratum : strata) shuffle_runs(stratum, random);
    std::shuffle(strata.begin(), strata.end(), random);
    for (std::size_t i = 0; out.size() < static_cast<std::size_t>(options.runs); ++i) {
      const auto& stratum = strata[i % strata.size()];
      out.push_back(stratum[i / strata.size() % stratum.size()]);
    }
  }
  for (DeviationRun& run : out) run.seed = options.run_seed.value_or(random() >> 16U);
  return out;
}

std::vector<DeviationResult> bench_deviations(const DeviationOptions& options) {
  const std::vector<DeviationRun> runs = planned_runs(options);
  UnitPictures pictures(options.rendered_paths);
  std::vector<DeviationResult> results;
  ProgressStage stage(options.progress, "runs", runs.size());
  for (const DeviationRun& run : runs) {
    for (const DeviationResult& result : run_one(run, options, pictures)) {
      results.push_back(result);
      if (options.on_result) options.on_result(result);
    }
    stage.step();
  }
  return results;
}

}  // namespace scattermeter::apps
