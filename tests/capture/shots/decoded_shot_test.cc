#include "capture/shots/decoded_shot.h"

#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include "tests/fixtures/capture/decoded_example.h"

namespace scattermeter::capture {
namespace {

TEST(DecodedShot, KeepsEveryBit) {
  const DecodedShot shot = decoded_example();
  const std::vector<std::uint8_t> bytes = to_bytes(shot);
  const std::optional<DecodedShot> back = decoded_shot(bytes);
  ASSERT_TRUE(back);
  EXPECT_EQ(to_bytes(*back), bytes);
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
  EXPECT_EQ(back->exposures[1].pedestal_counts, shot.exposures[1].pedestal_counts);
  EXPECT_EQ(back->exposures[1].pedestal_std_counts, shot.exposures[1].pedestal_std_counts);
  EXPECT_EQ(back->exposures[1].beside_counts, shot.exposures[1].beside_counts);
  EXPECT_EQ(back->frame_mean_counts, shot.frame_mean_counts);
  ASSERT_TRUE(back->edge_blur);
  EXPECT_EQ(back->edge_blur->mm2, shot.edge_blur->mm2);
}

TEST(DecodedShot, BlurThatWasNotLookedForOrNotSeen) {
  DecodedShot shot = decoded_example();
  shot.edge_blur = EdgeBlur{};
  ASSERT_TRUE(decoded_shot(to_bytes(shot))->edge_blur);
  EXPECT_FALSE(decoded_shot(to_bytes(shot))->edge_blur->is_measured);
  shot.edge_blur.reset();
  EXPECT_FALSE(decoded_shot(to_bytes(shot))->edge_blur);
}

// Bytes that are cut short anywhere, or lists that do not fit together.
TEST(DecodedShot, RefusesWhatIsNotAShot) {
  const std::vector<std::uint8_t> bytes = to_bytes(decoded_example());
  for (std::size_t n = 0; n < bytes.size(); n += 1 + n / 50) {
    EXPECT_FALSE(decoded_shot({bytes.data(), n})) << n;
  }
  // Lists in lists without end, and one that claims 2^63 entries.
  EXPECT_FALSE(decoded_shot(std::vector<std::uint8_t>(1'000'000, 0x81)));
  EXPECT_FALSE(decoded_shot(std::vector<std::uint8_t>{0x9b, 0x80, 0, 0, 0, 0, 0, 0, 0, 0}));
  EXPECT_FALSE(decoded_shot(std::vector<std::uint8_t>{0xbb, 0xff, 0, 0, 0, 0, 0, 0, 0, 0}));
  DecodedShot shorter = decoded_example();
  shorter.observation.channel[1].variance.pop_back();
  EXPECT_FALSE(decoded_shot(to_bytes(shorter)));
  DecodedShot uneven = decoded_example();
  uneven.observation.channel[1] = {};
  EXPECT_FALSE(decoded_shot(to_bytes(uneven)));
  DecodedShot counted = decoded_example();
  counted.observation.channel[0].rows_used = 49;
  EXPECT_FALSE(decoded_shot(to_bytes(counted)));
  DecodedShot odd = decoded_example();
  odd.observation.channel[0].state[0] = static_cast<RowState>(200);
  EXPECT_FALSE(decoded_shot(to_bytes(odd)));
}

// A bracket's parts are one per exposure, or there are none.
TEST(DecodedShot, RefusesPartsOfOtherExposures) {
  DecodedShot shot = decoded_example();
  shot.exposures.pop_back();
  EXPECT_FALSE(decoded_shot(to_bytes(shot)));
  for (ChannelObservation& o : shot.observation.channel) o.exposures.clear();
  EXPECT_TRUE(decoded_shot(to_bytes(shot)));
}

}  // namespace
}  // namespace scattermeter::capture
