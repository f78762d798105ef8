#include "apps/instrument/measure.h"

#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/results/result_json.h"
#include "core/base/input_error.h"
#include "tests/fixtures/apps/small_rig.h"

namespace scattermeter::apps {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// The cube of three materials under one LED, shot once for all tests.
class MeasureTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    files_ = new SmallRig;
    files_->keep_shots("_cube_1");
    files_->simulate();
  }
  static void TearDownTestSuite() { delete files_; }
  Measurement measure_with(const MeasureOptions& options) const {
    return measure(rig_, files_->shots(), options);
  }
  static std::vector<std::string> answers(const Measurement& m) {
    std::vector<std::string> out;
    for (const ChannelResult& r : m.results) out.push_back(r.material + " " + r.channel);
    return out;
  }
  static SmallRig* files_;
  Rig rig_ = read_rig(files_->rig());
};
SmallRig* MeasureTest::files_ = nullptr;

TEST_F(MeasureTest, FindsTheTruthAndSaysWhatItRead) {
  const Measurement m = measure_with({});
  EXPECT_THAT(answers(m), ElementsAre("PP R", "PP G", "PP B", "PE R", "PE G", "PE B", "POM R",
                                      "POM G", "POM B"));
  EXPECT_FALSE(m.any_refused());
  for (std::size_t i = 0; i < m.results.size(); ++i) {
    const ChannelResult& r = m.results[i];
    const Medium& truth = rig_.truth.materials.at(r.material)[i % 3];
    // Interval of 95 %: five deviations hold all nine.
    EXPECT_NEAR(r.estimate.sigma_s_prime_per_mm.value, truth.sigma_s_prime_per_mm,
                5.0 * r.estimate.sigma_s_prime_per_mm.std)
        << r.material << r.channel;
    EXPECT_NEAR(r.estimate.sigma_a_per_mm.value, truth.sigma_a_per_mm,
                5.0 * r.estimate.sigma_a_per_mm.std)
        << r.material << r.channel;
    EXPECT_LT(r.estimate.sigma_s_prime_per_mm.std, 0.1 * truth.sigma_s_prime_per_mm);
    EXPECT_EQ(r.eta_int_over_ext, 1.4);
  }
  std::vector<std::string> names;
  for (const InputFile& f : m.inputs) {
    names.push_back(std::filesystem::path(f.path).filename().string());
    EXPECT_EQ(f.sha256.size(), 64U);
  }
  EXPECT_THAT(names, ElementsAre("rig.yaml", "cube.obj", "PP_cube_1.dng", "PE_cube_1.dng",
                                 "POM_cube_1.dng"));
  EXPECT_EQ(m.timing_s.back().first, "total");
  EXPECT_EQ(m.patch_size_mm.size(), 1U);
  EXPECT_TRUE(m.brackets.empty());
  EXPECT_TRUE(m.notes.empty());
}

// A material alone gives the result that it has among others, to rounding.
TEST_F(MeasureTest, OnlyTheMaterialsAskedFor) {
  const Measurement all = measure_with({});
  MeasureOptions options;
  options.materials = {"POM"};
  options.estimate.channels = "GB";
  const Measurement some = measure_with(options);
  EXPECT_THAT(answers(some), ElementsAre("POM G", "POM B"));
  const double among_others = all.results[7].estimate.sigma_a_per_mm.value;
  EXPECT_NEAR(some.results[0].estimate.sigma_a_per_mm.value, among_others, 1e-9 * among_others);
  EXPECT_EQ(some.skipped.shots_not_asked, 2U);
  EXPECT_EQ(some.skipped.channels_not_asked, 1U);
  // Shots of other materials are no strangers in the folder.
  EXPECT_TRUE(some.notes.empty());
  options.materials = {"PVC"};
  try {
    measure_with(options);
    ADD_FAILURE() << "measured PVC";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("no shot is of material PVC (there are: PP, PE, POM)"));
  }
}

TEST_F(MeasureTest, StrangersInTheFolderAreNoted) {
  MeasureOptions options;
  options.materials = {"PE"};
  const std::string stranger = files_->shots() + "/notes.txt";
  write_file(stranger, std::string("x"));
  EXPECT_THAT(measure_with(options).notes,
              ElementsAre("notes.txt: not in the rig's list of shots, skipped"));
  std::filesystem::remove(stranger);
}

// Decoded shots are kept and found again: the same digits.
TEST_F(MeasureTest, KeepsDecodedShots) {
  MeasureOptions options;
  options.materials = {"PE"};
  options.cache_folder = *files_ / "cache";
  const Measurement first = measure_with(options);
  EXPECT_EQ(first.skipped.shots_from_cache, 0U);
  const Measurement second = measure_with(options);
  EXPECT_EQ(second.skipped.shots_from_cache, 1U);
  for (std::size_t i = 0; i < first.results.size(); ++i) {
    EXPECT_EQ(first.results[i].estimate.sigma_s_prime_per_mm.value,
              second.results[i].estimate.sigma_s_prime_per_mm.value);
    EXPECT_EQ(first.results[i].estimate.sigma_a_per_mm.std,
              second.results[i].estimate.sigma_a_per_mm.std);
  }
  // Another rig has other shots.
  rig_.scene.camera.sensor.noise.read_noise_counts = 2.0;
  EXPECT_EQ(measure_with(options).skipped.shots_from_cache, 0U);
}

TEST(Measurement, OneRefusalIsEnough) {
  Measurement m;
  EXPECT_FALSE(m.any_refused());
  m.results.resize(2);
  m.results[0].estimate.converged = m.results[1].estimate.converged = true;
  EXPECT_FALSE(m.any_refused());
  m.results[1].estimate.reasons = {"dark"};
  EXPECT_TRUE(m.any_refused());
}

}  // namespace
}  // namespace scattermeter::apps
