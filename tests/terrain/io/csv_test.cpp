#include "terrain/io/csv.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/files.h"

namespace belvedere {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// The fields of the only row.
std::vector<std::string> row(const std::string& text) {
  const CsvTable table = parse_csv(text, "t.csv");
  EXPECT_EQ(table.rows.size(), 1U) << text;
  return table.rows.empty() ? std::vector<std::string>() : table.rows[0].fields;
}

TEST(Csv, SeparatorIsWhatTheHeaderHasMostOf) {
  EXPECT_THAT(row("a,b,c\n1,2,3\n"), ElementsAre("1", "2", "3"));
  EXPECT_THAT(row("a;b;c\n1,5;2;3\n"), ElementsAre("1,5", "2", "3"));
  EXPECT_THAT(row("a\tb, in m\tc\n1\t2\t3\n"), ElementsAre("1", "2", "3"));
}

TEST(Csv, QuotesKeepSeparatorsLinesAndQuotes) {
  EXPECT_THAT(row("a,b,c\n\"1,2\",\"two\nlines\",\"say \"\"yes\"\"\"\n"),
              ElementsAre("1,2", "two\nlines", "say \"yes\""));
  EXPECT_THAT(row("a,b\n  x  ,\"  x  \"\n"), ElementsAre("x", "  x  "))
      << "blanks count inside of quotes only";
  EXPECT_THAT(row("a,b\nBad \"Ischl\",2\n"), ElementsAre("Bad \"Ischl\"", "2"))
      << "a quote within a field is a letter";
}

TEST(Csv, AsSpreadsheetsOfAnyMachineWriteIt) {
  const CsvTable table = parse_csv("\xef\xbb\xbfName , Code\r\n\r\nHall,7\r\n,\r\nWien,8", "t.csv");
  EXPECT_THAT(table.columns, ElementsAre("Name", "Code"));
  ASSERT_EQ(table.rows.size(), 2U);
  EXPECT_THAT(table.rows[0].fields, ElementsAre("Hall", "7"));
  EXPECT_THAT(table.rows[1].fields, ElementsAre("Wien", "8"));
  EXPECT_THAT(parse_csv("", "t.csv").columns, IsEmpty());
}

// Some programs tell spreadsheets the separator in a line of its own.
TEST(Csv, ALineThatNamesTheSeparatorIsNoHeader) {
  for (const char* first : {"sep=;\r\n", "\"sep=;\"\n", "\xef\xbb\xbfSEP=;\n"}) {
    const CsvTable table = parse_csv(std::string(first) + "name;a,b,c,d\nHall;7\n", "t.csv");
    EXPECT_THAT(table.columns, ElementsAre("name", "a,b,c,d")) << first;
    ASSERT_EQ(table.rows.size(), 1U);
    EXPECT_THAT(table.rows[0].fields, ElementsAre("Hall", "7"));
    EXPECT_EQ(table.rows[0].line, 3) << "as editors count";
  }
  EXPECT_THAT(parse_csv("sep=\t\na\tb\n1\t2\n", "t.csv").columns, ElementsAre("a", "b"));
  EXPECT_THAT(parse_csv("sep,x\n1,2\n", "t.csv").columns, ElementsAre("sep", "x"));
}

TEST(Csv, Utf16IsRefusedWithTheRemedy) {
  EXPECT_THAT(test::input_error([] {
                parse_csv(std::string("\xff\xfe"
                                      "a\0,\0",
                                      6),
                          "t.csv");
              }),
              testing::AllOf(testing::HasSubstr("UTF-16"), testing::HasSubstr("UTF-8")));
}

TEST(Csv, RowsKnowTheLineTheyBeginAt) {
  const CsvTable table = parse_csv("a,b\n\n\"two\nlines\",1\nx,2\n", "t.csv");
  ASSERT_EQ(table.rows.size(), 2U);
  EXPECT_EQ(table.rows[0].line, 3);
  EXPECT_EQ(table.rows[1].line, 5);
}

TEST(Csv, ShortRowsAreFilledUpAndLongOnesRefused) {
  EXPECT_THAT(row("a,b,c\n1\n"), ElementsAre("1", "", ""));
  EXPECT_THAT(test::usage_error([] { parse_csv("a,b\n1,2\n1,2,3\n", "t.csv"); }),
              AllOf(HasSubstr("t.csv:3"), HasSubstr("3 fields"), HasSubstr("allowed: 2")));
}

TEST(Csv, AnOpenQuoteIsNamedWhereItsRowBegins) {
  EXPECT_THAT(test::usage_error([] { parse_csv("a,b\n1,2\n3,\"4\n5,6\n", "t.csv"); }),
              AllOf(HasSubstr("t.csv:3"), HasSubstr("unclosed quote")));
}

TEST(Csv, ColumnsAreFoundInSmallAndCapitalLetters) {
  const CsvTable table = parse_csv("NAME,Lon,lat\n", "t.csv");
  EXPECT_EQ(table.find("name"), 0);
  EXPECT_EQ(table.find("LAT"), 2);
  EXPECT_EQ(table.find("lo"), -1);
  EXPECT_EQ(table.find_any({"longitude", "lon", "name"}), 1)
      << "the first of the names asked for, not of the columns";
  EXPECT_EQ(table.find_any({"east", "x"}), -1);
}

TEST(Csv, FilesThatAreNotThereOrTooLong) {
  const test::Folder folder;
  EXPECT_THAT(test::input_error([&] { read_csv(folder / "none.csv"); }), HasSubstr("none.csv"));
  EXPECT_THAT(test::input_error([&] { read_csv(folder.path()); }), HasSubstr(folder.path()));
  const std::string path = folder.write("t.csv", "a\n1\n");
  EXPECT_THAT(read_csv(path).rows.at(0).fields, ElementsAre("1"));
  std::filesystem::resize_file(path, (16U << 20) + 1);
  EXPECT_THAT(test::message_of(ErrorKind::limit, [&] { read_csv(path); }), HasSubstr("16 MiB"));
}

}  // namespace
}  // namespace belvedere
