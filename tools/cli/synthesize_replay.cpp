#include "tools/cli/synthesize_replay.h"

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <set>

#include "base/error.h"
#include "base/text/text_encoding.h"
#include "renderer/image/image_io.h"
#include "renderer/image/provenance.h"
#include "tools/cli/commands.h"
#include "tools/cli/synthesis_files.h"
#include "tools/options/options.h"

namespace belvedere::tools {
namespace {

ChannelType widest(const ImageInfo& info) {
  ChannelType type = ChannelType::uint8;
  for (const PartSpec& part : info.parts) {
    for (const ChannelSpec& channel : part.channels) {
      if (channel.type == ChannelType::half || channel.type == ChannelType::float32)
        return ChannelType::float32;
      if (channel.type != ChannelType::uint8) type = channel.type;
    }
  }
  return type;
}

// Each layer must match, texel for texel, the picture that the matches were made on.
void check_layers(const ReplayFiles& files, const StoredMatches& stored,
                  const std::vector<ImageInfo>& infos) {
  if (!stored.pictures.empty() && files.layers.size() != stored.pictures.size()) {
    std::string names;
    for (const MatchedPicture& picture : stored.pictures)
      names += (names.empty() ? "" : ", ") + picture.name;
    refuse("command line", fmt::format("{} --picture are given", files.layers.size()),
           fmt::format("{}, a layer of each painting {} copies from, in this order: {}",
                       stored.pictures.size(), files.match, names));
  }
  for (std::size_t i = 0; i < stored.pictures.size(); ++i) {
    const MatchedPicture& painting = stored.pictures[i];
    if (infos[i].width != painting.width || infos[i].height != painting.height)
      refuse(
          files.layers[i], fmt::format("has {} × {} pixels", infos[i].width, infos[i].height),
          fmt::format(
              "{} × {}, as {}, which {} copies from: a layer matches its painting texel for texel",
              painting.width, painting.height, painting.name, files.match));
  }
  // Without that note in the file, only the copied texels give a lower bound.
  for (std::size_t i = 0; i < stored.matches.size(); ++i) {
    const Match& m = stored.matches[i];
    if (m.exemplar == Match::none) continue;
    if (m.exemplar >= infos.size())
      refuse("command line", fmt::format("{} --picture are given", infos.size()),
             fmt::format("at least {}: {} copies from that many paintings", m.exemplar + 1,
                         files.match));
    const ImageInfo& info = infos[m.exemplar];
    if (m.x >= info.width || m.y >= info.height)
      refuse(files.layers[m.exemplar], fmt::format("has {} × {} pixels", info.width, info.height),
             fmt::format("a layer as large as the painting {} copies from: texel {}, {} is needed",
                         files.match, m.x, m.y));
  }
}

void check_format(const ReplayFiles& files, const std::vector<ImageInfo>& infos,
                  Progress& progress) {
  const std::string extension = lower_extension(files.out);
  if (extension != ".png" && extension != ".tif" && extension != ".tiff" && extension != ".exr")
    refuse("--out " + files.out, "is not the name of a picture that can be written",
           ".tif (16 bit), .png (8 bit), or .exr for layers of floating-point numbers");
  for (std::size_t i = 0; i < infos.size(); ++i) {
    const std::string& layer = files.layers[i];
    const ChannelType type = widest(infos[i]);
    if (extension == ".exr" && infos[i].format != "openexr")
      refuse("--out " + files.out,
             fmt::format("OpenEXR holds linear light, but the values of {} are not linear", layer),
             "a .tif, which keeps 8 and 16 bits exactly, or a layer in OpenEXR");
    if (extension == ".png" && type == ChannelType::float32)
      refuse("--out " + files.out, fmt::format("{} contains floating-point numbers", layer),
             ".exr, or .tif for numbers 0 … 1");
    if (extension == ".png" && type == ChannelType::uint16)
      progress.note(fmt::format(
          "{} has 16 bits, of which a PNG of this program keeps 8; a .tif keeps all", layer));
    if (extension == ".exr") continue;
    for (const PartSpec& part : infos[i].parts) {
      const auto is_alpha = [](const ChannelSpec& channel) { return channel.name == "A"; };
      if (std::any_of(part.channels.begin(), part.channels.end(), is_alpha))
        progress.note(fmt::format("the alpha channel of {} is left out", layer));
    }
  }
}

// Pictures of three channels.
void lay_picture(const ReplayFiles& files, const MatchField& matches,
                 const PictureFileOptions& options, Progress& progress) {
  std::vector<Grid<glm::vec3>> pictures;
  std::size_t cut = 0;
  for (const std::string& layer : files.layers) {
    pictures.push_back(read_picture(layer));
    const auto fits = [](float v) { return v >= 0.F && v <= 1.F; };
    cut += static_cast<std::size_t>(
        std::count_if(pictures.back().begin(), pictures.back().end(),
                      [&](const glm::vec3& c) { return !fits(c.x) || !fits(c.y) || !fits(c.z); }));
  }
  if (cut > 0)
    progress.note(
        fmt::format("{} texels are outside 0 … 1 and are clamped; an .exr would keep them", cut));
  std::vector<const Grid<glm::vec3>*> layers;
  for (const Grid<glm::vec3>& picture : pictures) layers.push_back(&picture);
  const Grid<glm::vec3> picture = replay(matches, layers, Grid<glm::vec3>());
  progress.begin("writing", 0.0);
  if (lower_extension(files.out) == ".png")
    write_png8(files.out, picture, options);
  else
    write_tiff16(files.out, picture, options);
}

// A channel of a layer: ids keep their bits.
Grid<float> read_layer(const std::string& file, const ChannelSpec& channel) {
  if (channel.type != ChannelType::uint32) return read_channel(file, channel.name);
  const Grid<std::uint32_t> ids = read_id_channel(file, channel.name);
  Grid<float> bits(ids.width(), ids.height());
  std::transform(ids.begin(), ids.end(), bits.begin(),
                 [](std::uint32_t id) { return std::bit_cast<float>(id); });
  return bits;
}

// Every channel of every part.
void lay_channels(const ReplayFiles& files, const MatchField& matches,
                  const std::vector<ImageInfo>& infos, const FileNotes& notes, Progress& progress) {
  std::vector<PartSpec> parts = infos.front().parts;
  std::set<std::string> names;
  for (const PartSpec& part : parts)
    for (const ChannelSpec& channel : part.channels)
      if (!names.insert(channel.name).second)
        refuse(files.layers.front(), fmt::format("has two channels named {}", channel.name),
               "each name once");
  for (std::size_t i = 1; i < infos.size(); ++i) {
    bool same = infos[i].parts.size() == parts.size();
    for (std::size_t p = 0; same && p < parts.size(); ++p)
      same = infos[i].parts[p].channels == parts[p].channels;
    if (!same)
      refuse(files.layers[i], fmt::format("has different channels from {}", files.layers.front()),
             "the same channels in every layer");
  }
  for (PartSpec& part : parts)
    if (part.name.empty()) part.name = "layer";  // files of one part need not name it
  progress.begin("writing", 0.0);
  ExrWriter writer(files.out, matches.width(), matches.height(), parts, notes);
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const std::size_t channels = parts[p].channels.size();
    std::vector<std::vector<Grid<float>>> layers(files.layers.size());  // by layer and channel
    for (std::size_t i = 0; i < files.layers.size(); ++i) {
      for (const ChannelSpec& channel : parts[p].channels) {
        layers[i].push_back(read_layer(files.layers[i], channel));
        if (layers[i].back().width() != infos[i].width ||
            layers[i].back().height() != infos[i].height)
          throw Error(ErrorKind::input, files.layers[i],
                      fmt::format("its channel {} differs in size from its first", channel.name),
                      "one size for all channels");
      }
    }
    for (int y0 = 0; y0 < matches.height(); y0 += ExrWriter::band_rows) {
      const int rows = std::min(ExrWriter::band_rows, matches.height() - y0);
      std::vector<float> band;
      band.reserve(static_cast<std::size_t>(rows) * static_cast<std::size_t>(matches.width()) *
                   channels);
      for (std::size_t i = matches.index(0, y0); i < matches.index(0, y0 + rows); ++i) {
        const Match& m = matches[i];
        for (std::size_t c = 0; c < channels; ++c)
          band.push_back(m.exemplar == Match::none ? 0.F : layers[m.exemplar][c](m.x, m.y));
      }
      writer.write_rows(p, y0, rows, band);
    }
  }
  writer.finish();
}

}  // namespace

ReplayResult replay_layers(const ReplayFiles& files, Progress& progress) {
  progress.begin("reading", 0.0);
  const StoredMatches stored = read_matches(files.match);
  std::vector<ImageInfo> infos;
  for (const std::string& layer : files.layers) infos.push_back(read_image_info(layer));
  check_layers(files, stored, infos);
  check_format(files, infos, progress);

  std::map<std::string, std::string> inputs{{file_name(files.match), files.match}};
  for (const std::string& layer : files.layers) inputs[file_name(layer)] = layer;
  const FileNotes notes = to_notes(make_provenance("", inputs));
  if (lower_extension(files.out) == ".exr")
    lay_channels(files, stored.matches, infos, notes, progress);
  else
    lay_picture(files, stored.matches, {.icc_profile = infos.front().icc_profile, .notes = notes},
                progress);

  const auto empty = std::count_if(stored.matches.begin(), stored.matches.end(),
                                   [](const Match& m) { return m.exemplar == Match::none; });
  return {stored.matches.width(), stored.matches.height(), static_cast<std::size_t>(empty)};
}

}  // namespace belvedere::tools
