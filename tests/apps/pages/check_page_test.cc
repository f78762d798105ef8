#include "apps/pages/check_page.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/checked_small_rig.h"
#include "tests/fixtures/apps/html_check.h"
#include "tests/fixtures/apps/made_check.h"
#include "tests/fixtures/apps/made_checked_rig.h"

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
    EXPECT_THAT(page, Not(HasSubstr("<script>x"))) << name;
    EXPECT_THAT(page, HasSubstr("data-widget=\"rig\"")) << name;
  }
  EXPECT_THAT(slurp(rig.out() + "/result.html"), HasSubstr("data-widget=\"plot\""));
}

TEST(CheckPage, HoldsEveryValue) {
  MadeCheckedRig made(2);
  made.checked.frames[1].png = "\x89PNG";
  made.checked.shots[1].exposure_s = 0.25;
  made.checked.shots[1].observation.channel[2].samples_clipped = 17;
  const std::string page = check_page(made.checked, made_check(), "scattermeter check <x>");
  EXPECT_EQ(html_problem(page), "");
  for (const char* text :
       {"1 of 3 checks failed.", "rig.yaml, 2 shots. scattermeter check &lt;x&gt;",
        "a.dng &lt;R&gt;", "expose longer", "c.dng: skipped", "pose: 2 values",
        "data:image/png;base64,iVBORw==",
        "b.dng: cube of m, lit by led1; 0.25 s, f/8, ISO 100; 17 samples clipped"}) {
    EXPECT_THAT(page, HasSubstr(text));
  }
  CheckReport passed = made_check();
  passed.items.erase(passed.items.begin() + 1);
  EXPECT_THAT(check_page(made.checked, passed, ""), HasSubstr("All 2 checks passed."));
}

}  // namespace
}  // namespace scattermeter::apps
