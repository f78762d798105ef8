#include "capture/raw/nikon_maker_note.h"

#include <algorithm>
#include <array>

#include "capture/raw/ifd_bytes.h"

namespace scattermeter::capture {
namespace {

void put_big_endian(std::vector<std::uint8_t>& out, unsigned value) {
  out.push_back(static_cast<std::uint8_t>(value >> 8U));
  out.push_back(static_cast<std::uint8_t>(value));
}

// Version, the predictions of the four CFA phases, size, decoded value of each code. (0x44 0x10:
// the table has an entry for each code, and no split follows it.)
std::vector<std::uint8_t> linearization(const std::vector<std::uint16_t>& table,
                                        std::uint16_t first_prediction) {
  std::vector<std::uint8_t> out = {0x44, 0x10};
  for (int phase = 0; phase < 4; ++phase) put_big_endian(out, first_prediction);
  put_big_endian(out, static_cast<unsigned>(table.size()));
  for (const std::uint16_t value : table) put_big_endian(out, value);
  return out;
}

// Red, green of the red rows, green of the blue rows, blue, on the scale of 14 bits.
std::vector<std::uint16_t> black_14_bits(const RawMetadata& metadata) {
  std::vector<std::uint16_t> black(4);
  for (std::size_t phase = 0; phase < 4; ++phase) {
    const Channel channel = metadata.cfa.phase[phase];
    const bool red_row = metadata.cfa.phase[phase ^ 1U] == Channel::kRed;
    const std::size_t at = channel == Channel::kRed    ? 0
                           : channel == Channel::kBlue ? 3
                           : red_row                   ? 1
                                                       : 2;
    black[at] = static_cast<std::uint16_t>(4 * metadata.black_counts[phase]);
  }
  return black;
}

}  // namespace

std::vector<std::uint8_t> nikon_maker_note(const RawMetadata& metadata,
                                           std::uint16_t first_prediction) {
  IfdBytes directory(ByteOrder::kBigEndian);
  directory.undefined(0x0001, {'0', '2', '1', '0'});                              // version
  directory.shorts(0x0002, {0, static_cast<std::uint16_t>(metadata.iso)});        // ISO
  directory.ascii(0x0004, "RAW    ");                                             // quality
  directory.rationals(0x000c, {{256, 256}, {256, 256}, {256, 256}, {256, 256}});  // R B G G
  if (std::any_of(metadata.black_counts.begin(), metadata.black_counts.end(),
                  [](int black) { return black != 0; })) {
    directory.shorts(0x003d, black_14_bits(metadata));
  }
  directory.shorts(0x0093, {1});  // compression: lossy, type 1
  directory.undefined(0x0096, linearization(metadata.linearization_table, first_prediction));

  std::vector<std::uint8_t> note = {'N', 'i', 'k', 'o', 'n', 0, 2, 0x10, 0, 0};
  const std::array<std::uint8_t, 8> header = {'M', 'M', 0, 42, 0, 0, 0, 8};
  const std::vector<std::uint8_t> fields = directory.at(header.size());
  note.insert(note.end(), header.begin(), header.end());
  note.insert(note.end(), fields.begin(), fields.end());
  return note;
}

}  // namespace scattermeter::capture
