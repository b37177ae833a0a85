#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace belvedere {

// A table of text with a header line. Private to terrain/.
struct CsvTable {
  std::string name;                  // the file's, for messages
  std::vector<std::string> columns;  // of the header, without surrounding blanks
  struct Row {
    int line = 0;                     // from 1
    std::vector<std::string> fields;  // as many as columns
  };
  std::vector<Row> rows;

  // The column of that name, case-insensitive; -1 if there is none.
  int find(std::string_view column) const;
  // The first existing column of several names; -1.
  int find_any(const std::vector<std::string_view>& names) const;
};

// RFC 4180 as spreadsheets write it: commas, semicolons or tabs (whichever is most frequent in the
// header), quotes, a byte order mark, either line end; blank lines are skipped. Error(usage)
// `name:line` for an unclosed quote or a row with more fields than the header; missing fields at a
// row's end are empty.
CsvTable parse_csv(std::string_view text, const std::string& name);
// Error(input) if the file is missing, Error(limit) above 16 MiB.
// `encoding`: of its text; empty: UTF-8.
CsvTable read_csv(const std::string& path, const std::string& encoding = {});

}  // namespace belvedere
