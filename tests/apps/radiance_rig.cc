#include "tests/apps/radiance_rig.h"

#include "apps/camera_view.h"
#include "calib/camera_model.h"

namespace scattermeter::apps {

Rig radiance_rig(int scale) {
  Rig rig;
  rig.path = "rig.yaml";
  calib::CameraIntrinsics& k = rig.camera.intrinsics;
  k.width_px = 120 * scale;
  k.height_px = 80 * scale;
  k.fx_px = k.fy_px = 300.0 * scale;
  k.cx_px = 0.5 * (k.width_px - 1);
  k.cy_px = 0.5 * (k.height_px - 1);
  rig.camera.model = "NIKON D80";
  rig.camera.responsivity = {2.4e10, 2.9e10, 2.1e10};
  rig.camera.sensor.noise = {6.0, 1.2};
  rig.camera.f_number = 8;
  rig.truth_pose = RigTruthPose{{0, -100, 150}, {0, 0, 0}};
  const Rigid3d camera_from_world = look_at({0, -100, 150}, {0, 0, 0}, {0, 0, 1});
  const std::vector<Eigen::Vector3d> marks = {{-26, -14, 0}, {26, -14, 0}, {26, 20, 0},
                                              {-26, 20, 0},  {0, -16, 0},  {-28, -8, 12},
                                              {28, -8, 12},  {24, 16, 15}};
  const std::vector<Eigen::Vector2d> px = calib::project(k, camera_from_world, marks);
  for (std::size_t i = 0; i < marks.size(); ++i) rig.pose.points.push_back({marks[i], px[i]});
  RigLight light;
  light.name = "led1";
  light.led.position_mm = {30, -60, 80};
  light.led.axis = Eigen::Vector3d(-30, 60, -80).normalized();
  light.led.intensity_W_per_sr = {0.05, 0.05, 0.05};
  rig.lights.push_back(light);

  RigRadianceCalibration radiance;
  int number = 0;
  const auto shot = [&](const std::string& kind, double exposure_s, double lamp = 1.0) {
    return RadianceShot{kind + std::to_string(++number) + ".dng", exposure_s, lamp, 1};
  };
  for (const double t : {0.02, 0.02, 0.5, 0.5, 2.0, 2.0}) radiance.dark.push_back(shot("dark", t));
  for (const double lamp : {1.0, 0.2}) {
    for (const double stated : {1.0 / 250, 1.0 / 125, 1.0 / 60, 1.0 / 30, 1.0 / 25, 1.0 / 20}) {
      for (int i = 0; i < 2; ++i) radiance.flats.push_back(shot("flat", stated, lamp));
    }
  }
  radiance.flat_radiance_W_per_mm2_sr = {2.9e-6, 2.45e-6, 3.2e-6};  // 3500 counts in 1/20 s
  RigWhite white;
  white.shots = {shot("white", 1.0 / 30), shot("white", 1.0 / 60)};
  white.light = "led1";
  white.plane.origin_mm = {-15, -10, 0};
  white.plane.width_mm = 30;
  white.plane.height_mm = 20;
  white.plane.albedo = {0.95, 0.96, 0.94};
  white.plane.albedo_relative_std = 0.003;
  radiance.white = white;
  RigGlare glare;
  glare.shots = {shot("glare", 1.0 / 20)};
  const auto rectangle = [scale](int x, int y, int width, int height) {
    return PixelRect{scale * x, scale * y, scale * width, scale * height};
  };
  glare.traps_px = {rectangle(4, 4, 24, 60), rectangle(90, 10, 24, 60)};
  glare.bright_px = rectangle(40, 20, 40, 40);
  glare.bright_radiance_W_per_mm2_sr = {2.9e-6, 2.45e-6, 3.2e-6};
  radiance.glare = glare;
  rig.calibration.radiance = radiance;

  RigSensorTruth& truth = rig.truth_sensor;
  truth.vignetting_radial = {std::vector<double>{-0.30, 0.05}, {-0.28, 0.04}, {-0.33, 0.06}};
  truth.veiling_glare = 0.02;
  truth.hot_pixel_share = 1e-3;
  truth.hot_pixel_counts_per_s = 200;
  truth.dark_current_counts_per_s = 3;
  truth.black_drift_counts = 0.05;
  truth.non_linearity = -0.01;
  truth.shutter_in_thirds = true;
  return rig;
}

RadianceResult calibrated(const Rig& rig, const Rig& truth, std::uint64_t seed) {
  const RadianceShots shots(truth, true);
  return calibrate_radiance(rig, [&](const RadianceShot& s) { return shots.frame(s, seed); });
}

// log(light / recorded) of the simulated sensor.
double true_log_ratio(const Rig& rig, double recorded) {
  double light = recorded;
  for (int i = 0; i < 60; ++i) {
    light = recorded / (1.0 + rig.truth_sensor.non_linearity * light / (4095.0 - 64.0));
  }
  return std::log(light / recorded);
}

}  // namespace scattermeter::apps
