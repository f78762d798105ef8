#include "apps/instrument/outline_finding.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scattermeter::apps {
namespace {

using calib::OutlineCause;
using ::testing::HasSubstr;

calib::OutlineDiagnosis diagnosis_of(const std::vector<OutlineCause>& causes) {
  calib::OutlineDiagnosis d;
  d.agrees = false;
  d.explanations.emplace_back();  // the rig as it is
  for (std::size_t k = 0; k < causes.size(); ++k) {
    calib::OutlineExplanation& e = d.explanations.emplace_back();
    e.cause = causes[k];
    e.text = "cause " + std::to_string(k);
  }
  return d;
}

TEST(OutlineFinding, NamesTheCauseAndTheNextStep) {
  calib::OutlineDiagnosis d =
      diagnosis_of({OutlineCause::kMeshScale, OutlineCause::kMeshDisplaced});
  d.likely = 1;
  const Finding f = outline_finding(d, "cube");
  EXPECT_EQ(f.cause, "mesh scaled");
  EXPECT_EQ(f.text, "cause 0");
  EXPECT_THAT(f.advice, HasSubstr("scale the mesh of objects.cube"));
  EXPECT_TRUE(f.shots.empty());
}

TEST(OutlineFinding, ListsWhatCannotBeToldFromIt) {
  calib::OutlineDiagnosis d =
      diagnosis_of({OutlineCause::kMeshDisplaced, OutlineCause::kMeshTurned,
                    OutlineCause::kMeshMisplaced, OutlineCause::kMeshScale});
  d.likely = 3;
  const Finding f = outline_finding(d, "pyramid");
  EXPECT_EQ(f.cause, "mesh displaced");
  EXPECT_EQ(f.text, "cause 0 (cannot be told from: cause 1, cause 2)");
  EXPECT_THAT(f.advice, HasSubstr("objects.pyramid"));
}

TEST(OutlineFinding, CameraAndShot) {
  EXPECT_THAT(outline_finding(diagnosis_of({OutlineCause::kCamera}), "").advice,
              HasSubstr("pose points again"));
  const Finding f = outline_finding(diagnosis_of({OutlineCause::kShotMoved}), "");
  EXPECT_EQ(f.cause, "shot moved");
  EXPECT_THAT(f.advice, HasSubstr("take this shot again"));
}

}  // namespace
}  // namespace scattermeter::apps
