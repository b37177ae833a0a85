#include <fmt/core.h>

#include <memory>

#include "base/text/json.h"
#include "renderer/image/image_io.h"
#include "renderer/image/picture_diff.h"
#include "tools/cli/commands.h"
#include "tools/cli/terminal.h"
#include "tools/options/options.h"

namespace belvedere::tools {
namespace {

struct InfoOptions {
  std::string file;
  bool hash = false;
  bool json = false;
};

const char* type_name(ChannelType type) {
  switch (type) {
    case ChannelType::half:
      return "half";
    case ChannelType::float32:
      return "float";
    case ChannelType::uint32:
      return "uint";
    case ChannelType::uint8:
      return "uint8";
    case ChannelType::uint16:
      return "uint16";
  }
  return "?";
}

std::string as_json(const std::string& file, const ImageInfo& info, const PictureHash& hash) {
  Json parts = Json::array();
  for (const PartSpec& part : info.parts) {
    Json channels = Json::array();
    for (const ChannelSpec& channel : part.channels)
      channels.add(Json::object()
                       .add("name", Json::text(channel.name))
                       .add("type", Json::text(type_name(channel.type))));
    parts.add(
        Json::object().add("name", Json::text(part.name)).add("channels", std::move(channels)));
  }
  Json notes = Json::object();
  for (const auto& [key, text] : info.notes) notes.add(key, Json::text(text));
  Json out =
      Json::object()
          .add("file", Json::text(file))
          .add("format", Json::text(info.format))
          .add("width", Json::number(info.width))
          .add("height", Json::number(info.height))
          .add("dots_per_inch", Json::number(info.dots_per_inch))
          .add("icc_profile_bytes", Json::number(static_cast<double>(info.icc_profile.size())))
          .add("parts", std::move(parts))
          .add("notes", std::move(notes));
  if (!hash.whole.empty()) {
    Json channels = Json::object();
    for (const ChannelHash& one : hash.channels) channels.add(one.channel, Json::text(one.hash));
    out.add("hash", Json::text(hash.whole)).add("channel_hashes", std::move(channels));
  }
  return out.str() + "\n";
}

std::string as_text(const std::string& file, const ImageInfo& info, const PictureHash& hash) {
  std::string out =
      fmt::format("{}: {}, {} × {} pixels", file, info.format, info.width, info.height);
  if (info.dots_per_inch > 0.0) {
    constexpr double mm_per_inch = 25.4;
    const double mm = mm_per_inch / info.dots_per_inch;
    out += fmt::format(", {:.4g} dpi ({:.0f} × {:.0f} mm)", info.dots_per_inch, info.width * mm,
                       info.height * mm);
  }
  if (!info.icc_profile.empty())
    out += fmt::format(", colour profile of {} bytes", info.icc_profile.size());
  out += "\n";
  for (const PartSpec& part : info.parts) {
    out += part.name.empty() ? "channels:" : fmt::format("part {}:", part.name);
    for (const ChannelSpec& channel : part.channels)
      out += fmt::format(" {} ({})", channel.name, type_name(channel.type));
    out += "\n";
  }
  if (!hash.whole.empty()) out += fmt::format("hash of the pixels: {}\n", hash.whole);
  for (const ChannelHash& one : hash.channels)
    out += fmt::format("  {} {}\n", one.hash, one.channel);
  for (const auto& [key, text] : info.notes) {
    // Long notes, such as the scene, begin on their own line.
    const bool lines = text.find('\n') != std::string::npos;
    out += key + (lines ? ":\n" : ": ");
    std::size_t from = 0;
    while (from < text.size()) {
      const std::size_t end = std::min(text.find('\n', from), text.size());
      out += (lines ? "  " : "") + text.substr(from, end - from) + "\n";
      from = end + 1;
    }
    if (text.empty()) out += "\n";
  }
  return out;
}

}  // namespace

Action add_info(CommandOptions& command) {
  const auto options = std::make_shared<InfoOptions>();
  command.add_option("FILE", options->file, "An OpenEXR, TIFF, PNG or JPEG file").required();
  command.add_flag("--hash", options->hash,
                   "Also the hash of the pixels, by channel: equal for equal pixels, whatever the "
                   "header contains");
  command.add_flag("--json", options->json, "As JSON");
  command.footer(
      "  belvedere info karwendel/guidance.exr      size, channels, camera, scene, versions, "
      "hashes of the inputs");
  return [options] {
    const ImageInfo info = read_image_info(options->file);
    const PictureHash hash = options->hash ? hash_picture(options->file) : PictureHash();
    print_out(options->json ? as_json(options->file, info, hash)
                            : as_text(options->file, info, hash));
    return 0;
  };
}

}  // namespace belvedere::tools
