#include "capture/files/output_place.h"

#include <cerrno>
#include <filesystem>
#include <system_error>

#include <unistd.h>

#include "capture/files/file_kind.h"
#include "core/base/input_error.h"

namespace scattermeter::capture {

namespace fs = std::filesystem;

namespace {

bool is_same(const fs::path& a, const fs::path& b) {
  std::error_code error;
  return fs::equivalent(a, b, error) && !error;
}

}  // namespace

void require_output_folder(const std::string& folder) {
  if (folder.empty()) throw InputError("--out", "is empty, the name of a folder is needed");
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

void require_output_file(const std::string& path, const std::vector<std::string>& inputs) {
  if (path.empty()) throw InputError("--out", "is empty, the name of a file is needed");
  if (is_folder(path)) throw InputError(path, "is a folder, the name of a file is needed");
  const fs::path folder = fs::path(path).parent_path();
  const std::string extension = fs::path(path).extension().string();
  for (const std::string& input : inputs) {
    const bool is_of_folder = is_folder(input) && is_there(path) && extension != ".yaml" &&
                              extension != ".yml" && is_same(folder.empty() ? "." : folder, input);
    if (is_of_folder || is_same(path, input)) {
      throw InputError("--out",
                       "is one of the files that are read, and would be replaced: " + path);
    }
  }
  require_output_folder(folder.empty() ? "." : folder.string());
}

bool is_same_folder(const std::string& a, const std::string& b) {
  return is_folder(a) && is_folder(b) && is_same(a, b);
}

}  // namespace scattermeter::capture
