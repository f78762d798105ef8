// Any bytes as a result.json: read, or refused by InputError.
#include <cstddef>
#include <cstdint>

#include "apps/result_reader.h"
#include "core/input_error.h"
#include "tests/fuzz/fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const scattermeter::FuzzFile file("a.json");
  try {
    (void)scattermeter::apps::read_result(file.with(data, size));
  } catch (const scattermeter::InputError&) {
  }
  return 0;
}
