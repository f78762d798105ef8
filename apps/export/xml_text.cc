#include "apps/export/xml_text.h"

#include "apps/pages/html_page.h"
#include "apps/report/csv.h"

namespace scattermeter::apps {

std::string xml_comments(const std::vector<std::string>& lines, const std::string& indent) {
  std::string out;
  for (const std::string& line : lines) {
    std::string text;
    for (char c : plain_text(line)) {
      if (c == '-' && !text.empty() && text.back() == '-') text += ' ';
      text += c;
    }
    out += indent + "<!-- " + text + " -->\n";
  }
  return out;
}

std::string xml_value(const std::string& indent, const std::string& element,
                      const std::string& name, const std::string& type, const std::string& value) {
  std::string out = indent + "<" + element + " name=\"" + html_text(name).markup + "\"";
  if (!type.empty()) out += " type=\"" + type + "\"";
  return out + " value=\"" + html_text(value).markup + "\"/>\n";
}

std::string rgb_list(const std::array<double, 3>& values, const std::string& separator) {
  return csv_number(values[0]) + separator + csv_number(values[1]) + separator +
         csv_number(values[2]);
}

}  // namespace scattermeter::apps
