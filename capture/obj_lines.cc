#include "capture/obj_lines.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

#include "core/input_error.h"

namespace scattermeter::capture {
namespace {

// The statements of the format's specification (version 3.0, and those superseded by it).
constexpr std::array<std::string_view, 43> kKeywords = {
    "v",         "vt",    "vn",       "vp",       "deg",    "bmat",   "step",   "cstype",
    "p",         "l",     "f",        "curv",     "curv2",  "surf",   "parm",   "trim",
    "hole",      "scrv",  "sp",       "end",      "con",    "g",      "s",      "mg",
    "o",         "bevel", "c_interp", "d_interp", "lod",    "usemtl", "mtllib", "shadow_obj",
    "trace_obj", "ctech", "stech",    "maplib",   "usemap", "call",   "csh",    "bsp",
    "bzp",       "cdc",   "res"};

std::vector<std::string_view> words_of(std::string_view line) {
  line = line.substr(0, line.find('#'));
  std::vector<std::string_view> words;
  constexpr std::string_view kBlank = " \t\v\f";
  for (std::size_t at = line.find_first_not_of(kBlank); at != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(kBlank, at), line.size());
    words.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(kBlank, end);
  }
  return words;
}

// What stood in the file, fit for a message: short and printable.
std::string quoted(std::string_view word) {
  std::string text = "'";
  for (const char c : word.substr(0, 40)) text += c >= ' ' && c <= '~' ? c : '?';
  return text + (word.size() > 40 ? "...'" : "'");
}

template <typename Number>
bool parse(std::string_view word, Number& value) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  const auto result = std::from_chars(word.data(), word.data() + word.size(), value);
  return result.ec == std::errc() && result.ptr == word.data() + word.size();
}

class Scanner {
 public:
  Scanner(const std::string& path, std::size_t max_triangles)
      : path_(path), max_triangles_(max_triangles) {}

  void line(std::string_view line) {
    ++line_number_;
    const std::vector<std::string_view> words = words_of(line);
    if (words.empty()) return;
    if (words.back().ends_with('\\')) refuse("lines continued with a backslash are not supported");
    if (words[0] == "v") {
      vertex(words);
    } else if (words[0] == "f") {
      face(words);
    } else if (std::find(kKeywords.begin(), kKeywords.end(), words[0]) == kKeywords.end()) {
      refuse(quoted(words[0]) + " is no keyword of an OBJ file");
    }
  }

  // Faces may name vertices that come later, so the upper bound is known only here.
  ObjGeometry finish() {
    if (largest_index_ > static_cast<long long>(geometry_.vertices)) {
      line_number_ = largest_index_line_;
      refuse("vertex index " + std::to_string(largest_index_) + " is out of range, the file has " +
             std::to_string(geometry_.vertices) + " vertices");
    }
    return std::move(geometry_);
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const {
    throw InputError(path_ + ":" + std::to_string(line_number_), what);
  }

  void vertex(const std::vector<std::string_view>& words) {
    const std::size_t numbers = words.size() - 1;
    if (numbers != 3 && numbers != 4 && numbers != 6 && numbers != 7) {
      refuse("a vertex takes three coordinates, got " + std::to_string(numbers) + " numbers");
    }
    geometry_.text += 'v';
    for (std::size_t i = 1; i < words.size(); ++i) {
      double value = 0;
      if (!parse(words[i], value) || !std::isfinite(value)) {
        refuse("coordinate " + quoted(words[i]) + " is not a finite number");
      }
      if (i <= 3) geometry_.text.append(" ").append(words[i]);
    }
    geometry_.text += '\n';
    if (++geometry_.vertices > std::numeric_limits<int>::max()) refuse("too many vertices");
  }

  void face(const std::vector<std::string_view>& words) {
    const std::size_t corners = words.size() - 1;
    if (corners < 3) refuse("a face takes three or more corners, got " + std::to_string(corners));
    geometry_.triangles += corners - 2;
    if (geometry_.triangles > max_triangles_) {
      refuse("more than " + std::to_string(max_triangles_) +
             " triangles (limits.mesh_triangles of the rig)");
    }
    geometry_.text += 'f';
    for (std::size_t i = 1; i < words.size(); ++i) {
      geometry_.text.append(" ").append(vertex_index(words[i]));
    }
    geometry_.text += '\n';
    ++geometry_.faces;
  }

  // The vertex part of a corner, checked as far as the line allows.
  std::string_view vertex_index(std::string_view corner) {
    const std::string_view whole = corner.substr(0, corner.find('/'));
    long long index = 0;
    if (!parse(whole, index)) refuse("face corner " + quoted(corner) + " is not an index");
    check_rest(corner);
    if (index == 0 || index < -static_cast<long long>(geometry_.vertices)) {
      refuse("vertex index " + std::to_string(index) + " is out of range, " +
             std::to_string(geometry_.vertices) + " vertices stand before it");
    }
    if (index > largest_index_) {
      largest_index_ = index;
      largest_index_line_ = line_number_;
    }
    return whole;
  }

  // Texture and normal index: not used, but a corner that is no corner shows a damaged file.
  void check_rest(std::string_view corner) const {
    const std::string_view all = corner;
    for (int part = 1; corner.find('/') != std::string_view::npos; ++part) {
      corner.remove_prefix(corner.find('/') + 1);
      const std::string_view index = corner.substr(0, corner.find('/'));
      const bool left_out = index.empty() && part == 1 && corner.size() > 1;
      long long unused = 0;
      if (part > 2 || (!left_out && !parse(index, unused))) {
        refuse("face corner " + quoted(all) + " is not an index");
      }
    }
  }

  const std::string& path_;
  std::size_t max_triangles_;
  std::size_t line_number_ = 0;
  ObjGeometry geometry_;
  long long largest_index_ = 0;
  std::size_t largest_index_line_ = 0;
};

}  // namespace

ObjGeometry obj_geometry(const std::string& path, const std::string& text,
                         std::size_t max_triangles) {
  Scanner scanner(path, max_triangles);
  const std::string_view all = text;
  for (std::size_t at = 0; at < all.size();) {
    const std::size_t end = std::min(all.find_first_of("\r\n", at), all.size());
    scanner.line(all.substr(at, end - at));
    const bool two = all.substr(end, 2) == "\r\n";
    at = end + (two ? 2 : 1);
  }
  return scanner.finish();
}

}  // namespace scattermeter::capture
