// Elements and comments of XML files.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace scattermeter::apps {

// One comment for each line; "--", which would end a comment, is separated by a space.
std::string xml_comments(const std::vector<std::string>& lines, const std::string& indent);

// <element name="..." type="..." value="..."/> with an indent and a line end; an empty type is
// omitted. Name and value are escaped.
std::string xml_value(const std::string& indent, const std::string& element,
                      const std::string& name, const std::string& type, const std::string& value);

// "a, b, c", each value as the shortest decimal that reads back as the same number.
std::string rgb_list(const std::array<double, 3>& values, const std::string& separator = ", ");

}  // namespace scattermeter::apps
