// Blender's script, run by Debian's Python; coefficients by Cycles' own rules.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "apps/report/child_process.h"
#include "tests/fixtures/apps/exported.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

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

TEST(ExportBlender, ScriptMakesTheMedium) {
  const Exported exported;
  // Without the option in Blender's own unit, the metre.
  const std::pair<double, std::vector<std::string>> units[] = {{1.0, {"--mm-per-unit", "1"}},
                                                               {1000.0, {}}};
  for (const auto& [mm_per_unit, options] : units) {
    const std::string script = exported.text("blender", options);
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

}  // namespace
}  // namespace scattermeter::apps
