// Any bytes as a raw file: decoded by LibRaw, or refused by InputError.
#include <cstddef>
#include <cstdint>

#include "capture/raw_reader.h"
#include "core/input_error.h"
#include "tests/fuzz/fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const scattermeter::FuzzFile file("a.dng");
  try {
    (void)scattermeter::capture::read_raw(file.with(data, size), 4.0);
  } catch (const scattermeter::InputError&) {
  }
  return 0;
}
