#include "apps/watching/watched_folder.h"

#include <algorithm>
#include <utility>

#include "capture/files/digest.h"
#include "core/base/input_error.h"

namespace scattermeter::apps {
namespace {

namespace fs = std::filesystem;

constexpr int kLooksUntilGone = 2;

}  // namespace

WatchedFolder::WatchedFolder(std::string folder) : folder_(std::move(folder)) { present(); }

std::string WatchedFolder::path_of(const std::string& name) const {
  return (fs::path(folder_) / name).string();
}

std::map<std::string, WatchedFolder::File> WatchedFolder::present() const {
  std::map<std::string, File> out;
  std::error_code error;
  for (fs::directory_iterator it(folder_, error), end; !error && it != end; it.increment(error)) {
    // A file that vanishes meanwhile is not there.
    std::error_code vanished;
    const std::string name = it->path().filename().string();
    if (name.starts_with(".") || !it->is_regular_file(vanished)) continue;
    File file;
    file.size = it->file_size(vanished);
    file.time = it->last_write_time(vanished);
    if (!vanished && file.size > 0) out[name] = file;
  }
  if (error) throw InputError(folder_, "cannot be watched: " + error.message());
  return out;
}

std::string WatchedFolder::same_contents(const std::string& name) const {
  const std::string& sha256 = files_.at(name).sha256;
  for (const auto& [other, file] : files_) {
    if (other != name && file.sha256 == sha256) return other;
  }
  return "";
}

FolderNews WatchedFolder::completed(const std::string& name) {
  const std::string same = same_contents(name);
  if (same.empty()) return {FolderEvent::kComplete, name, ""};
  if (files_.at(same).looks_missed == 0) return {FolderEvent::kDoubled, name, same};
  files_.erase(same);
  return {FolderEvent::kRenamed, name, same};
}

std::vector<FolderNews> WatchedFolder::look() {
  const std::map<std::string, File> now = present();
  std::vector<std::string> complete;
  for (const auto& [name, seen] : now) {
    const auto [at, is_new] = files_.try_emplace(name, seen);
    File& known = at->second;
    known.looks_missed = 0;
    if (known.size != seen.size || known.time != seen.time) {
      known = seen;
    } else if (!is_new && known.sha256.empty()) {
      complete.push_back(name);
    }
  }
  for (auto& [name, file] : files_) file.looks_missed += now.contains(name) ? 0 : 1;
  std::stable_sort(complete.begin(), complete.end(), [&](const auto& a, const auto& b) {
    return files_.at(a).time < files_.at(b).time;
  });
  std::vector<FolderNews> out;
  for (const std::string& name : complete) {
    try {
      files_.at(name).sha256 = capture::sha256_of_file(path_of(name));
    } catch (const InputError&) {
      continue;  // taken away, or not yet to be read: the next look tells
    }
    out.push_back(completed(name));
  }
  for (auto at = files_.begin(); at != files_.end();) {
    if (at->second.looks_missed < kLooksUntilGone) {
      ++at;
      continue;
    }
    if (!at->second.sha256.empty()) out.push_back({FolderEvent::kGone, at->first, ""});
    at = files_.erase(at);
  }
  return out;
}

}  // namespace scattermeter::apps
