#include "apps/bench/material_list.h"

#include <array>
#include <charconv>
#include <sstream>
#include <string_view>

#include <fmt/core.h>

#include "capture/files/file_text.h"
#include "core/base/input_error.h"
#include "core/material/published_media.h"

namespace scattermeter::apps {
namespace {

std::vector<std::string> fields_of(std::string line) {
  if (!line.empty() && line.back() == '\r') line.pop_back();
  std::vector<std::string> fields(1);
  for (char c : line) {
    if (c == ',') {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
  return fields;
}

constexpr std::array<const char*, 5> kColumns = {"name", "channel", "eta", "sigma_s_prime_per_mm",
                                                 "sigma_a_per_mm"};

double number(const std::string& where, const char* column, const std::string& text, double min,
              double max) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !(value > min) ||
      !(value < max)) {
    throw InputError(where + ": " + column, "'" + text + "' is not a number above " +
                                                fmt::format("{:g} and below {:g}", min, max));
  }
  return value;
}

}  // namespace

std::vector<ListedMaterial> read_materials(const std::string& path) {
  std::istringstream in(capture::file_text(path, "a table of materials is expected"));
  std::string line;
  if (!std::getline(in, line)) throw InputError(path, "is empty");
  const std::vector<std::string> header = fields_of(line);
  std::array<std::size_t, kColumns.size()> place{};
  for (std::size_t c = 0; c < kColumns.size(); ++c) {
    while (place[c] < header.size() && header[place[c]] != kColumns[c]) ++place[c];
    if (place[c] == header.size()) {
      throw InputError(path + ":1", std::string("has no column ") + kColumns[c]);
    }
  }
  std::vector<ListedMaterial> out;
  for (int n = 2; std::getline(in, line); ++n) {
    if (line.empty() || line == "\r") continue;
    const std::string where = fmt::format("{}:{}", path, n);
    const std::vector<std::string> fields = fields_of(line);
    if (fields.size() < header.size()) {
      throw InputError(where,
                       fmt::format("has {} fields, the header {}", fields.size(), header.size()));
    }
    const auto text = [&](std::size_t c) { return fields[place[c]]; };
    ListedMaterial m;
    m.name = text(0);
    if (m.name.empty()) throw InputError(where + ": name", "is empty");
    if (text(1) != "R" && text(1) != "G" && text(1) != "B") {
      throw InputError(where + ": channel", "R, G or B expected, got '" + text(1) + "'");
    }
    m.channel = text(1)[0];
    m.medium.eta_int_over_ext = number(where, kColumns[2], text(2), 0.5, 4.0);
    m.medium.sigma_s_prime_per_mm = number(where, kColumns[3], text(3), 0.0, 1e6);
    m.medium.sigma_a_per_mm = number(where, kColumns[4], text(4), 0.0, 1e6);
    for (const ListedMaterial& other : out) {
      if (other.name != m.name) continue;
      if (other.channel == m.channel) {
        throw InputError(where + ": channel", m.name + " " + text(1) + " is given twice");
      }
      if (other.medium.eta_int_over_ext != m.medium.eta_int_over_ext) {
        throw InputError(where + ": eta", text(2) + " differs from another channel's of " + m.name);
      }
    }
    out.push_back(m);
  }
  if (out.empty()) throw InputError(path, "holds no material");
  return out;
}

const std::vector<ListedMaterial>& well_known_materials() {
  static const std::vector<ListedMaterial> list = [] {
    std::vector<ListedMaterial> out;
    for (const std::string_view name : {"marble", "skimmilk", "skin1", "ketchup"}) {
      for (const PublishedMaterial& m : published_materials()) {
        if (m.name != name) continue;
        for (std::size_t c = 0; c < 3; ++c) {
          out.push_back({std::string(name), "RGB" [c], {
                           m.sigma_s_prime_per_mm[c], m.sigma_a_per_mm[c], m.eta_int_over_ext
                         }});
        }
      }
    }
    return out;
  }();
  return list;
}

}  // namespace scattermeter::apps
