#pragma once

#include <optional>
#include <string>
#include <vector>

#include "renderer/scene/scene.h"
#include "terrain/io/dem.h"
#include "terrain/register/registration.h"
#include "tools/options/options.h"

namespace belvedere::tools {

// Options of the commands that pick pairs of a painting and register it by them.
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

// The sections of a scene file that a registration is about, and the lines of the land cover; all
// others are at their defaults.
std::string registered_scene_text(const Scene& scene);

}  // namespace belvedere::tools
