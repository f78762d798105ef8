// OpenPBR and MaterialX, read back by a parser that is not ours; coefficients by their rules.
#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pugixml.hpp>

#include "tests/fixtures/apps/exported.h"

namespace scattermeter::apps {
namespace {

// As the OpenPBR specification 1.1 prints it, with its six figures.
TEST(ExportMaterialX, OpenPbrTellsTheMedium) {
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

TEST(ExportMaterialX, TellsTheMediumPerMetre) {
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

}  // namespace
}  // namespace scattermeter::apps
