#include <chrono>
#include <filesystem>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/html_check.h"
#include "tests/fixtures/apps/small_rig.h"

namespace scattermeter::apps {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

TEST(WatchCommand, TakesWhatIsThereAndSaysWhatIsMissing) {
  SmallRig files;
  files.keep_shots("PP_cube");
  files.simulate();
  fs::create_directory(files / "card");
  fs::copy_file(files.shots() + "/PP_cube_1.dng", files / "card/DSC_1.dng");
  fs::copy_file(files.shots() + "/PP_cube_1.dng", files / "card/DSC_1b.dng");
  write_file(files / "card/notes.txt", "to do");
  const std::vector<std::string> watch = {"watch",     files / "card", "--rig",
                                          files.rig(), "--out",        files.out(),
                                          "--once",    "--interval",   "0.05"};
  const Answer one = run(watch);
  EXPECT_EQ(one.status, 1) << one.err;
  EXPECT_THAT(one.out, HasSubstr(".dng: taken as PP_cube_1.dng"));
  EXPECT_THAT(one.out, HasSubstr("the same as DSC_1"));
  EXPECT_THAT(one.out, HasSubstr("notes.txt: not taken"));
  EXPECT_THAT(one.out, HasSubstr("with PP_cube_2.dng"));
  EXPECT_THAT(one.out, HasSubstr("1 shot is still awaited"));
  const std::string page = slurp(files.out() + "/watch.html");
  EXPECT_EQ(html_problem(page), "");
  EXPECT_THAT(page, HasSubstr("http-equiv=\"refresh\""));
  EXPECT_THAT(page, HasSubstr("Next: PP_cube_2.dng: cube of PP, lit by led2"));
  fs::copy_file(files.shots() + "/PP_cube_2.dng", files / "card/DSC_2.dng");
  const Answer both = run(watch);
  EXPECT_EQ(both.status, 0) << both.err;
  EXPECT_THAT(both.out, HasSubstr("all shots are there; next: scattermeter measure"));
  EXPECT_THAT(slurp(files.out() + "/watch.html"), Not(HasSubstr("http-equiv=\"refresh\"")));
  const Answer measured =
      run({"measure", files.out() + "/shots", "--rig", files.rig(), "--out", files.out()});
  EXPECT_EQ(measured.status, 0) << measured.err << measured.out;
}

// A file under the name of the other shot is refused; given its right name, it is taken.
TEST(WatchCommand, TakesARejectedFileUnderItsRightName) {
  SmallRig files;
  files.keep_shots("PP_cube");
  files.simulate();
  const fs::path card = files / "card";
  fs::create_directory(card);
  fs::copy_file(files.shots() + "/PP_cube_2.dng", card / "PP_cube_1.dng");
  std::thread user([&] {
    // Renamed as soon as it has been looked at.
    for (int i = 0; i < 1000 && !fs::exists(files.out() + "/watch.html"); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    while (slurp(files.out() + "/watch.html").find("TAKE AGAIN") == std::string::npos) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    fs::rename(card / "PP_cube_1.dng", card / "PP_cube_2.dng");
    fs::copy_file(files.shots() + "/PP_cube_1.dng", card / "PP_cube_1.dng");
  });
  const Answer all =
      run({"watch", card, "--rig", files.rig(), "--out", files.out(), "--interval", "0.05"});
  user.join();
  EXPECT_EQ(all.status, 0) << all.err << all.out;
  EXPECT_THAT(all.out, HasSubstr("PP_cube_1.dng: TAKE AGAIN"));
  EXPECT_THAT(all.out, HasSubstr("PP_cube_2.dng: taken as PP_cube_2.dng"));
}

TEST(WatchCommand, BadInputIsNamed) {
  SmallRig files;
  EXPECT_THAT(run({"watch", files / "nothing", "--rig", files.rig(), "--out", files.out()}).err,
              HasSubstr("nothing"));
  fs::create_directory(files / "card");
  EXPECT_THAT(run({"watch", files / "card", "--rig", files.rig(), "--out", files / "card"}).err,
              HasSubstr("--out"));
}

}  // namespace
}  // namespace scattermeter::apps
