// Rigs that deviate in everything at once, by as much as their files say.
#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "apps/deviations/deviation.h"
#include "core/scene/default_uncertainty.h"

namespace scattermeter::apps {
namespace {

// Another row, and the deviation that the stated rig has for it, in the row's unit.
struct DrawnPart {
  const char* name;
  double std;
  bool positive = false;
};

namespace stated = default_uncertainty;
// The deviation of the rig's first LED.
constexpr double kAsTheRigSays = -1.0;
constexpr std::array<DrawnPart, 20> kParts = {{
    {"mesh displaced in x", stated::kObjectPosition_mm},
    {"mesh displaced in y", stated::kObjectPosition_mm},
    {"mesh displaced in z", stated::kObjectPosition_mm},
    {"mesh turned about z", 0.2},  // 0.1 mm at the size of the bodies, some 30 mm
    {"mesh turned about x", 0.2},
    {"mesh scaled", 100.0 * stated::kMeshScale},
    {"edges bevelled", stated::kEdge_mm, true},
    {"LEDs displaced sideways", kAsTheRigSays},
    {"LEDs displaced in depth", kAsTheRigSays},
    {"LED axes turned", stated::kLedAxis_deg},
    {"LED exponent off", stated::kLedExponent},
    {"all LED intensities off", 100.0 * stated::kLedIntensity},
    {"responsivity off", 2.0},
    {"even light", 100.0 * stated::kEvenLight, true},
    {"eta off", stated::kEta},
    {"focal length off", 100.0 * stated::kFocalLength},
    {"principal point off", 100.0 * stated::kPrincipalPoint},
    {"pixels not square", 100.0 * stated::kPixelAspect},
    {"lens distortion off", stated::kDistortion, true},
    {"vignetting", 100.0 * stated::kVignetting},
}};

void draw_all(TrueSetup& t, const DeviationDraw& d) {
  std::mt19937_64 random(d.seed);
  std::normal_distribution<double> normal;
  const bool is_round = t.mesh.triangles.size() > 100;
  const double led_mm = t.rig.scene.lights.front().led()->position_std_mm;
  for (const DrawnPart& part : kParts) {
    const Deviation& row = deviation_named(part.name);
    const double std = part.std == kAsTheRigSays ? led_mm : part.std;
    double size = d.size * std * normal(random);
    if (part.positive) size = std::abs(size);
    if (row.needs.edges && is_round) continue;
    row.truth(t, {size, 1.0, d.seed});
  }
}

// The picture of each mark is read with the stated error.
void read_marks(Rig& rig, const DeviationDraw& d) {
  std::mt19937_64 random(d.seed + 1);
  std::normal_distribution<double> normal(0.0, d.size * rig.pose.options.point_std_px);
  for (PointPair& pair : rig.pose.points) {
    pair.image_px += Eigen::Vector2d(normal(random), normal(random));
  }
}

void bend_towards_white(std::vector<ColourFrame>& frames, const DeviationDraw& d) {
  std::mt19937_64 random(d.seed + 3);
  std::normal_distribution<double> normal(0.0, d.size * stated::kNonLinearity);
  const double at_white = normal(random);
  for (ColourFrame& frame : frames) {
    for (std::vector<float>& plane : frame.counts) {
      for (float& c : plane) c *= static_cast<float>(1.0 + at_white * c / frame.range_counts);
    }
  }
}

void shift_second(std::vector<ColourFrame>& frames, const DeviationDraw& d) {
  if (frames.size() < 2) return;
  std::mt19937_64 random(d.seed + 2);
  std::normal_distribution<double> normal(0.0, d.size * stated::kShotShift_px);
  deviation_named("object moved between the shots")
      .frames(frames, {std::abs(normal(random)), 1.0, d.seed});
}

}  // namespace

std::vector<Deviation> drawn_deviations() {
  return {{.name = "rig drawn as stated",
           .words = {},
           .unit = "deviations",
           .sizes = {1},
           .within = 1,
           .truth = draw_all,
           .frames =
               [](std::vector<ColourFrame>& frames, const DeviationDraw& d) {
                 shift_second(frames, d);
                 bend_towards_white(frames, d);
               },
           .stated = read_marks}};
}

}  // namespace scattermeter::apps
