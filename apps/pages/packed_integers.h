// Arrays of numbers as text in the data of a page.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace scattermeter::apps {

// The `bytes` low bytes of each value (two's complement), as planes, the lowest bytes of all values
// first, which compresses well; deflated with zlib's header (RFC 1950), then in base64.
std::string packed_integers(const std::vector<std::int32_t>& values, int bytes);

}  // namespace scattermeter::apps
