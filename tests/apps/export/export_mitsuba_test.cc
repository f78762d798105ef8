// Read back by a parser that is not ours; coefficients by Mitsuba's own rules.
#include <gtest/gtest.h>
#include <pugixml.hpp>

#include "tests/fixtures/apps/exported.h"

namespace scattermeter::apps {
namespace {

TEST(ExportMitsuba, TellsTheMedium) {
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

}  // namespace
}  // namespace scattermeter::apps
