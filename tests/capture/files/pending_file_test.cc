#include "capture/files/pending_file.h"

#include <array>
#include <csignal>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/time.h>
#include <unistd.h>

#include "core/base/input_error.h"
#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::capture {
namespace {

std::string message_of(const std::string& path) {
  try {
    PendingFile file(path);
    file.commit();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

std::string text_of(const std::string& path) {
  const std::vector<std::uint8_t> bytes = read_file(path);
  return {bytes.begin(), bytes.end()};
}

TEST(PendingFile, AppearsOnlyByCommit) {
  const TemporaryFolder folder;
  const std::string path = folder / "out.txt";
  {
    PendingFile file(path);
    ASSERT_EQ(::write(file.descriptor(), "new", 3), 3);
    EXPECT_FALSE(std::filesystem::exists(path));
    file.commit();
  }
  EXPECT_EQ(text_of(path), "new");
  EXPECT_EQ(folder.entries(), 1);
}

TEST(PendingFile, WithoutCommitLeavesWhatWasThere) {
  const TemporaryFolder folder;
  const std::string path = folder / "out.txt";
  write_file(path, std::string("old"));
  {
    PendingFile file(path);
    ASSERT_EQ(::write(file.descriptor(), "new", 3), 3);
    EXPECT_EQ(folder.entries(), 2);
  }
  EXPECT_EQ(text_of(path), "old");
  EXPECT_EQ(folder.entries(), 1);
}

TEST(PendingFile, TwoWritersOfOneNameDoNotMix) {
  const TemporaryFolder folder;
  PendingFile a(folder / "out.txt");
  PendingFile b(folder / "out.txt");
  EXPECT_NE(a.temporary_path(), b.temporary_path());
}

TEST(PendingFile, NamesTheFileThatCannotBeWritten) {
  const TemporaryFolder folder;
  const std::string lost = folder / "nowhere/out.txt";
  EXPECT_EQ(message_of(lost), lost + ": cannot be written: No such file or directory");
  const std::string occupied = folder / "occupied";
  std::filesystem::create_directory(occupied);
  EXPECT_EQ(message_of(occupied), occupied + ": cannot be written: Is a directory");
  EXPECT_EQ(folder.entries(), 1);
}

TEST(WriteTextFile, CreatesFoldersAndReplacesTheFile) {
  const TemporaryFolder folder;
  const std::string path = folder / "new/folder/out.txt";
  write_text_file(path, "first");
  write_text_file(path, "second");
  EXPECT_EQ(text_of(path), "second");
  EXPECT_EQ(folder.entries(), 1);
}

TEST(WriteTextFile, NamesTheFileThatCannotBeWritten) {
  try {
    write_text_file("/proc/nowhere/out.txt", "text");
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::StartsWith("/proc/nowhere"));
  }
  try {
    write_all(-1, "text", "out.txt");
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "out.txt: cannot be written: Bad file descriptor");
  }
}

// A timer interrupts the writes to a pipe whose reader is late: a write that waits for room fails
// with EINTR, and one that has begun ends early.
TEST(WriteAll, ContinuesAfterSignals) {
  static volatile std::sig_atomic_t signals = 0;
  std::array<int, 2> ends{};
  ASSERT_EQ(::pipe(ends.data()), 0);
  struct sigaction count {};
  struct sigaction before {};
  count.sa_handler = [](int) { signals = signals + 1; };
  ASSERT_EQ(::sigaction(SIGALRM, &count, &before), 0);  // without SA_RESTART
  sigset_t alarm;
  sigemptyset(&alarm);
  sigaddset(&alarm, SIGALRM);
  pthread_sigmask(SIG_BLOCK, &alarm, nullptr);  // for the reader, which inherits it
  std::string received;
  std::thread reader([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    std::array<char, 4096> buffer{};
    for (ssize_t n = 0; (n = ::read(ends[0], buffer.data(), buffer.size())) > 0;) {
      received.append(buffer.data(), static_cast<std::size_t>(n));
    }
  });
  pthread_sigmask(SIG_UNBLOCK, &alarm, nullptr);
  const itimerval every_ms{{0, 1000}, {0, 1000}};
  ::setitimer(ITIMER_REAL, &every_ms, nullptr);
  std::string sent;
  for (int i = 0; i < 300'000; ++i) sent += static_cast<char>(i % 251);
  EXPECT_NO_THROW(write_all(ends[1], sent, "pipe"));
  const itimerval never{};
  ::setitimer(ITIMER_REAL, &never, nullptr);
  ::close(ends[1]);
  reader.join();
  ::close(ends[0]);
  ::sigaction(SIGALRM, &before, nullptr);
  EXPECT_GT(signals, 0);
  EXPECT_EQ(received, sent);
}

}  // namespace
}  // namespace scattermeter::capture
