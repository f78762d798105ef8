#include "capture/files/obj_syntax.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

#include "core/base/input_error.h"

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

// The words before a comment. Only these two characters separate words for tinyobjloader, too.
std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  constexpr std::string_view kBlank = " \t";
  for (std::size_t at = line.find_first_not_of(kBlank);
       at != std::string_view::npos && line[at] != '#';) {
    const std::size_t end = std::min(line.find_first_of(kBlank, at), line.size());
    words.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(kBlank, end);
  }
  return words;
}

// A word of the file, shortened and made printable for a message.
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

class Checker {
 public:
  Checker(const std::string& path, std::size_t max_triangles)
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
      refuse(quoted(words[0]) + " is not a keyword of an OBJ file" +
             (path_.ends_with(".obj") && words[0] != "solid"
                  ? ""
                  : "; a mesh of another kind (STL, PLY) is to be exported as OBJ"));
    }
  }

  // Faces may name vertices of later lines, so the upper bound is known only at the end.
  ObjCounts finish() {
    if (largest_index_ > static_cast<long long>(counts_.vertices)) {
      line_number_ = largest_index_line_;
      refuse("vertex index " + std::to_string(largest_index_) + " is out of range, the file has " +
             std::to_string(counts_.vertices) + " vertices");
    }
    return counts_;
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
    for (std::size_t i = 1; i < words.size(); ++i) {
      double value = 0;
      if (!parse(words[i], value) || !std::isfinite(value)) {
        refuse("coordinate " + quoted(words[i]) + " is not a finite number");
      }
    }
    if (++counts_.vertices > std::numeric_limits<int>::max()) refuse("too many vertices");
  }

  void face(const std::vector<std::string_view>& words) {
    const std::size_t corners = words.size() - 1;
    if (corners < 3) refuse("a face takes three or more corners, got " + std::to_string(corners));
    counts_.triangles += corners - 2;
    if (counts_.triangles > max_triangles_) {
      refuse("more than " + std::to_string(max_triangles_) +
             " triangles (limits.mesh_triangles of the rig)");
    }
    for (std::size_t i = 1; i < words.size(); ++i) corner(words[i]);
    ++counts_.faces;
  }

  // i, i/j, i//k or i/j/k. Indices of texture and normal are not used, but one that is no integer
  // shows a damaged file.
  void corner(std::string_view word) {
    long long index = 0;
    std::string_view rest = word;
    for (int part = 0; part < 3; ++part) {
      const std::size_t end = std::min(rest.find('/'), rest.size());
      const bool is_last = end == rest.size();
      const bool left_out = part == 1 && end == 0 && !is_last;
      long long unused = 0;
      if (!left_out && !parse(rest.substr(0, end), part == 0 ? index : unused)) break;
      if (is_last) return vertex_index(index);
      rest.remove_prefix(end + 1);
    }
    refuse("face corner " + quoted(word) + " is not an index");
  }

  void vertex_index(long long index) {
    if (index == 0 || index < -static_cast<long long>(counts_.vertices)) {
      refuse("vertex index " + std::to_string(index) + " is out of range, " +
             std::to_string(counts_.vertices) + " vertices precede it");
    }
    if (index > largest_index_) {
      largest_index_ = index;
      largest_index_line_ = line_number_;
    }
  }

  const std::string& path_;
  std::size_t max_triangles_;
  std::size_t line_number_ = 0;
  ObjCounts counts_;
  long long largest_index_ = 0;
  std::size_t largest_index_line_ = 0;
};

}  // namespace

ObjCounts check_obj_syntax(const std::string& path, std::string_view text,
                           std::size_t max_triangles) {
  Checker checker(path, max_triangles);
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find_first_of("\r\n", at), text.size());
    checker.line(text.substr(at, end - at));
    at = end + (text.substr(end, 2) == "\r\n" ? 2 : 1);
  }
  return checker.finish();
}

}  // namespace scattermeter::capture
