// The index of a channel among R, G, B.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

#include "core/camera/cfa_samples.h"

namespace scattermeter {

// channel: one of kRgbName; std::invalid_argument for any other letter.
inline std::size_t channel_index(char channel) {
  for (std::size_t i = 0; i < kRgbName.size(); ++i) {
    if (kRgbName[i] == channel) return i;
  }
  throw std::invalid_argument(std::string("channel_index: no channel: ") + channel);
}

}  // namespace scattermeter
