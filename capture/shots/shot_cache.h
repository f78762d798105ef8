// Cache of decoded shots beside a result, so that a repeated measurement need not decode them
// again.
#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "capture/shots/decoded_shot.h"

namespace scattermeter::capture {

// A folder with one file per shot, named by a key that identifies everything the shot was made
// from. A file appears complete or not at all, and a file with a wrong digest is ignored. Safe to
// use from several threads and several programs at once.
class ShotCache {
 public:
  explicit ShotCache(std::string folder);

  // When the newest of its files was written; absent without any. It has no shot of a newer raw.
  std::optional<std::filesystem::file_time_type> newest() const;
  std::optional<DecodedShot> find(const std::string& key);
  // If the file cannot be written the shot is not kept, which has no other effect than problem().
  void keep(const std::string& key, const DecodedShot& shot);
  // Undoes all changes by this object: removes the files that it wrote and the folders that it
  // made.
  void forget();
  // Removes the files that were neither found nor kept since this object was made.
  void remove_others();

  std::size_t found() const { return found_; }
  // Why the first shot that could not be kept failed; empty if all were kept.
  std::string problem() const;

 private:
  std::string path_of(const std::string& key) const;

  std::string folder_;
  std::atomic<std::size_t> found_ = 0;
  mutable std::mutex mutex_;
  std::set<std::string> used_;            // file names
  std::set<std::string> kept_;            // those of `used_` that are new
  std::vector<std::string> new_folders_;  // innermost first
  std::string problem_;
};

}  // namespace scattermeter::capture
