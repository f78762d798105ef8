#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/core.h>
#include <gtest/gtest.h>

#include "apps/instrument/open_shots.h"
#include "apps/simulation/bodies_rig.h"
#include "calib/pose/shot_pose.h"
#include "core/base/covariance_root.h"
#include "core/base/tangents.h"
#include "core/camera/lens.h"
#include "core/camera/lens_parameters.h"
#include "core/camera/pose_shift.h"
#include "core/light/incident_light.h"
#include "core/material/fresnel.h"
#include "core/nuisances/nuisances.h"
#include "tests/fixtures/apps/calibrated_nuisances.h"

namespace scattermeter::apps {
namespace {

// A lens of f, centre, k1 and k2, known to these deviations.
LensRoot lens_known_to(const Eigen::VectorXd& std) {
  return lens_root(parameter_names({true, DistortionTerms::kK1K2}),
                   std.cwiseAbs2().asDiagonal().toDenseMatrix());
}

const LitMedium kMedium{{1.0, 0.003, 1.3}, 1.0};

DistanceKnots knots_of(const LitObjects& library) {
  return {library.smallest_patch_mm() / 16.0, library.longest_distance_mm()};
}

// Of kMedium.
LightSensitivity sensitivity_of(const SeenObject& seen, const SceneLight& light,
                                LitObjects& library) {
  const DistanceKnots knots = knots_of(library);
  const WeightMatrix weights =
      smooth_weights(seen.sites,
                     SourceCloud(library.light(seen.object->stated->name, light.name, 0),
                                 seen.object->box.center_mm()),
                     knots, pair_options(knots));
  return sensitivity(seen, weights, changed_images(seen, light, 0, library, knots, {kMedium}),
                     {kMedium}, knots);
}

// One column of the nuisances against what the rig's own functions give for another lens: the pose
// fitted anew through it, the ray of the same pixel, where that meets the facet.
TEST_F(CalibratedNuisances, LensColumnsByDifferences) {
  const capture::FrameSource frames = [&](std::size_t i, std::size_t k) {
    return shots_.frame(i, 1, k);
  };
  for (int parameter = 0; parameter < 5; ++parameter) {
    Rig rig = exact_;
    Eigen::VectorXd std = Eigen::VectorXd::Zero(5);
    std[parameter] = parameter == 0  ? 1e-3 * rig.scene.camera.intrinsics.fx_px
                     : parameter < 3 ? 0.5
                                     : 0.02;
    rig.scene.camera.lens_root = lens_known_to(std);
    const PoseResult pose = calib::pose_from_points(rig.scene, rig.pose);
    LitObjects library(rig.scene, scenes_, std::nullopt, 0.0);
    const SharedView view = see_all(rig.scene, scenes_, library, pose);
    const std::vector<ObservedShot> opened = open_shots(
        rig, capture::shots_from(rig.scene, {0}, frames), scenes_, library, view, nullptr);
    const SeenObject& seen = *opened[0].seen;
    const SceneLight& light = rig.scene.light(opened[0].stated->lights.at(0));
    const LightSensitivity by_shift = sensitivity_of(seen, light, library);
    const ChannelObservation& o = opened[0].observation.channel[1];
    std::vector<Eigen::Index> used;
    for (std::size_t j = 0; j < o.l.size(); ++j) {
      if (o.state[j] == RowState::kUsed) used.push_back(static_cast<Eigen::Index>(j));
    }
    const std::vector<NuisanceColumn> columns =
        SceneNuisances(rig.scene, 1, {{{&seen, light.name, 0}, {&by_shift, 0}}})
            .columns(opened[0], o, used);
    const NuisanceColumn* column = nullptr;
    for (const NuisanceColumn& c : columns) {
      if (c.nuisance.group != "lens" || c.change.isZero(0.0)) continue;
      ASSERT_EQ(column, nullptr) << "one parameter, one column";
      column = &c;
    }
    ASSERT_NE(column, nullptr);

    const auto seen_through = [&](double by) {
      Rig other = exact_;
      LensParameters lens = lens_parameters(exact_.scene.camera.intrinsics);
      lens += parameter_map({true, DistortionTerms::kK1K2}) * (by * std);
      other.scene.camera.intrinsics = intrinsics_of(lens, exact_.scene.camera.intrinsics.width_px,
                                                    exact_.scene.camera.intrinsics.height_px);
      return CameraView{other.scene.camera.intrinsics,
                        calib::pose_from_points(other.scene, other.pose).camera_from_world};
    };
    constexpr double kStep = 0.02;
    const CameraView up = seen_through(kStep), down = seen_through(-kStep);
    Eigen::Index row = 0;
    double worst = 0.0, largest = 0.0;
    for (std::size_t j = 0; j < o.l.size(); ++j) {
      if (o.state[j] != RowState::kUsed) continue;
      const Eigen::Vector3d& normal = seen.patches->normal(seen.map.patch_of_row[j]);
      const Eigen::Vector3d& site_mm = seen.sites[j].center_mm;
      const Eigen::Vector2d pixel =
          project(rig.scene.camera.intrinsics, pose.camera_from_world, {site_mm})[0];
      const auto meets = [&](const CameraView& camera) {
        const Eigen::Vector3d origin = camera.center_in_world_mm();
        const Eigen::Vector3d direction = camera.camera_from_world.rotation.conjugate() *
                                          Lens(camera.intrinsics).unproject(pixel).homogeneous();
        return (origin + normal.dot(site_mm - origin) / normal.dot(direction) * direction).eval();
      };
      const Eigen::Vector3d moved_mm = (meets(up) - meets(down)) / (2.0 * kStep);
      // The observed l = pi L / Ft falls as Ft grows.
      const auto log_ft = [&](const CameraView& camera) {
        const Eigen::Vector3d to_camera =
            (camera.center_in_world_mm() - meets(camera)).normalized();
        return std::log(
            fresnel_transmittance(seen.object->stated->eta_int_over_ext, normal.dot(to_camera)));
      };
      double expected = light->power()[1] * by_shift.l(static_cast<Eigen::Index>(j), 0) *
                        (log_ft(up) - log_ft(down)) / (2.0 * kStep);
      for (std::size_t t = 0; t < 2; ++t) {
        expected += light->power()[1] *
                    by_shift.per_tangent_mm[t](static_cast<Eigen::Index>(j), 0) *
                    tangents(normal)[t].dot(moved_mm);
      }
      worst = std::max(worst, std::abs(column->change[row] - expected));
      largest = std::max(largest, std::abs(expected));
      ++row;
    }
    ASSERT_GT(largest, 0.0);
    EXPECT_LT(worst, 1e-3 * largest) << "parameter " << parameter;
  }
}

// The light by a shift of the view is that of the pose's columns, the other way.
TEST_F(CalibratedNuisances, LightByAShiftedView) {
  PoseResult pose = calib::pose_from_points(exact_.scene, exact_.pose);
  LitObjects library(exact_.scene, scenes_, std::nullopt, 180.0);
  PoseShift shift;
  shift << 2e-4, -1e-4, 3e-4, 0.02, 0.03, -0.1;
  // Columns "pose0" to "pose5" in units of the shift's own parts.
  pose.covariance = shift.cwiseAbs2().asDiagonal();
  const std::string name = exact_.scene.shots[0].object;
  const SharedView view = see_all(exact_.scene, scenes_, library, pose, {{name, shift}});
  const capture::FrameSource frames = [&](std::size_t i, std::size_t k) {
    return shots_.frame(i, 1, k);
  };
  const std::vector<ObservedShot> opened = open_shots(
      exact_, capture::shots_from(exact_.scene, {0}, frames), scenes_, library, view, nullptr);
  const SeenObject& seen = *opened[0].seen;
  EXPECT_EQ(seen.shift, shift);
  const SceneLight& light = exact_.scene.light(opened[0].stated->lights.at(0));
  const LightSensitivity s = sensitivity_of(seen, light, library);
  const SceneNuisances nuisances(exact_.scene, 1, {{{&seen, light.name, 0}, {&s, 0}}});
  const std::vector<Eigen::Index> rows = {0, 3, 7, 20};
  // A root of a diagonal covariance has the signs and the order of its own choice.
  const Eigen::Matrix<double, 6, 1> signs =
      (covariance_root(pose.covariance).transpose() * shift)
          .cwiseQuotient(covariance_root(pose.covariance).colwise().squaredNorm().transpose());
  Eigen::VectorXd expected = Eigen::VectorXd::Zero(4);
  for (const NuisanceColumn& c :
       nuisances.columns(opened[0], opened[0].observation.channel[1], rows)) {
    if (c.nuisance.group == "pose") expected -= signs[c.nuisance.name.back() - '0'] * c.change;
  }
  const Eigen::VectorXd found = nuisances.light_by_shift(opened[0], rows);
  EXPECT_GT(expected.norm(), 0.0);
  EXPECT_LT((found - expected).norm(), 1e-9 * expected.norm());
}

// A sphere displaced by some hundredths of a millimetre shows another place in each sample, and
// shows it at another angle: against the intersections of the samples' rays with a true sphere.
TEST(PlaceNuisances, PositionColumnsOfASphere) {
  constexpr double kEta = 1.49, kRadius_mm = 10.0, kStep_mm = 0.02;
  const Medium& medium = kMedium.medium;
  Rig rig = bodies_rig(240, kEta, {{"PE", {medium, medium, medium}}}, {"sphere"});
  rig.scene.shots.resize(1);
  rig.scene.objects.front().position_std_mm = 0.1;
  const ObjectScenes scenes = bodies_scenes(rig);
  const VirtualShots shots(rig, scenes, {.noise = false});
  const PoseResult pose = calib::pose_from_points(rig.scene, rig.pose);
  LitObjects library(rig.scene, scenes, std::nullopt, 180.0);
  const SharedView view = see_all(rig.scene, scenes, library, pose);
  const capture::FrameSource frames = [&](std::size_t i, std::size_t k) {
    return shots.frame(i, 1, k);
  };
  const std::vector<ObservedShot> opened =
      open_shots(rig, capture::shots_from(rig.scene, {0}, frames), scenes, library, view, nullptr);
  const SeenObject& seen = *opened[0].seen;
  const SceneLight& light = rig.scene.light(opened[0].stated->lights.at(0));
  const LightSensitivity s = sensitivity_of(seen, light, library);
  // Away from the limb, where the mesh's facets are a few of their slants off.
  constexpr double kLeastCos = 0.3;
  const Eigen::Vector3d center_mm = seen.object->box.center_mm();
  const Eigen::Vector3d eye_mm = seen.camera_center_mm;
  std::vector<Eigen::Index> rows;
  for (std::size_t j = 0; j < seen.sites.size(); ++j) {
    const Eigen::Vector3d normal = (seen.sites[j].center_mm - center_mm).normalized();
    if (normal.dot((eye_mm - seen.sites[j].center_mm).normalized()) > kLeastCos) {
      rows.push_back(static_cast<Eigen::Index>(j));
    }
  }
  const auto columns = SceneNuisances(rig.scene, 1, {{{&seen, light.name, 0}, {&s, 0}}})
                           .columns(opened[0], opened[0].observation.channel[1], rows);
  // Turns leave it in its place.
  EXPECT_EQ(std::count_if(columns.begin(), columns.end(),
                          [](const auto& c) { return c.nuisance.group == "mesh position"; }),
            3);
  for (int axis = 0; axis < 3; ++axis) {
    const auto column = std::find_if(columns.begin(), columns.end(), [&](const auto& c) {
      return c.nuisance.name == fmt::format("sphere.position{}", axis);
    });
    ASSERT_NE(column, columns.end());
    // The point of the sphere about the origin, and the direction to the camera.
    const auto seen_at = [&](const Eigen::Vector3d& site_mm, double by_mm) {
      const Eigen::Vector3d moved_mm = center_mm + by_mm * Eigen::Vector3d::Unit(axis);
      const Eigen::Vector3d along = (site_mm - eye_mm).normalized();
      const Eigen::Vector3d from = eye_mm - moved_mm;
      const double b = along.dot(from);
      const double root = b * b - from.squaredNorm() + kRadius_mm * kRadius_mm;
      return std::pair((from - (b + std::sqrt(root)) * along).eval(), (-along).eval());
    };
    Eigen::VectorXd expected(column->change.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const auto j = static_cast<std::size_t>(rows[i]);
      const auto [up_mm, to_up] = seen_at(seen.sites[j].center_mm, kStep_mm);
      const auto [down_mm, to_down] = seen_at(seen.sites[j].center_mm, -kStep_mm);
      const auto log_ft = [&](const Eigen::Vector3d& point_mm, const Eigen::Vector3d& to) {
        return std::log(fresnel_transmittance(kEta, point_mm.normalized().dot(to)));
      };
      double& change = expected[static_cast<Eigen::Index>(i)];
      change = s.l(rows[i], 0) * (log_ft(up_mm, to_up) - log_ft(down_mm, to_down));
      for (std::size_t t = 0; t < 2; ++t) {
        change += s.per_tangent_mm[t](rows[i], 0) *
                  tangents(seen.patches->normal(seen.map.patch_of_row[j]))[t].dot(up_mm - down_mm);
      }
      change *= light->power()[1] / (2.0 * kStep_mm);
    }
    EXPECT_LT((column->change - expected).norm(), 0.05 * expected.norm()) << axis;
  }
}

// A larger piece is nearer to camera and LED, and catches no more power.
TEST_F(CalibratedNuisances, SizeColumnOfMovedLightAndCamera) {
  Rig rig = exact_;
  for (SceneLight& light : rig.scene.lights) light.led()->position_std_mm = 0.3;
  rig.scene.objects.front().position_std_mm = 0.1;
  rig.scene.objects.front().scale_relative_std = 0.002;
  const ObjectScenes scenes = bodies_scenes(rig);
  const PoseResult pose = calib::pose_from_points(rig.scene, rig.pose);
  LitObjects library(rig.scene, scenes, std::nullopt, 180.0);
  const std::string name = rig.scene.shots[0].object;
  const SharedView view = see_all(rig.scene, scenes, library, pose);
  const capture::FrameSource frames = [&](std::size_t i, std::size_t k) {
    return shots_.frame(i, 1, k);
  };
  const std::vector<ObservedShot> opened =
      open_shots(rig, capture::shots_from(rig.scene, {0}, frames), scenes, library, view, nullptr);
  const SeenObject& seen = *opened[0].seen;
  const SceneLight& light = rig.scene.light(opened[0].stated->lights.at(0));
  const DistanceKnots knots = knots_of(library);
  const auto image = [&](const Led& led, double size) -> Eigen::VectorXd {
    std::vector<ExitSite> sites;
    const Eigen::Vector3d center = seen.object->box.center_mm();
    for (std::size_t j = 0; j < seen.sites.size(); ++j) {
      const Eigen::Vector3d& normal = seen.patches->normal(seen.map.patch_of_row[j]);
      const Eigen::Vector3d by =
          surface_shift_by_pose(pose.camera_from_world, seen.sites[j].center_mm, normal) *
          ((size - 1.0) * pose_shift_by_size(pose.camera_from_world, center));
      sites.push_back(moved(seen.sites[j], by));
    }
    const IncidentLight lit =
        illuminate(*seen.patches, *seen.object->rays, led, seen.object->stated->eta_int_over_ext);
    return smooth_weights(sites, SourceCloud(lit, center), knots, pair_options(knots)) *
           scaled_curves({kMedium}, knots, seen.object->stated->eta_int_over_ext);
  };
  constexpr double kStep = 0.005;
  const auto grown = [&](double size) -> Eigen::VectorXd {
    const Eigen::Vector3d center = seen.object->box.center_mm();
    Led led = light.led()->led;
    led.position_mm = center + (led.position_mm - center) / size;
    return image(led, size) / (size * size);
  };
  const LightSensitivity s = sensitivity_of(seen, light, library);
  std::vector<Eigen::Index> rows;
  for (std::size_t j = 0; j < seen.sites.size(); ++j) rows.push_back(static_cast<Eigen::Index>(j));
  const Eigen::VectorXd expected =
      light->power()[1] * (grown(1.0 + kStep) - grown(1.0 - kStep)) / (2.0 * kStep);
  bool found = false;
  for (const NuisanceColumn& c : SceneNuisances(rig.scene, 1, {{{&seen, light.name, 0}, {&s, 0}}})
                                     .columns(opened[0], opened[0].observation.channel[1], rows)) {
    if (c.nuisance.group != "mesh scale") continue;
    found = true;
    EXPECT_EQ(c.nuisance.name, name + ".size");
    EXPECT_EQ(c.nuisance.std, 0.002);
    EXPECT_LT((c.change - expected).norm(), 0.1 * expected.norm());
  }
  EXPECT_TRUE(found);
}

TEST_F(CalibratedNuisances, LensIsInTheBudget) {
  const Estimate exact = measured(exact_);
  Rig open = exact_, zero = exact_;
  Eigen::VectorXd std(5);
  std << 5e-3 * exact_.scene.camera.intrinsics.fx_px, 2.0, 2.0, 0.05, 0.0;
  open.scene.camera.lens_root = lens_known_to(std);
  zero.scene.camera.lens_root = lens_known_to(Eigen::VectorXd::Zero(5));
  const Estimate with_lens = measured(open);
  ASSERT_TRUE(exact.converged && with_lens.converged);
  EXPECT_EQ(part(exact, "lens"), 0.0);
  EXPECT_GT(part(with_lens, "lens"), 0.0);
  EXPECT_GT(with_lens.sigma_s_prime_per_mm.std, exact.sigma_s_prime_per_mm.std);
  // A covariance of zero is no lens error at all, to the last digit.
  const Estimate same = measured(zero);
  EXPECT_EQ(same.sigma_s_prime_per_mm.value, exact.sigma_s_prime_per_mm.value);
  EXPECT_EQ(same.sigma_s_prime_per_mm.std, exact.sigma_s_prime_per_mm.std);
  EXPECT_EQ(same.budget.size(), exact.budget.size());
}

}  // namespace
}  // namespace scattermeter::apps
