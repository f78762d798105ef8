// A body under one LED, as the camera of the simulated rigs sees it, for paths of any medium.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "apps/rig/open_objects.h"
#include "apps/rig/rig.h"
#include "core/estimation/channel_rows.h"
#include "core/estimation/channel_simulation.h"
#include "core/estimation/channel_weights.h"
#include "core/scene/lit_objects.h"
#include "core/scene/observed_shot.h"
#include "core/scene/seen_object.h"
#include "core/transport/path_score.h"
#include "core/transport/scattering_rows.h"

namespace scattermeter::apps {

struct LitBodyOptions {
  int image_width_px = 968;
  // With smaller ones, more of a patch's variance would be that of few paths.
  double patch_size_mm = 1.0;
  double g = 0.0;  // Henyey and Greenstein's
};

// The first shot of bodies_rig() (apps/simulation/bodies_rig.h) in the first channel. Its
// rows are those that a search by transport uses: the patches of which nothing is hidden.
class LitBody {
 public:
  static constexpr double kEta = 1.3;  // int over ext
  // body: one of body_names() (core/mesh/bodies.h).
  LitBody(const std::string& body, const LitBodyOptions& options);
  LitBody(const LitBody&) = delete;
  LitBody& operator=(const LitBody&) = delete;

  const MaterialChannel& channel() const { return channel_; }
  Eigen::Index n_rows() const { return static_cast<Eigen::Index>(patches_.size()); }
  // Of the rows.
  const Eigen::VectorXd& area_mm2() const { return area_mm2_; }
  const std::vector<Eigen::Vector3d>& center_mm() const { return center_mm_; }
  // The body's light in an atlas.
  TransportAtlas::LitView& in(TransportAtlas& atlas) const;
  // A simulation from this atlas, which must outlive it as this object must. Its rows are set.
  ChannelSimulation simulation(TransportAtlas& atlas) const;
  // What it interpolates over.
  ScatteringImage dipole(const ScatteringPoint& at);

  // The light at a node of the atlas, as the simulation's image has it, from either half of at
  // least so many paths.
  std::array<Eigen::VectorXd, 2> halves_at_node(TransportAtlas& atlas, int node,
                                                double sigma_a_per_mm, std::int64_t paths) const;
  // Paths of the very medium, as the simulation's image.
  struct Traced {
    ScatteringImage image;
    PathAudit audit;
  };
  Traced traced(const Medium& medium, std::uint64_t seed, int blocks) const;

 private:
  Rig rig_;
  ObjectScenes objects_;
  std::optional<LitObjects> lit_;
  std::vector<ObservedShot> shots_;
  MaterialChannel channel_;
  ChannelRows rows_;
  std::vector<int> patches_;  // of the rows
  Eigen::VectorXd area_mm2_;
  std::vector<Eigen::Vector3d> center_mm_;
  WeightMatrix weights_;  // of the rows; empty until the dipole is asked for
};

}  // namespace scattermeter::apps
