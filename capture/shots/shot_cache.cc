#include "capture/shots/shot_cache.h"

#include <filesystem>
#include <system_error>
#include <utility>
#include <vector>

#include "capture/files/checked_file.h"
#include "core/base/input_error.h"

namespace scattermeter::capture {
namespace {

constexpr const char* kEnding = ".shot";

}  // namespace

ShotCache::ShotCache(std::string folder) : folder_(std::move(folder)) {
  std::error_code ignored;
  for (std::filesystem::path at = folder_; !at.empty() && !std::filesystem::exists(at, ignored);
       at = at.parent_path()) {
    new_folders_.push_back(at.string());
  }
}

void ShotCache::forget() {
  const std::lock_guard lock(mutex_);
  std::error_code ignored;
  for (const std::string& name : kept_) std::filesystem::remove(folder_ + "/" + name, ignored);
  // Folders that contain anything else by now are not removed.
  for (const std::string& name : new_folders_) std::filesystem::remove(name, ignored);
}

std::string ShotCache::path_of(const std::string& key) const {
  return folder_ + "/" + key + kEnding;
}

std::optional<std::filesystem::file_time_type> ShotCache::newest() const {
  std::optional<std::filesystem::file_time_type> out;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder_, error)) {
    const auto time = entry.last_write_time(error);
    if (!error && (!out || time > *out)) out = time;
  }
  return out;
}

std::optional<DecodedShot> ShotCache::find(const std::string& key) {
  const std::optional<std::string> content = read_checked_file(path_of(key));
  if (!content) return std::nullopt;
  std::optional<DecodedShot> shot =
      decoded_shot({reinterpret_cast<const std::uint8_t*>(content->data()), content->size()});
  if (!shot) return std::nullopt;
  ++found_;
  const std::lock_guard lock(mutex_);
  used_.insert(key + kEnding);
  return shot;
}

void ShotCache::keep(const std::string& key, const DecodedShot& shot) {
  const std::vector<std::uint8_t> bytes = to_bytes(shot);
  std::string problem;
  try {
    write_checked_file(path_of(key), {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  } catch (const InputError& e) {
    problem = e.what();
  }
  const std::lock_guard lock(mutex_);
  if (problem_.empty()) problem_ = problem;
  used_.insert(key + kEnding);
  kept_.insert(key + kEnding);
}

void ShotCache::remove_others() {
  const std::lock_guard lock(mutex_);
  std::error_code ignored;
  std::vector<std::filesystem::path> others;
  for (const auto& entry : std::filesystem::directory_iterator(folder_, ignored)) {
    const std::filesystem::path& path = entry.path();
    if (path.extension() == kEnding && !used_.contains(path.filename())) others.push_back(path);
  }
  for (const std::filesystem::path& path : others) std::filesystem::remove(path, ignored);
}

std::string ShotCache::problem() const {
  const std::lock_guard lock(mutex_);
  return problem_;
}

}  // namespace scattermeter::capture
