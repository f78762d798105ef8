#include "tests/capture/probe_bytes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>

#include "tests/temporary_folder.h"

namespace scattermeter::capture {
namespace {

std::array<std::uint8_t, 4> rgbe(const float* rgb) {
  const float top = std::max({rgb[0], rgb[1], rgb[2]});
  if (top < 1e-32F) return {0, 0, 0, 0};
  int exponent = 0;
  const float scale = std::frexp(top, &exponent) * 256.0F / top;
  return {static_cast<std::uint8_t>(rgb[0] * scale), static_cast<std::uint8_t>(rgb[1] * scale),
          static_cast<std::uint8_t>(rgb[2] * scale), static_cast<std::uint8_t>(exponent + 128)};
}

void append_runs(const std::vector<std::uint8_t>& row, std::string& out) {
  std::size_t at = 0;
  while (at < row.size()) {
    std::size_t run = 1;
    while (at + run < row.size() && run < 127 && row[at + run] == row[at]) ++run;
    if (run >= 3) {
      out += static_cast<char>(128 + run);
      out += static_cast<char>(row[at]);
      at += run;
      continue;
    }
    std::size_t count = 0;
    const std::size_t begin = at;
    while (at < row.size() && count < 128 &&
           !(at + 2 < row.size() && row[at] == row[at + 1] && row[at] == row[at + 2])) {
      ++at;
      ++count;
    }
    out += static_cast<char>(count);
    for (std::size_t i = begin; i < at; ++i) out += static_cast<char>(row[i]);
  }
}

}  // namespace

std::string hdr_bytes(const ProbeImage& image, bool run_length) {
  std::string out = "#?RADIANCE\n# made by a test\nFORMAT=32-bit_rle_rgbe\n\n-Y " +
                    std::to_string(image.height_px) + " +X " + std::to_string(image.width_px) +
                    "\n";
  const auto width = static_cast<std::size_t>(image.width_px);
  for (int y = 0; y < image.height_px; ++y) {
    std::array<std::vector<std::uint8_t>, 4> planes;
    for (std::size_t x = 0; x < width; ++x) {
      const auto code = rgbe(&image.radiance[3 * (static_cast<std::size_t>(y) * width + x)]);
      for (std::size_t c = 0; c < 4; ++c) {
        planes[c].push_back(code[c]);
        if (!run_length) out += static_cast<char>(code[c]);
      }
    }
    if (!run_length) continue;
    out += {2, 2, static_cast<char>(width / 256), static_cast<char>(width % 256)};
    for (const auto& plane : planes) append_runs(plane, out);
  }
  return out;
}

std::string exr_bytes(const ProbeImage& image, ExrType type, const std::string& channels) {
  const TemporaryFolder folder;
  const std::string path = folder / "probe.exr";
  const auto pixels = static_cast<std::size_t>(image.width_px * image.height_px);
  std::vector<std::vector<char>> planes;
  {
    Imf::Header header(image.width_px, image.height_px);
    Imf::FrameBuffer frame;
    const Imf::PixelType pixel = type == ExrType::kHalf    ? Imf::HALF
                                 : type == ExrType::kFloat ? Imf::FLOAT
                                                           : Imf::UINT;
    const std::size_t bytes = type == ExrType::kHalf ? 2 : 4;
    for (std::size_t c = 0; c < channels.size(); ++c) {
      std::vector<char>& plane = planes.emplace_back(pixels * bytes);
      for (std::size_t i = 0; i < pixels; ++i) {
        const float value = image.radiance[3 * i + c % 3];
        if (type == ExrType::kHalf) {
          reinterpret_cast<Imath::half*>(plane.data())[i] = Imath::half(value);
        } else if (type == ExrType::kFloat) {
          reinterpret_cast<float*>(plane.data())[i] = value;
        } else {
          reinterpret_cast<std::uint32_t*>(plane.data())[i] = static_cast<std::uint32_t>(value);
        }
      }
      const std::string name(1, channels[c]);
      header.channels().insert(name, Imf::Channel(pixel));
      frame.insert(name, Imf::Slice(pixel, plane.data(), bytes,
                                    bytes * static_cast<std::size_t>(image.width_px)));
    }
    Imf::OutputFile file(path.c_str(), header);
    file.setFrameBuffer(frame);
    file.writePixels(image.height_px);
  }
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace scattermeter::capture
