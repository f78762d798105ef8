// Any bytes as a result.json: read, or refused by InputError.
#include <cstddef>
#include <cstdint>

#include "apps/results/result_reader.h"
#include "tests/fuzz/fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const scattermeter::FuzzFile file("a.json");
  scattermeter::read_or_refuse(scattermeter::apps::read_result, file.with(data, size));
  return 0;
}
