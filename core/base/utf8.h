// Whether bytes are text.
#pragma once

#include <cstddef>
#include <string_view>

namespace scattermeter {

// The position of the first byte that belongs to no character encoded in UTF-8 (RFC 3629: no
// surrogates, nothing above U+10FFFF, the shortest form of each); the size of the text if there is
// none.
std::size_t first_no_utf8(std::string_view text);

}  // namespace scattermeter
