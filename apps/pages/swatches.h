// The colour of a measured material, on a page.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "apps/instrument/measure.h"
#include "apps/pages/html_page.h"

namespace scattermeter::apps {

inline constexpr double kSwatchThickness_mm = 10.0;

// Reflectance of a plate of the estimated material with its standard deviation from that of both
// coefficients and their correlation (core/material/slab_reflectance.h).
Quantity plate_reflectance(const ChannelResult& result, double thickness_mm,
                           double background_albedo);

// A measured material on the standard body (apps/simulation/standard_body.h).
struct MaterialLook {
  std::string picture;  // data: address of a PNG in sRGB: white light (D65) as its white
  // R, G, B at the two places, 1 for a white matt surface that faces the light; the standard
  // deviation is that of the coefficients.
  std::array<Quantity, kRgb> lit, shadow;
};

// Empty unless all three channels were measured, with one eta and mean free paths of at most 3 mm:
// beyond, the dipole does not show a body of this size.
std::optional<MaterialLook> material_look(const std::vector<const ChannelResult*>& channels);

// The picture, for a page; `material`: for the alternative text.
Html look_picture(const MaterialLook& look, const std::string& material);

// The look, if there is one, and reflectances of a plate over black and over white and of a thick
// block, with the colours on a screen: the camera's R, G, B as those of sRGB, white light as its
// white (D65). Empty unless all three channels were measured.
Html swatches(const std::vector<const ChannelResult*>& channels,
              const std::optional<MaterialLook>& look);

}  // namespace scattermeter::apps
