#include "tools/cli/texture/begin_options.h"
#include "tools/options/options.h"

#include <fmt/core.h>

namespace belvedere::tools {

void add_begin_options(CommandOptions& command, BeginOptions& options, const std::string& meaning) {
  command.add_option("--begin", options.kind, meaning)
      .one_of({"white", "streaks", "discs"})
      .type_name("KIND");
  command
      .add_option("--begin-px", options.px,
                  "With --begin: half length of streaks, radius of discs. Default: 8")
      .range(1.0, 256.0)
      .type_name("PX");
}

TextureBegin begin_of(const BeginOptions& options) {
  if (options.kind == "streaks") return {TextureSeed::streaks, static_cast<float>(options.px)};
  if (options.kind == "discs") return {TextureSeed::discs, static_cast<float>(options.px)};
  return {};
}

const char* name_of(TextureSeed seed) {
  switch (seed) {
    case TextureSeed::white:
      return "white";
    case TextureSeed::streaks:
      return "streaks";
    case TextureSeed::discs:
      return "discs";
  }
  return "";
}

std::string describe_begin(TextureSeed seed, float px, bool polish) {
  return fmt::format("{}{}{}", name_of(seed), px > 0.F ? fmt::format(" of {} px", px) : "",
                     polish ? ", polished" : "");
}

}  // namespace belvedere::tools
