#include "apps/pages/swatches.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/core.h>

#include "apps/report/render_pictures.h"
#include "core/material/slab_reflectance.h"

namespace scattermeter::apps {
namespace {

constexpr double kBlock_mm = 1e4;  // thicker than light reaches
// Of a reflectance by diffusion, at the albedos that can be measured (slab_reflectance.h).
constexpr double kApproximationStd = 0.01;

struct Plate {
  const char* what;
  double thickness_mm;
  double background_albedo;
};
constexpr Plate kPlates[] = {{"10 mm over black", kSwatchThickness_mm, 0.0},
                             {"10 mm over white", kSwatchThickness_mm, 1.0},
                             {"thick block", kBlock_mm, 0.0}};

bool is_measured(const ChannelResult* r) {
  return !r->refused() && r->estimate.converged && r->estimate.sigma_s_prime_per_mm.value > 0.0;
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
  const Estimate& e = result.estimate;
  const Quantity& s = e.sigma_s_prime_per_mm;
  const Quantity& a = e.sigma_a_per_mm;
  const auto at = [&](double sigma_s_prime, double sigma_a) {
    return slab_reflectance({sigma_s_prime, std::max(0.0, sigma_a), result.eta_int_over_ext},
                            thickness_mm, background_albedo);
  };
  const double value = at(s.value, a.value);
  // Changes by one standard deviation; towards more, where no coefficient can become negative.
  const double by_s = at(s.value + s.std, a.value) - value;
  const double by_a = at(s.value, a.value + a.std) - value;
  const double variance = by_s * by_s + by_a * by_a + 2.0 * e.correlation * by_s * by_a;
  return normal_quantity(value, std::sqrt(std::max(0.0, variance)));
}

Html swatches(const std::vector<const ChannelResult*>& channels) {
  if (channels.size() != kRgb || !std::all_of(channels.begin(), channels.end(), is_measured)) {
    return {};
  }
  HtmlTable table;
  table.header = {"plate", "colour", "R [%]", "G [%]", "B [%]"};
  for (const Plate& plate : kPlates) {
    std::array<double, kRgb> reflectance{};
    std::vector<HtmlTable::Cell> row = {text_cell(plate.what), {}};
    for (std::size_t c = 0; c < kRgb; ++c) {
      const Quantity q =
          plate_reflectance(*channels[c], plate.thickness_mm, plate.background_albedo);
      reflectance[c] = q.value;
      row.push_back(number_cell(fmt::format("{:.1f} ± {:.1f}", 100.0 * q.value,
                                            100.0 * std::hypot(q.std, kApproximationStd))));
    }
    row[1].content = colour_cell(plate.what, reflectance);
    table.rows.push_back(row);
  }
  Html out = html_element("h3", html_text("What it looks like"));
  out += html_table(table);
  out += html_element(
      "p",
      html_text("Share of uniform white light (D65) that comes back, surface reflection included, "
                "by the diffusion of light in a plate with smooth faces; one standard deviation, "
                "of the coefficients and 1 % for the approximation. The camera's R, G, B stand for "
                "those of the screen "
                "(sRGB): a colour is as right as the camera's filters are like them."),
      "dim");
  return out;
}

}  // namespace scattermeter::apps
