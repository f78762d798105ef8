// What the roughness of surfaces does to the rows of a channel's shots.
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "core/scene/scene.h"
#include "core/scene/seen_object.h"

namespace scattermeter {

// Light that the surface of a shot's object reflects from the shot's LEDs, by row of the shot's
// map, W/mm^2.
struct RowGloss {
  Eigen::VectorXd l;           // gloss_per_mm2()
  Eigen::VectorXd irradiance;  // on the surface, shadows left out
};
// surface_alpha > 0: taken for that of the object. Far from the mirror directions, in proportion to
// its square.
RowGloss row_gloss(const Scene& scene, const SceneShot& shot, const SeenObject& seen,
                   std::size_t channel, double surface_alpha);

// Whether a row's gloss exceeds a twentieth of the light that a material of medium albedo (l half
// the irradiance) sends to the camera. The scale of the image does not matter.
bool is_glossy(const RowGloss& gloss, std::size_t row);

class RoughSurfaces {
 public:
  // Some rows of a shot's map, in order.
  struct Rows {
    const SceneShot* shot;
    const SeenObject* seen;
    std::vector<std::size_t> rows;
  };

  RoughSurfaces() = default;
  // The scene need not outlive the object.
  RoughSurfaces(const Scene& scene, std::size_t channel, const std::vector<Rows>& rows);

  // By row, l of the gloss; 0 for smooth objects.
  const Eigen::VectorXd& gloss() const { return gloss_; }
  // Change of l by one standard deviation of SceneObject::surface_alpha, common to all objects.
  // l: of light from inside, as the dipole has it; per_log_mismatch: its derivative by the
  // logarithm of the dipole's boundary mismatch A. The light that enters and leaves goes with the
  // boundary's transmittances in the directions of light and camera, and A with that of diffuse
  // light, 1 - F_dr = T / eta^2 by reciprocity. On a cube, three tenths more than paths say (test).
  Eigen::VectorXd change(const Eigen::VectorXd& l, const Eigen::VectorXd& per_log_mismatch) const;

 private:
  Eigen::VectorXd gloss_;
  Eigen::VectorXd relative_, log_mismatch_, gloss_change_;  // by one deviation
};

}  // namespace scattermeter
