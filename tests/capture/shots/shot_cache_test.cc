#include "capture/shots/shot_cache.h"

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture/files/digest.h"
#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::apps {
namespace {

DecodedShot some_shot() {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  DecodedShot shot;
  for (ChannelObservation& o : shot.observation.channel) {
    for (int j = 0; j < 50; ++j) {
      o.l.push_back(normal(random));
      o.variance.push_back(normal(random));
      o.variance_per_l.push_back(normal(random));
      o.l_per_count.push_back(normal(random));
      o.state.push_back(static_cast<RowState>(j % 8));
      o.rows_used += j % 8 == 0 ? 1 : 0;
    }
    o.l[3] = std::numeric_limits<double>::quiet_NaN();
    o.l[4] = -0.0;
    o.rows_clipped = 7;
    o.rows_floor = 6;
    o.samples = 1234;
    o.samples_clipped = 17;
    o.brightest_counts = 0.1 + 0.2;
    o.brightest_snr = 1e-300;
    o.noise_ratio = 1.0 / 3.0;
    o.exposures = {{o.variance, 11}, {o.l_per_count, 12}};
  }
  shot.exposure_s = 0.1;
  shot.iso = 100;
  shot.f_number = 11;
  shot.exposures = {{"a.dng", 0.1, 0.11, 0.01, 0.2, {std::nan(""), 0.3, 4.0}},
                    {"b \xff.dng", 0.2, 0.22, 0.02, 0.4, {0.1, 0.2, 0.3}}};
  shot.frame_mean_counts = {1.0, 2.0, 3.0};
  return shot;
}

TEST(ShotCache, KeepsEveryBit) {
  const DecodedShot shot = some_shot();
  const std::vector<std::uint8_t> bytes = capture::to_bytes(shot);
  const std::optional<DecodedShot> back = capture::decoded_shot(bytes);
  ASSERT_TRUE(back);
  EXPECT_EQ(capture::to_bytes(*back), bytes);
  const ChannelObservation& a = shot.observation.channel[2];
  const ChannelObservation& b = back->observation.channel[2];
  ASSERT_EQ(a.l.size(), b.l.size());
  EXPECT_EQ(std::memcmp(a.l.data(), b.l.data(), a.l.size() * sizeof(double)), 0);
  EXPECT_EQ(a.state, b.state);
  EXPECT_EQ(a.rows_used, b.rows_used);
  EXPECT_EQ(a.brightest_counts, b.brightest_counts);
  EXPECT_EQ(b.exposures[1].of_row, a.exposures[1].of_row);
  EXPECT_EQ(b.exposures[1].samples, 12U);
  EXPECT_EQ(back->exposures[1].file, "b \xff.dng");
  EXPECT_TRUE(std::isnan(back->exposures[0].departure.log_ratio));
  EXPECT_EQ(back->exposures[1].departure.mean_counts, 0.3);
  EXPECT_EQ(back->frame_mean_counts, shot.frame_mean_counts);
}

// Bytes that are cut short anywhere, or lists that do not fit together.
TEST(ShotCache, RefusesWhatIsNoShot) {
  const std::vector<std::uint8_t> bytes = capture::to_bytes(some_shot());
  for (std::size_t n = 0; n < bytes.size(); n += 1 + n / 50) {
    EXPECT_FALSE(capture::decoded_shot({bytes.data(), n})) << n;
  }
  // Lists in lists without end, and one that claims 2^63 entries.
  EXPECT_FALSE(capture::decoded_shot(std::vector<std::uint8_t>(1'000'000, 0x81)));
  EXPECT_FALSE(
      capture::decoded_shot(std::vector<std::uint8_t>{0x9b, 0x80, 0, 0, 0, 0, 0, 0, 0, 0}));
  EXPECT_FALSE(
      capture::decoded_shot(std::vector<std::uint8_t>{0xbb, 0xff, 0, 0, 0, 0, 0, 0, 0, 0}));
  DecodedShot shorter = some_shot();
  shorter.observation.channel[1].variance.pop_back();
  EXPECT_FALSE(capture::decoded_shot(capture::to_bytes(shorter)));
  DecodedShot uneven = some_shot();
  uneven.observation.channel[1] = {};
  EXPECT_FALSE(capture::decoded_shot(capture::to_bytes(uneven)));
  DecodedShot counted = some_shot();
  counted.observation.channel[0].rows_used = 49;
  EXPECT_FALSE(capture::decoded_shot(capture::to_bytes(counted)));
  DecodedShot odd = some_shot();
  odd.observation.channel[0].state[0] = static_cast<RowState>(200);
  EXPECT_FALSE(capture::decoded_shot(capture::to_bytes(odd)));
}

TEST(ShotCache, FindsWhatItKept) {
  const TemporaryFolder folder;
  const std::string place = folder / "cache";
  const DecodedShot shot = some_shot();
  {
    capture::ShotCache cache(place);
    EXPECT_FALSE(cache.find("a"));
    cache.keep("a", shot);
    cache.keep("b", shot);
    EXPECT_EQ(cache.problem(), "");
    EXPECT_EQ(cache.found(), 0U);
  }
  capture::ShotCache cache(place);
  const std::optional<DecodedShot> back = cache.find("a");
  ASSERT_TRUE(back);
  EXPECT_EQ(capture::to_bytes(*back), capture::to_bytes(shot));
  EXPECT_EQ(cache.found(), 1U);
  std::ofstream(place + "/notes.txt") << "mine";
  cache.remove_others();
  EXPECT_TRUE(std::filesystem::exists(place + "/a.shot"));
  EXPECT_FALSE(std::filesystem::exists(place + "/b.shot"));
  EXPECT_TRUE(std::filesystem::exists(place + "/notes.txt"));
}

// Nothing but what stood there before.
TEST(ShotCache, Forgets) {
  const TemporaryFolder folder;
  capture::ShotCache made(folder / "out/cache");
  made.keep("a", some_shot());
  made.forget();
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
  capture::ShotCache(folder / "cache").keep("a", some_shot());
  capture::ShotCache again(folder / "cache");
  again.keep("b", some_shot());
  again.forget();
  EXPECT_TRUE(again.find("a"));
  EXPECT_FALSE(again.find("b"));
}

// A byte that changed, half a file, another shot under the name, an empty file.
TEST(ShotCache, DoesNotBelieveADamagedFile) {
  const TemporaryFolder folder;
  capture::ShotCache(folder / "").keep("a", some_shot());
  std::string content;
  {
    std::ifstream in(folder / "a.shot", std::ios::binary);
    content.assign(std::istreambuf_iterator<char>(in), {});
  }
  const auto found = [&](const std::string& now) {
    std::ofstream(folder / "a.shot", std::ios::binary | std::ios::trunc) << now;
    return capture::ShotCache(folder / "").find("a").has_value();
  };
  EXPECT_TRUE(found(content));
  std::string other = content;
  other[content.size() / 2] = static_cast<char>(other[content.size() / 2] ^ 1);
  EXPECT_FALSE(found(other));
  EXPECT_FALSE(found(content.substr(0, content.size() / 2)));
  EXPECT_FALSE(found(content.substr(0, 30)));
  EXPECT_FALSE(found(""));
  const std::string no_shot = "no shot";
  EXPECT_FALSE(found(capture::Digest().bytes(no_shot.data(), no_shot.size()).hex() + no_shot));
}

TEST(ShotCache, AFolderThatTakesNothingIsNoError) {
  const TemporaryFolder folder;
  std::ofstream(folder / "file") << "in the way";
  capture::ShotCache cache(folder / "file/cache");
  cache.keep("a", some_shot());
  EXPECT_THAT(cache.problem(), ::testing::HasSubstr("file"));
  cache.remove_others();
}

TEST(Digest, OfKnownTexts) {
  // FIPS 180-2, appendix B.1.
  EXPECT_EQ(capture::Digest().bytes("abc", 3).hex(),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_NE(capture::Digest().text("ab").text("c").hex(),
            capture::Digest().text("a").text("bc").hex());
  EXPECT_NE(capture::Digest().number(0.0).hex(), capture::Digest().number(-0.0).hex());
}

}  // namespace
}  // namespace scattermeter::apps
