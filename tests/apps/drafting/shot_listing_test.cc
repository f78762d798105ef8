#include "apps/drafting/shot_listing.h"

#include <cstdint>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture/raw/dng_writer.h"
#include "core/base/input_error.h"
#include "tests/fixtures/apps/small_rig.h"
#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::apps {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

void write_shot(const std::string& path, double exposure_s, int width_px = 64) {
  capture::RawMetadata metadata;
  metadata.exposure_s = exposure_s;
  metadata.f_number = 11;
  const std::vector<std::uint16_t> codes(static_cast<std::size_t>(width_px) * 48, 500);
  capture::write_dng(path, width_px, 48, codes, metadata);
}

TEST(ShotListing, ReadsWhatTheRawsSay) {
  const TemporaryFolder folder;
  write_shot(folder / "b.dng", 0.5);
  write_shot(folder / "a.dng", 0.125);
  write_file(folder / "notes.txt", "the second with the lamp on the left");
  write_file(folder / ".hidden", "");
  const ShotListing listing = list_shots(folder.path());
  ASSERT_EQ(listing.shots.size(), 2U);
  EXPECT_EQ(listing.shots[0].file, "a.dng");
  EXPECT_NEAR(listing.shots[0].exposure_s, 0.125, 1e-6);
  EXPECT_EQ(listing.shots[1].file, "b.dng");
  EXPECT_NEAR(listing.shots[1].f_number, 11.0, 1e-6);
  EXPECT_EQ(listing.width_px, 64);
  EXPECT_EQ(listing.height_px, 48);
  EXPECT_THAT(listing.model, HasSubstr("D80"));
  ASSERT_EQ(listing.skipped.size(), 1U);
  EXPECT_THAT(listing.skipped[0], HasSubstr("notes.txt"));
}

TEST(ShotListing, NamesWhatMakesNoRig) {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& part) {
    EXPECT_THAT([&] { list_shots(folder.path()); }, ThrowsMessage<InputError>(HasSubstr(part)));
  };
  message("is empty");
  write_file(folder / "notes.txt", "none");
  message("has no raw that can be read");
  write_shot(folder / "a.dng", 0.1);
  write_shot(folder / "b.dng", 0.1, 80);
  EXPECT_THAT([&] { list_shots(folder.path()); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("b.dng"), HasSubstr("80 x 48"))));
  EXPECT_THROW(list_shots(folder / "nowhere"), MissingFile);
}

}  // namespace
}  // namespace scattermeter::apps
