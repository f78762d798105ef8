#include "apps/deviations/deviation.h"

#include <algorithm>
#include <set>
#include <stdexcept>

#include <gtest/gtest.h>

#include "apps/deviations/deviation_runs.h"

namespace scattermeter::apps {
namespace {

DeviationRun run_of(const Deviation& kind, std::size_t size_idx) {
  return {.kind = &kind, .size_idx = size_idx, .body = "cube"};
}

// A grey object on black, two shots that differ.
std::vector<ColourFrame> some_frames() {
  std::vector<ColourFrame> frames(2, black_frame(300, 200, 4000.0));
  for (std::size_t f = 0; f < 2; ++f) {
    frames[f].object = {50, 50, 200, 100};
    for (std::size_t c = 0; c < 3; ++c) {
      for (int y = 51; y < 149; ++y) {
        for (int x = 51; x < 249; ++x) {
          frames[f].at(c, x, y) = 1000.0F + 2.0F * static_cast<float>(x + f) + 5.0F * c;
        }
      }
    }
  }
  return frames;
}

// What a setup says, as numbers.
std::vector<double> numbers(const TrueSetup& t) {
  std::vector<double> out;
  const auto add = [&](const auto& v) { out.insert(out.end(), v.begin(), v.end()); };
  for (const Eigen::Vector3d& v : t.mesh.vertices_mm) add(v);
  const SceneCamera& camera = t.rig.scene.camera;
  const CameraIntrinsics& k = camera.intrinsics;
  add(std::vector<double>{k.fx_px, k.fy_px, k.cx_px, k.cy_px});
  add(k.distortion);
  add(*camera.responsivity);
  add(camera.sensor.black_counts);
  add(std::vector<double>{
      static_cast<double>(camera.sensor.white_counts), camera.sensor.noise.gain_e_per_count,
      t.rig.scene.objects.front().phase.mean_cosine(), t.rig.truth.sensor.veiling_glare,
      t.rig.scene.objects.front().eta_int_over_ext, t.rig.scene.objects.front().surface_alpha});
  for (Channel c : camera.sensor.cfa.phase) out.push_back(static_cast<double>(c));
  for (const auto& radial : t.rig.truth.sensor.vignetting_radial) add(radial);
  for (const Eigen::Vector3d& v :
       {t.rig.truth.pose->position_mm, t.rig.truth.pose->look_at_mm, t.rig.truth.pose->up}) {
    add(v);
  }
  for (const TrueShot& shot : t.shots) {
    for (const Medium& m : shot.media) out.push_back(m.sigma_s_prime_per_mm);
    if (shot.right_half) out.push_back((*shot.right_half)[0].sigma_s_prime_per_mm);
    for (const SceneLight& light : shot.lights) {
      add(light->power());
      if (light.led() == nullptr) continue;
      add(light.led()->led.position_mm);
      add(light.led()->led.axis);
      out.push_back(light.led()->led.exponent);
    }
  }
  return out;
}

std::vector<double> numbers(const Rig& stated) {
  std::vector<double> out;
  for (const PointPair& p : stated.pose.points) out.push_back(p.image_px.sum());
  for (const SceneLight& light : stated.scene.lights) {
    out.push_back(light.led()->led.position_mm.sum());
    out.push_back(light.led()->led.intensity_W_per_sr.sum());
  }
  for (const SceneShot& shot : stated.scene.shots) {
    out.push_back(shot.lights.front() == "led1" ? 1.0 : 2.0);
  }
  return out;
}

bool changes_frames(const Deviation& kind, const DeviationDraw& draw) {
  std::vector<ColourFrame> frames = some_frames();
  const std::vector<ColourFrame> before = frames;
  kind.frames(frames, draw);
  for (std::size_t f = 0; f < frames.size(); ++f) {
    if (frames[f].counts != before[f].counts) return true;
  }
  return false;
}

// Every size of every kind changes one thing, whatever was drawn.
TEST(Deviation, EveryRowChangesSomething) {
  for (const Deviation& kind : all_deviations()) {
    const int functions = (kind.truth ? 1 : 0) + (kind.frames ? 1 : 0) + (kind.stated ? 1 : 0);
    EXPECT_EQ(functions, kind.name == "none" ? 0 : kind.words.empty() ? 3 : 1) << kind.name;
    for (std::size_t s = 0; s < kind.sizes.size(); ++s) {
      for (const double sign : {1.0, -1.0}) {
        const DeviationDraw draw{kind.sizes[s], sign, 7};
        const Rig stated = stated_rig(run_of(kind, s), 320);
        if (kind.truth) {
          TrueSetup truth = true_setup(stated, stated_mesh("cube"));
          kind.truth(truth, draw);
          EXPECT_NE(numbers(truth), numbers(true_setup(stated, stated_mesh("cube")))) << kind.name;
          EXPECT_EQ(mesh_problem(truth.mesh), "") << kind.name;
        }
        if (kind.frames) {
          EXPECT_TRUE(changes_frames(kind, draw)) << kind.name;
        }
        if (kind.stated) {
          Rig other = stated;
          kind.stated(other, draw);
          EXPECT_NE(numbers(other), numbers(stated)) << kind.name;
        }
      }
    }
  }
}

TEST(Deviation, RowsAreComplete) {
  std::set<std::string> names;
  int three_sizes = 0;
  for (const Deviation& kind : all_deviations()) {
    EXPECT_TRUE(names.insert(kind.name).second) << kind.name;
    EXPECT_EQ(kind.words.empty(), kind.name == "none" || kind.name == "rig drawn as stated")
        << kind.name;
    ASSERT_FALSE(kind.sizes.empty()) << kind.name;
    EXPECT_TRUE(std::is_sorted(kind.sizes.begin(), kind.sizes.end())) << kind.name;
    EXPECT_LE(kind.within, static_cast<int>(kind.sizes.size())) << kind.name;
    three_sizes += kind.sizes.size() >= 3 ? 1 : 0;
    EXPECT_EQ(&deviation_named(kind.name), &kind);
  }
  EXPECT_GE(names.size(), 60U);
  EXPECT_GE(three_sizes, 50);
  EXPECT_EQ(all_deviations().front().name, "none");
  EXPECT_THROW(deviation_named("nonsense"), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter::apps
