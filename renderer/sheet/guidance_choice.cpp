#include "renderer/sheet/guidance_choice.h"

#include <algorithm>
#include <variant>

#include "base/error.h"
#include "base/guidance_channels.h"

namespace belvedere {
namespace {

// Channels of strokes belong to exemplar paintings only.
bool has_sheet(const GuidanceChannel& channel) { return channel.maker != ChannelMaker::strokes; }

bool is_of(const GuidanceChannel& channel, const std::string& name) {
  return !name.empty() &&
         std::find(channel.names.begin(), channel.names.end(), name) != channel.names.end();
}

[[noreturn]] void refuse(const std::string& name) {
  std::string names;
  for (const GuidanceChannel& channel : guidance_channels())
    if (has_sheet(channel)) names += (names.empty() ? "" : ", ") + std::string(channel.names[0]);
  throw Error(ErrorKind::usage, "--channels",
              "\"" + name + "\" is not a channel of a picture's guidance", names + "; or none");
}

}  // namespace

GuidanceChoice read_guidance_choice(const std::string& text) {
  if (text == "none") return std::vector<std::string>();
  std::vector<std::string> names;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string name = text.substr(begin, end - begin);
    const auto known = [&](const GuidanceChannel& channel) {
      return has_sheet(channel) && is_of(channel, name);
    };
    if (std::none_of(guidance_channels().begin(), guidance_channels().end(), known)) refuse(name);
    names.push_back(name);
    begin = end + 1;
  }
  return names;
}

void keep_chosen(GuidanceBuffers& guidance, const GuidanceChoice& choice) {
  if (!choice) return;
  for (const GuidanceChannel& channel : guidance_channels()) {
    const auto names_it = [&](const std::string& name) { return is_of(channel, name); };
    if (std::none_of(choice->begin(), choice->end(), names_it))
      std::visit([&](auto member) { (guidance.*member) = {}; }, channel.member);
  }
}

}  // namespace belvedere
