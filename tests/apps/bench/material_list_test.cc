#include "apps/bench/material_list.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/input_error.h"
#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::apps {
namespace {

class MaterialListTest : public ::testing::Test {
 protected:
  std::vector<ListedMaterial> read(const std::string& text) {
    const std::string path = folder_ / "list.csv";
    std::ofstream(path) << text;
    return read_materials(path);
  }
  std::string problem(const std::string& text) {
    try {
      read(text);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }
  TemporaryFolder folder_;
};

constexpr const char* kHeader = "channel,name,more,sigma_s_prime_per_mm,sigma_a_per_mm,eta\n";

TEST_F(MaterialListTest, ColumnsByName) {
  const auto list =
      read(std::string(kHeader) + "R,milk,9,0.7,0.0014,1.3\r\n\nB,milk,,1.9,1e-2,1.3\n");
  ASSERT_EQ(list.size(), 2U);
  EXPECT_EQ(list[0].name, "milk");
  EXPECT_EQ(list[1].channel, 'B');
  EXPECT_DOUBLE_EQ(list[0].medium.sigma_s_prime_per_mm, 0.7);
  EXPECT_DOUBLE_EQ(list[1].medium.sigma_a_per_mm, 0.01);
  EXPECT_DOUBLE_EQ(list[1].medium.eta_int_over_ext, 1.3);
}

TEST_F(MaterialListTest, NamesWhatIsWrong) {
  using ::testing::AllOf;
  using ::testing::HasSubstr;
  const std::string header = kHeader;
  EXPECT_THAT(problem("name,channel\n"), HasSubstr("no column eta"));
  EXPECT_THAT(problem(header), HasSubstr("no material"));
  EXPECT_THAT(problem(header + "R,milk,9,0.7,zero,1.3\n"),
              AllOf(HasSubstr("list.csv:2: sigma_a_per_mm"), HasSubstr("'zero'")));
  EXPECT_THAT(problem(header + "R,milk,9,0.7,nan,1.3\n"), HasSubstr("'nan'"));
  EXPECT_THAT(problem(header + "R,milk,9,-1,1,1.3\n"), HasSubstr("sigma_s_prime_per_mm"));
  EXPECT_THAT(problem(header + "X,milk,9,1,1,1.3\n"), HasSubstr("'X'"));
  EXPECT_THAT(problem(header + "R,milk,9,1,1\n"), HasSubstr("5 fields, the header 6"));
  EXPECT_THAT(problem(header + "R,milk,9,1,1,1.3\nR,milk,9,1,1,1.3\n"), HasSubstr("twice"));
  EXPECT_THAT(problem(header + "R,milk,9,1,1,1.3\nG,milk,9,1,1,1.4\n"),
              HasSubstr("list.csv:3: eta"));
  EXPECT_THROW(read_materials("/nowhere.csv"), InputError);
}

TEST(WellKnownMaterials, AreWhole) { EXPECT_EQ(well_known_materials().size(), 12U); }

}  // namespace
}  // namespace scattermeter::apps
