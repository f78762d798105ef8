// A rig that deviates in one thing from what its file says: the rows of `bench deviations`.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/deviations/colour_frame.h"
#include "apps/rig/rig.h"
#include "core/material/medium.h"
#include "core/mesh/triangle_mesh.h"
#include "core/scene/scene.h"

namespace scattermeter::apps {

// What is true in one shot.
struct TrueShot {
  std::array<Medium, 3> media;  // R, G, B; eta is the object's
  // Of the half of the object that is right of its centre in the frame; absent: the same.
  std::optional<std::array<Medium, 3>> right_half;
  std::vector<SceneLight> lights;  // all that are on
};

// All that makes the shots. It begins as the stated rig says.
struct TrueSetup {
  Rig rig;  // camera, truth.pose, sensor with truth.sensor, eta of the one object
  TriangleMesh mesh;
  std::vector<TrueShot> shots;  // as rig.scene.shots
  // The pose marks were taken by the true camera; otherwise by the stated one, before it changed.
  bool marks_by_true_camera = false;
};

// Size and random choices of one run.
struct DeviationDraw {
  double size = 0;  // in the unit of its row
  double sign = 1;  // +1 or -1
  std::uint64_t seed = 1;
  double signed_size() const { return sign * size; }
};

// Where a deviation has a meaning.
struct DeviationNeeds {
  bool two_leds = false;
  bool edges = false;   // not on a sphere
  bool volume = false;  // not with shots rendered by the dipole
};

// One kind of deviation. Exactly one of the three functions is set, except for the control and for
// the rigs that deviate in everything.
struct Deviation {
  std::string name;
  std::vector<std::string> words;  // a refusal that contains one of them names the cause
  std::string unit;
  std::vector<double> sizes;  // ascending
  // The first so many sizes are within what the stated rig allows for: these must be answered.
  int within = 0;
  DeviationNeeds needs = {};
  // Changes what is true.
  std::function<void(TrueSetup&, const DeviationDraw&)> truth = {};
  // Changes the expected counts of the shots, before noise.
  std::function<void(std::vector<ColourFrame>&, const DeviationDraw&)> frames = {};
  // Changes what the rig file says, as a typing error does.
  std::function<void(Rig&, const DeviationDraw&)> stated = {};
};

// The rows by what deviates.
std::vector<Deviation> mesh_deviations();
std::vector<Deviation> led_deviations();
std::vector<Deviation> stray_light_deviations();
std::vector<Deviation> camera_deviations();
std::vector<Deviation> sensor_deviations();
std::vector<Deviation> object_deviations();
std::vector<Deviation> drawn_deviations();

// All of them, the control (no deviation) first.
const std::vector<Deviation>& all_deviations();
// Throws std::invalid_argument for an unknown name, with the known ones.
const Deviation& deviation_named(const std::string& name);

}  // namespace scattermeter::apps
