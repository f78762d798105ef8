#include "apps/pages/swatches.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/core.h>

#include "apps/report/render_pictures.h"
#include "apps/simulation/standard_body.h"
#include "core/material/slab_reflectance.h"

namespace scattermeter::apps {
namespace {

constexpr double kBlock_mm = 1e4;  // thicker than light reaches
// Of a reflectance by diffusion, at the albedos that can be measured (slab_reflectance.h).
constexpr double kApproximationStd = 0.01;
// Of the cube by the dipole, relative: paths of light in it (core/transport/volume_light.h, 0.5 to
// 1.5 million, errors of 3 to 5 %) show the lit face 2 to 16 % and the place in shadow 29 to 80 %
// brighter, with strong absorption (0.05 per mm) 2.5 times as bright; mean free paths of 0.6 to
// 3 mm, eta 1.3 and 1.5.
constexpr double kLitStd = 0.1;
constexpr double kShadowStd = 0.8;
// Beyond this mean free path, light reaches the edges of the cube from everywhere, and the dipole
// does not know them.
constexpr double kLongestPath_mm = 3.0;
constexpr const char* kLookCaption =
    "A cube of 20 mm under white light (D65) from the left above, in sRGB; white is a matt white "
    "surface that faces the light. The face to the right is lit through the material only.";
constexpr const char* kPlatesCaption =
    "Plates and block: share of uniform white light (D65) that comes back, surface reflection "
    "included, by the diffusion of light in a plate with smooth faces. ";
constexpr const char* kCubeCaption =
    "Cube, without the gloss of its surface: the middle of the upper face, and the face in shadow "
    "2 mm behind its lit edge, by the dipole, which ignores edges and shows both too dark, by up "
    "to 15 % and by up to 60 %. ";
constexpr const char* kColoursCaption =
    "One standard deviation, of the coefficients and of the approximation. The camera's R, G, B "
    "stand for those of the screen (sRGB): a colour is as accurate as the camera's filters are "
    "like them.";

struct Plate {
  const char* what;
  double thickness_mm;
  double background_albedo;
};
constexpr Plate kPlates[] = {{"10 mm over black", kSwatchThickness_mm, 0.0},
                             {"10 mm over white", kSwatchThickness_mm, 1.0},
                             {"thick block", kBlock_mm, 0.0}};

// Of a value that depends on both coefficients, from its changes by one standard deviation of each.
Quantity with_deviation(const Estimate& e, double value, double by_s, double by_a) {
  const double variance = by_s * by_s + by_a * by_a + 2.0 * e.correlation * by_s * by_a;
  return normal_quantity(value, std::sqrt(std::max(0.0, variance)));
}

// With the coefficients changed by so many standard deviations; only towards more, where none can
// become negative.
Medium medium_of(const ChannelResult& r, double stds_s, double stds_a) {
  const Quantity& s = r.estimate.sigma_s_prime_per_mm;
  const Quantity& a = r.estimate.sigma_a_per_mm;
  return {s.value + stds_s * s.std, std::max(0.0, a.value + stds_a * a.std), r.eta_int_over_ext};
}

bool all_measured(const std::vector<const ChannelResult*>& channels) {
  return channels.size() == kRgb &&
         std::all_of(channels.begin(), channels.end(), [](const ChannelResult* r) {
           return !r->refused() && r->estimate.converged &&
                  r->estimate.sigma_s_prime_per_mm.value > 0.0;
         });
}

Html colour_cell(const std::string& what, const std::array<double, kRgb>& reflectance) {
  const std::string code = fmt::format("#{:02x}{:02x}{:02x}", srgb_byte(reflectance[0]),
                                       srgb_byte(reflectance[1]), srgb_byte(reflectance[2]));
  return {
      fmt::format("<span class=\"swatch\" role=\"img\" aria-label=\"{}: {}\" "
                  "style=\"background: {}\"></span> {}",
                  what, code, code, code)};
}

}  // namespace

Quantity plate_reflectance(const ChannelResult& result, double thickness_mm,
                           double background_albedo) {
  const auto at = [&](double stds_s, double stds_a) {
    return slab_reflectance(medium_of(result, stds_s, stds_a), thickness_mm, background_albedo);
  };
  const double value = at(0, 0);
  return with_deviation(result.estimate, value, at(1, 0) - value, at(0, 1) - value);
}

std::optional<MaterialLook> material_look(const std::vector<const ChannelResult*>& channels) {
  const auto is_shown = [&](const ChannelResult* r) {
    return r->eta_int_over_ext == channels.front()->eta_int_over_ext &&
           1.0 / medium_of(*r, 0, 0).sigma_t_prime_per_mm() <= kLongestPath_mm;
  };
  if (!all_measured(channels) || !std::all_of(channels.begin(), channels.end(), is_shown)) {
    return std::nullopt;
  }
  const auto media = [&](double stds_s, double stds_a) {
    std::array<Medium, kRgb> out;
    for (std::size_t c = 0; c < kRgb; ++c) out[c] = medium_of(*channels[c], stds_s, stds_a);
    return out;
  };
  const std::vector<StandardBody> bodies = standard_bodies({media(0, 0), media(1, 0), media(0, 1)});
  const auto colour = [&](StandardPlace place) {
    std::array<Quantity, kRgb> out;
    const Eigen::Array3d value = bodies[0].at(place);
    const Eigen::Array3d by_s = bodies[1].at(place) - value;
    const Eigen::Array3d by_a = bodies[2].at(place) - value;
    for (std::size_t c = 0; c < kRgb; ++c) {
      const auto k = static_cast<Eigen::Index>(c);
      out[c] = with_deviation(channels[c]->estimate, value[k], by_s[k], by_a[k]);
    }
    return out;
  };
  return MaterialLook{data_address("image/png", png_bytes(srgb_picture(bodies[0].picture, 1.0))),
                      colour(StandardPlace::kLit), colour(StandardPlace::kShadow)};
}

Html look_picture(const MaterialLook& look, const std::string& material) {
  return {fmt::format("<img class=\"look\" src=\"{}\" alt=\"{}\">", look.picture,
                      html_text("A 20 mm cube of " + material + ", lit from the left").markup)};
}

Html swatches(const std::vector<const ChannelResult*>& channels,
              const std::optional<MaterialLook>& look) {
  if (!all_measured(channels)) return {};
  HtmlTable table;
  table.header = {"piece", "colour", "R [%]", "G [%]", "B [%]"};
  const auto add = [&](const std::string& what, const std::array<Quantity, kRgb>& light,
                       const auto& approximation_std) {
    std::array<double, kRgb> value{};
    std::vector<HtmlTable::Cell> row = {text_cell(what), {}};
    for (std::size_t c = 0; c < kRgb; ++c) {
      value[c] = light[c].value;
      row.push_back(number_cell(
          fmt::format("{:.1f} ± {:.1f}", 100.0 * light[c].value,
                      100.0 * std::hypot(light[c].std, approximation_std(light[c].value)))));
    }
    row[1].content = colour_cell(what, value);
    table.rows.push_back(row);
  };
  for (const Plate& plate : kPlates) {
    std::array<Quantity, kRgb> light;
    for (std::size_t c = 0; c < kRgb; ++c) {
      light[c] = plate_reflectance(*channels[c], plate.thickness_mm, plate.background_albedo);
    }
    add(plate.what, light, [](double) { return kApproximationStd; });
  }
  Html out = html_element("h3", html_text("What it looks like"));
  if (look) {
    add("20 mm cube, lit face", look->lit, [](double value) { return kLitStd * value; });
    add("20 mm cube, shadow", look->shadow, [](double value) { return kShadowStd * value; });
    Html figure = look_picture(*look, channels.front()->material);
    figure += html_element("figcaption", html_text(kLookCaption));
    out += html_aside(html_element("figure", figure), html_table(table));
  } else {
    out += html_table(table);
  }
  out += html_element(
      "p",
      html_text(fmt::format("{}{}{}", kPlatesCaption, look ? kCubeCaption : "", kColoursCaption)),
      "dim");
  return out;
}

}  // namespace scattermeter::apps
