#include "capture/raw/nikon_maker_note.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scattermeter::capture {
namespace {

using testing::ElementsAre;

std::vector<std::uint8_t> part(const std::vector<std::uint8_t>& bytes, std::size_t from,
                               std::size_t count) {
  return {bytes.begin() + static_cast<std::ptrdiff_t>(from),
          bytes.begin() + static_cast<std::ptrdiff_t>(from + count)};
}

// Value of a field in the note, whose own TIFF file begins at byte 10; empty if it is not there.
std::vector<std::uint8_t> field(const std::vector<std::uint8_t>& note, unsigned tag,
                                std::size_t bytes) {
  for (std::size_t at = 20; at + 12 <= note.size() && at < 20 + 12U * note[19]; at += 12) {
    if ((note[at] << 8U | note[at + 1]) != static_cast<int>(tag)) continue;
    if (bytes <= 4) return part(note, at + 8, bytes);
    return part(note, 10U + (note[at + 10] << 8U | note[at + 11]), bytes);
  }
  return {};
}

TEST(NikonMakerNote, HoldsTheTable) {
  RawMetadata metadata;
  metadata.linearization_table = {0, 1, 3, 300};
  metadata.iso = 1600;
  const std::vector<std::uint8_t> note = nikon_maker_note(metadata, 328);
  EXPECT_THAT(part(note, 0, 18),
              ElementsAre('N', 'i', 'k', 'o', 'n', 0, 2, 16, 0, 0, 'M', 'M', 0, 42, 0, 0, 0, 8));
  // Version, four predictions, number of entries, entries.
  EXPECT_THAT(field(note, 0x96, 20),
              ElementsAre(0x44, 0x10, 1, 72, 1, 72, 1, 72, 1, 72, 0, 4, 0, 0, 0, 1, 0, 3, 1, 44));
  EXPECT_THAT(field(note, 0x02, 4), ElementsAre(0, 0, 6, 64));
  EXPECT_THAT(field(note, 0x93, 2), ElementsAre(0, 1));
  EXPECT_TRUE(field(note, 0x3d, 8).empty());
}

TEST(NikonMakerNote, BlackOfEveryPhase) {
  RawMetadata metadata;
  metadata.linearization_table = {0, 1};
  metadata.cfa = cfa_pattern_from_name("GBRG");
  metadata.black_counts = {10, 20, 30, 40};  // green of the blue row, blue, red, green
  EXPECT_THAT(field(nikon_maker_note(metadata, 0), 0x3d, 8),
              ElementsAre(0, 120, 0, 160, 0, 40, 0, 80));
}

}  // namespace
}  // namespace scattermeter::capture
