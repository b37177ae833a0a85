#pragma once

#include <string>

#include "texture/statistical/clique_model.h"

namespace belvedere::tools {

class CommandOptions;

// The initial noise of a texture, if the user chooses it: --begin, --begin-px.
struct BeginOptions {
  std::string kind;  // white, streaks, discs; empty: the program chooses
  double px = 8.0;   // half length of streaks, radius of discs, 1…256
};
// `meaning`: help text of --begin.
void add_begin_options(CommandOptions& command, BeginOptions& options, const std::string& meaning);

struct TextureBegin {
  TextureSeed seed = TextureSeed::white;
  float px = 0.F;  // 0 of white noise
};
TextureBegin begin_of(const BeginOptions& options);

const char* name_of(TextureSeed seed);
// Describes the noise: "streaks of 12 px", "white, polished".
std::string describe_begin(TextureSeed seed, float px, bool polish);

}  // namespace belvedere::tools
