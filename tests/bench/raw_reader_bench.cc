// Decoding beside bare LibRaw, on a full-size frame of 12 bits a sample, packed, as cameras write.
#include <filesystem>
#include <random>
#include <vector>

#include <benchmark/benchmark.h>
#include <libraw/libraw.h>

#include "capture/raw/dng_writer.h"
#include "capture/raw/raw_reader.h"

namespace scattermeter::capture {
namespace {

constexpr int kWidth = 3872, kHeight = 2592;

const std::string& raw_path() {
  static const std::string kPath = [] {
    std::vector<std::uint16_t> codes(static_cast<std::size_t>(kWidth) * kHeight);
    std::mt19937 random(1);
    for (std::uint16_t& code : codes) code = static_cast<std::uint16_t>(64 + random() % 4000);
    const std::string path =
        (std::filesystem::temp_directory_path() / "raw_reader_bench.dng").string();
    write_dng(path, kWidth, kHeight, codes, RawMetadata{});
    return path;
  }();
  return kPath;
}

void decode(benchmark::State& state) {
  const std::string path = raw_path();
  for (auto _ : state) benchmark::DoNotOptimize(read_raw(path).samples.data());
}
BENCHMARK(decode)->Unit(benchmark::kMillisecond);

void decode_bare_libraw(benchmark::State& state) {
  const std::string path = raw_path();
  for (auto _ : state) {
    LibRaw raw;
    if (raw.open_file(path.c_str()) != LIBRAW_SUCCESS || raw.unpack() != LIBRAW_SUCCESS) {
      state.SkipWithError("LibRaw does not take the file");
      return;
    }
    benchmark::DoNotOptimize(raw.imgdata.rawdata.raw_image);
  }
}
BENCHMARK(decode_bare_libraw)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace scattermeter::capture
