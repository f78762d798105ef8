#include "capture/pending_file.h"

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

#include "core/input_error.h"

namespace scattermeter::capture {
namespace {

std::string reason(int error) { return std::generic_category().message(error); }

}  // namespace

PendingFile::PendingFile(std::string path) : path_(std::move(path)) {
  // Process id and counter keep writers apart; a leftover of a killed process with the same id is
  // stepped over, never overwritten. mkstemp would do, but makes files that only the owner reads.
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

}  // namespace scattermeter::capture
