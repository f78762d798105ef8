// Standard deviations of what a rig does not state: those of a careful user's rig.
#pragma once

#include "core/scene/scene.h"

namespace scattermeter::default_uncertainty {

// Handbook values of one plastic differ by 0.01 to 0.02 between grades and wavelengths, those of
// food and tissue by more, and one plastic taken for another by 0.1; by transport, the image hardly
// tells eta from sigma_s'.
inline constexpr double kEta = 0.04;
// Of gamma, about isotropic scattering: as large as the root mean square of g, for any g from 0 to
// 0.95 by the function of Henyey and Greenstein.
inline constexpr double kGamma = 0.55;
// Of a g from the literature, for another sample of the material.
inline constexpr double kStatedGamma = 0.1;
// An object put down at marks, or a mesh aligned by hand, mm.
inline constexpr double kObjectPosition_mm = 0.1;
// A machined or printed piece of 20 mm, measured to 0.04 mm.
inline constexpr double kMeshScale = 0.002;
// Machined edges are broken by some 0.1 mm, moulded and printed ones rounded by as much.
inline constexpr double kEdge_mm = 0.1;
// Moulded and polished faces mirror a lamp as a blot with a faint halo: alpha of a face whose
// roughness is not stated.
inline constexpr double kSurfaceAlpha = 0.03;
// A position taken with a ruler, mm, and a direction by eye, degrees.
inline constexpr double kLedPosition_mm = 0.3;
inline constexpr double kLedAxis_deg = 1.0;
// LEDs of one type, by their data sheets.
inline constexpr double kLedExponent = 0.05;
inline constexpr double kLedIntensity = 0.01;
// Irradiance by the walls of a dark room or a lamp's standby light, as a share of the LEDs'.
inline constexpr double kEvenLight = 0.003;

// The picture on a tripod, from shot to shot, px.
inline constexpr double kShotShift_px = 0.1;

// A lens that no calibration file describes: measured with other pictures, or focused again since.
// Its principal point as a share of the frame's width.
inline constexpr double kFocalLength = 0.002;
inline constexpr double kPixelAspect = 0.0005;
inline constexpr double kPrincipalPoint = 0.002;
inline constexpr double kDistortion = 0.01;
LensDeviations lens(const CameraIntrinsics& intrinsics);
// Of a lens stopped down, without flats: a frame whose corners are 13 degrees off its centre has a
// tenth less light there by geometry alone (the cosine to the fourth power).
inline constexpr double kVignetting = 0.1;
// A sensor and its amplifier, without flats: at the white level, towards which most of them bend.
inline constexpr double kNonLinearity = 0.005;

// Gives every object and every LED without a calibration these deviations where it has none, and
// the scene its even light and the shift of its shots, and the camera's lens, fall-off and
// response.
void take_where_none(Scene& scene);

}  // namespace scattermeter::default_uncertainty
