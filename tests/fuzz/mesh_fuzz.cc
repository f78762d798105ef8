// Any bytes as a mesh: read, or refused by InputError.
#include <cstddef>
#include <cstdint>

#include "capture/obj_reader.h"
#include "core/input_error.h"
#include "tests/fuzz/fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const scattermeter::FuzzFile file("a.obj");
  try {
    (void)scattermeter::capture::read_obj(file.with(data, size), 100'000);
  } catch (const scattermeter::InputError&) {
  }
  return 0;
}
