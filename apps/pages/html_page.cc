#include "apps/pages/html_page.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/core.h>

#include "apps/pages/base64.h"
#include "apps/pages/page_script.h"

namespace scattermeter::apps {
namespace {

constexpr const char* kStyle = R"css(
:root { color-scheme: light dark; --ink: #1b1f24; --paper: #ffffff; --soft: #f3f5f7; --line: #d4d9df;
  --dim: #5a6470; --pass: #11632f; --fail: #b3141d; --bar: #4a86c5;
  --camera: #3b6fa8; --led: #b26a00; --mark: #8a3fa0; }
@media (prefers-color-scheme: dark) { :root { --ink: #e4e7eb; --paper: #14171a; --soft: #1e2328;
  --line: #3a424b; --dim: #a2acb8; --pass: #6fd08f; --fail: #ff8a86; --bar: #6fa8e0;
  --camera: #7fb0ea; --led: #f0b429; --mark: #d39be6; } }
* { box-sizing: border-box; }
body { margin: 0 auto; padding: 1rem; max-width: 78rem; background: var(--paper); color: var(--ink);
  font: 1rem/1.5 system-ui, sans-serif; overflow-wrap: anywhere; }
h1 { font-size: 1.6rem; line-height: 1.2; margin: 0.3em 0; }
h2 { font-size: 1.25rem; margin: 1.6em 0 0.4em; border-bottom: 1px solid var(--line); }
h3 { font-size: 1.05rem; margin: 1.2em 0 0.3em; }
p { max-width: 48rem; }
.dim { color: var(--dim); font-size: 0.875rem; }
.pass { color: var(--pass); font-weight: 600; }
.fail { color: var(--fail); font-weight: 600; }
.scroll { overflow-x: auto; margin: 0.6rem 0; border: 1px solid var(--line); border-radius: 6px; }
table { border-collapse: collapse; width: 100%; font-size: 0.9rem; overflow-wrap: normal; }
th, td { padding: 0.3rem 0.6rem; text-align: left; vertical-align: top;
  border-bottom: 1px solid var(--line); }
tr:last-child td { border-bottom: 0; }
th { background: var(--soft); font-weight: 600; }
td.number { text-align: right; white-space: nowrap; font-variant-numeric: tabular-nums; }
th.number { text-align: right; }
.figures { display: grid; gap: 0.8rem;
  grid-template-columns: repeat(auto-fill, minmax(min(100%, 23rem), 1fr)); }
figure { margin: 0; padding: 0.4rem; border: 1px solid var(--line); border-radius: 6px;
  background: var(--soft); min-width: 0; }
figure img { display: block; width: 100%; height: auto; background: #ffffff; border-radius: 3px; }
figcaption { font-size: 0.875rem; color: var(--dim); padding: 0.3rem 0.2rem 0; }
pre { margin: 0.6rem 0; padding: 0.6rem; font-size: 0.85rem; }
details { margin: 0.6rem 0; }
summary { cursor: pointer; font-weight: 600; }
meter { width: 6rem; }
.swatch { display: inline-block; width: 4rem; height: 1.6rem; vertical-align: middle;
  border: 1px solid var(--line); border-radius: 4px; }
img.look { display: block; width: 6rem; height: auto; background: #000000; border-radius: 4px; }
td img.look { width: 3rem; }
.aside { display: flex; flex-wrap: wrap; gap: 0.8rem; align-items: start; }
.aside > figure { width: 15rem; max-width: 100%; }
.aside > figure img.look { width: 100%; }
.aside > .scroll { margin: 0; flex: 1 1 22rem; min-width: 0; }
@media (max-width: 30rem) { body { padding: 0.6rem; } th, td { padding: 0.25rem 0.4rem; } }
@media (max-width: 46rem) { .wide, .wide tbody { display: block; }
  .wide thead { position: absolute; clip-path: inset(50%); width: 1px; height: 1px; overflow: hidden; }
  .wide tr { display: grid; grid-template-columns: repeat(auto-fill, minmax(10rem, 1fr));
    padding: 0.3rem 0; border-bottom: 1px solid var(--line); }
  .wide tr:last-child { border-bottom: 0; }
  .wide td { border-bottom: 0; }
  .wide td.number { text-align: left; }
  .wide td::before { display: block; content: attr(data-label); font: 0.8rem/1.3 system-ui, sans-serif;
    color: var(--dim); } }
)css";

// Columns that fit the width of a phone.
constexpr std::size_t kNarrowColumns = 3;

// The length of the valid UTF-8 sequence that starts here, or 0 (RFC 3629: no overlong forms, no
// surrogates, nothing above U+10FFFF).
std::size_t sequence_length(const std::string& text, std::size_t at) {
  const auto byte = [&](std::size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
  };
  const unsigned first = byte(at);
  std::size_t n = 0;
  unsigned low = 0x80;
  unsigned high = 0xBF;
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first <= 0xDF) n = 2;
  if (first >= 0xE0 && first <= 0xEF) n = 3;
  if (first >= 0xF0 && first <= 0xF4) n = 4;
  if (first == 0xE0) low = 0xA0;
  if (first == 0xED) high = 0x9F;
  if (first == 0xF0) low = 0x90;
  if (first == 0xF4) high = 0x8F;
  for (std::size_t i = 1; i < n; ++i) {
    if (byte(at + i) < low || byte(at + i) > high) return 0;
    low = 0x80;
    high = 0xBF;
  }
  return n;
}

}  // namespace

Html& Html::operator+=(const Html& other) {
  markup += other.markup;
  return *this;
}

std::string plain_text(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t n = sequence_length(text, i);
    const auto byte = static_cast<unsigned char>(text[i]);
    if (n == 0) {
      out += "\xEF\xBF\xBD";
    } else if (n > 1) {
      out += text.substr(i, n);
    } else {
      out += byte < 0x20U || byte == 0x7FU ? ' ' : text[i];
    }
    i += n == 0 ? 1 : n;
  }
  return out;
}

Html html_text(const std::string& text) {
  std::string out;
  for (const char c : plain_text(text)) {
    if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else if (c == '>') {
      out += "&gt;";
    } else if (c == '"') {
      out += "&quot;";
    } else if (c == '\'') {
      out += "&#39;";
    } else {
      out += c;
    }
  }
  return {out};
}

Html html_element(const std::string& name, const Html& inner, const std::string& css_class) {
  const std::string attribute =
      css_class.empty() ? "" : " class=\"" + html_text(css_class).markup + "\"";
  return {"<" + name + attribute + ">" + inner.markup + "</" + name + ">\n"};
}

HtmlTable::Cell text_cell(const std::string& text, const std::string& css_class) {
  return {html_text(text), false, css_class};
}

HtmlTable::Cell number_cell(const std::string& text) { return {html_text(text), true, ""}; }

Html html_table(const HtmlTable& table) {
  // Roles, since what is laid out otherwise than as a table is none to some screen readers.
  const bool is_wide = table.header.size() > kNarrowColumns;
  std::string out = "<div class=\"scroll\">";
  out += is_wide ? "<table class=\"wide\" role=\"table\">" : "<table>";
  const std::string row_tag = is_wide ? "<tr role=\"row\">" : "<tr>";
  out += "\n<thead>" + row_tag;
  for (std::size_t i = 0; i < table.header.size(); ++i) {
    const bool number = !table.rows.empty() && i < table.rows[0].size() && table.rows[0][i].number;
    out += number ? "<th scope=\"col\" class=\"number\">" : "<th scope=\"col\">";
    out += html_text(table.header[i]).markup + "</th>";
  }
  out += "</tr></thead>\n<tbody>\n";
  for (const auto& row : table.rows) {
    if (row.size() != table.header.size()) {
      throw std::invalid_argument(
          fmt::format("html_table: {} cells under {} headers", row.size(), table.header.size()));
    }
    out += row_tag;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const HtmlTable::Cell& cell = row[i];
      std::string css = cell.number ? "number" : "";
      if (!cell.css_class.empty()) css += (css.empty() ? "" : " ") + cell.css_class;
      out += "<td";
      if (!css.empty()) out += " class=\"" + html_text(css).markup + "\"";
      if (is_wide) out += " role=\"cell\" data-label=\"" + html_text(table.header[i]).markup + "\"";
      out += ">" + cell.content.markup + "</td>";
    }
    out += "</tr>\n";
  }
  return {out + "</tbody></table></div>\n"};
}

Html html_lines(const std::string& text) {
  std::string out;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    out += html_text(text.substr(begin, end - begin)).markup + "\n";
    begin = end + 1;
  }
  return {"<pre class=\"scroll\">\n" + out + "</pre>\n"};
}

std::string data_address(const std::string& type, const std::string& bytes) {
  return "data:" + type + ";base64," + base64(bytes);
}

Html html_figure(const std::string& address, const std::string& alt, const Html& caption) {
  return {"<figure><img src=\"" + html_text(address).markup + "\" alt=\"" + html_text(alt).markup +
          "\"><figcaption>" + caption.markup + "</figcaption></figure>\n"};
}

Html html_widget(const std::string& kind, const std::string& json, const Html& caption) {
  std::string data;
  for (const char c : json) data += c == '<' ? "\\u003c" : std::string(1, c);
  return {"<figure data-widget=\"" + html_text(kind).markup +
          "\"><div class=\"stage\"></div><noscript>Drawn where scripts may run.</noscript>" +
          "<script type=\"application/json\">" + data + "</script><figcaption>" + caption.markup +
          "</figcaption></figure>\n"};
}

Html html_figures(const std::vector<Html>& figures) {
  Html all;
  for (const Html& f : figures) all += f;
  return {"<div class=\"figures\">\n" + all.markup + "</div>\n"};
}

Html html_aside(const Html& figure, const Html& table) {
  return {"<div class=\"aside\">\n" + figure.markup + table.markup + "</div>\n"};
}

Html html_details(const std::string& summary, const Html& inner) {
  return {"<details><summary>" + html_text(summary).markup + "</summary>\n" + inner.markup +
          "</details>\n"};
}

std::string html_document(const std::string& title, const Html& body, int reload_s) {
  const std::string reload = reload_s == 0 ? ""
                                           : "<meta http-equiv=\"refresh\" content=\"" +
                                                 std::to_string(reload_s) + "\">\n";
  const bool is_live = body.markup.find("<figure data-widget=") != std::string::npos;
  const std::string may_run =
      is_live ? fmt::format("; script-src 'sha256-{}'", kPageScriptSha256) : "";
  const std::string script = is_live ? fmt::format("<script>{}</script>\n", kPageScript) : "";
  return std::string("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n") +
         "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src "
         "data:; style-src 'unsafe-inline'" +
         may_run + "\">\n" + reload +
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
         html_text(title).markup + "</title>\n<style>" + kStyle + "</style>\n</head>\n<body>\n" +
         body.markup + script + "</body>\n</html>\n";
}

}  // namespace scattermeter::apps
