// fuzz_seeds SOURCE OUT: small files that the doors accept, for the fuzzers to begin with: made
// here, or taken from the sources (samples, the rigs of the tests).
#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include "apps/decoded_shot.h"
#include "capture/dng_writer.h"
#include "tests/apps/made_result.h"

namespace {

namespace fs = std::filesystem;

void write(const fs::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

void raws(const fs::path& folder) {
  constexpr int kSide = 24;
  std::vector<std::uint16_t> codes(kSide * kSide);
  for (std::size_t i = 0; i < codes.size(); ++i) codes[i] = static_cast<std::uint16_t>(64 + i);
  scattermeter::capture::DngMetadata metadata;
  scattermeter::capture::write_dng(folder / "plain.dng", kSide, kSide, codes, metadata);
  metadata.black_counts = {60, 61, 62, 63};
  for (std::uint16_t i = 0; i < 1024; ++i) {
    metadata.linearization_table.push_back(static_cast<std::uint16_t>(4 * i));
  }
  scattermeter::capture::write_dng(folder / "table.dng", kSide, kSide, codes, metadata);
}

void probes(const fs::path& folder) {
  const std::string head = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=2.0\n\n";
  std::string flat = head + "-Y 2 +X 4\n";
  for (int i = 0; i < 8; ++i) flat += std::string({'\x40', '\x50', '\x60', '\x80'});
  write(folder / "flat.hdr", flat);
  // Two rows of eight pixels, each channel a run.
  std::string runs = head + "-Y 2 +X 8\n";
  for (int row = 0; row < 2; ++row) {
    runs += std::string({'\x02', '\x02', '\x00', '\x08'});
    for (const char value : {'\x40', '\x50', '\x60', '\x80'}) {
      runs += std::string({static_cast<char>(128 + 8), value});
    }
  }
  write(folder / "runs.hdr", runs);
}

void copy_into(const fs::path& from, const fs::path& folder) {
  fs::copy_file(from, folder / from.filename(), fs::copy_options::overwrite_existing);
}

void calibrations(const fs::path& folder) {
  write(
      folder / "camera.yaml",
      "%YAML:1.0\n---\nimage_width: 480\nimage_height: 320\ncamera_matrix: !!opencv-matrix\n"
      "   rows: 3\n   cols: 3\n   dt: d\n   data: [ 520., 0., 240., 0., 520., 160., 0., 0., 1. ]\n"
      "distortion_coefficients: !!opencv-matrix\n   rows: 1\n   cols: 5\n   dt: d\n"
      "   data: [ -0.1, 0.05, 0., 0., 0. ]\n");
  write(folder / "led.yaml",
        "scattermeter_led: 1\nlight: led1\nposition_mm: [1, 2, 3]\naxis: [0, 0, -1]\n");
  write(folder / "radiance.yaml", "scattermeter_radiance: 1\nmodel: NIKON D80\n");
}

}  // namespace

int main(int count, char** words) {
  if (count != 3) {
    std::cerr << "usage: fuzz_seeds SOURCE OUT\n";
    return 2;
  }
  const fs::path source = words[1];
  const fs::path out = words[2];
  for (const char* door : {"rig", "calibration", "mesh", "probe", "raw", "result", "cache"}) {
    fs::create_directories(out / door);
  }
  raws(out / "raw");
  probes(out / "probe");
  calibrations(out / "calibration");
  write(out / "result/result.json",
        scattermeter::apps::made_result({{"PP", {{0.62, 0.7, 0.8}, {0.0012, 0.001, 0.0018}}}})
            .dump(1));
  scattermeter::apps::DecodedShot shot;
  for (scattermeter::ChannelObservation& o : shot.observation.channel) {
    o.l = o.variance = o.variance_per_l = o.l_per_count = {0.5, 0.25};
    o.state = {scattermeter::RowState::kUsed, scattermeter::RowState::kClipped};
    o.rows_used = 1;
    o.exposures = {{o.l, 2}};
  }
  shot.exposures = {{"a.dng", 0.1, 0.1, 0.01, 0.2, {}}};
  const std::vector<std::uint8_t> bytes = scattermeter::apps::to_bytes(shot);
  write(out / "cache/a.shot", {bytes.begin(), bytes.end()});
  for (const char* mesh : {"cube.obj", "pyramid_on_pedestal.obj"}) {
    copy_into(source / "samples/three_plastics" / mesh, out / "mesh");
  }
  copy_into(source / "samples/three_plastics/rig.yaml", out / "rig");
  for (const char* rig : {"rough.yaml", "truth.yaml"}) {
    copy_into(source / "samples/from_scratch" / rig, out / "rig");
  }
  return 0;
}
