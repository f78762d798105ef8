// SHA-256 of a file.
#pragma once

#include <string>

namespace scattermeter::apps {

// Lower-case hexadecimal digest. Throws InputError naming the file when it cannot be read.
std::string sha256_of_file(const std::string& path);

}  // namespace scattermeter::apps
