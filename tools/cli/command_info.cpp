#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "base/json.h"
#include "renderer/image/image_io.h"
#include "tools/cli/commands.h"
#include "tools/cli/terminal.h"

namespace belvedere::tools {
namespace {

struct Options {
  std::string file;
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

std::string as_json(const std::string& file, const ImageInfo& info) {
  Json parts = Json::array();
  for (const PartSpec& part : info.parts) {
    Json channels = Json::array();
    for (const ChannelSpec& channel : part.channels)
      channels.add(Json::object().add("name", Json::text(channel.name)).add("type", Json::text(type_name(channel.type))));
    parts.add(Json::object().add("name", Json::text(part.name)).add("channels", std::move(channels)));
  }
  Json notes = Json::object();
  for (const auto& [key, text] : info.notes) notes.add(key, Json::text(text));
  return Json::object()
             .add("file", Json::text(file))
             .add("format", Json::text(info.format))
             .add("width", Json::number(info.width))
             .add("height", Json::number(info.height))
             .add("dots_per_inch", Json::number(info.dots_per_inch))
             .add("icc_profile_bytes", Json::number(static_cast<double>(info.icc_profile.size())))
             .add("parts", std::move(parts))
             .add("notes", std::move(notes))
             .str() +
         "\n";
}

std::string as_text(const std::string& file, const ImageInfo& info) {
  std::string out = fmt::format("{}: {}, {} × {} pixels", file, info.format, info.width, info.height);
  if (info.dots_per_inch > 0.0) {
    constexpr double mm_per_inch = 25.4;
    const double mm = mm_per_inch / info.dots_per_inch;
    out += fmt::format(", {:.4g} dpi ({:.0f} × {:.0f} mm)", info.dots_per_inch, info.width * mm, info.height * mm);
  }
  if (!info.icc_profile.empty()) out += fmt::format(", colour profile of {} bytes", info.icc_profile.size());
  out += "\n";
  for (const PartSpec& part : info.parts) {
    out += part.name.empty() ? "channels:" : fmt::format("part {}:", part.name);
    for (const ChannelSpec& channel : part.channels) out += fmt::format(" {} ({})", channel.name, type_name(channel.type));
    out += "\n";
  }
  for (const auto& [key, text] : info.notes) {
    // Long notes, as the scene, begin on a line of their own.
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

Action add_info(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  command.add_option("FILE", options->file, "An OpenEXR, TIFF, PNG or JPEG file")->required();
  command.add_flag("--json", options->json, "As JSON");
  command.footer("  belvedere info karwendel/guidance.exr      size, channels, camera, scene, versions, hashes of the inputs");
  return [options] {
    const ImageInfo info = read_image_info(options->file);
    print_out(options->json ? as_json(options->file, info) : as_text(options->file, info));
    return 0;
  };
}

}  // namespace belvedere::tools
