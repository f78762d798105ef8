// Whether a page of ours is one piece.
#pragma once

#include <string>

namespace scattermeter::apps {

// What is wrong, or an empty string: every element that needs an end tag has one, in order;
// attributes are quoted; what src, href or url() names is a data: address; no script; no bare
// ampersand. Strict on purpose: our pages are made by one writer.
std::string html_problem(const std::string& page);

}  // namespace scattermeter::apps
