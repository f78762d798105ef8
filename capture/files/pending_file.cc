#include "capture/files/pending_file.h"

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

#include "core/base/input_error.h"

namespace scattermeter::capture {
namespace {

std::string reason(int error) { return std::generic_category().message(error); }

}  // namespace

PendingFile::PendingFile(std::string path) : path_(std::move(path)) {
  // Process id and counter keep writers apart; a leftover of a killed process with the same id is
  // skipped, never overwritten. mkstemp() is not used because only the owner can read its files.
  static std::atomic<unsigned> counter{0};
  do {
    temporary_path_ =
        path_ + ".part-" + std::to_string(::getpid()) + "-" + std::to_string(counter++);
    descriptor_ = ::open(temporary_path_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  } while (descriptor_ < 0 && errno == EEXIST);
  if (descriptor_ < 0) throw InputError(path_, "cannot be written: " + reason(errno));
}

PendingFile::~PendingFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!temporary_path_.empty()) ::unlink(temporary_path_.c_str());
}

void PendingFile::commit() {
  // Network file systems report a full disk only here.
  const int closed = ::close(std::exchange(descriptor_, -1));
  if (closed != 0) throw InputError(path_, "cannot be written: " + reason(errno));
  if (std::rename(temporary_path_.c_str(), path_.c_str()) != 0) {
    throw InputError(path_, "cannot be written: " + reason(errno));
  }
  temporary_path_.clear();
}

void make_folder_of(const std::string& path) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  std::error_code error;
  if (!folder.empty()) std::filesystem::create_directories(folder, error);
  if (error) throw InputError(folder.string(), "the folder cannot be made: " + error.message());
}

void write_all(int descriptor, std::string_view bytes, const std::string& path) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) throw InputError(path, "cannot be written: " + reason(errno));
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

void write_text_file(const std::string& path, std::string_view bytes) {
  make_folder_of(path);
  PendingFile file(path);
  write_all(file.descriptor(), bytes, path);
  file.commit();
}

}  // namespace scattermeter::capture
