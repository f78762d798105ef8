// Decoded shots kept beside a result, so that measuring again decodes nothing twice.
#pragma once

#include <atomic>
#include <cstddef>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "capture/shots/decoded_shot.h"

namespace scattermeter::capture {

// One file a shot in a folder, named by a key that stands for all that the shot was made from. A
// file appears whole or not at all, and one whose digest does not hold is as good as none. For
// several threads, and for several programs, at once.
class ShotCache {
 public:
  explicit ShotCache(std::string folder);

  std::optional<DecodedShot> find(const std::string& key);
  // Where the folder takes no file the shot is not kept; nothing else is lost.
  void keep(const std::string& key, const DecodedShot& shot);
  // As if this object had never been: removes what it kept, and the folders that were made for it.
  void forget();
  // Removes the files that were neither found nor kept since this object was made.
  void remove_others();

  std::size_t found() const { return found_; }
  // Why the first shot that could not be kept was not; empty: all were.
  std::string problem() const;

 private:
  std::string path_of(const std::string& key) const;

  std::string folder_;
  std::atomic<std::size_t> found_ = 0;
  mutable std::mutex mutex_;
  std::set<std::string> used_;            // file names
  std::set<std::string> kept_;            // of these, those that are new
  std::vector<std::string> new_folders_;  // the innermost first
  std::string problem_;
};

}  // namespace scattermeter::capture
