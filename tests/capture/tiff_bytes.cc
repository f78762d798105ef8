#include "tests/capture/tiff_bytes.h"

#include <random>

namespace scattermeter::capture {
namespace {

void put(Bytes& out, std::uint64_t value, std::size_t bytes) {
  for (std::size_t i = 0; i < bytes; ++i) out.push_back(static_cast<std::uint8_t>(value >> 8 * i));
}

// Most significant bit first; the last byte is filled up with `fill`.
class BitWriter {
 public:
  explicit BitWriter(bool jpeg_stuffing) : stuffing_(jpeg_stuffing) {}
  void put_bits(unsigned value, unsigned bits) {
    for (unsigned bit = bits; bit-- > 0;) {
      current_ = current_ << 1U | (value >> bit & 1U);
      if (++filled_ == 8) flush_byte();
    }
  }
  void pad(unsigned fill) {
    while (filled_ != 0) put_bits(fill, 1);
  }
  Bytes out;

 private:
  void flush_byte() {
    out.push_back(static_cast<std::uint8_t>(current_));
    if (stuffing_ && out.back() == 0xff) out.push_back(0);
    current_ = 0;
    filled_ = 0;
  }
  bool stuffing_;
  unsigned current_ = 0;
  unsigned filled_ = 0;
};

}  // namespace

void TiffBytes::bytes(unsigned tag, const Bytes& values) {
  fields_[tag] = {1, values.size(), values};
}

void TiffBytes::ascii(unsigned tag, const std::string& text) {
  Bytes data(text.begin(), text.end());
  data.push_back(0);
  fields_[tag] = {2, data.size(), data};
}

void TiffBytes::shorts(unsigned tag, const std::vector<unsigned>& values) {
  Bytes data;
  for (const unsigned value : values) put(data, value, 2);
  fields_[tag] = {3, values.size(), data};
}

void TiffBytes::longs(unsigned tag, const std::vector<unsigned>& values) {
  Bytes data;
  for (const unsigned value : values) put(data, value, 4);
  fields_[tag] = {4, values.size(), data};
}

void TiffBytes::rationals(unsigned tag, const std::vector<unsigned>& numerators,
                          unsigned denominator) {
  Bytes data;
  for (const unsigned numerator : numerators) {
    put(data, numerator, 4);
    put(data, denominator, 4);
  }
  fields_[tag] = {5, numerators.size(), data};
}

std::size_t TiffBytes::size() const {
  std::size_t total = 2 + 12 * fields_.size() + 4;
  for (const auto& [tag, field] : fields_) {
    if (field.data.size() > 4) total += field.data.size() + field.data.size() % 2;
  }
  return total;
}

void TiffBytes::append_to(Bytes& file) const {
  std::size_t data_at = file.size() + 2 + 12 * fields_.size() + 4;
  Bytes outside;
  put(file, fields_.size(), 2);
  for (const auto& [tag, field] : fields_) {
    put(file, tag, 2);
    put(file, field.type, 2);
    put(file, field.count, 4);
    Bytes data = field.data;
    if (data.size() <= 4) {
      data.resize(4);
      file.insert(file.end(), data.begin(), data.end());
      continue;
    }
    put(file, data_at, 4);
    data.resize(data.size() + data.size() % 2);
    data_at += data.size();
    outside.insert(outside.end(), data.begin(), data.end());
  }
  put(file, 0, 4);
  file.insert(file.end(), outside.begin(), outside.end());
}

Bytes TiffBytes::file(const std::vector<Bytes>& parts, bool tiled, std::size_t gap) {
  const unsigned offsets_tag = tiled ? 324 : 273;
  const unsigned counts_tag = tiled ? 325 : 279;
  longs(offsets_tag, std::vector<unsigned>(parts.size()));
  longs(counts_tag, std::vector<unsigned>(parts.size()));
  if (exif != nullptr) longs(34665, {0});

  const std::size_t exif_at = 8 + size();
  std::size_t at = exif_at + (exif != nullptr ? exif->size() : 0);
  std::vector<unsigned> offsets;
  std::vector<unsigned> counts;
  for (const Bytes& part : parts) {
    offsets.push_back(static_cast<unsigned>(at));
    counts.push_back(static_cast<unsigned>(part.size()));
    at += part.size() + gap;
  }
  longs(offsets_tag, offsets);
  longs(counts_tag, counts);
  if (exif != nullptr) longs(34665, {static_cast<unsigned>(exif_at)});

  Bytes out = {'I', 'I', 42, 0, 8, 0, 0, 0};
  append_to(out);
  if (exif != nullptr) exif->append_to(out);
  for (const Bytes& part : parts) {
    out.insert(out.end(), part.begin(), part.end());
    out.insert(out.end(), &part == &parts.back() ? 0 : gap, 0xaa);
  }
  return out;
}

TestImage random_image(unsigned width, unsigned height, unsigned bits, unsigned seed) {
  TestImage image{width, height, bits, {}};
  std::mt19937 generator(seed);
  for (std::size_t i = 0; i < std::size_t{width} * height; ++i) {
    image.codes.push_back(static_cast<std::uint16_t>(generator() >> (32 - bits)));
  }
  return image;
}

CfaDng::CfaDng(const TestImage& image) {
  longs(254, {0});
  longs(256, {image.width});
  longs(257, {image.height});
  shorts(258, {image.bits});
  shorts(259, {1});
  shorts(262, {32803});
  ascii(271, "Acme");
  ascii(272, "Acme X1");
  shorts(274, {1});
  shorts(277, {1});
  longs(278, {image.height});
  shorts(284, {1});
  shorts(33421, {2, 2});
  bytes(33422, {0, 1, 1, 2});
  bytes(50706, {1, 4, 0, 0});
  ascii(50708, "Acme X1");
  shorts(50714, {0});
  longs(50717, {(1U << image.bits) - 1});
  exif_fields_.rationals(33434, {1}, 50);
  exif_fields_.rationals(33437, {56}, 10);
  exif_fields_.shorts(34855, {200});
  exif = &exif_fields_;
}

Bytes packed_rows(const TestImage& image, unsigned first, unsigned count) {
  BitWriter writer(false);
  for (unsigned y = first; y < first + count; ++y) {
    for (unsigned x = 0; x < image.width; ++x) {
      const unsigned code = image.codes[std::size_t{y} * image.width + x];
      if (image.bits == 16) {
        writer.put_bits(code & 0xffU, 8);
        writer.put_bits(code >> 8U, 8);
      } else {
        writer.put_bits(code, image.bits);
      }
    }
    writer.pad(0);
  }
  return writer.out;
}

Bytes lossless_jpeg_rows(const TestImage& image, unsigned first, unsigned count) {
  const auto high = [](unsigned value) { return static_cast<std::uint8_t>(value >> 8U); };
  const auto low = [](unsigned value) { return static_cast<std::uint8_t>(value); };
  Bytes out = {0xff, 0xd8};
  // Seventeen difference sizes, all with codes of five bits: size s has the code s.
  Bytes table = {0xff, 0xc4, 0, 2 + 17 + 17, 0};
  for (int length = 1; length <= 16; ++length) table.push_back(length == 5 ? 17 : 0);
  for (std::uint8_t size = 0; size <= 16; ++size) table.push_back(size);
  const Bytes frame = {0xff,
                       0xc3,
                       0,
                       11,
                       low(image.bits),
                       high(count),
                       low(count),
                       high(image.width),
                       low(image.width),
                       1,
                       0,
                       0x11,
                       0};
  const Bytes scan = {0xff, 0xda, 0, 8, 1, 0, 0, 1, 0, 0};
  for (const Bytes& segment : {table, frame, scan}) {
    out.insert(out.end(), segment.begin(), segment.end());
  }
  BitWriter writer(true);
  const auto code_at = [&](unsigned y, unsigned x) {
    return static_cast<int>(image.codes[std::size_t{y} * image.width + x]);
  };
  for (unsigned y = first; y < first + count; ++y) {
    for (unsigned x = 0; x < image.width; ++x) {
      int predicted = 1 << (image.bits - 1);
      if (x > 0) {
        predicted = code_at(y, x - 1);
      } else if (y > first) {
        predicted = code_at(y - 1, x);
      }
      const int difference = code_at(y, x) - predicted;
      unsigned size = 0;
      while (std::abs(difference) >> size != 0) ++size;
      writer.put_bits(size, 5);
      const int stored = difference < 0 ? difference + (1 << size) - 1 : difference;
      writer.put_bits(static_cast<unsigned>(stored), size);
    }
  }
  writer.pad(1);
  out.insert(out.end(), writer.out.begin(), writer.out.end());
  out.insert(out.end(), {0xff, 0xd9});
  return out;
}

}  // namespace scattermeter::capture
