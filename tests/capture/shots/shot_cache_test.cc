#include "capture/shots/shot_cache.h"

#include <chrono>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture/files/digest.h"
#include "tests/fixtures/capture/decoded_example.h"
#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::capture {
namespace {

TEST(ShotCache, FindsWhatItKept) {
  const TemporaryFolder folder;
  const std::string path = folder / "cache";
  const DecodedShot shot = decoded_example();
  {
    ShotCache cache(path);
    EXPECT_FALSE(cache.find("a"));
    cache.keep("a", shot);
    cache.keep("b", shot);
    EXPECT_EQ(cache.problem(), "");
    EXPECT_EQ(cache.found(), 0U);
  }
  ShotCache cache(path);
  const std::optional<DecodedShot> back = cache.find("a");
  ASSERT_TRUE(back);
  EXPECT_EQ(to_bytes(*back), to_bytes(shot));
  EXPECT_EQ(cache.found(), 1U);
  std::ofstream(path + "/notes.txt") << "mine";
  cache.remove_others();
  EXPECT_TRUE(std::filesystem::exists(path + "/a.shot"));
  EXPECT_FALSE(std::filesystem::exists(path + "/b.shot"));
  EXPECT_TRUE(std::filesystem::exists(path + "/notes.txt"));
}

TEST(ShotCache, KnowsItsNewestFile) {
  const TemporaryFolder folder;
  ShotCache cache(folder / "cache");
  EXPECT_FALSE(cache.newest());
  cache.keep("a", decoded_example());
  cache.keep("b", decoded_example());
  const auto time = std::filesystem::last_write_time(folder / "cache/b.shot");
  std::filesystem::last_write_time(folder / "cache/a.shot", time + std::chrono::hours(1));
  EXPECT_EQ(cache.newest(), time + std::chrono::hours(1));
}

// Only what was there before is left.
TEST(ShotCache, Forgets) {
  const TemporaryFolder folder;
  ShotCache made(folder / "out/cache");
  made.keep("a", decoded_example());
  made.forget();
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
  ShotCache(folder / "cache").keep("a", decoded_example());
  ShotCache again(folder / "cache");
  again.keep("b", decoded_example());
  again.forget();
  EXPECT_TRUE(again.find("a"));
  EXPECT_FALSE(again.find("b"));
}

// A byte that changed, half a file, another shot under the name, an empty file.
TEST(ShotCache, DoesNotBelieveADamagedFile) {
  const TemporaryFolder folder;
  ShotCache(folder / "").keep("a", decoded_example());
  std::string content;
  {
    std::ifstream in(folder / "a.shot", std::ios::binary);
    content.assign(std::istreambuf_iterator<char>(in), {});
  }
  const auto found = [&](const std::string& now) {
    std::ofstream(folder / "a.shot", std::ios::binary | std::ios::trunc) << now;
    return ShotCache(folder / "").find("a").has_value();
  };
  EXPECT_TRUE(found(content));
  std::string other = content;
  other[content.size() / 2] = static_cast<char>(other[content.size() / 2] ^ 1);
  EXPECT_FALSE(found(other));
  EXPECT_FALSE(found(content.substr(0, content.size() / 2)));
  EXPECT_FALSE(found(content.substr(0, 30)));
  EXPECT_FALSE(found(""));
  const std::string no_shot = "no shot";
  EXPECT_FALSE(found(Digest().bytes(no_shot.data(), no_shot.size()).hex() + no_shot));
}

TEST(ShotCache, AFolderThatTakesNothingIsNoError) {
  const TemporaryFolder folder;
  std::ofstream(folder / "file") << "in the way";
  ShotCache cache(folder / "file/cache");
  cache.keep("a", decoded_example());
  EXPECT_THAT(cache.problem(), ::testing::HasSubstr("file"));
  cache.remove_others();
}

}  // namespace
}  // namespace scattermeter::capture
