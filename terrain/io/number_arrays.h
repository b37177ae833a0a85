#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace belvedere {

// An array of numbers with named dimensions, as netCDF files hold them; the last dimension runs fastest.
struct NumberArray {
  std::string name;
  std::vector<std::string> dimensions;
  std::vector<std::size_t> sizes;
  std::vector<double> values;  // scaled as the file says; NaN where it has no value
  std::string unit;            // "degC", "days since 1801-10-01"; empty where nothing is said
};

// The named arrays of a netCDF file, in the order asked for; nothing where the file has none of that name. Throws Error(input) naming the
// file: missing, of another format, damaged; Error(limit) where an array would not fit into memory, before allocating.
std::vector<std::optional<NumberArray>> read_number_arrays(const std::string& path, const std::vector<std::string>& names);

}  // namespace belvedere
