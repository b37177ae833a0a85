#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace belvedere {

// An array of numbers with named dimensions, as in netCDF files; the last dimension is contiguous.
struct NumberArray {
  std::string name;
  std::vector<std::string> dimensions;
  std::vector<std::size_t> sizes;
  std::vector<double> values;  // scaled as specified by the file; NaN if missing
  std::string unit;            // "degC", "days since 1801-10-01"; empty if not given
};

// The named arrays of a netCDF file, in the requested order; nothing for names that the file lacks.
// Throws Error(input) naming the file: missing, of another format, damaged; Error(limit), before
// allocating, if an array would not fit into memory.
std::vector<std::optional<NumberArray>> read_number_arrays(const std::string& path,
                                                           const std::vector<std::string>& names);

}  // namespace belvedere
