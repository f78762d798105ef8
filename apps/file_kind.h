// What a path leads to; a path that the system refuses (too long a name, a loop of links) leads to
// nothing.
#pragma once

#include <filesystem>

namespace scattermeter::apps {

inline bool is_there(const std::filesystem::path& path) {
  std::error_code refused;
  return std::filesystem::exists(path, refused);
}

inline bool is_folder(const std::filesystem::path& path) {
  std::error_code refused;
  return std::filesystem::is_directory(path, refused);
}

}  // namespace scattermeter::apps
