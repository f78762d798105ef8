// LEDs that stand so far from where the rig states them that their light is computed there.
#pragma once

#include <map>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "apps/instrument/seen_shots.h"
#include "core/estimation/channel_result.h"
#include "core/scene/scene.h"

namespace scattermeter::apps {

using LedDisplacements = std::map<std::string, Eigen::VectorXd>;  // Light::displacement(), by LED

// As often are they put where the shots show them: from 2 mm off, twice suffices.
inline constexpr int kMostLedMoves = 4;

class LedWatch {
 public:
  // Both must outlive it. looks: false: finds nothing.
  LedWatch(const Scene& scene, const SeenShots& seen, bool looks);
  // Whether the dipole's fits put an LED farther from where its light is computed than the
  // derivatives by its position, axis and lobe describe the image; not where the dipole misses all
  // images.
  bool finds(const std::vector<ChannelResult>& results);
  const LedDisplacements& found() const { return found_; }

 private:
  const Scene& scene_;
  const SeenShots& seen_;
  bool looks_;
  LedDisplacements found_;
};

// Puts the LEDs there.
void displace_leds(const LedDisplacements& by, Scene& scene);
// A sentence on each LED that the rig states elsewhere; "" if there is none.
std::string displaced_leds_note(const Scene& scene);

}  // namespace scattermeter::apps
