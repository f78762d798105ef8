// Pieces of XML files.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace scattermeter::apps {

// The lines as comments, one each; what would end a comment is taken apart.
std::string xml_comments(const std::vector<std::string>& lines, const std::string& indent);

// <element name="..." type="..." value="..."/> with an indent and a line end; an empty type is left
// out. The value is escaped.
std::string xml_value(const std::string& indent, const std::string& element,
                      const std::string& name, const std::string& type, const std::string& value);

// "a, b, c", each the shortest text that reads back as the same number.
std::string rgb_list(const std::array<double, 3>& values, const std::string& separator = ", ");

}  // namespace scattermeter::apps
