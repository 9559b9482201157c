#include "postproc/tables/table.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "assembly/files/atomic_file.hpp"
#include "postproc/figures/gnuplot.hpp"
#include "postproc/report/html.hpp"
#include "postproc/report/warnings.hpp"
#include "postproc/tables/csv_file.hpp"
#include "tests/postproc/models.hpp"

namespace cupola::table_test {
namespace {

Table example() {
  return {"example",
          "A table",
          {{"name", "", "name, \"quoted\""}, {"value_N", "N", ""}, {"count", "", "<count>"}},
          {{std::string("plain"), 1.0 / 3.0, 7},
           {std::string("with, comma and \"quote\""), -0.0, -1},
           {std::string("<b>&"), 5e-324, 0}}};
}

TEST(Table, CsvKeepsAllDigits) {
  const std::string path = test::fresh_folder("a") + "/example.csv";
  write_text_atomically(path, to_csv(example()));
  const CsvFile csv = read_csv(path);
  EXPECT_EQ(csv.columns, (std::vector<std::string>{"name", "value_N", "count"}));
  ASSERT_EQ(csv.rows.size(), 3u);
  EXPECT_EQ(csv.number(0, 1), 1.0 / 3.0);
  EXPECT_EQ(csv.rows[1][0], "with, comma and \"quote\"");
  EXPECT_EQ(csv.number(1, 2), -1.0);
  EXPECT_EQ(csv.number(2, 1), 5e-324);
}

TEST(Table, UndefinedNumbersAreEmptyCells) {
  const Table table{"t", "", {{"a", "", ""}, {"b", "", ""}}, {{std::nan(""), 2.0}}};
  EXPECT_EQ(to_csv(table), "a,b\n,2\n");
  const CsvFile csv = parse_csv(to_csv(table), "t.csv");
  EXPECT_TRUE(std::isnan(csv.number(0, 0)));
  EXPECT_EQ(csv.number(0, 1), 2.0);
}

TEST(Table, ReportShowsFourSignificantDigits) {
  EXPECT_EQ(to_display(0.0), "0");
  EXPECT_EQ(to_display(1234567.8), "1234568");
  EXPECT_EQ(to_display(0.0123456), "0.01235");
  EXPECT_EQ(to_display(1.5e-9), "1.50e-09");
  EXPECT_EQ(to_display(-2.5e12), "-2.50e+12");
  EXPECT_EQ(to_display(std::numeric_limits<double>::infinity()), "∞");
  EXPECT_EQ(to_display(std::nan("")), "");
  Table::Column column{"height_m", "m", ""};
  column.floor = 1e-9;
  EXPECT_EQ(to_display(-2e-9, column), "-2.00e-09");
  EXPECT_EQ(to_display(-1e-9, column), "0") << "up to the floor";
  column.spread = 3.0;
  EXPECT_EQ(to_display(1525.6543, column), "1525.654") << "far above the other heights' spread";
  EXPECT_EQ(to_display(1525.0, column), "1525");
  EXPECT_EQ(to_display(2.65432, column), "2.654");
  EXPECT_EQ(to_display(42), "42");
}

TEST(Html, TextFromUsersIsEscaped) {
  EXPECT_EQ(markup_text("<script>\"&'"), "&lt;script&gt;&quot;&amp;&#39;");
  const std::string table = html_table(example());
  EXPECT_EQ(table.find("<b>&"), std::string::npos);
  EXPECT_NE(table.find("&lt;b&gt;&amp;"), std::string::npos);
  EXPECT_NE(table.find("&lt;count&gt;"), std::string::npos);
}

TEST(Html, KeysBetweenBackticksAreCode) {
  EXPECT_EQ(html_text("`a: <b>` and `c`"), "<code>a: &lt;b&gt;</code> and <code>c</code>");
  EXPECT_EQ(html_text("one ` alone"), "one ` alone");
  Table table{"t", "title", {{"sentence", "", ""}}, {{std::string("asked for by `key: value`")}}};
  EXPECT_EQ(html_table(table).find('`'), std::string::npos);
  EXPECT_EQ(warnings_html({"try `key: value`"}).find('`'), std::string::npos);
}

// A quote would end a gnuplot string and a line end would end a comment; either could start a command.
TEST(Gnuplot, TextFromUsersCannotStartACommand) {
  EXPECT_EQ(gnuplot_text("a'b\nsystem('x')\r`x`"), "a''b system(''x'') `x`");
}

TEST(Html, PicturesAreEmbedded) {
  const std::string folder = test::fresh_folder("a");
  write_text_atomically(folder + "/a.svg", "Many hands make light work.");
  EXPECT_EQ(html_picture(folder + "/a.svg", "x\"y"),
            "<img alt=\"x&quot;y\" src=\"data:image/svg+xml;base64,TWFueSBoYW5kcyBtYWtlIGxpZ2h0IHdvcmsu\">");
  for (const auto& [text, code] :
       {std::pair{"M", "TQ=="}, {"Ma", "TWE="}, {"Man", "TWFu"}}) {  // RFC 4648, section 10
    write_text_atomically(folder + "/b.png", text);
    EXPECT_NE(html_picture(folder + "/b.png", "").find(std::string("base64,") + code + "\""),
              std::string::npos);
  }
  EXPECT_EQ(html_picture(folder + "/none.png", ""), "");
}

TEST(Table, FormulasAndLineEndsComeBackAsText) {
  const Table table{"t",
                    "",
                    {{"a", "", ""}, {"b", "", ""}},
                    {{std::string("=1+1"), std::string("x,\n\"y\"")}, {-1.5, std::string("-1.5")}}};
  const std::string text = to_csv(table);
  EXPECT_EQ(text, "a,b\n\"'=1+1\",\"x,\n\"\"y\"\"\"\n-1.5,-1.5\n");
  const CsvFile csv = parse_csv(text, "t.csv");
  EXPECT_EQ(csv.rows, (std::vector<std::vector<std::string>>{{"=1+1", "x,\n\"y\""}, {"-1.5", "-1.5"}}));
}

}  // namespace
}  // namespace cupola::table_test
