#include "apps/pages/watch_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/html_check.h"

namespace scattermeter::apps {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

RunningAnswer running() {
  RunningAnswer out;
  out.channels.resize(2);
  out.channels[0].channel = 'R';
  out.channels[0].estimate.sigma_s_prime_per_mm = normal_quantity(0.62, 0.0062);
  out.channels[0].estimate.sigma_a_per_mm = normal_quantity(0.002, 0.0002);
  out.channels[1].channel = 'G';
  out.channels[1].estimate.reasons = {"too dark"};
  out.next = "b.dng";
  out.with_next = {{0.008, 0.07}, {0.0, 0.0}};
  return out;
}

TEST(WatchPage, AnswersSayWhatTheNextShotAdds) {
  EXPECT_THAT(answer_lines(running()),
              ElementsAre("R sigma_s' 0.6200 ± 0.0062, sigma_a 0.00200 ± 0.00020 /mm (1 % and 10 "
                          "%; with b.dng 0.8 % and 7 %)",
                          "G not yet: too dark"));
}

TEST(WatchPage, ShowsTheStateAndReloadsUntilAllIsThere) {
  WatchState state;
  state.title = "card, <rig>";
  state.files = {{"a.dng", 0, 0, "card/DSC_1.NEF"}, {"b.dng", 1, 0, ""}};
  state.next = "b.dng: cube of PP, lit by led2";
  TakenShot taken{"card/DSC_1.NEF", "a.dng", {{}, {"outline 0.1 px off"}, {}}, "PNG", true};
  state.taken["a.dng"] = taken;
  taken.verdict.problems = {"overexposed"};
  state.rejected = {taken};
  state.answers["PP"] = running();
  state.lines = {{"DSC_1.NEF: taken", "pass"}};
  const std::string page = watch_page(state);
  EXPECT_EQ(html_problem(page), "");
  for (const char* text :
       {"1 of 2 shots taken", "Next: b.dng: cube of PP, lit by led2", "DSC_1.NEF: taken as a.dng",
        "rejected: overexposed", "awaited", "outline 0.1 px off", "card, &lt;rig&gt;",
        "G not yet: too dark", "http-equiv=\"refresh\" content=\"2\""}) {
    EXPECT_THAT(page, HasSubstr(text));
  }
  state.files[1].taken_from = "card/DSC_2.NEF";
  state.next.clear();
  EXPECT_THAT(watch_page(state), HasSubstr("All shots are there."));
  EXPECT_THAT(watch_page(state), Not(HasSubstr("refresh")));
}

}  // namespace
}  // namespace scattermeter::apps
