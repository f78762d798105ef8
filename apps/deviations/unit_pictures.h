// Pictures of true setups by one light of unit power each, kept for further use: most deviations
// leave some of them as they are.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <list>
#include <map>
#include <memory>
#include <string>

#include "apps/deviations/deviation.h"
#include "apps/simulation/shot_renderer.h"
#include "core/material/medium.h"
#include "core/scene/scene.h"

namespace scattermeter::apps {

struct UnitPicture {
  // W/(mm^2 sr) per unit of the light's power, every channel at every pixel.
  ColourRadiance radiance;
  // Monte Carlo variance of the mean over a square of pixels of about the size of a patch, times
  // its number of pixels, over the mean radiance: per channel, from two independent halves. 0 for
  // the dipole.
  std::array<double, 3> variance_px_per_radiance{};
};

class UnitPictures {
 public:
  // paths: of a volume rendering, for each light and channel. most: pictures that are kept.
  explicit UnitPictures(std::int64_t paths, std::size_t most = 256) : paths_(paths), most_(most) {}

  // Two lights other than LEDs and even light are the same if their names are. Throws InputError
  // for what cannot be rendered.
  std::shared_ptr<const UnitPicture> of(const TrueSetup& setup, const SceneLight& light,
                                        const std::array<Medium, 3>& media, bool volume);

  std::size_t rendered() const { return rendered_; }

 private:
  std::int64_t paths_;
  std::size_t most_;
  std::size_t rendered_ = 0;
  std::list<std::string> by_use_;  // keys, the last used first
  struct Kept {
    std::shared_ptr<const UnitPicture> picture;
    std::list<std::string>::iterator use;
  };
  std::map<std::string, Kept> kept_;
};

}  // namespace scattermeter::apps
