// Existence and kind of a file; a path that the system rejects (name too long, loop of links)
// counts as not existing.
#pragma once

#include <filesystem>

namespace scattermeter::capture {

inline bool is_there(const std::filesystem::path& path) {
  std::error_code refused;
  return std::filesystem::exists(path, refused);
}

inline bool is_folder(const std::filesystem::path& path) {
  std::error_code refused;
  return std::filesystem::is_directory(path, refused);
}

}  // namespace scattermeter::capture
