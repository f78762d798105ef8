#include "apps/export/xml_text.h"

#include <gtest/gtest.h>
#include <pugixml.hpp>

namespace scattermeter::apps {
namespace {

TEST(XmlText, CommentsEndWhereTheyShould) {
  EXPECT_EQ(xml_comments({"one", "two"}, "  "), "  <!-- one -->\n  <!-- two -->\n");
  EXPECT_EQ(xml_comments({}, "  "), "");
  // "--" is not allowed inside, nor is a dash at the end.
  EXPECT_EQ(xml_comments({"a --> b ---"}, ""), "<!-- a - -> b - - - -->\n");
}

TEST(XmlText, ValuesAreReadBack) {
  const std::string nasty = "a<b> & \"c\" 'd'";
  const std::string element = xml_value(" ", "input", nasty, "color3", nasty);
  EXPECT_EQ(element.front(), ' ');
  EXPECT_EQ(element.back(), '\n');
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(element.c_str()));
  const pugi::xml_node node = document.child("input");
  EXPECT_EQ(node.attribute("name").value(), nasty);
  EXPECT_EQ(node.attribute("value").value(), nasty);
  EXPECT_STREQ(node.attribute("type").value(), "color3");
  EXPECT_EQ(xml_value("", "float", "scale", "", "2"), "<float name=\"scale\" value=\"2\"/>\n");
}

TEST(XmlText, ListsAreExact) {
  EXPECT_EQ(rgb_list({0.1, 1.0 / 3.0, 2e-7}), "0.1, 0.3333333333333333, 2e-07");
  EXPECT_EQ(rgb_list({1, 2, 3}, " "), "1 2 3");
}

}  // namespace
}  // namespace scattermeter::apps
