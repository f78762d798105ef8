// Coefficients by pbrt-v4's own rules.
#include <cctype>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/fixtures/apps/exported.h"

namespace scattermeter::apps {
namespace {

// pbrt-v4's statements: directive, quoted name, then "type name" with its values in brackets.
struct PbrtStatement {
  std::string directive, name;
  std::map<std::string, std::vector<std::string>> parameters;
};

std::vector<PbrtStatement> pbrt_statements(const std::string& text) {
  std::vector<std::string> tokens;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    for (std::size_t i = 0; i < line.size();) {
      if (line[i] == '#') break;
      if (std::isspace(static_cast<unsigned char>(line[i])) != 0) {
        ++i;
        continue;
      }
      const bool quoted = line[i] == '"';
      std::size_t end = quoted ? line.find('"', i + 1) : line.find_first_of(" \t", i);
      EXPECT_TRUE(!quoted || end != std::string::npos) << line;
      if (end == std::string::npos) end = line.size();
      tokens.push_back(line.substr(i, end - i));
      i = end + (quoted ? 1 : 0);
    }
  }
  std::vector<PbrtStatement> out;
  for (std::size_t i = 0; i < tokens.size();) {
    PbrtStatement s;
    s.directive = tokens.at(i++);
    EXPECT_NE(s.directive.front(), '"');
    s.name = tokens.at(i++).substr(1);
    while (i < tokens.size() && tokens[i].front() == '"') {
      std::vector<std::string>& values = s.parameters[tokens[i++].substr(1)];
      if (tokens.at(i) != "[") {
        values.push_back(tokens[i++]);
        continue;
      }
      for (++i; tokens.at(i) != "]"; ++i) values.push_back(tokens[i]);
      ++i;
    }
    out.push_back(s);
  }
  return out;
}

TEST(ExportPbrt, TellsTheMedium) {
  const Exported exported;
  for (const UnitCase& u : kUnits) {
    std::map<std::string, std::size_t> seen;
    for (const PbrtStatement& s : pbrt_statements(exported.text("pbrt", u.options))) {
      const std::string kind = s.directive + s.parameters.at("string type").front();
      if (kind == "MakeNamedMaterial\"dielectric") {
        EXPECT_EQ(s.parameters.at("float eta").front(), "1.4");
        continue;
      }
      EXPECT_TRUE(kind == "MakeNamedMedium\"homogeneous" || kind == "MakeNamedMaterial\"subsurface")
          << kind;
      const double scale = std::stod(s.parameters.at("float scale").front());
      Triple sigma_s{}, sigma_a{};
      for (std::size_t c = 0; c < 3; ++c) {
        sigma_s[c] = scale * std::stod(s.parameters.at("rgb sigma_s").at(c));
        sigma_a[c] = scale * std::stod(s.parameters.at("rgb sigma_a").at(c));
      }
      EXPECT_EQ(std::stod(s.parameters.at("float g").front()), u.g);
      expect_medium(seen[kind]++, sigma_s, sigma_a, u.mm_per_unit, u.g, 1e-14);
    }
    EXPECT_EQ(seen["MakeNamedMedium\"homogeneous"], kExported.size());
    EXPECT_EQ(seen["MakeNamedMaterial\"subsurface"], kExported.size());
  }
}

}  // namespace
}  // namespace scattermeter::apps
