#include "apps/pages/html_page.h"

#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/pages/page_script.h"
#include "tests/fixtures/apps/html_check.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(HtmlPage, TextIsEscaped) {
  EXPECT_EQ(html_text("<script>alert('a & \"b\"')</script>").markup,
            "&lt;script&gt;alert(&#39;a &amp; &quot;b&quot;&#39;)&lt;/script&gt;");
  EXPECT_EQ(html_text("a\nb\x7f\x01").markup, "a b  ");
  // Umlaut, ellipsis and an emoji stay; Latin-1, an overlong slash, a surrogate and a cut sequence
  // do not.
  EXPECT_EQ(html_text("\xC3\xBC\xE2\x80\xA6\xF0\x9F\x98\x80").markup,
            "\xC3\xBC\xE2\x80\xA6\xF0\x9F\x98\x80");
  EXPECT_EQ(html_text("\xFC").markup, "\xEF\xBF\xBD");
  EXPECT_EQ(html_text("\xC0\xAF").markup, "\xEF\xBF\xBD\xEF\xBF\xBD");
  EXPECT_EQ(html_text("\xED\xA0\x80").markup, "\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD");
  EXPECT_EQ(html_text("a\xE2\x80").markup, "a\xEF\xBF\xBD\xEF\xBF\xBD");
}

TEST(HtmlPage, DocumentIsWellFormedAndAsksNobody) {
  HtmlTable table;
  table.header = {"a<b", "c"};
  table.rows = {{text_cell("<script src=\"http://x\">", "fail"), number_cell("1")}};
  Html body = html_element("h1", html_text("A & B"));
  body += html_table(table);
  body += html_figures(
      {html_figure(data_address("image/png", "\x01\x02"), "a \"picture\"", html_text("caption"))});
  body += html_details("more", html_element("p", html_text("text"), "dim"));
  const std::string page = html_document("</title><script>", body);
  EXPECT_EQ(html_problem(page), "");
  EXPECT_THAT(page, Not(HasSubstr("<script")));
  EXPECT_THAT(page, HasSubstr("name=\"viewport\""));
  EXPECT_THAT(page, HasSubstr("prefers-color-scheme: dark"));
}

TEST(HtmlPage, OnlyItsOwnScriptRuns) {
  const Html widget = html_widget("plot", "{\"a\":\"</script><script>alert(1)\"}", html_text("x"));
  EXPECT_THAT(widget.markup, HasSubstr("\\u003c/script>\\u003cscript>alert"));
  const std::string page = html_document("t", widget);
  EXPECT_EQ(html_problem(page), "");
  EXPECT_THAT(page, HasSubstr("script-src 'sha256-" + std::string(kPageScriptSha256) + "'"));
  EXPECT_EQ(kPageScript.find("</script"), std::string::npos);
  EXPECT_NE(html_problem(html_document("t", {"<script>alert(1)</script>"})), "");
}

TEST(HtmlPage, TheCheckerItselfSeesProblems) {
  EXPECT_NE(html_problem("<!DOCTYPE html><html><body><p>a</body></html>"), "");
  EXPECT_NE(html_problem("<!DOCTYPE html><html><body><img src=\"http://a/b.png\"></body></html>"),
            "");
  EXPECT_NE(html_problem("<!DOCTYPE html><html><body><p style=\"background: url(//a)\"></p></body>"
                         "</html>"),
            "");
}

// On a phone, a cell of a wide table stands beside its header.
TEST(HtmlPage, CellsOfAWideTableHaveTheirHeaders) {
  HtmlTable table;
  table.header = {"a", "b", "c", "\"d\""};
  table.rows = {{text_cell("1"), text_cell("2"), text_cell("3"), number_cell("4")}};
  const std::string wide = html_table(table).markup;
  EXPECT_THAT(wide, HasSubstr("<td class=\"number\" role=\"cell\" data-label=\"&quot;d&quot;\">4"));
  EXPECT_EQ(html_problem(html_document("t", {wide})), "");
  table.header.pop_back();
  table.rows[0].pop_back();
  EXPECT_THAT(html_table(table).markup, Not(HasSubstr("data-label")));
}

TEST(HtmlPage, RefusesRowsOfAnotherLength) {
  HtmlTable table;
  table.header = {"a", "b"};
  table.rows = {{text_cell("1")}};
  EXPECT_THROW(html_table(table), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter::apps
