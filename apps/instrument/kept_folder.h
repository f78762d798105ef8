// What is kept of a jig in a folder.
#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace scattermeter::apps {

// Files FOLDER/NAME.ENDING. What is to be kept waits for write(), so that a measurement that fails
// leaves nothing behind. A file appears complete or not at all, and one with a wrong digest is
// ignored. Of more than most_bytes, the files that were not used for longest are removed.
class KeptFolder {
 public:
  static constexpr std::uintmax_t kMostBytes = std::uintmax_t{1} << 30;
  // ending: with its dot.
  KeptFolder(std::string folder, std::string ending, std::uintmax_t most_bytes = kMostBytes);

  std::optional<std::string> find(const std::string& name);
  void keep(const std::string& name, std::string bytes);

  // Writes all that waits. Returns why the first that failed did; "" if none.
  std::string write();

 private:
  std::string path_of(const std::string& name) const;
  void remove_oldest();

  std::string folder_, ending_;
  std::uintmax_t most_bytes_;
  std::mutex mutex_;
  std::vector<std::pair<std::string, std::string>> waiting_;  // paths and contents
};

}  // namespace scattermeter::apps
