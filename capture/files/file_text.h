// The content of a file that a user names.
#pragma once

#include <string>

namespace scattermeter::capture {

// The bytes of the file. expected: a clause for someone who names a folder, such as "an OBJ file is
// expected". Throws MissingFile if there is no such file, InputError if it is a folder or cannot be
// read.
std::string file_text(const std::string& path, const std::string& expected);

}  // namespace scattermeter::capture
