// The light of the shots compared with what lights and objects of the rig can show, before any fit.
#pragma once

#include <cstddef>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "apps/looks/finding.h"
#include "core/diffusion/distance_weights.h"
#include "core/estimation/channel_weights.h"
#include "core/scene/lit_objects.h"
#include "core/scene/observed_shot.h"
#include "core/scene/scene.h"

namespace scattermeter::apps {

// How well lights explain a shot's image: rms of the rest over the rms of the image, with a free
// scale, for the best of a grid of media.
struct ShotLikeness {
  double own = std::numeric_limits<double>::quiet_NaN();  // as listed; NaN: the shot is unusable
  double best_other = std::numeric_limits<double>::infinity();
  std::string other;                      // "lit by led2", "of object pyramid, lit by led1"
  std::vector<std::string> other_lights;  // of the best other; sorted
};

// A shot whose listed object and lights leave a larger rest may show something else.
inline constexpr double kDoubtfulImage = 0.1;

class LightLook {
 public:
  // All arguments must outlive it; weights that are missing are added to `weights`, those of other
  // lights only where the listed ones leave doubt.
  LightLook(const Scene& scene, LitObjects& lit, const std::vector<ObservedShot>& shots,
            Weights& weights);

  // Of one of the shots in its best channel, against all sets of lights of the scene's shots, each
  // LED of the scene alone, and one LED more than is listed.
  ShotLikeness likeness(std::size_t shot);
  // The same for the observation of a frame at another view (of another object).
  void compare_object(const SeenObject& seen, const Observation& observation, std::size_t channel,
                      ShotLikeness& out);

  // Exchanged lights, files of other lights, LEDs that were on too, covered parts, and light off by
  // a factor of more than three beyond any medium that the images allow; the most probable first.
  // Shots are given as indices into the scene's list.
  std::vector<Finding> findings();

  static std::size_t best_channel(const Observation& observation);

 private:
  // Sums over the used rows of one image.
  struct Match {
    double rest = std::numeric_limits<double>::quiet_NaN();  // of the best medium
    Eigen::VectorXd rests;                                   // by medium
    Eigen::VectorXd scales;                                  // measured over predicted, by medium
    Eigen::Index best = 0;
  };
  std::vector<std::vector<std::string>> settings_for(const std::vector<std::string>& own) const;
  Match match(const SeenObject& seen, const ChannelObservation& o,
              const std::vector<std::string>& lights, std::size_t channel) const;
  // False where a light reaches no part of the object.
  bool add_weights_for(const SeenObject& seen, const SceneShot& stated,
                       const std::vector<std::string>& lights);
  void offer(double rest, const std::string& what, const std::vector<std::string>& lights,
             ShotLikeness& out) const;
  double covered_share(std::size_t shot, std::size_t channel) const;

  std::size_t index_of(std::size_t shot) const;
  void find_exchanged(const std::vector<ShotLikeness>& likeness, std::vector<Finding>& out) const;
  void find_covered(const std::vector<ShotLikeness>& likeness, std::vector<Finding>& out) const;
  struct PossibleFactors;
  std::vector<PossibleFactors> possible_factors(const std::vector<ShotLikeness>& likeness) const;
  void find_factors(const std::vector<ShotLikeness>& likeness, std::vector<Finding>& out) const;

  const Scene& scene_;
  LitObjects& lit_;
  const std::vector<ObservedShot>& shots_;
  Weights& weights_;
  DistanceKnots knots_;
  Eigen::MatrixXd curves_;                          // knots x media
  std::vector<std::vector<std::string>> settings_;  // sets of lights, sorted
};

}  // namespace scattermeter::apps
