#include "core/estimation/edge_width.h"

#include <algorithm>
#include <cmath>

#include "core/base/median.h"
#include "core/estimation/model_choice.h"
#include "core/nuisances/edge_light.h"

namespace scattermeter {
namespace {

struct Found {
  std::vector<double> widths_mm;  // by channel
  double image_relative = 0;      // the largest effect on an image
};

}  // namespace

std::vector<bool> take_edge_widths(const Scene& scene, const std::vector<ChannelResult>& results,
                                   EdgeWidths& widths_mm) {
  // Of the image: a tenth of it is what the width leaves wrong, as much as counts
  // (kLeastExplained).
  constexpr double kVisible = 1e-3;
  constexpr double kNarrowest = 0.1, kWidest = 3.0;  // of the width before anything is known
  std::vector<bool> taken(results.size());
  for (const SceneObject& object : scene.objects) {
    std::map<std::string, Found> of_material;
    for (const ChannelResult& r : results) {
      // Where the dipole does not hold, its fit does not tell the width.
      if (!r.estimate.converged || misses_image(r.estimate)) continue;
      for (const PriorPull& p : r.estimate.pulls) {
        if (p.name != object.name + ".edges") continue;
        Found& found = of_material[r.material];
        found.widths_mm.push_back(p.offset);
        found.image_relative = std::max(found.image_relative, p.image_relative);
      }
    }
    const double first_mm = chamfer_width_mm(object);
    for (const auto& [material, found] : of_material) {
      const double width_mm =
          std::clamp(upper_median(found.widths_mm), kNarrowest * first_mm, kWidest * first_mm);
      double& now_mm = widths_mm.try_emplace({material, object.name}, first_mm).first->second;
      if (!(found.image_relative * std::abs(width_mm / now_mm - 1.0) > kVisible)) continue;
      now_mm = width_mm;
      for (std::size_t i = 0; i < results.size(); ++i) {
        if (results[i].material == material && results[i].estimate.converged) taken[i] = true;
      }
    }
  }
  return taken;
}

}  // namespace scattermeter
