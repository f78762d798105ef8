// Any bytes as a decoded shot of a cache: read, or none.
#include <cstddef>
#include <cstdint>

#include "capture/shots/decoded_shot.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  (void)scattermeter::capture::decoded_shot({data, size});
  return 0;
}
