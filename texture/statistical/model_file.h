#pragma once

#include <string>

#include "texture/statistical/clique_model.h"

namespace belvedere {

struct ConfigValue;

// A model as a small text: TOML with the clique types as base64. It reads back to the same bits.
std::string model_text(const CliqueModel& model);

// Error(usage) with file and line for an invalid model: a key that is missing or unknown, an
// unknown version, types that are cut off or impossible. `read_model` also Error(input) if the file
// is missing.
CliqueModel parse_model(const std::string& text, const std::string& name);
CliqueModel read_model(const std::string& path);
// From a table within a larger document of that name.
CliqueModel parse_model(const ConfigValue& table, const std::string& name);

}  // namespace belvedere
