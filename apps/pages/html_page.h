// Self-contained HTML pages of text, tables and pictures.
#pragma once

#include <string>
#include <vector>

namespace scattermeter::apps {

// Markup, distinct from text. Only the functions below make it, so that text is escaped exactly
// once.
struct Html {
  std::string markup;
  Html& operator+=(const Html& other);
};

// The text with control characters replaced by spaces and invalid UTF-8 by U+FFFD.
std::string plain_text(const std::string& text);

// plain_text() with &, <, >, " and ' as entities.
Html html_text(const std::string& text);

// <name class="...">inner</name>; an empty class is omitted.
Html html_element(const std::string& name, const Html& inner, const std::string& css_class = "");

struct HtmlTable {
  struct Cell {
    Html content;
    bool number = false;    // right-aligned with tabular figures
    std::string css_class;  // "pass", "fail" or ""
  };
  std::vector<std::string> header;
  std::vector<std::vector<Cell>> rows;
};
HtmlTable::Cell text_cell(const std::string& text, const std::string& css_class = "");
HtmlTable::Cell number_cell(const std::string& text);

// A table that scrolls within its own box if it is wider than the page. On a phone, cells of more
// than three columns stand below each other, each with its header. Throws std::invalid_argument
// unless each row has as many cells as the header.
Html html_table(const HtmlTable& table);

// Lines of text as they stand, in letters of one width; control characters but line ends become
// spaces.
Html html_lines(const std::string& text);

// "data:TYPE;base64,...".
std::string data_address(const std::string& type, const std::string& bytes);

// A picture from a data: address with its caption; `alt` is the alternative text.
Html html_figure(const std::string& address, const std::string& alt, const Html& caption);

// A figure that the page's script draws (apps/pages/web): `kind` names how, `json` is what from.
// The caption says in words what it shows.
Html html_widget(const std::string& kind, const std::string& json, const Html& caption);

// Figures side by side as far as the width of the page allows.
Html html_figures(const std::vector<Html>& figures);

// A figure with its picture beside a table, below it where the page is narrow.
Html html_aside(const Html& figure, const Html& table);

// A section that opens on a click.
Html html_details(const std::string& summary, const Html& inner);

// The complete document: UTF-8, responsive, light or dark as the reader prefers. Its
// Content-Security-Policy forbids all requests and, but for the page's own (page_script.h), which
// stands in a document with widgets, all scripts. reload_s: after which it is loaded again; 0:
// never.
std::string html_document(const std::string& title, const Html& body, int reload_s = 0);

}  // namespace scattermeter::apps
