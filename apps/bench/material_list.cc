#include "apps/bench/material_list.h"

#include <array>
#include <charconv>
#include <fstream>

#include <fmt/core.h>

#include "core/base/input_error.h"

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
  std::ifstream in(path);
  std::string line;
  if (!in || !std::getline(in, line)) throw InputError(path, "cannot be read, or is empty");
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
  static const std::vector<ListedMaterial> list = {
      {"marble", 'R', {2.19, 0.0021, 1.5}},   {"marble", 'G', {2.62, 0.0041, 1.5}},
      {"marble", 'B', {3.00, 0.0071, 1.5}},   {"skimmilk", 'R', {0.70, 0.0014, 1.3}},
      {"skimmilk", 'G', {1.22, 0.0025, 1.3}}, {"skimmilk", 'B', {1.90, 0.0142, 1.3}},
      {"skin1", 'R', {0.74, 0.032, 1.3}},     {"skin1", 'G', {0.88, 0.17, 1.3}},
      {"skin1", 'B', {1.01, 0.48, 1.3}},      {"ketchup", 'R', {0.18, 0.061, 1.3}},
      {"ketchup", 'G', {0.07, 0.97, 1.3}},    {"ketchup", 'B', {0.03, 1.45, 1.3}}};
  return list;
}

}  // namespace scattermeter::apps
