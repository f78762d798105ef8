// Irradiance at a point under a light probe.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "core/light/probe_tree.h"
#include "core/light/transmitted_cosine.h"
#include "core/mesh/ray_scene.h"

namespace scattermeter {

// ∫ L(w) cos Ft(eta, cos) V(w) dw at points of one facet after another, R G B, per unit of the
// probe's radiance. `tolerance`: target error of each part, relative to the irradiance of the
// unoccluded facet. A workspace: one per thread.
class ProbeIrradiance {
 public:
  enum class Part { kSky, kBright };

  // scene: may be nullptr if only open() is called. The arguments must outlive the object.
  ProbeIrradiance(const ProbeTree& tree, const RayScene* scene,
                  const TransmittedCosine& transmitted, double tolerance);

  // The facet for the calls below: its unit normal, and the mesh's vertices in front of its plane
  // (empty: nothing can occlude it).
  void set_facet(const Eigen::Vector3d& normal, std::vector<Eigen::Vector3d> in_front_mm);

  // Irradiance of the unoccluded facet, constant over it.
  const Eigen::Array3d& open(Part part) const {
    return part == Part::kSky ? open_sky_ : open_bright_;
  }
  // Irradiance with occlusion. The point lies in the interior of the facet.
  Eigen::Array3d at(const Eigen::Vector3d& point_mm, Part part);
  std::size_t rays() const { return rays_; }

 private:
  friend struct SkyEmitter;
  friend struct BrightEmitter;
  Eigen::Array3d arriving(const ProbeLight& light) const;
  bool is_fine(const ProbeLight& light, bool bright) const;
  Eigen::Array3d sky_energy(const ProbeCell& cell);
  void find_linear_sky();
  Eigen::Array3d cut_energy(const ProbeCell& cell, bool bright, int cuts) const;
  bool dim(const Eigen::Array3d& energy) const;
  bool visible(double x_px, double y_px);
  bool trace(double x_px, double y_px);

  const ProbeTree& tree_;
  const RayScene* scene_;
  const TransmittedCosine& transmitted_;
  double tolerance_;
  Eigen::Quaterniond world_from_probe_;
  int wide_level_;  // cells above it are always subdivided
  // Of an open facet under a linear probe.
  struct LinearSky {
    Eigen::Array3d level = Eigen::Array3d::Zero();
    Eigen::Matrix3d per_normal = Eigen::Matrix3d::Zero();  // by channel
  };
  std::optional<LinearSky> linear_sky_;

  // Values of the facet.
  Eigen::Vector3d normal_;
  Eigen::Vector3d normal_in_probe_;
  std::vector<Eigen::Vector3d> in_front_mm_;
  Eigen::Array3d open_sky_;
  Eigen::Array3d open_bright_;
  std::vector<Eigen::Array3d> bright_energy_;  // by bright pixel
  // Energies of the sky's cells above the pixels, as far as they have been needed.
  struct Known {
    std::uint32_t facet = 0;
    Eigen::Array3f energy;
  };
  std::uint32_t facet_ = 0;
  std::vector<std::vector<Known>> known_;  // by level - 1

  // Values of the point: visibility on a lattice of pixel corners, 2^shift apart.
  Eigen::Vector3d point_mm_;
  std::uint32_t point_ = 0;
  int shift_;
  std::size_t lattice_width_;
  std::vector<std::uint32_t> lattice_;  // 2 * point + seen
  std::size_t rays_ = 0;
};

}  // namespace scattermeter
