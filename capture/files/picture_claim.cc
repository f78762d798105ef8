#include "capture/files/picture_claim.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <map>
#include <set>
#include <string>

namespace scattermeter::capture {
namespace {

// Random access to the bytes of the file. Bytes beyond its end are 0, and ok() is false from then
// on.
class Head {
 public:
  explicit Head(std::istream& file) : file_(file) {}

  std::string text(std::uint64_t at, std::size_t count) {
    std::string bytes(count, '\0');
    file_.clear();
    file_.seekg(static_cast<std::streamoff>(at));
    file_.read(bytes.data(), static_cast<std::streamsize>(count));
    if (!file_) ok_ = false;
    return bytes;
  }
  std::uint32_t little(std::uint64_t at, std::size_t count) { return number(at, count, true); }
  std::uint32_t big(std::uint64_t at, std::size_t count) { return number(at, count, false); }
  bool ok() const { return ok_; }

 private:
  std::uint32_t number(std::uint64_t at, std::size_t count, bool least_first) {
    std::string bytes = text(at, count);
    if (least_first) std::reverse(bytes.begin(), bytes.end());
    std::uint32_t value = 0;
    for (const char c : bytes) value = value << 8U | static_cast<unsigned char>(c);
    return value;
  }

  std::istream& file_;
  bool ok_ = true;
};

PictureClaim of_size(std::uint32_t width_px, std::uint32_t height_px) {
  return {width_px, height_px, static_cast<double>(width_px) * height_px};
}

// Reads the first frame header. The segments before it hold EXIF, profiles and tables.
PictureClaim jpeg(Head& head) {
  constexpr int kMostSegments = 10'000;
  std::uint64_t at = 2;
  for (int i = 0; i < kMostSegments && head.ok(); ++i) {
    if (head.big(at, 1) != 0xff) return {};
    const std::uint32_t marker = head.big(at + 1, 1);
    if (marker == 0xff) {  // fill bytes
      ++at;
      continue;
    }
    const bool bare = marker == 0x01 || (marker >= 0xd0 && marker <= 0xd8);
    const bool frame =
        marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
    if (marker == 0xd9 || marker == 0xda) return {};  // the end, or samples without a frame
    if (frame) return of_size(head.big(at + 7, 2), head.big(at + 5, 2));
    at += 2 + (bare ? 0 : std::max(2U, head.big(at + 2, 2)));
  }
  return {};
}

PictureClaim png(Head& head) {
  if (head.text(12, 4) != "IHDR") return {};
  return of_size(head.big(16, 4), head.big(20, 4));
}

PictureClaim bmp(Head& head) {
  if (head.little(14, 4) == 12) return of_size(head.little(18, 2), head.little(20, 2));
  const std::uint32_t height = head.little(22, 4);  // negative: rows from the top
  return of_size(head.little(18, 4), height >> 31U != 0 ? 0U - height : height);
}

// Reads the two numbers after "P5" and the like, each preceded by white space and comments.
PictureClaim portable_map(Head& head) {
  constexpr std::size_t kLongestHead = 4096;
  std::uint64_t at = 2;
  std::uint32_t size[2] = {0, 0};
  for (std::uint32_t& number : size) {
    int c = 0;
    bool comment = false;
    const auto next = [&] { return c = static_cast<int>(head.big(at++, 1)); };
    while (next(), head.ok() && at < kLongestHead && (comment || std::isdigit(c) == 0)) {
      if (c == '#') comment = true;
      if (c == '\n' || c == '\r') comment = false;
      if (!comment && c != '#' && std::isspace(c) == 0) return {};
    }
    std::uint64_t value = 0;
    for (; std::isdigit(c) != 0; next()) {
      value = 10 * value + static_cast<std::uint64_t>(c - '0');
      if (value > 0x7fffffff) return {};
    }
    number = static_cast<std::uint32_t>(value);
  }
  return of_size(size[0], size[1]);
}

PictureClaim webp(Head& head) {
  const std::string kind = head.text(12, 4);
  if (kind == "VP8 ") return of_size(head.little(26, 2) & 0x3fffU, head.little(28, 2) & 0x3fffU);
  if (kind == "VP8X") return of_size(head.little(24, 3) + 1, head.little(27, 3) + 1);
  if (kind != "VP8L") return {};
  const std::uint32_t bits = head.little(21, 4);
  return of_size((bits & 0x3fffU) + 1, (bits >> 14U & 0x3fffU) + 1);
}

PictureClaim tiff(Head& head, bool least_first) {
  const auto number = [&](std::uint64_t at, std::size_t count) {
    return least_first ? head.little(at, count) : head.big(at, count);
  };
  constexpr std::uint32_t kWidth = 256, kLength = 257, kStripRows = 278, kTileWidth = 322,
                          kTileLength = 323;
  std::map<std::uint32_t, std::uint32_t> fields = {
      {kWidth, 0}, {kLength, 0}, {kStripRows, 0}, {kTileWidth, 0}, {kTileLength, 0}};
  std::set<std::uint32_t> met;
  const std::uint64_t directory = number(4, 4);
  const std::uint32_t entries = number(directory, 2);
  for (std::uint32_t i = 0; i < entries && head.ok(); ++i) {
    const std::uint64_t at = directory + 2 + 12 * std::uint64_t{i};
    const std::uint32_t tag = number(at, 2);
    const auto field = fields.find(tag);
    if (field == fields.end()) continue;
    const std::uint32_t type = number(at + 2, 2);  // 3: 2 bytes, 4: 4 bytes
    if ((type != 3 && type != 4) || number(at + 4, 4) != 1) return {};
    if (!met.insert(tag).second) return {};
    field->second = number(at + 8, type == 3 ? 2 : 4);
  }
  PictureClaim claim = of_size(fields[kWidth], fields[kLength]);
  const auto at_once = [&](std::uint32_t width_px, std::uint32_t height_px) {
    claim.pixels = std::max(claim.pixels, static_cast<double>(width_px) * height_px);
  };
  constexpr std::uint32_t kAllRows = 0xffffffff;
  if (fields[kStripRows] != kAllRows) at_once(fields[kWidth], fields[kStripRows]);
  at_once(fields[kTileWidth], fields[kTileLength]);
  return claim;
}

std::string kind_of(Head& head) {
  using namespace std::string_literals;
  const std::string first = head.text(0, 12);
  if (first.starts_with("\xff\xd8\xff")) return "JPEG";
  if (first.starts_with("\x89PNG\r\n\x1a\n")) return "PNG";
  if (first.starts_with("BM")) return "BMP";
  if (first.starts_with("II*\0"s) || first.starts_with("MM\0*"s)) return "TIFF";
  if (first.starts_with("RIFF") && first.ends_with("WEBP")) return "WebP";
  if (first[0] == 'P' && first[1] >= '1' && first[1] <= '6') return "PNM";
  return "";
}

// OpenCV leaves a file with this mark to its reader of DICOM, whatever the first bytes say; that
// one ends the program on a damaged file.
bool is_dicom(std::istream& file) {
  Head head(file);
  return head.text(128, 4) == "DICM";
}

PictureClaim claim_of(Head& head) {
  const std::string kind = kind_of(head);
  if (kind == "JPEG") return jpeg(head);
  if (kind == "PNG") return png(head);
  if (kind == "BMP") return bmp(head);
  if (kind == "TIFF") return tiff(head, head.text(0, 1) == "I");
  if (kind == "WebP") return webp(head);
  if (kind == "PNM") return portable_map(head);
  return {};
}

}  // namespace

std::string picture_kind(std::istream& file) {
  Head head(file);
  return kind_of(head);
}

std::optional<PictureClaim> picture_claim(std::istream& file) {
  if (is_dicom(file)) return std::nullopt;
  Head head(file);
  const PictureClaim claim = claim_of(head);
  if (!head.ok() || claim.width_px == 0 || claim.height_px == 0) return std::nullopt;
  return claim;
}

}  // namespace scattermeter::capture
