#include "report/terminal/text.h"

#include <gtest/gtest.h>

#include "report/rows/csv_rows.h"

namespace slipcheck::testing {
namespace {

TEST(Text, KeepsWhatIsUtf8) {
  EXPECT_EQ(valid_utf8("e_eff ± 3 µm … ✓ 漢 🎱"), "e_eff ± 3 µm … ✓ 漢 🎱");
}

TEST(Text, ReplacesWhatIsNot) {
  EXPECT_EQ(valid_utf8("a\xff"
                       "b"),
            "a\uFFFDb");
  EXPECT_EQ(valid_utf8("\xc3"), "\uFFFD");                                // cut off
  EXPECT_EQ(valid_utf8("\xc0\xaf"), "\uFFFD\uFFFD");                      // overlong
  EXPECT_EQ(valid_utf8("\xed\xa0\x80"), "\uFFFD\uFFFD\uFFFD");            // surrogate
  EXPECT_EQ(valid_utf8("\xf4\x90\x80\x80"), "\uFFFD\uFFFD\uFFFD\uFFFD");  // beyond U+10FFFF
}

TEST(Text, LetsNothingControlTheTerminal) {
  EXPECT_EQ(printable("a\x1b[31mb\nc\td"), "a\uFFFD[31mb c d");
  EXPECT_EQ(printable("\u202Eright to left"), "\uFFFDright to left");
  EXPECT_EQ(printable("\u009B31m"), "\uFFFD31m");
}

TEST(Csv, NoTextIsAFormula) {
  EXPECT_EQ(csv_field("slip (x)"), "slip (x)");
  EXPECT_EQ(csv_field("a=b"), "a=b");
  EXPECT_EQ(csv_field("=1+2"), "'=1+2");
  EXPECT_EQ(csv_field("=HYPERLINK(\"a\",\"b\")"), "\"'=HYPERLINK(\"\"a\"\",\"\"b\"\")\"");
  for (const char* text : {"+1", "-1", "@x"}) EXPECT_EQ(csv_field(text), "'" + std::string(text));
  CsvRows rows({"number", "text"});
  rows.add({-1.5, "-1.5"});
  EXPECT_EQ(rows.text(), "number,text\n-1.5,'-1.5\n");
}

TEST(Text, CountsColumns) {
  EXPECT_EQ(display_width("83.01 ms"), 8u);
  EXPECT_EQ(display_width("3 µm … ✓"), 8u);
  EXPECT_EQ(display_width("漢字"), 4u);
  EXPECT_EQ(display_width("\x1b[1mm\x1b[0;31mm\x1b[0m"), 2u);
  EXPECT_EQ(display_width("\x1b["), 0u);
  EXPECT_EQ(display_width("e\u0301"), 1u);
}

TEST(Text, FillsUpAndShortensByColumns) {
  EXPECT_EQ(padded("µ", 3), "µ  ");
  EXPECT_EQ(padded("µ", 3, true), "  µ");
  EXPECT_EQ(padded("long", 3), "long");
  EXPECT_EQ(shortened("µµµµ", 3), "µµ…");
  EXPECT_EQ(shortened("漢字", 3), "漢…");
  EXPECT_EQ(shortened("fits", 4), "fits");
}

TEST(Text, WrapsAtBlanks) {
  EXPECT_EQ(wrapped("one two  three", 7), (std::vector<std::string>{"one two", "three"}));
  EXPECT_EQ(wrapped("unbreakable", 4), std::vector<std::string>{"unbreakable"});
  EXPECT_EQ(wrapped("", 4), std::vector<std::string>{""});
}

}  // namespace
}  // namespace slipcheck::testing
