// Any bytes as a light probe (Radiance or OpenEXR): read, or refused by InputError.
#include <cstddef>
#include <cstdint>

#include "capture/probe_reader.h"
#include "core/input_error.h"
#include "tests/fuzz/fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const scattermeter::FuzzFile file("a.hdr");
  try {
    (void)scattermeter::capture::read_probe(file.with(data, size), {1 << 20});
  } catch (const scattermeter::InputError&) {
  }
  return 0;
}
