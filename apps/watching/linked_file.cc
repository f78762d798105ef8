#include "apps/watching/linked_file.h"

#include <filesystem>
#include <system_error>

#include "core/base/input_error.h"

namespace scattermeter::apps {

namespace fs = std::filesystem;

void link_or_copy(const std::string& from, const std::string& to) {
  std::error_code error;
  fs::create_directories(fs::path(to).parent_path(), error);
  fs::remove(to, error);
  fs::create_hard_link(from, to, error);
  if (!error) return;
  fs::copy_file(from, to, fs::copy_options::overwrite_existing, error);
  if (error) throw InputError(to, "cannot be written: " + error.message());
}

}  // namespace scattermeter::apps
