// The estimate of one material in one channel.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/agreement/shot_agreement.h"
#include "core/fit/dipole_misfit.h"
#include "core/fit/estimate.h"
#include "core/fit/prior_pulls.h"
#include "core/fit/smooth_reflectance.h"
#include "core/view/observation.h"
#include "core/view/sample_map.h"

namespace scattermeter {

// Observed and predicted l of a shot, by row of its map (a patch), in W/mm^2 or up to one factor as
// in ChannelObservation. predicted and std are NaN for rows that were not used.
struct ShotRows {
  std::string file;
  std::shared_ptr<const SampleMap> map;
  std::vector<float> observed;
  std::vector<float> predicted;
  std::vector<float> std;  // of observed
  std::vector<RowState> state;
};

// The pattern of an image's residual (core/estimation/residual_look.h).
struct ResidualLook {
  std::string phrase;  // "one face (normal [1.00, 0.00, 0.00]), 3.1 % brighter than predicted"
  double share = 0;    // of the squared residual, in standard deviations, beyond the noise
};

// The estimate from a single shot.
struct ShotResult {
  std::string file;
  Estimate estimate;
};

struct ChannelResult {
  std::string material;
  char channel;  // 'R', 'G', 'B'
  double eta_int_over_ext;
  std::string model;  // name of the estimator that produced the estimate
  Estimate estimate;
  std::vector<std::string> shots;  // file names of the shots used
  // Numbers of patches, summed over the shots: by state (index: RowState), and those partly hidden
  // by the silhouette, a crease or another part of the object.
  std::array<std::size_t, kRowStates> patches_by_state{};
  std::size_t patches_partly_seen = 0;
  std::size_t nuisances_negligible =
      0;  // left out of the dipole's fit (core/estimation/channel_image.h)
  // Of dipole and transport:
  std::vector<ShotResult> singles;  // estimates of single shots; empty if there is only one
  ShotAgreement agreement;          // whether the shots agree
  // r(d) without the dipole, and whether the dipole fits it. With transport's estimate it shows why
  // the dipole is inadequate.
  std::optional<SmoothReflectance> recovered;
  std::optional<DipoleMisfit> misfit;
  RigEvidence evidence;             // of this channel's model
  double image_in_std = 0;          // |l / std| of the rows, of the dipole's fit
  std::vector<MoreRows> more_rows;  // of the dipole, if the shots have more (EstimateOptions)
  // Of transport only: the dipole's estimate, and why --model auto rejected it.
  std::optional<Estimate> dipole;
  std::string why_transport;
  // More would hardly change the estimate or its verdict, or would take too long.
  bool has_enough_paths = false;
  // Of the residual with the rig as stated: the dipole's first fit's, or transport's.
  std::optional<ResidualLook> look;
  std::vector<ShotRows> rows;  // by shot, if EstimateOptions::keep_rows and the fit was completed
  bool refused() const { return !estimate.reasons.empty(); }
};

// The difference between the estimates of dipole and transport.
struct DipoleDistance {
  double sigma_s_prime_relative = 0;
  double sigma_a_per_mm = 0;
};
// Empty unless there are both estimates and the dipole determines sigma_s' (is_undetermined()).
std::optional<DipoleDistance> dipole_distance(const ChannelResult& result);

// The changes of the image by the rig's quantities were computed for the medium `at`: how far they
// are from those for the medium of the result, in standard deviations of the image, as their sizes
// (PriorPull::image_relative) times the change of the medium. 0 where the model misses the image
// and comes no nearer to it: its pulls then mean little.
double bent_in_std(const Estimate& at, const ChannelResult& result);

}  // namespace scattermeter
