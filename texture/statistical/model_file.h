#pragma once

#include <string>

#include "texture/statistical/clique_model.h"

namespace belvedere {

struct ConfigValue;

// A model as a small text: TOML, and in it the clique types as base64. It reads back to the same bits.
std::string model_text(const CliqueModel& model);

// Error(usage) with file and line for what is no model: a key that is missing or unknown, a version that this program does not know, types
// that are cut off or that no picture can have. `read_model` also Error(input) where the file is missing.
CliqueModel parse_model(const std::string& text, const std::string& name);
CliqueModel read_model(const std::string& path);
// From a table within a larger document of that name.
CliqueModel parse_model(const ConfigValue& table, const std::string& name);

}  // namespace belvedere
