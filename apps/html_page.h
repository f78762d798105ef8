// A self-contained HTML page: text, tables and pictures, nothing from anywhere else.
#pragma once

#include <string>
#include <vector>

namespace scattermeter::apps {

// Markup, as against text: made by the functions below only, so that text is escaped once.
struct Html {
  std::string markup;
  Html& operator+=(const Html& other);
};

// Control characters become spaces, bytes that are no UTF-8 become U+FFFD.
std::string plain_text(const std::string& text);

// plain_text() with &, <, >, " and ' as entities.
Html html_text(const std::string& text);

// <name class="...">inner</name>; an empty class is left out.
Html html_element(const std::string& name, const Html& inner, const std::string& css_class = "");

struct HtmlTable {
  struct Cell {
    Html content;
    bool number = false;    // to the right, figures of one width
    std::string css_class;  // "pass", "fail" or ""
  };
  std::vector<std::string> header;
  std::vector<std::vector<Cell>> rows;
};
HtmlTable::Cell text_cell(const std::string& text, const std::string& css_class = "");
HtmlTable::Cell number_cell(const std::string& text);

// Scrolls inside its own box where it is wider than the page. Precondition (std::invalid_argument):
// as many cells in each row as in the header.
Html html_table(const HtmlTable& table);

// "data:TYPE;base64,...".
std::string data_address(const std::string& type, const std::string& bytes);

// A picture from a data: address with its caption; `alt` says what it shows to those who don't see
// it.
Html html_figure(const std::string& address, const std::string& alt, const Html& caption);

// Figures beside each other as far as the page is wide enough.
Html html_figures(const std::vector<Html>& figures);

// Opens on a click.
Html html_details(const std::string& summary, const Html& inner);

// The whole document: UTF-8, fluid from a phone to a screen, light and dark by the reader's choice.
// Its Content-Security-Policy forbids every request and every script.
std::string html_document(const std::string& title, const Html& body);

}  // namespace scattermeter::apps
