#pragma once

#include <string>

namespace belvedere::tools {

// Writes a text, whole or not at all (output_file.h). Error(output).
void write_text_file(const std::string& path, const std::string& text);

}  // namespace belvedere::tools
