// Every format read back by a parser that is not ours, as far as there is one, and its coefficients
// recomputed by the renderer's own rules.
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <sstream>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>
#include <unistd.h>

#include "apps/export/export_formats.h"
#include "apps/export/identifiers.h"
#include "apps/report/child_process.h"
#include "core/base/input_error.h"
#include "tests/fixtures/apps/made_result.h"
#include "tests/fixtures/apps/small_rig.h"
#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;
using Triple = std::array<double, 3>;

constexpr const char* kNasty = "<script>--> \"POM\" \\ & 'ö'\n]]>";

const MadeMaterials kExported = {{"POM", {{1.4, 1.6, 1.75}, {0.002, 0.004, 0.008}}},
                                 {kNasty, {{0.5, 0.62, 0.7}, {0.003, 0.0002, 0.4}}}};

class Exported {
 public:
  explicit Exported(const nlohmann::json& json = made_result(kExported)) {
    write_file(result(), json.dump());
  }
  std::string result() const { return folder_ / "result.json"; }
  std::string out() const { return folder_ / "out"; }
  std::string operator/(const std::string& name) const { return folder_ / name; }
  Answer run_format(const std::string& format, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words = {"export", result(), "--format", format, "--out", out()};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  }
  std::string text(const std::string& format, const std::vector<std::string>& more = {}) const {
    const Answer answer = run_format(format, more);
    EXPECT_EQ(answer.status, 0) << answer.err;
    return slurp(out());
  }

 private:
  TemporaryFolder folder_;
};

Triple triple(std::string text) {
  for (char& c : text) c = c == ',' ? ' ' : c;
  std::istringstream in(text);
  Triple out{};
  in >> out[0] >> out[1] >> out[2];
  EXPECT_FALSE(in.fail()) << text;
  return out;
}

// The materials stand in the file in the order of the result.
const MadeMaterial& truth_at(std::size_t i) {
  return std::next(kExported.begin(), static_cast<long>(i))->second;
}

void expect_medium(std::size_t i, const Triple& sigma_s, const Triple& sigma_a, double mm_per_unit,
                   double g, double tolerance = 1e-9) {
  const MadeMaterial& truth = truth_at(i);
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(sigma_s[c] * (1.0 - g) / mm_per_unit, truth.sigma_s_prime[c],
                tolerance * truth.sigma_s_prime[c]);
    // From 1 - albedo, so relative to sigma_t.
    EXPECT_NEAR(sigma_a[c] / mm_per_unit, truth.sigma_a[c], tolerance * truth.sigma_s_prime[c]);
  }
}

pugi::xml_document parsed(const std::string& text) {
  pugi::xml_document document;
  const pugi::xml_parse_result ok = document.load_string(text.c_str(), pugi::parse_full);
  EXPECT_TRUE(ok) << ok.description() << " in " << text;
  return document;
}

pugi::xml_node named(const pugi::xml_node& parent, const char* name) {
  const pugi::xml_node node = parent.find_child_by_attribute("name", name);
  EXPECT_TRUE(node) << name;
  return node;
}

struct UnitCase {
  double mm_per_unit, g;
  std::vector<std::string> options;
};
const std::vector<UnitCase> kUnits = {{1.0, 0.0, {}},
                                      {10.0, 0.8, {"--mm-per-unit", "10", "--g", "0.8"}}};

TEST(Export, MitsubaTellsTheMedium) {
  const Exported exported;
  for (const UnitCase& u : kUnits) {
    const pugi::xml_document document = parsed(exported.text("mitsuba", u.options));
    std::size_t i = 0;
    for (const pugi::xml_node& medium : document.child("scene").children("medium")) {
      EXPECT_STREQ(medium.attribute("type").value(), "homogeneous");
      const Triple relative = triple(named(medium, "sigma_t").attribute("value").value());
      const Triple albedo = triple(named(medium, "albedo").attribute("value").value());
      const double scale = named(medium, "scale").attribute("value").as_double();
      Triple sigma_s{}, sigma_a{};
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_GT(relative[c], 0.0);  // what Mitsuba takes as an RGB value
        EXPECT_LE(relative[c], 1.0);
        sigma_s[c] = relative[c] * scale * albedo[c];
        sigma_a[c] = relative[c] * scale * (1.0 - albedo[c]);
      }
      expect_medium(i++, sigma_s, sigma_a, u.mm_per_unit, u.g);
      const pugi::xml_node phase = medium.child("phase");
      EXPECT_STREQ(phase.attribute("type").value(), u.g == 0.0 ? "isotropic" : "hg");
      if (u.g != 0.0) {
        EXPECT_EQ(named(phase, "g").attribute("value").as_double(), u.g);
      }
    }
    EXPECT_EQ(i, kExported.size());
    const pugi::xml_node surface = document.child("scene").child("bsdf");
    EXPECT_EQ(named(surface, "int_ior").attribute("value").as_double(), 1.4);
  }
}

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

TEST(Export, PbrtTellsTheMedium) {
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

// As the OpenPBR specification 1.1 prints it, with its six figures.
TEST(Export, OpenPbrTellsTheMedium) {
  const Exported exported;
  for (const UnitCase& u : kUnits) {
    const pugi::xml_document document = parsed(exported.text("openpbr", u.options));
    const pugi::xml_node root = document.child("materialx");
    std::size_t i = 0;
    for (const pugi::xml_node& node : root.children("open_pbr_surface")) {
      const auto value = [&](const char* name) { return named(node, name).attribute("value"); };
      const Triple colour = triple(value("subsurface_color").value());
      const Triple scale = triple(value("subsurface_radius_scale").value());
      const double g = value("subsurface_scatter_anisotropy").as_double();
      EXPECT_EQ(g, u.g);
      Triple sigma_s{}, sigma_a{};
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_LE(scale[c], 1.0);
        const double x = colour[c];
        const double s = 4.09712 + 4.20863 * x - std::sqrt(9.59217 + 41.6808 * x + 17.7126 * x * x);
        const double albedo = (1.0 - s * s) / (1.0 - g * s * s);
        const double sigma_t = 1.0 / (value("subsurface_radius").as_double() * scale[c]);
        sigma_s[c] = sigma_t * albedo;
        sigma_a[c] = sigma_t * (1.0 - albedo);
      }
      // The specification's figures leave 2e-5 of s.
      expect_medium(i, sigma_s, sigma_a, u.mm_per_unit, u.g, 3e-5);
      EXPECT_EQ(value("specular_ior").as_double(), 1.4);
      EXPECT_EQ(value("subsurface_weight").as_double(), 1.0);
      ++i;
    }
    EXPECT_EQ(i, kExported.size());
    // The name as given, apart from what no XML attribute can hold.
    std::vector<std::string> names;
    for (const pugi::xml_node& m : root.children("surfacematerial")) {
      names.emplace_back(m.attribute("uiname").value());
      const std::string node = named(m, "surfaceshader").attribute("nodename").value();
      EXPECT_TRUE(root.find_child_by_attribute("name", node.c_str())) << node;
    }
    EXPECT_THAT(names, ::testing::ElementsAre("<script>--> \"POM\" \\ & 'ö' ]]>", "POM"));
  }
}

TEST(Export, MaterialXTellsTheMediumPerMetre) {
  const Exported exported;
  for (const UnitCase& u : kUnits) {
    const pugi::xml_document document = parsed(exported.text("materialx", u.options));
    const pugi::xml_node root = document.child("materialx");
    std::size_t i = 0;
    for (const pugi::xml_node& node : root.children("anisotropic_vdf")) {
      const auto value = [&](const char* name) {
        return std::string(named(node, name).attribute("value").value());
      };
      EXPECT_EQ(std::stod(value("anisotropy")), u.g);
      expect_medium(i++, triple(value("scattering")), triple(value("absorption")),
                    u.options.empty() ? 1000.0 : u.mm_per_unit, u.g, 1e-14);
    }
    EXPECT_EQ(i, kExported.size());
    // Each connection leads somewhere.
    for (const auto& input : document.select_nodes("//input[@nodename]")) {
      const char* node = input.node().attribute("nodename").value();
      EXPECT_TRUE(root.find_child_by_attribute("name", node)) << node;
    }
  }
}

// A bpy that notes what the script sets, run by Debian's Python.
constexpr const char* kFakeBpy = R"py(
import json
made = []
class Socket: pass
class Inputs(dict):
    def __missing__(self, key):
        self[key] = Socket(); return self[key]
class Node:
    def __init__(self): self.type = "BSDF_PRINCIPLED"; self.inputs = Inputs()
class Tree:
    def __init__(self): self.nodes = [Node()]
class Material:
    def __init__(self, name): self.name = name; self.node_tree = Tree()
class Materials:
    def new(self, name):
        made.append(Material(name)); return made[-1]
class data: materials = Materials()
def dump():
    return json.dumps([{"name": m.name, "method": m.node_tree.nodes[0].subsurface_method,
                        **{k: s.default_value for k, s in m.node_tree.nodes[0].inputs.items()}}
                       for m in made])
)py";

// Cycles' own road from colour and radius to the medium, in single precision as there.
Triple cycles_medium(float colour, float radius) {
  const float mean_free_path = radius * 0.25F * std::numbers::inv_pi_v<float>;
  const float b = 4.98511194385F + 0.127355959438F * std::exp(0.0F);
  const float e = 4.23190299701F + 0.00310603949088F * std::exp(0.0F);
  const float blend = std::pow(colour, 0.25F);
  float alpha = (1.0F - blend) * 1.8260523782F * std::pow(std::atan(b * colour), 1.09686102424F) +
                blend * 0.496310210422F * std::pow(std::atan(e * colour), 2.40602999408F);
  alpha = std::clamp(alpha, 0.0F, 0.999999F);
  return {alpha / mean_free_path, (1.0F - alpha) / mean_free_path, 0.0};
}

TEST(Export, BlendersScriptMakesTheMedium) {
  const Exported exported;
  for (double mm_per_unit : {1.0, 1000.0}) {
    const std::string script =
        exported.text("blender", {"--mm-per-unit", std::to_string(mm_per_unit)});
    write_file(exported / "bpy.py", std::string(kFakeBpy));
    write_file(exported / "made.py", script);
    const std::string out = exported / "made.json";
    const int descriptor = ::open(out.c_str(), O_CREAT | O_WRONLY, 0600);
    const ChildResult child =
        run_child({"/usr/bin/python3", "-c",
                   "import sys; sys.path.insert(0, sys.argv[1]); import made, bpy; "
                   "print(bpy.dump())",
                   exported / "."},
                  "", descriptor);
    ::close(descriptor);
    ASSERT_EQ(child.status, 0) << child.errors;
    const nlohmann::json made = nlohmann::json::parse(slurp(out));
    ASSERT_EQ(made.size(), kExported.size());
    for (std::size_t i = 0; i < made.size(); ++i) {
      EXPECT_EQ(made[i]["name"], std::next(kExported.begin(), static_cast<long>(i))->first);
      EXPECT_EQ(made[i]["method"], "RANDOM_WALK");
      EXPECT_EQ(made[i]["IOR"], 1.4);
      Triple sigma_s{}, sigma_a{};
      for (std::size_t c = 0; c < 3; ++c) {
        const Triple m = cycles_medium(made[i]["Base Color"][c].get<float>(),
                                       made[i]["Subsurface Radius"][c].get<float>() *
                                           made[i]["Subsurface Scale"].get<float>());
        sigma_s[c] = m[0];
        sigma_a[c] = m[1];
      }
      // A few steps of single precision near 1.
      expect_medium(i, sigma_s, sigma_a, mm_per_unit, 0.0, 1e-6);
    }
  }
  const Answer g = exported.run_format("blender", {"--g", "0.5"});
  EXPECT_EQ(g.status, 2);
  EXPECT_THAT(g.err, HasSubstr("--g: the format blender takes 0 only, got 0.5"));
}

TEST(Export, CsvHoldsValuesAndUncertainties) {
  const std::string text = Exported(made_result({{"P,O\"M", kExported.at("POM")}})).text("csv");
  EXPECT_THAT(text, HasSubstr("material,channel,verdict,model,eta,sigma_s_prime_per_mm,"
                              "sigma_s_prime_per_mm_std,sigma_s_prime_per_mm_low95,"
                              "sigma_s_prime_per_mm_high95,sigma_a_per_mm,"));
  EXPECT_THAT(
      text,
      HasSubstr("\n\"P,O\"\"M\",G,ok,dipole,1.4,1.6,0.4,0.8,3.2,0.004,0.001,0.002,0.008,0.5,"));
}

TEST(Export, EveryFileStatesUnitScaleAndUncertainty) {
  const Exported exported;
  for (const char* format : {"mitsuba", "pbrt", "blender", "openpbr", "materialx"}) {
    const std::string text = exported.text(format, {"--mm-per-unit", "25.4"});
    EXPECT_THAT(text, HasSubstr("1 scene unit = 25.4 mm")) << format;
    EXPECT_THAT(text, ::testing::ContainsRegex(
                          "POM R: sigma_s' 1.4 [+]- 0.35 per mm, sigma_a 0.002 [+]- 0.0005"))
        << format;
  }
}

TEST(Export, RefusedIsNotWritten) {
  nlohmann::json json = made_result(kExported);
  for (nlohmann::json& entry : json["results"]) {
    if (entry["material"] != "POM" || entry["channel"] != "B") continue;
    entry["verdict"] = "refused";
    entry["reasons"] = {"The dipole does not fit."};
    entry["sigma_a_per_mm"] = {
        {"value", nullptr}, {"std", nullptr}, {"interval95", {nullptr, nullptr}}};
  }
  const Exported exported(json);
  for (const char* format : {"mitsuba", "pbrt", "blender", "openpbr", "materialx"}) {
    const Answer answer = exported.run_format(format);
    EXPECT_EQ(answer.status, 1) << format;
    EXPECT_THAT(answer.err, HasSubstr("POM B is refused: The dipole does not fit."));
    EXPECT_THAT(answer.err, HasSubstr("nothing is written"));
    EXPECT_EQ(slurp(exported.out()), "");
  }
  // The others can be had.
  EXPECT_EQ(exported.run_format("pbrt", {"--material", kNasty}).status, 0);
  EXPECT_THAT(slurp(exported.out()), ::testing::Not(HasSubstr("POM R")));
  // The table tells the verdict and keeps the numbers to itself.
  const Answer csv = exported.run_format("csv");
  EXPECT_EQ(csv.status, 1);
  EXPECT_THAT(slurp(exported.out()), HasSubstr("POM,B,refused,dipole,1.4,,,,,,,,,,The dipole"));
}

TEST(Export, NamesWhatIsWrongInAResult) {
  const auto error = [](const std::function<void(nlohmann::json&)>& spoil) {
    nlohmann::json json = made_result(kExported);
    spoil(json);
    const Answer answer = Exported(json).run_format("csv");
    EXPECT_EQ(answer.status, 2);
    return answer.err;
  };
  EXPECT_THAT(error([](auto& j) { j["results"][4].erase("sigma_a_per_mm"); }),
              HasSubstr("result.json: results[4].sigma_a_per_mm: is missing"));
  EXPECT_THAT(error([](auto& j) { j["results"][0]["sigma_s_prime_per_mm"]["value"] = -2; }),
              HasSubstr("results[0].sigma_s_prime_per_mm.value: expected a number from"));
  EXPECT_THAT(error([](auto& j) { j["results"][0]["channel"] = "X"; }),
              HasSubstr("results[0].channel: expected R, G or B, got \"X\""));
  EXPECT_THAT(error([](auto& j) { j["results"][1]["channel"] = "R"; }),
              HasSubstr("has this channel twice"));
  EXPECT_THAT(error([](auto& j) { j["results"].erase(0); }), HasSubstr("has no channel R"));
  EXPECT_THAT(error([](auto& j) { j["results"][0]["eta"] = 1.5; }), HasSubstr("different eta"));
  EXPECT_THAT(error([](auto& j) { j["results"][0]["verdict"] = "maybe"; }),
              HasSubstr("verdict: expected ok or refused, got \"maybe\""));
  EXPECT_THAT(error([](auto& j) { j["results"] = nlohmann::json::array(); }),
              HasSubstr("expected at least one entry"));
  EXPECT_THAT(error([](auto& j) { j = nlohmann::json::array(); }), HasSubstr("expected an object"));
  const Exported exported;
  EXPECT_THAT(exported.run_format("csv", {"--material", "PP"}).err,
              HasSubstr("holds no material PP, only "));
  EXPECT_EQ(exported.run_format("obj").status, 2);
  EXPECT_EQ(run({"export", "/nowhere.json", "--format", "csv", "--out", exported.out()}).status, 2);
  write_file(exported.result(), std::string("{\"results\": ["));
  EXPECT_THAT(exported.run_format("csv").err, HasSubstr("is not JSON"));
}

// Two names that no file can tell apart after escaping stay two materials.
TEST(Export, IdentifiersAreUnique) {
  EXPECT_EQ(identifiers({"a b", "a_b", "2 mm", "", "a b"}),
            (std::vector<std::string>{"a_b", "a_b_2", "m_2_mm", "m_", "a_b_3"}));
}

}  // namespace
}  // namespace scattermeter::apps
