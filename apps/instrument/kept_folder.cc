#include "apps/instrument/kept_folder.h"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include <oneapi/tbb/parallel_for.h>

#include "capture/files/checked_file.h"
#include "core/base/input_error.h"

namespace scattermeter::apps {
namespace {

namespace fs = std::filesystem;

}  // namespace

KeptFolder::KeptFolder(std::string folder, std::string ending, std::uintmax_t most_bytes)
    : folder_(std::move(folder)), ending_(std::move(ending)), most_bytes_(most_bytes) {}

std::string KeptFolder::path_of(const std::string& name) const {
  return folder_ + "/" + name + ending_;
}

std::optional<std::string> KeptFolder::find(const std::string& name) {
  const std::string path = path_of(name);
  std::optional<std::string> content = capture::read_checked_file(path);
  if (!content) return std::nullopt;
  std::error_code ignored;
  fs::last_write_time(path, fs::file_time_type::clock::now(), ignored);
  return content;
}

void KeptFolder::keep(const std::string& name, std::string bytes) {
  const std::lock_guard lock(mutex_);
  waiting_.emplace_back(path_of(name), std::move(bytes));
}

std::string KeptFolder::write() {
  std::vector<std::pair<std::string, std::string>> files;
  {
    const std::lock_guard lock(mutex_);
    files.swap(waiting_);
  }
  if (files.empty()) return "";
  std::vector<std::string> problems(files.size());
  tbb::parallel_for(std::size_t{0}, files.size(), [&](std::size_t i) {
    try {
      capture::write_checked_file(files[i].first, files[i].second);
    } catch (const InputError& e) {
      problems[i] = e.what();
    }
  });
  remove_oldest();
  const auto first = std::find_if(problems.begin(), problems.end(),
                                  [](const std::string& p) { return !p.empty(); });
  return first == problems.end() ? "" : *first;
}

void KeptFolder::remove_oldest() {
  std::error_code ignored;
  std::vector<std::pair<fs::file_time_type, fs::path>> files;
  std::uintmax_t bytes = 0;
  for (const auto& entry : fs::directory_iterator(folder_, ignored)) {
    if (entry.path().extension() != ending_) continue;
    // Another program may have removed it since.
    std::error_code gone;
    const std::uintmax_t size = entry.file_size(gone);
    const fs::file_time_type used = gone ? fs::file_time_type{} : entry.last_write_time(gone);
    if (gone) continue;
    bytes += size;
    files.emplace_back(used, entry.path());
  }
  if (bytes <= most_bytes_) return;
  std::sort(files.begin(), files.end());
  for (const auto& [used, path] : files) {
    if (bytes <= most_bytes_) return;
    const std::uintmax_t size = fs::file_size(path, ignored);
    if (!ignored && fs::remove(path, ignored)) bytes -= size;
  }
}

}  // namespace scattermeter::apps
