#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/html_check.h"
#include "tests/fixtures/apps/made_result.h"
#include "tests/fixtures/apps/small_rig.h"
#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

class CompareCommand : public ::testing::Test {
 protected:
  CompareCommand() {
    nlohmann::json json = made_result({{"PP", {{0.62, 0.7, 0.8}, {0.001, 0.001, 0.002}}},
                                       {"POM", {{9.0, 10.0, 11.0}, {0.002, 0.002, 0.004}}}});
    json["inputs"] = {{{"file", "rig.yaml"}, {"sha256", "12ab"}}};
    write_file(first_, json.dump());
  }
  TemporaryFolder folder_;
  std::string first_ = folder_ / "a.json";
};

TEST_F(CompareCommand, StatusTellsWhetherMaterialsDiffer) {
  const Answer same = run({"compare", first_, first_});
  EXPECT_EQ(same.status, 0) << same.err;
  EXPECT_THAT(same.out, HasSubstr("PP: no difference found (p = 1)"));
  EXPECT_THAT(same.out, HasSubstr("counted once"));
  const Answer other = run({"compare", first_, first_, "--material", "PP=POM"});
  EXPECT_EQ(other.status, 1) << other.err;
  EXPECT_THAT(other.out, HasSubstr("PP and POM: different"));
}

TEST_F(CompareCommand, WritesAPage) {
  const Answer a = run({"compare", first_, first_, "--out", folder_ / "page"});
  EXPECT_EQ(a.status, 0) << a.err;
  EXPECT_THAT(a.out, HasSubstr("written: " + (folder_ / "page/compare.html")));
  EXPECT_EQ(html_problem(slurp(folder_ / "page/compare.html")), "");
}

TEST_F(CompareCommand, FindsKnownMaterials) {
  const Answer published = run({"compare", first_, "--library", "--material", "PP"});
  EXPECT_THAT(published.out, HasSubstr("like PP"));
  EXPECT_THAT(published.out, HasSubstr("Jensen et al. 2001"));
  write_file(folder_ / "b.json", slurp(first_));
  const Answer own = run({"compare", first_, "--library", folder_.path()});
  EXPECT_EQ(own.status, 0) << own.err;
  EXPECT_THAT(own.out, HasSubstr("POM: may be POM"));
  EXPECT_EQ(run({"compare", first_, first_, "--library"}).status, 2);
  EXPECT_THAT(run({"compare", first_, "--library", folder_ / "none"}).err, HasSubstr("none"));
  EXPECT_THAT(run({"compare", first_}).err, HasSubstr("needs a second result, or --library"));
}

TEST_F(CompareCommand, BadInputIsNamed) {
  EXPECT_EQ(run({"compare", first_}).status, 2);
  const Answer none = run({"compare", first_, first_, "--material", "PPP"});
  EXPECT_EQ(none.status, 2);
  EXPECT_THAT(none.err, HasSubstr("did you mean PP"));
  write_file(folder_ / "b.json", std::string("{}"));
  EXPECT_THAT(run({"compare", first_, folder_ / "b.json"}).err, HasSubstr("b.json"));
}

}  // namespace
}  // namespace scattermeter::apps
