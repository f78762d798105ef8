// What the search by transport takes from the dipole: the shots' rows and a smooth pilot image.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "core/diffusion/distance_weights.h"
#include "core/estimation/channel_simulation.h"
#include "core/estimation/estimation.h"
#include "core/estimation/transport_round.h"
#include "core/fit/part_light.h"
#include "core/fit/scattering_equation.h"
#include "core/fit/shot_parts.h"
#include "core/transport/scattering_rows.h"

namespace scattermeter {

// The dipole's image of the medium at `at` with its derivatives, at scale 1; variance stays empty.
// weights: W on the knots, one row of the image each.
ScatteringImage dipole_pilot(const WeightMatrix& weights, const DistanceKnots& knots,
                             const ScatteringPoint& at, double eta_int_over_ext);

// Of all quantities.
ScatteringImage mean_of(const ScatteringImage& a, const ScatteringImage& b);

// Monte Carlo variances proportional to light over area, with the sum of `noisy_variance`: weights
// must not depend on the noise of paths. l (negative counts as 0) and area_mm2: of the rows.
// Precondition: some l is positive.
Eigen::VectorXd smooth_path_variance(const Eigen::VectorXd& l, const std::vector<double>& area_mm2,
                                     const Eigen::VectorXd& noisy_variance);

// EquationPilot::further of a pilot's image, rows x (2 or 3): its derivatives without their detail
// and, unless the scale is an unknown (`is_free`), its light.
Eigen::MatrixXd further_images(const ShotParts& parts, const ScatteringImage& image, bool is_free);
// EquationPilot::expected of these, 5 x unknowns: half of the dipole's detail is found, about.
Eigen::MatrixXd expected_coefficients(bool is_free);

// Variance of an estimate from so many blocks of paths, over what the covariance of these paths
// alone says: its weights and derivatives are learned from them, too. In repeated draws for a cube
// it was 2 at 75 blocks and 1 from 400 on.
double variance_by_learning(int blocks);

// The pilots of a search: the dipole's image and derivatives, corrected part by part by what either
// half of the paths shows.
class PathPilots {
 public:
  void forget() { light_ = {}; }
  // Whether there are enough paths to correct anything by, and for a round to be the last.
  bool have_learned() const;
  // dipole: at the look's point. cells: covariances of the light of the cells, by half.
  void learn(const ShotParts& parts, const ChannelSimulation::Look& seen,
             const std::array<Eigen::MatrixXd, 2>& cells, const ScatteringImage& dipole);
  // dipole: at the point of the round. noisy_variance: of the rows, as by paths. of_block: the
  // covariance of the errors to be expected over that of one block. Precondition: learn() was
  // called.
  std::array<TransportRound::Pilot, 2> pilots(const ShotParts& parts, const ScatteringImage& dipole,
                                              const std::vector<double>& area_mm2,
                                              const Eigen::VectorXd& noisy_variance,
                                              double of_block) const;

 private:
  std::array<PartLight, 2> light_;
};

// The dipole's system for the search: with the light by way of the plane, which paths simulate, and
// without the shifts of single shots: with these, the search for faint materials ends with scale
// and eta far off. Its first nuisance is gamma (PhaseFunction::gamma()); of rough objects, the
// second is their roughness, in deviations. The columns of both are zeros.
DenseSystem system_of_paths(const DipoleSystem& dipole, double gamma_std, bool is_rough);

// The column of the roughness at a point: RoughSurfaces::change().
Eigen::VectorXd roughness_change(const RoughSurfaces& surfaces, const WeightMatrix& weights,
                                 const DistanceKnots& knots, const ScatteringPoint& at,
                                 double eta_int_over_ext);

}  // namespace scattermeter
