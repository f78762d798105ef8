#include "tests/apps/html_check.h"

#include <cctype>
#include <set>
#include <vector>

namespace scattermeter::apps {
namespace {

const std::set<std::string> kVoid = {"meta", "img", "br", "hr", "link", "!DOCTYPE"};

}  // namespace

std::string html_problem(const std::string& page) {
  if (!page.starts_with("<!DOCTYPE html>")) return "no document type";
  std::vector<std::string> open;
  for (std::size_t i = 0; i < page.size();) {
    if (page[i] == '&') {
      const std::size_t end = page.find(';', i);
      if (end == std::string::npos || end - i > 8) return "a bare & at " + page.substr(i, 40);
    }
    if (page[i] != '<') {
      ++i;
      continue;
    }
    const bool closes = page.compare(i, 2, "</") == 0;
    std::size_t k = i + (closes ? 2 : 1);
    std::string name;
    while (k < page.size() &&
           (std::isalnum(static_cast<unsigned char>(page[k])) != 0 || page[k] == '!')) {
      name += page[k++];
    }
    if (name.empty()) return "a bare < at " + page.substr(i, 40);
    if (name == "script") return "a script";
    // Attributes.
    while (k < page.size() && page[k] != '>') {
      if (std::isspace(static_cast<unsigned char>(page[k])) != 0) {
        ++k;
        continue;
      }
      std::string attribute;
      while (k < page.size() && page[k] != '=' && page[k] != '>' && page[k] != ' ') {
        attribute += page[k++];
      }
      if (k >= page.size() || page[k] != '=') {
        if (name == "!DOCTYPE" && attribute == "html") continue;
        return "attribute " + attribute + " without a value";
      }
      if (page[++k] != '"') return "attribute " + attribute + " without quotes";
      const std::size_t end = page.find('"', ++k);
      if (end == std::string::npos) return "attribute " + attribute + " without an end";
      const std::string value = page.substr(k, end - k);
      k = end + 1;
      if (value.find('<') != std::string::npos) return "a < in attribute " + attribute;
      if (attribute.starts_with("on")) return "a script in " + attribute;
      if ((attribute == "src" || attribute == "href" || attribute == "srcset") &&
          !value.starts_with("data:")) {
        return attribute + " asks for " + value;
      }
      if (attribute == "style" && value.find("url(") != std::string::npos) return "url() in style";
    }
    i = k + 1;
    if (closes) {
      if (open.empty() || open.back() != name) {
        return "</" + name + "> ends " + (open.empty() ? "nothing" : open.back());
      }
      open.pop_back();
    } else if (!kVoid.contains(name)) {
      open.push_back(name);
      if (name == "style") {
        const std::size_t end = page.find("</style>", i);
        if (end == std::string::npos) return "style without an end";
        const std::string css = page.substr(i, end - i);
        if (css.find("url(") != std::string::npos || css.find("@import") != std::string::npos) {
          return "the style asks for more";
        }
        i = end;
      }
    }
  }
  return open.empty() ? "" : "<" + open.back() + "> has no end";
}

}  // namespace scattermeter::apps
