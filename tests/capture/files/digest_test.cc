#include "capture/files/digest.h"

#include <string>

#include <gtest/gtest.h>

#include "core/base/input_error.h"
#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::capture {
namespace {

constexpr const char* kOfAbc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";

// FIPS 180-4, the examples that NIST publishes for SHA-256: one block, two blocks, a million times
// "a"; and the empty message.
TEST(Digest, OfThePublishedMessages) {
  EXPECT_EQ(Digest().bytes("abc", 3).hex(), kOfAbc);
  const std::string two = "abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq";
  EXPECT_EQ(Digest().bytes(two.data(), two.size()).hex(),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(Digest().hex(), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  const std::string thousand(1000, 'a');
  Digest million;
  for (int i = 0; i < 1000; ++i) million.bytes(thousand.data(), thousand.size());
  EXPECT_EQ(million.hex(), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Digest, ReadsBytesAsOneSequence) {
  EXPECT_EQ(Digest().bytes("a", 1).bytes("bc", 2).hex(), kOfAbc);
}

TEST(Digest, KeepsTextsAndNumbersApart) {
  EXPECT_NE(Digest().text("ab").text("c").hex(), Digest().text("a").text("bc").hex());
  EXPECT_NE(Digest().text("").hex(), Digest().hex());
  EXPECT_NE(Digest().number(0.0).hex(), Digest().number(-0.0).hex());
  const double two[] = {1.5, 2.5};
  EXPECT_EQ(Digest().numbers(two).hex(), Digest().number(1.5).number(2.5).hex());
}

TEST(Digest, OfAFileIsThatOfItsBytes) {
  const TemporaryFolder folder;
  write_file(folder / "abc", std::string("abc"));
  EXPECT_EQ(sha256_of_file(folder / "abc"), kOfAbc);
  // Longer than a block of reading.
  write_file(folder / "long", std::string(3'000'001, 'x'));
  Digest expected;
  const std::string xs(3'000'001, 'x');
  EXPECT_EQ(sha256_of_file(folder / "long"), expected.bytes(xs.data(), xs.size()).hex());
  EXPECT_THROW(sha256_of_file(folder / "missing"), MissingFile);
}

TEST(FileDigests, ReadsAFileOnce) {
  const TemporaryFolder folder;
  write_file(folder / "abc", std::string("abc"));
  FileDigests digests;
  EXPECT_EQ(digests.of(folder / "abc"), kOfAbc);
  write_file(folder / "abc", std::string("something else"));
  EXPECT_EQ(digests.of(folder / "abc"), kOfAbc);
  EXPECT_NE(FileDigests().of(folder / "abc"), kOfAbc);
}

}  // namespace
}  // namespace scattermeter::capture
