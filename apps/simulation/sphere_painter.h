// Mirror spheres lit by an LED, painted into a frame.
#pragma once

#include <vector>

#include "apps/simulation/radiance_canvas.h"
#include "calib/led/mirror_sphere.h"
#include "core/light/led.h"
#include "core/view/camera_view.h"

namespace scattermeter::apps {

// Mirrors reflect this share; below the mirror lies a weak diffuse base.
inline constexpr double kMirrorReflectance = 0.9;
inline constexpr double kMirrorBaseAlbedo = 0.02;
// Radius of the emitting disc of an LED whose radius_mm is 0: the image of a point has no size.
inline constexpr double kChipRadius_mm = 0.5;

// Paints the diffuse base of the spheres and adds the LED's disc as each sphere mirrors it, blurred
// by the lens to a standard deviation of 0.7 px. Spheres hide the LED and each other from the
// camera and from the light; light that two spheres reflect is left out.
void paint_spheres(const std::vector<calib::MirrorSphere>& spheres, const Led& led,
                   const CameraView& view, RadianceCanvas& canvas);

}  // namespace scattermeter::apps
