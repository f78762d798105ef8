#include "core/view/exit_transmittance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "core/material/fresnel.h"
#include "core/view/pixel_points.h"

namespace scattermeter {
namespace {

constexpr int kPoints = 16;
// A relative difference between neighbours that matters.
constexpr double kContrast = 1e-3;

}  // namespace

ExitTransmittance::ExitTransmittance(const RayGrid& rays, const RayScene& scene,
                                     const PatchMesh& patches, const SeenSurface& surface,
                                     double eta_int_over_ext)
    : rays_(rays), scene_(scene), patches_(patches), surface_(surface), eta_(eta_int_over_ext) {}

double ExitTransmittance::at_center(std::size_t i) const {
  return fresnel_transmittance(eta_, static_cast<double>(surface_.seen(i).cos_theta));
}

bool ExitTransmittance::mixed(int x, int y, double own) const {
  const std::int32_t facet = surface_.seen(surface_.index(x, y)).facet;
  for (int yn = std::max(0, y - 1); yn <= std::min(rays_.height - 1, y + 1); ++yn) {
    for (int xn = std::max(0, x - 1); xn <= std::min(rays_.width - 1, x + 1); ++xn) {
      const std::size_t other = surface_.index(xn, yn);
      if (surface_.seen(other).patch < 0 || surface_.seen(other).facet == facet) continue;
      if (std::abs(at_center(other) - own) > kContrast * own) return true;
    }
  }
  return false;
}

double ExitTransmittance::of(int x, int y) const {
  const double at_middle = at_center(surface_.index(x, y));
  if (rays_.width < 2 || rays_.height < 2 || !mixed(x, y, at_middle)) return at_middle;
  const PixelPoints pixel(rays_, x, y);
  std::array<Eigen::Vector3f, kPoints> directions;
  for (int i = 0; i < kPoints; ++i) {
    directions[static_cast<std::size_t>(i)] = pixel.direction(i, kPoints).cast<float>();
  }
  std::array<RayHit, kPoints> hits;
  scene_.first_hits(rays_.origin_in_world_mm, directions, hits);
  double sum = 0.0;
  int n = 0;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const double cos_theta =
        cosine_of(hits[i], patches_, rays_.origin_in_world_mm, directions[i].cast<double>());
    if (!(cos_theta > 0.0)) continue;
    sum += fresnel_transmittance(eta_, cos_theta);
    ++n;
  }
  return n > 0 ? sum / n : at_middle;
}

}  // namespace scattermeter
