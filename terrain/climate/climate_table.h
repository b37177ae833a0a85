#pragma once

#include <cstddef>
#include <string>

#include "base/config.h"
#include "base/function_ref.h"

namespace belvedere {

// The tables of places that the climate ships with: TOML files of version 1 with one list of rows.

// A row; columns from 0. Error(usage) with the line of a value that is no number in its range, or
// no text.
class ClimateRow {
 public:
  ClimateRow(const ConfigArray& values, const std::string& name) : values_(values), name_(name) {}
  double number(std::size_t column, double low, double high) const;
  std::string text(std::size_t column) const { return as_string(values_[column], name_); }

 private:
  const ConfigArray& values_;
  const std::string& name_;
};

struct ClimateTable {
  const char* list;     // "glaciers"
  const char* one;      // "glacier"
  std::size_t columns;  // of every row
  const char* values;   // what they are: "name, latitude, …"
};
// Error(usage) for another file, and with the line of a row of another length.
void for_each_row(const std::string& text, const std::string& name, const ClimateTable& table,
                  FunctionRef<void(const ClimateRow&)> use);

}  // namespace belvedere
