#include "apps/simulation/shot_renderer.h"

#include <algorithm>
#include <numbers>

#include <oneapi/tbb/parallel_for.h>

#include "apps/simulation/board_picture.h"
#include "calib/pose/shot_pose.h"
#include "core/base/input_error.h"
#include "core/light/gloss.h"
#include "core/light/plane_light.h"
#include "core/material/fresnel.h"
#include "core/scene/surroundings.h"
#include "core/transport/volume_light.h"

namespace scattermeter::apps {
namespace {

const std::array<Medium, 3>& truth_of(const Rig& rig, const SceneShot& shot) {
  const auto it = rig.truth.materials.find(shot.material);
  if (it == rig.truth.materials.end()) {
    throw InputError(rig.at(shot.line) + ": truth.materials." + shot.material,
                     "is missing: simulate needs the truth of every material in the shots");
  }
  return it->second;
}

}  // namespace

CameraView true_view(const Rig& rig) {
  if (rig.truth.pose) {
    const CameraPlacement& t = *rig.truth.pose;
    return {rig.scene.camera.intrinsics, look_at(t.position_mm, t.look_at_mm, t.up)};
  }
  if (rig.pose.charuco) {
    throw InputError(
        rig.at(rig.pose.line) + ": truth.pose",
        "is missing: a rig whose pose comes from a board in the shots cannot be simulated "
        "without it");
  }
  return {rig.scene.camera.intrinsics,
          calib::pose_from_points(rig.scene, rig.pose).camera_from_world};
}

// At the nodes, with the mean normals of the patches around them.
void ShotRenderer::add_gloss(const SceneLight& light, const ObjectScene& object,
                             const PatchMesh& patches, const SurfaceField& field,
                             std::vector<Eigen::Array3d>& values) const {
  std::vector<Eigen::Vector3d> normals(values.size(), Eigen::Vector3d::Zero());
  for (int k = 0; k < patches.size(); ++k) {
    for (const int node : field.nodes_of(k)) {
      if (node >= 0) normals[static_cast<std::size_t>(node)] += patches.normal(k);
    }
  }
  const RoughBoundary boundary(object.stated->surface_alpha, object.stated->eta_int_over_ext);
  tbb::parallel_for(std::size_t{0}, values.size(), [&](std::size_t i) {
    if (normals[i].isZero(0.0)) return;
    values[i] += light->power() * gloss_per_mm2(boundary, *object.rays, light.led()->led,
                                                field.nodes_mm()[i], normals[i].normalized(),
                                                view_.center_in_world_mm());
  });
}

ShotRenderer::ShotRenderer(const Rig& rig, const ObjectScenes& objects,
                           const RenderTransport& transport)
    : rig_(rig), objects_(objects), transport_(transport), view_(true_view(rig)) {
  for (const SceneShot& shot : rig.scene.shots) {
    truth_of(rig, shot);
    const SceneObject& object = rig.scene.object(shot.object);
    if (object.surface_alpha > 0.0 && !transport.volume) {
      throw InputError(rig.at(object.line) + ": objects." + object.name + ".roughness",
                       "the dipole shows smooth surfaces only: use simulate --transport volume, "
                       "or render --model transport");
    }
    for (const std::string& name : shot.lights) rig.scene.light(name)->open();
  }
}

ShotRenderer::Stage& ShotRenderer::stage(const std::string& object) {
  auto [it, is_new] = stages_.try_emplace(object);
  if (is_new) {
    const ObjectScene& scene = objects_.at(object);
    require_in_view(rig_.scene, objects_, view_, object);
    double patch_mm = scene.size_mm();
    const auto patch_size_mm = [&](const std::array<Medium, 3>& media, double size_mm) {
      if (!transport_.volume) return render_patch_size_mm(media, size_mm);
      double shortest_mm = size_mm;
      for (const Medium& m : media) {
        shortest_mm = std::min(shortest_mm, 1.0 / m.sigma_t_prime_per_mm());
      }
      return volume_patch_size_mm(shortest_mm, size_mm);
    };
    for (const SceneShot& shot : rig_.scene.shots) {
      if (shot.object == object) {
        patch_mm = std::min(patch_mm, patch_size_mm(truth_of(rig_, shot), scene.size_mm()));
      }
    }
    Stage& s = it->second;
    s.patches = std::make_unique<PatchMesh>(scene.mesh(), patch_mm);
    s.pixels = std::make_unique<ShadeMap>(rays_around(view_, scene.mesh(), 2), *scene.rays,
                                          *s.patches, scene.stated->eta_int_over_ext);
    s.needed = s.pixels->needed_patches(s.patches->size());
  }
  return it->second;
}

std::vector<IncidentLight> ShotRenderer::light_on(const Light& light, const ObjectScene& object,
                                                  const PatchMesh& patches) const {
  std::optional<PatchMesh> coarse;
  return light.illuminate(patches_for(light, LightUse::kRender, object, patches, coarse),
                          *object.rays, object.stated->eta_int_over_ext, LightUse::kRender);
}

SurfaceField ShotRenderer::field(const SceneShot& shot, Stage& s) const {
  const ObjectScene& scene = objects_.at(shot.object);
  std::array<Medium, 3> media = truth_of(rig_, shot);
  for (Medium& m : media) m.eta_int_over_ext = scene.stated->eta_int_over_ext;
  SurfaceField field(*s.patches, s.needed);
  const auto add = [&](const Light& light, const std::string& name) {
    const auto [it, is_new] = s.lights.try_emplace(name);
    if (is_new) it->second = light_on(light, scene, *s.patches);
    for (std::size_t c = 0; c < it->second.size(); ++c) {
      Eigen::Array3d power = light.power();
      if (light.channels() > 1) {
        power.setZero();
        power[static_cast<Eigen::Index>(c)] = light.power()[static_cast<Eigen::Index>(c)];
      }
      if (it->second[c].lit.empty()) continue;
      field.add(dipole_radiosity(field.nodes_mm(), it->second[c], scene.box.center_mm(),
                                 1.001 * scene.diagonal_mm(), media, power));
    }
  };
  const auto& plane = rig_.scene.surroundings.plane;
  for (const std::string& name : shot.lights) {
    const SceneLight& light = rig_.scene.light(name);
    add(*light, name);
    if (light.led() == nullptr || !plane || !(plane->albedo > 0.0).any()) continue;
    add(PlaneLight(light.led()->led, plane->z_mm, plane->albedo, plane->albedo_std),
        name + " by way of the plane");
  }
  return field;
}

SurfaceField ShotRenderer::volume_field(const SceneShot& shot, Stage& s) {
  const ObjectScene& scene = objects_.at(shot.object);
  const double eta = scene.stated->eta_int_over_ext;
  const double alpha = scene.stated->surface_alpha;
  if (!s.boundary) s.boundary = std::make_unique<PathBoundary>(*scene.rays);
  if (!s.camera) {
    s.camera.emplace(*s.boundary, view_.center_in_world_mm(),
                     ScatteringMedium{1.0, 0.0, 0.0, eta, alpha});
  }
  SurfaceField field(*s.patches, s.needed, smooth_parts(scene.mesh()));
  for (const std::string& name : shot.lights) {
    const SceneLight& light = rig_.scene.light(name);
    std::vector<Eigen::Array3d> values(field.nodes_mm().size(), Eigen::Array3d::Zero());
    for (int c = 0; c < 3; ++c) {
      if (!(light->power()[c] > 0.0)) continue;
      Medium reduced = truth_of(rig_, shot)[static_cast<std::size_t>(c)];
      reduced.eta_int_over_ext = eta;
      const ScatteringMedium medium = scattering_medium(reduced, scene.stated->phase, alpha);
      std::optional<DiffusePlane> plane;
      if (const auto& stated = rig_.scene.surroundings.plane) {
        plane = stated->in(static_cast<std::size_t>(c));
      }
      const auto source =
          entry_above(light, *scene.rays, eta, c, plane.value_or(DiffusePlane{}), alpha);
      const CameraConnection camera = s.camera->with(medium, plane);
      const VolumeLight l = volume_radiosity(
          field, *s.patches, {*s.boundary, medium, *source, &camera, plane},
          {transport_.seed * 1'000'003ULL + runs_++, transport_.paths, transport_.peers});
      monte_carlo_std_ = std::max(monte_carlo_std_, l.median_relative_std);
      for (std::size_t i = 0; i < values.size(); ++i) {
        values[i][c] = light->power()[c] * l.l_at_nodes[i];
      }
    }
    if (alpha > 0.0 && light.led() != nullptr) add_gloss(light, scene, *s.patches, field, values);
    field.add(values);
  }
  return field;
}

SurfaceField ShotRenderer::light_from(const SceneShot& shot, Stage& s) {
  return transport_.volume ? volume_field(shot, s) : field(shot, s);
}

ColourRadiance ShotRenderer::render_colour(const SceneShot& shot) {
  Stage& s = stage(shot.object);
  const SurfaceField light = light_from(shot, s);
  const ShadeMap& pixels = *s.pixels;
  ColourRadiance out{pixels.x0(), pixels.y0(), pixels.width(), pixels.height(), {}};
  const auto row = 3U * static_cast<std::size_t>(out.width);
  out.rgb.resize(row * static_cast<std::size_t>(out.height));
  tbb::parallel_for(0, out.height, [&](int y) {
    for (int x = 0; x < out.width; ++x) {
      for (int c = 0; c < 3; ++c) {
        out.rgb[static_cast<std::size_t>(y) * row + static_cast<std::size_t>(3 * x + c)] =
            static_cast<float>(pixels.radiance(x, y, light, c));
      }
    }
  });
  return out;
}

RadiancePicture ShotRenderer::render(const SceneShot& shot) {
  Stage& s = stage(shot.object);
  const SurfaceField light = light_from(shot, s);
  const double eta = objects_.at(shot.object).stated->eta_int_over_ext;
  const ShadeMap& pixels = *s.pixels;
  RadiancePicture out;
  out.brightest = light.max() * fresnel_transmittance(eta, 1.0) / std::numbers::pi;
  if (rig_.pose.charuco) {
    out.width = rig_.scene.camera.intrinsics.width_px;
    out.height = rig_.scene.camera.intrinsics.height_px;
  } else {
    out.x0 = pixels.x0();
    out.y0 = pixels.y0();
    out.width = pixels.width();
    out.height = pixels.height();
  }
  out.radiance.assign(static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height),
                      0.0F);
  tbb::parallel_for(0, pixels.height(), [&](int y) {
    for (int x = 0; x < pixels.width(); ++x) {
      const int xx = pixels.x0() + x;
      const int yy = pixels.y0() + y;
      out.radiance[static_cast<std::size_t>(yy - out.y0) * static_cast<std::size_t>(out.width) +
                   static_cast<std::size_t>(xx - out.x0)] =
          static_cast<float>(pixels.radiance(x, y, light, channel(xx, yy)));
    }
  });
  if (rig_.pose.charuco) {
    std::vector<Led> leds;
    const Eigen::Vector3d normal =
        rig_.pose.charuco->world_from_board.rotation * Eigen::Vector3d::UnitZ();
    Eigen::Array3d ambient = Eigen::Array3d::Zero();
    for (const std::string& name : shot.lights) {
      const SceneLight& lamp = rig_.scene.light(name);
      ambient += lamp->open_irradiance_W_per_mm2(normal);
      if (lamp.led() != nullptr) leds.push_back(lamp.led()->led);
    }
    add_board(view_, *rig_.pose.charuco, leds, ambient, *objects_.at(shot.object).rays,
              rig_.scene.camera.sensor.cfa, out.radiance);
  }
  return out;
}

}  // namespace scattermeter::apps
