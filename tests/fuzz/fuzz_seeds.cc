// fuzz_seeds SOURCE OUT: small files that the doors accept, for the fuzzers to begin with: made
// here, or taken from the sources (seeds/ beside this file, samples). The rigs and calibrations are
// read here: one that a door no longer accepts ends this program.
#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "apps/rig/led_calibration_file.h"
#include "apps/rig/radiance_file.h"
#include "apps/rig/rig.h"
#include "calib/lens/camera_calibration_file.h"
#include "capture/raw/dng_writer.h"
#include "capture/raw/nef_writer.h"
#include "capture/shots/decoded_shot.h"
#include "tests/fixtures/apps/made_result.h"

namespace {

namespace fs = std::filesystem;
using namespace std::string_literals;

void write(const fs::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

void copy_into(const fs::path& from, const fs::path& folder) {
  fs::copy_file(from, folder / from.filename(), fs::copy_options::overwrite_existing);
}

void raws(const fs::path& folder) {
  constexpr int kSide = 24;
  std::vector<std::uint16_t> codes(kSide * kSide);
  for (std::size_t i = 0; i < codes.size(); ++i) codes[i] = static_cast<std::uint16_t>(64 + i);
  scattermeter::capture::RawMetadata metadata;
  scattermeter::capture::write_dng(folder / "plain.dng", kSide, kSide, codes, metadata);
  metadata.black_counts = {60, 61, 62, 63};
  for (std::uint16_t i = 0; i < 1024; ++i) {
    metadata.linearization_table.push_back(static_cast<std::uint16_t>(4 * i));
  }
  scattermeter::capture::write_dng(folder / "table.dng", kSide, kSide, codes, metadata);
  scattermeter::capture::write_nef(folder / "nikon.nef", kSide, kSide, codes, metadata);
  metadata.make = "Hasselblad";  // refused before LibRaw reads it
  metadata.model = "Hasselblad H3D-39";
  scattermeter::capture::write_dng(folder / "hasselblad.dng", kSide, kSide, codes, metadata);
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

// The rig refers to the calibrations by their names: all stand in one folder while they are read.
void rigs_and_calibrations(const fs::path& seeds, const fs::path& out) {
  namespace apps = scattermeter::apps;
  scattermeter::calib::read_camera_calibration_file(seeds / "camera.yaml");
  apps::read_led_calibration_file(seeds / "led.yaml");
  apps::read_radiance_file(seeds / "radiance.yaml");
  for (const char* name : {"camera.yaml", "led.yaml", "radiance.yaml"}) {
    copy_into(seeds / name, out / "calibration");
  }
  for (const char* name : {"rig.yaml", "calibrated_rig.yaml"}) {
    apps::read_rig(seeds / name);
    copy_into(seeds / name, out / "rig");
  }
}

void pictures(const fs::path& folder) {
  cv::Mat picture(20, 30, CV_8UC3);
  cv::randu(picture, 0, 256);
  for (const char* ending : {".png", ".jpg", ".tif", ".bmp", ".ppm", ".webp"}) {
    cv::imwrite(folder / ("a"s + ending), picture);
  }
}

}  // namespace

int main(int count, char** words) {
  if (count != 3) {
    std::cerr << "usage: fuzz_seeds SOURCE OUT\n";
    return 2;
  }
  const fs::path source = words[1];
  const fs::path out = words[2];
  for (const char* door :
       {"rig", "calibration", "mesh", "picture", "probe", "raw", "result", "cache"}) {
    fs::create_directories(out / door);
  }
  raws(out / "raw");
  probes(out / "probe");
  rigs_and_calibrations(source / "tests/fuzz/seeds", out);
  pictures(out / "picture");
  write(out / "result/result.json",
        scattermeter::apps::made_result({{"PP", {{0.62, 0.7, 0.8}, {0.0012, 0.001, 0.0018}}}})
            .dump(1));
  scattermeter::DecodedShot shot;
  for (scattermeter::ChannelObservation& o : shot.observation.channel) {
    o.l = o.variance = o.variance_per_l = o.l_per_count = {0.5, 0.25};
    o.state = {scattermeter::RowState::kUsed, scattermeter::RowState::kClipped};
    o.rows_used = 1;
    o.exposures = {{o.l, 2}};
  }
  shot.exposures = {{"a.dng", 0.1, 0.1, 0.01, 0.2, {}}};
  const std::vector<std::uint8_t> bytes = scattermeter::capture::to_bytes(shot);
  write(out / "cache/a.shot", {bytes.begin(), bytes.end()});
  for (const char* mesh : {"cube.obj", "pyramid_on_pedestal.obj"}) {
    copy_into(source / "samples/three_plastics" / mesh, out / "mesh");
  }
  return 0;
}
