#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/small_rig.h"
#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(PrintCommand, WritesTheSheetAndTheRigsLines) {
  const TemporaryFolder folder;
  const Answer answer =
      run({"print", "--out", folder / "board.pdf", "--board", "8x6:7:5", "--body", "cube:20"});
  ASSERT_EQ(answer.status, 0) << answer.err;
  EXPECT_THAT(answer.out, HasSubstr("charuco: {squares: [8, 6], square_mm: 7, marker_mm: 5, "
                                    "dictionary: DICT_4X4_50, origin_mm: [-28, -60, 0]}"));
  EXPECT_THAT(slurp(folder / "board.pdf"), StartsWith("%PDF-"));
}

TEST(PrintCommand, BadInputIsNamed) {
  const TemporaryFolder folder;
  EXPECT_THAT(run({"print", "--out", folder / "b.pdf", "--board", "8x6"}).err,
              HasSubstr("--board"));
  EXPECT_THAT(run({"print", "--out", folder / "b.txt"}).err, HasSubstr(".pdf or .png"));
  EXPECT_EQ(run({"print", "--out", folder / "b.pdf", "--paper", "A0"}).status, 2);
}

}  // namespace
}  // namespace scattermeter::apps
