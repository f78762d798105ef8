// The estimate of one material in one channel.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/fit/dipole_misfit.h"
#include "core/fit/estimate.h"
#include "core/fit/shot_agreement.h"
#include "core/fit/smooth_reflectance.h"
#include "core/view/observation.h"
#include "core/view/sample_map.h"

namespace scattermeter {

// What a shot shows and what the model predicts of it, by row of its map (a patch), W/mm^2 or up to
// one factor as ChannelObservation. NaN in predicted and std where the row took no part.
struct ShotRows {
  std::string file;
  std::shared_ptr<const SampleMap> map;
  std::vector<float> observed;
  std::vector<float> predicted;
  std::vector<float> std;  // of observed
  std::vector<RowState> state;
};

// A shot measured alone.
struct ShotResult {
  std::string file;
  Estimate estimate;
};

struct ChannelResult {
  std::string material;
  char channel;  // 'R', 'G', 'B'
  double eta_int_over_ext;
  std::string model;  // name of the estimator that the estimate is from
  Estimate estimate;
  std::vector<std::string> shots;  // file names that took part
  // Patches, summed over the shots, by what kept them out (index: RowState; kUsed: in use), and
  // those that the silhouette, a crease or another part of the object hides in part.
  std::array<std::size_t, kRowStates> patches_by_state{};
  std::size_t patches_partly_seen = 0;
  std::size_t nuisances_negligible =
      0;  // left out of the dipole's fit (core/estimation/channel_image.h)
  // Dipole and transport.
  std::vector<ShotResult> singles;  // each shot alone; empty for a single shot
  ShotAgreement agreement;          // whether the shots agree
  // r(d) without the dipole, and whether the dipole fits it. Also beside transport's estimate,
  // where it shows why the dipole would not do.
  std::optional<SmoothReflectance> recovered;
  std::optional<DipoleMisfit> misfit;
  // Of transport only: the dipole's estimate, and why --model auto did not keep it.
  std::optional<Estimate> dipole;
  std::string why_transport;
  std::vector<ShotRows> rows;  // by shot, where asked for and the model came to an end
  bool refused() const { return !estimate.reasons.empty(); }
};

// How far the dipole's estimate lies from transport's.
struct DipoleDistance {
  double sigma_s_prime_relative = 0;
  double sigma_a_per_mm = 0;
};
// Empty where there are not two estimates.
std::optional<DipoleDistance> dipole_distance(const ChannelResult& result);

}  // namespace scattermeter
