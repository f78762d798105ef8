#include "capture/files/file_text.h"

#include <fstream>
#include <sstream>
#include <utility>

#include "capture/files/file_kind.h"
#include "core/base/input_error.h"

namespace scattermeter::capture {

void require_file(const std::string& path, const std::string& expected) {
  if (!is_there(path)) throw MissingFile(path, "no such file");
  if (is_folder(path)) throw InputError(path, "is a folder, " + expected);
}

std::string file_text(const std::string& path, const std::string& expected) {
  require_file(path, expected);
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  // Only the state of the source is checked: copying an empty file sets the fail bit of the sink.
  if (!stream || ((text << stream.rdbuf()), stream.bad())) {
    throw InputError(path, "cannot be read");
  }
  return std::move(text).str();
}

}  // namespace scattermeter::capture
