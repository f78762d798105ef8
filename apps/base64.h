// Bytes as text for data: addresses.
#pragma once

#include <string>

namespace scattermeter::apps {

// RFC 4648, with padding, without line breaks.
std::string base64(const std::string& bytes);

}  // namespace scattermeter::apps
