#include "terrain/climate/climate_table.h"

#include <fmt/core.h>

#include "base/error.h"

namespace belvedere {

double ClimateRow::number(std::size_t column, double low, double high) const {
  const double found = as_number(values_[column], name_);
  if (!(found >= low && found <= high))
    throw Error(ErrorKind::usage, config_where(name_, values_[column].position),
                describe(values_[column]), fmt::format("{} to {}", low, high));
  return found;
}

void for_each_row(const std::string& text, const std::string& name, const ClimateTable& table,
                  FunctionRef<void(const ClimateRow&)> use) {
  const ConfigValue document = parse_config(text, name);
  const ConfigTable& root = as_table(document, name);
  allow_only(root, {"version", table.list}, name);
  const ConfigValue* version = find(root, "version");
  const ConfigValue* rows = find(root, table.list);
  if (version == nullptr || rows == nullptr || as_integer(*version, name) != 1)
    throw Error(ErrorKind::usage, name, fmt::format("not a table of {}", table.list),
                fmt::format("version = 1 and {}", table.list));
  for (const ConfigValue& value : as_array(*rows, name)) {
    const ConfigArray& row = as_array(value, name);
    if (row.size() != table.columns)
      throw Error(ErrorKind::usage, config_where(name, value.position),
                  fmt::format("a {} with {} values", table.one, row.size()),
                  fmt::format("{} values: {}", table.columns, table.values));
    use(ClimateRow(row, name));
  }
}

}  // namespace belvedere
