#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace belvedere {

// A table of text with a header line. Private to terrain/.
struct CsvTable {
  std::string name;                  // the file's, for messages
  std::vector<std::string> columns;  // of the header, without blanks around them
  struct Row {
    int line = 0;                     // from 1
    std::vector<std::string> fields;  // as many as columns
  };
  std::vector<Row> rows;

  // The column of that name, small and capital letters alike; -1 where there is none.
  int find(std::string_view column) const;
  // The first of several names that there is; -1.
  int find_any(const std::vector<std::string_view>& names) const;
};

// RFC 4180 as spreadsheets write it: commas, semicolons or tabs (whichever the header has most of), quotes, a byte order mark,
// either line end; blank lines are left out. Error(usage) `name:line` for an open quote or a row with more fields than the
// header; missing fields at a row's end are empty.
CsvTable parse_csv(std::string_view text, const std::string& name);
// Error(input) where the file is missing, Error(limit) over 16 MiB.
CsvTable read_csv(const std::string& path);

}  // namespace belvedere
