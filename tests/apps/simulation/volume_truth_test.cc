#include "apps/simulation/volume_truth.h"

#include <cmath>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "apps/simulation/bodies_rig.h"

namespace scattermeter::apps {
namespace {

// The noise that is put on the dipole's image is that of the mean of the batches.
TEST(VolumeTruth, DisturbsByTheNoiseOfTheMean) {
  const Medium medium{0.7, 0.1, 1.0};
  const Rig rig = bodies_rig(240, 1.3, {{"m", {medium, medium, medium}}}, {"cube"});
  const ObjectScenes scenes = bodies_scenes(rig);
  const VolumeTruth truth(rig, scenes, {.paths = 4 * 6400, .batches = 4, .seed = 3});
  SampleMap where;  // the frame's middle
  where.x0 = 90;
  where.y0 = 50;
  where.width = where.height = 60;
  const CfaSamples mean = truth.shots()(0, where);
  std::vector<CfaSamples> disturbed;
  for (int b = 0; b < truth.batches(); ++b) disturbed.push_back(truth.disturbed(b)(0, where));
  double change = 0.0, signal = 0.0;
  for (std::size_t i = 0; i < mean.signal_counts.size(); ++i) {
    double dipole = 0.0, square = 0.0;
    for (const CfaSamples& d : disturbed) dipole += d.signal_counts[i] / 4.0;
    for (const CfaSamples& d : disturbed) square += std::pow(d.signal_counts[i] - dipole, 2) / 3.0;
    change += square;
    signal += std::pow(dipole, 2);
    EXPECT_EQ(mean.clipped[i], 0);
  }
  // Root mean square over the samples, weighed by brightness; the patches' median is not far.
  EXPECT_GT(std::sqrt(change / signal), 0.5 * truth.patch_std());
  EXPECT_LT(std::sqrt(change / signal), 2.0 * truth.patch_std());
  // Four times the paths: a half.
  const VolumeTruth finer(rig, scenes, {.paths = 4 * 4 * 6400, .batches = 4, .seed = 3});
  EXPECT_NEAR(finer.patch_std() / truth.patch_std(), 0.5, 0.05);
  // A seed of its own for the sensor's noise.
  const VolumeTruth noisy(rig, scenes,
                          {.paths = 4 * 6400, .batches = 4, .seed = 3, .noise_seed = 8});
  const CfaSamples n = noisy.shots()(0, where);
  double chi2 = 0.0;
  for (std::size_t i = 0; i < n.signal_counts.size(); ++i) {
    chi2 += std::pow(n.signal_counts[i] - mean.signal_counts[i], 2) / n.variance_counts2[i];
  }
  const double dof = 3600.0;  // of mean dof and standard deviation sqrt(2 dof)
  EXPECT_NEAR(chi2, dof, 4.0 * std::sqrt(2.0 * dof));
  EXPECT_THROW(VolumeTruth(rig, scenes, {.batches = 1}), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter::apps
