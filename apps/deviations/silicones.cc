#include "apps/deviations/silicones.h"

#include <algorithm>
#include <limits>
#include <random>
#include <stdexcept>

#include "apps/deviations/colour_difference.h"
#include "apps/deviations/unit_pictures.h"
#include "apps/simulation/bodies_rig.h"
#include "apps/simulation/synthetic_camera.h"
#include "core/mesh/bodies.h"
#include "core/scene/default_uncertainty.h"

namespace scattermeter::apps {
namespace {

constexpr double kSiliconeEta = 1.41;
constexpr double kMostForward = 0.9;
constexpr double kTableAlbedo = 0.04;

std::string mesh_name(const std::string& body) {
  if (body == "cube") return "cube";
  if (body == "bust") return "scan";
  throw std::invalid_argument("bench_silicones: no body " + body);
}

std::vector<Silicone> wanted_silicones(const std::vector<std::string>& names) {
  if (names.empty()) return {silicones().begin(), silicones().end()};
  std::vector<Silicone> out;
  for (const std::string& name : names) {
    const auto it = std::find_if(silicones().begin(), silicones().end(),
                                 [&](const Silicone& s) { return s.name == name; });
    if (it == silicones().end())
      throw std::invalid_argument("bench_silicones: no silicone " + name);
    out.push_back(*it);
  }
  return out;
}

Rig careful_rig(const Silicone& silicone, const std::string& mesh, int images, int width_px) {
  Rig rig = bodies_rig(width_px, kSiliconeEta, {{silicone.name, silicone.media}}, {mesh});
  rig.path = "rig.yaml";
  rig.scene.lights.push_back(synthetic_led("led3", {20, 70, 85}, {-20, -70, -75}));
  SceneShot third = rig.scene.shots.back();
  third.file = std::string(silicone.name) + "_" + mesh + "_3.dng";
  third.lights = {"led3"};
  rig.scene.shots.push_back(third);
  rig.scene.shots.resize(static_cast<std::size_t>(images));
  rig.scene.camera.responsivity_relative_std = 0.02;
  rig.pose.options = {};
  rig.pose.options.point_std_px = 0.3;
  default_uncertainty::take_where_none(rig.scene);
  return rig;
}

// What the kind "rig drawn as stated" leaves as it is.
void draw_matter_and_table(TrueSetup& setup, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  setup.rig.scene.objects.front().phase =
      std::uniform_real_distribution<double>(0.0, kMostForward)(random);
  ScenePlane table;
  table.albedo.setConstant(
      std::max(0.0, std::normal_distribution<double>(kTableAlbedo, kTableAlbedo)(random)));
  setup.rig.scene.surroundings.plane = table;
}

Eigen::Vector3d pixel(const ColourRadiance& picture, std::size_t i) {
  return {picture.rgb[3 * i], picture.rgb[3 * i + 1], picture.rgb[3 * i + 2]};
}

double re_rendered_difference(const TrueSetup& setup, const std::array<Medium, 3>& measured,
                              UnitPictures& pictures) {
  const SceneLight& light = setup.shots.front().lights.front();
  const auto truth = pictures.of(setup, light, setup.shots.front().media, false);
  const auto again = pictures.of(setup, light, measured, false);
  const ColourRadiance& a = truth->radiance;
  const double white = *std::max_element(a.rgb.begin(), a.rgb.end());
  double sum = 0.0;
  std::size_t n = 0;
  for (std::size_t i = 0; 3 * i < a.rgb.size(); ++i) {
    const Eigen::Vector3d one = pixel(a, i), two = pixel(again->radiance, i);
    if (!(one.minCoeff() > 0.0)) continue;
    sum += ciede2000(lab_from_linear_srgb(one / white), lab_from_linear_srgb(two / white));
    ++n;
  }
  return n > 0 ? sum / static_cast<double>(n) : std::numeric_limits<double>::quiet_NaN();
}

SiliconeResult measure_silicone(const Silicone& silicone, const std::string& body, int images,
                                int draw, std::uint64_t seed, const SiliconeOptions& o,
                                UnitPictures& pictures) {
  const std::string name = mesh_name(body);
  const Rig stated = careful_rig(silicone, name, images, o.image_width_px);
  TrueSetup setup = true_setup(stated, body_mesh(name));
  draw_matter_and_table(setup, seed);
  const DeviationRun run{&deviation_named("rig drawn as stated"), 0, body, images, true, seed};
  DeviationOptions options;
  options.measured_paths = o.measured_paths;
  options.time_limit_s = o.time_limit_s;
  options.progress = o.progress;
  const MeasuredSetup measured = measure_deviating(stated, setup, run, options, pictures);
  SiliconeResult out{body, silicone.name, images, draw, {}, 0.0, measured.seconds};
  std::array<Medium, 3> media;
  bool answered = true;
  for (std::size_t c = 0; c < 3; ++c) {
    const Estimate& e = measured.estimates[c];
    out.channel[c] = {silicone.media[c], e,
                      judge_answer(e, true_coefficients({silicone.media[c]}), {})};
    answered = answered && e.reasons.empty();
    media[c] = {e.sigma_s_prime_per_mm.value, std::max(0.0, e.sigma_a_per_mm.value), 1.0};
  }
  out.colour_difference = answered ? re_rendered_difference(measured.setup, media, pictures)
                                   : std::numeric_limits<double>::quiet_NaN();
  return out;
}

}  // namespace

const std::array<Silicone, 3>& silicones() {
  static const std::array<Silicone, 3> all = {
      {{"translucent", {{{0.70, 0.004, 1.0}, {0.78, 0.010, 1.0}, {0.86, 0.030, 1.0}}}},
       {"white", {{{1.50, 0.003, 1.0}, {1.65, 0.004, 1.0}, {1.80, 0.006, 1.0}}}},
       {"red", {{{2.40, 0.006, 1.0}, {2.60, 0.050, 1.0}, {2.80, 0.080, 1.0}}}}}};
  return all;
}

std::vector<SiliconeResult> bench_silicones(const SiliconeOptions& options) {
  for (const std::string& body : options.bodies) mesh_name(body);
  const std::vector<Silicone> wanted = wanted_silicones(options.silicones);
  for (const int images : options.images) {
    if (images < 1 || images > 3) throw std::invalid_argument("bench_silicones: 1 to 3 images");
  }
  std::vector<SiliconeResult> out;
  UnitPictures pictures(options.rendered_paths, 16);
  std::mt19937_64 random(options.seed);
  ProgressStage stage(options.progress, "silicones",
                      options.bodies.size() * options.images.size() * wanted.size() *
                          static_cast<std::size_t>(options.draws));
  for (int draw = 0; draw < options.draws; ++draw) {
    for (const std::string& body : options.bodies) {
      for (const Silicone& silicone : wanted) {
        // The images of one rig: what one image says, and what three say.
        const std::uint64_t seed = random() >> 16U;
        for (const int images : options.images) {
          out.push_back(measure_silicone(silicone, body, images, draw, seed, options, pictures));
          if (options.on_result) options.on_result(out.back());
          stage.step();
        }
      }
    }
  }
  return out;
}

}  // namespace scattermeter::apps
