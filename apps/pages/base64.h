// Base64 encoding.
#pragma once

#include <string>

namespace scattermeter::apps {

// Encodes bytes by RFC 4648, with padding and without line breaks.
std::string base64(const std::string& bytes);

}  // namespace scattermeter::apps
