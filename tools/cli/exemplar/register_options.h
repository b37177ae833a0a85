#pragma once

#include <optional>
#include <string>
#include <vector>

#include "terrain/io/dem.h"
#include "terrain/register/registration.h"
#include "tools/options/options.h"
#include "tools/options/run_options.h"

namespace belvedere::tools {

// What picking pairs of a painting and registering it by them have in common.
struct RegisterOptions : RunOptions {
  std::string painting, pairs, crs, projection = "auto";
  std::vector<std::string> dems;
  double cell_m = 0.0;
  std::optional<double> sigma_px;
  bool cropped = false;
};
// pairs: what --pairs means.
void add_register_options(CommandOptions& command, RegisterOptions& options,
                          const std::string& pairs);

DemParameters dem_parameters(const RegisterOptions& options);
RegistrationParameters registration_parameters(const RegisterOptions& options);

}  // namespace belvedere::tools
