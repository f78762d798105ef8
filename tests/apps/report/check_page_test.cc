#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/checked_small_rig.h"
#include "tests/fixtures/apps/html_check.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// Names from the rig stay text.
TEST(CheckPage, PagesEscapeNames) {
  SmallRig rig;
  rig.keep_shots("PE_cube");
  std::string text = rig.text();
  for (std::size_t at = 0; (at = text.find("material: PE", at)) != std::string::npos;) {
    text.replace(at, 12, "material: \"<script>x</script>&\"");
    at += 20;
  }
  rig.write(replaced(text, "    PE: {", "    \"<script>x</script>&\": {"));
  rig.simulate();
  EXPECT_EQ(check(rig).answer.status, 0);
  EXPECT_EQ(rig.measure().status, 0);
  for (const char* name : {"/check.html", "/result.html"}) {
    const std::string page = slurp(rig.out() + name);
    EXPECT_EQ(html_problem(page), "") << name;
    EXPECT_THAT(page, HasSubstr("&lt;script&gt;x&lt;/script&gt;&amp;")) << name;
    EXPECT_THAT(page, Not(HasSubstr("<script"))) << name;
  }
  EXPECT_THAT(slurp(rig.out() + "/result.html"), HasSubstr("data:image/svg+xml"));
}

}  // namespace
}  // namespace scattermeter::apps
