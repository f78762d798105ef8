#include "tests/calib/led_scenes.h"

#include <numbers>
#include <random>

#include <Eigen/Geometry>

#include "calib/led_start.h"

namespace scattermeter::calib {

Led true_led() {
  Led led;
  led.position_mm = {30, -60, 80};
  led.axis = Eigen::Vector3d(-25, 55, -80).normalized();
  led.exponent = 1.3;
  led.intensity_W_per_sr = {0.05, 0.06, 0.04};
  return led;
}

CameraIntrinsics led_camera() {
  CameraIntrinsics k;
  k.width_px = 968;
  k.height_px = 648;
  k.fx_px = k.fy_px = 2459.0;
  k.cx_px = 483.6;
  k.cy_px = 322.4;
  k.distortion = {-0.08, 0.05, 0.0005, -0.0003};
  return k;
}

Rigid3d led_camera_pose() {
  const Eigen::Vector3d eye(0, -100, 150);
  const Eigen::Vector3d z = -eye.normalized();
  const Eigen::Vector3d x = z.cross(Eigen::Vector3d::UnitZ()).normalized();
  Eigen::Matrix3d m;
  m << x.transpose(), z.cross(x).transpose(), z.transpose();
  Rigid3d pose;
  pose.rotation = Eigen::Quaterniond(m).normalized();
  pose.translation_mm = -(pose.rotation * eye);
  return pose;
}

LedScene draw_led_scene(const Led& truth, const LedSceneOptions& o, std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> normal;
  const auto draw3 = [&](double std) {
    const double x = normal(generator), y = normal(generator), z = normal(generator);
    return Eigen::Vector3d(std * Eigen::Vector3d(x, y, z));
  };
  LedScene scene;
  scene.intrinsics = led_camera();
  const Lens lens(scene.intrinsics);
  const Rigid3d true_pose = led_camera_pose();
  // true rotation = exp([w]) believed rotation, true translation = believed + dt.
  const Eigen::Vector3d w = draw3(o.rotation_std_rad);
  LedView view;
  view.camera_from_world.rotation = true_pose.rotation;
  if (w.norm() > 0.0) {
    view.camera_from_world.rotation =
        (Eigen::Quaterniond(Eigen::AngleAxisd(-w.norm(), w.normalized())) * true_pose.rotation)
            .normalized();
  }
  view.camera_from_world.translation_mm = true_pose.translation_mm - draw3(o.translation_std_mm);
  view.pose_covariance.diagonal().head<3>().setConstant(o.rotation_std_rad * o.rotation_std_rad);
  view.pose_covariance.diagonal().tail<3>().setConstant(o.translation_std_mm *
                                                        o.translation_std_mm);
  scene.views = {view};
  if (o.spheres) {
    for (const Eigen::Vector3d& c :
         {Eigen::Vector3d(-24, -12, 8), Eigen::Vector3d(24, -14, 8), Eigen::Vector3d(-22, 16, 10),
          Eigen::Vector3d(23, 15, 8), Eigen::Vector3d(0, 2, 8)}) {
      MirrorSphere sphere{c, 8.0, o.center_std_mm, 0.0};
      scene.spheres.push_back(sphere);
      sphere.center_mm += draw3(o.center_std_mm);
      SeenHighlight h;
      h.sphere = scene.spheres.size() - 1;
      h.image_px =
          highlight_px(lens, true_pose, sphere, truth) + draw3(o.highlight_std_px).head<2>();
      h.std_px = std::max(1e-6, o.highlight_std_px);
      scene.highlights.push_back(h);
    }
  }
  const double whiter = 1.0 + o.albedo_std * normal(generator);
  const Eigen::Vector3d eye = inverse(true_pose).translation_mm;
  constexpr int kColumns = 12, kRows = 9, kSub = 5;
  for (int p = 0; p < o.planes; ++p) {
    WhitePlane plane;
    plane.width_mm = 60 * o.plane_size;
    plane.height_mm = 45 * o.plane_size;
    plane.origin_mm = {-0.5 * plane.width_mm, -0.5 * plane.height_mm, o.plane_z_mm + 15.0 * p};
    plane.albedo = {0.9, 0.92, 0.88};
    plane.albedo_relative_std = o.albedo_std;
    scene.planes.push_back(plane);
    for (int i = 0; i < kColumns * kRows; ++i) {
      const double dx = plane.width_mm / kColumns;
      const double dy = plane.height_mm / kRows;
      ShadedCell cell;
      cell.plane = cell.shot = static_cast<std::size_t>(p);
      cell.column = i % kColumns;
      cell.row = i / kColumns;
      cell.place_mm = {(cell.column + 0.5) * dx, (cell.row + 0.5) * dy};
      const double shrink = 1.0 - 1.0 / (kSub * kSub);  // of 5 points against an interval
      cell.spread_mm2 = Eigen::Vector2d(dx * dx / 12.0, dy * dy / 12.0).asDiagonal() * shrink;
      double sum = 0.0;
      for (int k = 0; k < kSub * kSub; ++k) {
        const Eigen::Vector2d at =
            cell.place_mm + Eigen::Vector2d(((k % kSub + 0.5) / kSub - 0.5) * dx,
                                            ((k / kSub + 0.5) / kSub - 0.5) * dy);
        // The camera believes that the sample is at `at`; it stands elsewhere and sees another.
        const Eigen::Vector3d believed =
            plane.origin_mm + at.x() * plane.x_axis + at.y() * plane.y_axis;
        const Eigen::Vector3d ray = view.camera_from_world * believed;
        const auto seen = plane.meet_mm(eye, true_pose.rotation.conjugate() * ray);
        const Eigen::Vector3d point =
            plane.origin_mm + seen->x() * plane.x_axis + seen->y() * plane.y_axis;
        sum += truth.transmitted_irradiance_per_mm2(point, plane.normal(), 1.0) / (kSub * kSub);
      }
      for (int c = 0; c < 3; ++c) {
        cell.channel = c;
        const double radiance =
            whiter * plane.albedo[c] / std::numbers::pi *
            (truth.intensity_W_per_sr[c] * sum + o.ambient_irradiance_W_per_mm2[c]);
        cell.radiance_W_per_mm2_sr = radiance * (1.0 + o.cell_relative_std * normal(generator));
        cell.std_W_per_mm2_sr = std::max(1e-7, o.cell_relative_std) * radiance;
        scene.cells.push_back(cell);
      }
    }
  }
  return scene;
}

}  // namespace scattermeter::calib
