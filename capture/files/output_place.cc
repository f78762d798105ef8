#include "capture/files/output_place.h"

#include <cerrno>
#include <filesystem>
#include <system_error>

#include <unistd.h>

#include "capture/files/file_kind.h"
#include "core/base/input_error.h"

namespace scattermeter::capture {

namespace fs = std::filesystem;

void require_output_folder(const std::string& folder) {
  std::error_code error;
  fs::path nearest = fs::absolute(folder, error).lexically_normal();
  while (!is_there(nearest) && nearest.has_relative_path()) nearest = nearest.parent_path();
  if (!is_folder(nearest)) {
    throw InputError(folder, nearest == fs::path(folder)
                                 ? "is a file, a folder is needed for the results"
                                 : "cannot be created: " + nearest.string() + " is a file");
  }
  if (::access(nearest.c_str(), W_OK | X_OK) != 0) {
    throw InputError(folder, "cannot be written: " + std::generic_category().message(errno));
  }
}

void require_output_file(const std::string& path) {
  if (is_folder(path)) throw InputError(path, "is a folder, the name of a file is needed");
  const fs::path folder = fs::path(path).parent_path();
  require_output_folder(folder.empty() ? "." : folder.string());
}

bool is_same_folder(const std::string& a, const std::string& b) {
  std::error_code error;
  return is_folder(a) && is_folder(b) && fs::equivalent(a, b, error) && !error;
}

}  // namespace scattermeter::capture
