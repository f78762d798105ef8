// The content of a file that a user names.
#pragma once

#include <string>

namespace scattermeter::capture {

// Throws MissingFile if there is no such file, InputError if it is a folder. expected: a clause for
// someone who names a folder, such as "an OBJ file is expected".
void require_file(const std::string& path, const std::string& expected);

// The bytes of the file. Throws as require_file(), and InputError if it cannot be read.
std::string file_text(const std::string& path, const std::string& expected);

}  // namespace scattermeter::capture
