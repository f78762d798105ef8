#include "capture/raw/tiff_layout.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <map>
#include <set>
#include <span>
#include <vector>

#include "core/base/input_error.h"

namespace scattermeter::capture {
namespace {

using Values = std::vector<std::uint32_t>;
using Directory = std::map<unsigned, Values>;  // the integer fields in kTags, by tag

enum Tag : unsigned {
  kWidth = 256,
  kHeight = 257,
  kBitsPerSample = 258,
  kCompression = 259,
  kPhotometric = 262,
  kStripOffsets = 273,
  kSamplesPerPixel = 277,
  kStripByteCounts = 279,
  kTileOffsets = 324,
  kTileByteCounts = 325,
  kSubDirectories = 330,
  kDngVersion = 50706,
  kActiveArea = 50829,
};
const std::set<unsigned> kTags = {kWidth,       kHeight,         kBitsPerSample,   kCompression,
                                  kPhotometric, kStripOffsets,   kSamplesPerPixel, kStripByteCounts,
                                  kTileOffsets, kTileByteCounts, kSubDirectories,  kDngVersion,
                                  kActiveArea};
constexpr std::uint32_t kCfaPhotometric = 32803;
constexpr std::uint32_t kUncompressed = 1;
constexpr std::uint32_t kJpeg = 7;
constexpr std::size_t kMaxDirectories = 64;  // a file has a handful; a loop of links has no end

class TiffFile {
 public:
  explicit TiffFile(const std::string& path) : stream_(path, std::ios::binary) {
    if (!stream_) throw InputError(path, "cannot be opened");
    stream_.seekg(0, std::ios::end);
    size_ = static_cast<std::uint64_t>(stream_.tellg());
    std::array<unsigned char, 8> header{};
    if (!read(0, header)) return;
    big_endian_ = header[0] == 'M';
    const bool marked = (header[0] == 'I' && header[1] == 'I') || (big_endian_ && header[1] == 'M');
    if (marked && number(std::span(header).subspan(2, 2)) == 42) {
      first_directory_ = number(std::span(header).subspan(4, 4));
    }
  }

  std::uint64_t size() const { return size_; }

  // Of the main chain and one level below it; empty when the file is no TIFF.
  std::vector<Directory> directories() {
    std::vector<Directory> all;
    std::set<std::uint32_t> seen;
    std::uint32_t next = first_directory_;
    while (next != 0 && all.size() < kMaxDirectories && seen.insert(next).second) {
      Directory directory = read_directory(next, next);
      const Values below = directory[kSubDirectories];
      all.push_back(std::move(directory));
      for (const std::uint32_t offset : below) {
        std::uint32_t unused = 0;
        if (all.size() < kMaxDirectories) all.push_back(read_directory(offset, unused));
      }
    }
    return all;
  }

 private:
  bool read(std::uint64_t offset, std::span<unsigned char> bytes) {
    if (offset > size_ || bytes.size() > size_ - offset) return false;
    stream_.clear();
    stream_.seekg(static_cast<std::streamoff>(offset));
    stream_.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    return static_cast<bool>(stream_);
  }

  std::uint32_t number(std::span<const unsigned char> bytes) const {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      value = value << 8U | bytes[big_endian_ ? i : bytes.size() - 1 - i];
    }
    return value;
  }

  // next: offset of the following directory of the chain, 0 when there is none.
  Directory read_directory(std::uint32_t offset, std::uint32_t& next) {
    Directory directory;
    next = 0;
    std::array<unsigned char, 2> count_bytes{};
    if (!read(offset, count_bytes)) return directory;
    const std::uint32_t count = number(count_bytes);
    std::vector<unsigned char> entries(12 * std::size_t{count} + 4);
    if (!read(std::uint64_t{offset} + 2, entries)) return directory;
    for (std::uint32_t i = 0; i < count; ++i) {
      const auto entry = std::span<const unsigned char>(entries).subspan(12 * std::size_t{i}, 12);
      const unsigned tag = number(entry.first(2));
      if (kTags.contains(tag)) directory[tag] = read_values(entry);
    }
    next = number(std::span(entries).last(4));
    return directory;
  }

  Values read_values(std::span<const unsigned char> entry) {
    const std::uint32_t type = number(entry.subspan(2, 2));
    const std::uint64_t count = number(entry.subspan(4, 4));
    std::uint64_t width = 0;  // bytes of a value: BYTE, SHORT, LONG or a directory's offset
    if (type == 1) width = 1;
    if (type == 3) width = 2;
    if (type == 4 || type == 13) width = 4;
    if (width == 0 || count * width > size_) return {};
    std::vector<unsigned char> bytes(entry.begin() + 8, entry.end());
    if (count * width > 4) {
      bytes.resize(count * width);
      if (!read(number(entry.last(4)), bytes)) return {};
    }
    Values values(count);
    for (std::size_t i = 0; i < count; ++i) {
      values[i] = number(std::span<const unsigned char>(bytes).subspan(i * width, width));
    }
    return values;
  }

  std::ifstream stream_;
  std::uint64_t size_ = 0;
  std::uint32_t first_directory_ = 0;
  bool big_endian_ = false;
};

std::uint64_t first_value(const Directory& directory, Tag tag, std::uint32_t fallback) {
  const auto found = directory.find(tag);
  return found == directory.end() || found->second.empty() ? fallback : found->second.front();
}

const Values& values_of(const Directory& directory, Tag tag) {
  static const Values none;
  const auto found = directory.find(tag);
  return found == directory.end() ? none : found->second;
}

std::string cfa_image_problem(const Directory& image, std::uint64_t file_size, bool is_dng) {
  const bool tiled = !values_of(image, kTileOffsets).empty();
  const Values& offsets = values_of(image, tiled ? kTileOffsets : kStripOffsets);
  const Values& counts = values_of(image, tiled ? kTileByteCounts : kStripByteCounts);
  if (offsets.size() != counts.size()) return "its strip offsets and strip sizes do not match";
  std::uint64_t bytes = 0;
  bool contiguous = true;
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    const std::uint64_t end = std::uint64_t{offsets[i]} + counts[i];
    if (end > file_size) {
      return "the file is truncated: its samples extend to byte " + std::to_string(end) +
             ", the file ends at byte " + std::to_string(file_size);
    }
    bytes += counts[i];
    contiguous = contiguous && (i == 0 || offsets[i] == offsets[i - 1] + counts[i - 1]);
  }
  if (!is_dng) return {};

  const std::uint64_t compression = first_value(image, kCompression, kUncompressed);
  const std::string parts = std::to_string(offsets.size()) + (tiled ? " tiles" : " strips");
  if (compression == kJpeg && !tiled && offsets.size() > 1) {
    return "lossless JPEG in " + parts +
           " cannot be decoded correctly; convert the file to one strip, to tiles or to "
           "uncompressed samples";
  }
  if (compression != kUncompressed) return {};
  if (offsets.size() > 1 && (tiled || !contiguous)) {
    return "uncompressed samples in " + parts +
           " that are not contiguous cannot be decoded; convert the file to one strip";
  }
  const std::uint64_t row_bits = first_value(image, kWidth, 0) *
                                 first_value(image, kBitsPerSample, 1) *
                                 first_value(image, kSamplesPerPixel, 1);
  const std::uint64_t needed = (row_bits + 7) / 8 * first_value(image, kHeight, 0);
  if (bytes < needed) {
    return "its samples take " + std::to_string(needed) + " bytes, the file holds " +
           std::to_string(bytes);
  }
  return {};
}

}  // namespace

TiffLayout tiff_layout(const std::string& path) {
  TiffFile file(path);
  const std::vector<Directory> directories = file.directories();
  TiffLayout layout;
  layout.is_dng = !directories.empty() && directories.front().contains(kDngVersion);
  std::uint64_t widest = 0;
  for (const Directory& directory : directories) {
    if (first_value(directory, kPhotometric, 0) != kCfaPhotometric) continue;
    if (layout.problem.empty()) {
      layout.problem = cfa_image_problem(directory, file.size(), layout.is_dng);
    }
    const Values& area = values_of(directory, kActiveArea);  // top, left, bottom, right
    const std::uint64_t width = first_value(directory, kWidth, 0);
    if (width > widest && layout.is_dng && area.size() == 4) {
      layout.active_corner_px = {static_cast<int>(area[1]), static_cast<int>(area[0])};
    }
    widest = std::max(widest, width);
  }
  return layout;
}

}  // namespace scattermeter::capture
