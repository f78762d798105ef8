// Names of files that are kept between programs.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "capture/files/digest.h"
#include "core/base/version.h"

namespace scattermeter::apps {

// The first 32 digits of the SHA-256 of the program's version and these numbers.
inline std::string content_name(std::span<const double> numbers) {
  constexpr std::size_t kDigits = 32;
  return capture::Digest().text(kVersion).numbers(numbers).hex().substr(0, kDigits);
}

}  // namespace scattermeter::apps
