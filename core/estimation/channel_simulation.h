// Simulation of the shots of one channel by volume Monte Carlo.
#pragma once

#include <array>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "core/atlas/transport_atlas.h"
#include "core/estimation/channel_rows.h"
#include "core/fit/scattering_equation.h"
#include "core/scene/rough_surfaces.h"
#include "core/transport/scattering_rows.h"

namespace scattermeter {

// Between the nodes of the atlas, what is interpolated is the light over a control: that of the
// dipole, which varies in nearly the same way. By cubics through four nodes; shots that see an
// object under the same light share its paths, and so do channels and materials. Scene, channel and
// atlas must outlive the object.
class ChannelSimulation {
 public:
  // The dipole's image and derivatives at a point, with the simulation's rows.
  using Control = std::function<ScatteringImage(const ScatteringPoint&)>;

  // Thrown where paths are missing that may not be traced.
  struct PathsMissing : std::exception {};

  // may_trace: otherwise it has the paths that the atlas has. Throws InputError if a light reaches
  // no part of an object.
  ChannelSimulation(const Scene& scene, const MaterialChannel& channel, TransportAtlas& atlas,
                    bool may_trace = true);

  double largest_size_mm() const;  // of the lit bodies

  // From now on, images and projections have the rows whose state is kUsed, shot by shot.
  void set_rows(const ChannelRows& rows);
  // Of those rows; their gloss is part of the images.
  const RoughSurfaces& surfaces() const { return surfaces_; }
  Eigen::Index n_rows() const { return static_cast<Eigen::Index>(area_mm2_.size()); }
  // By row, of its patch.
  const std::vector<double>& area_mm2() const { return area_mm2_; }
  const std::vector<Eigen::Vector3d>& center_mm() const { return center_mm_; }

  // Blocks count paths, kBlockPaths each, for each light and view: as many paths drawn at the point
  // itself would have the errors of these.
  static constexpr double kBlockPaths = 4096.0;
  struct Look {
    ScatteringImage image;  // at scale 1, W/mm^2
    PathHalves halves;      // the same from either half of the paths, without variances
    // Of the mean of projections[half] * halves[half].l, and that of projections[half] * image.l
    // as the half alone shows it.
    Eigen::MatrixXd covariance;
    std::array<Eigen::MatrixXd, 2> by_half;
    Eigen::VectorXd per_eta;  // d image.l / d eta at the same sigma_s' and sigma_a
    int blocks = 0;           // of the light and view that has fewest; at least those asked for
    // Degrees of freedom of the covariance (Welch 1947, Satterthwaite 1946), of the same.
    double freedom = 0;
  };
  // For either half of the paths: any number of rows x n_rows().
  using Projections = std::array<Eigen::SparseMatrix<double>, 2>;
  // Traces what is missing for so many blocks, or throws PathsMissing.
  Look look(const ScatteringPoint& at, int blocks, const Projections& projections,
            const Control& control) const;
  // The light alone, at a node of the atlas, from at least so many blocks there: as image.l. Traces
  // or throws as look() does.
  Eigen::VectorXd light_at_node(int node, double sigma_a_per_mm, int blocks) const;
  // Paths that look() would trace.
  std::int64_t missing_paths(const ScatteringPoint& at, int blocks) const;

 private:
  // A light and view of the channel's shots.
  struct Lit {
    TransportAtlas::LitView* in_atlas;
    double power;
    std::vector<std::size_t> shots;
    // Pairs of a row of the images that it lights and the row of the view.
    std::vector<std::pair<Eigen::Index, Eigen::Index>> rows;
    // Of the last look: the next one needs them again.
    mutable std::vector<std::shared_ptr<const WhiteRows>> held;
  };
  std::shared_ptr<const WhiteRows> node_of(const Lit& lit, int idx, int levels) const;

  const Scene& scene_;
  const MaterialChannel& channel_;
  bool may_trace_;
  RoughSurfaces surfaces_;
  std::vector<Lit> lit_;
  std::vector<double> area_mm2_;
  std::vector<Eigen::Vector3d> center_mm_;
};

}  // namespace scattermeter
