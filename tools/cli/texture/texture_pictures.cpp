#include "tools/cli/texture/texture_pictures.h"

#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <utility>

#include "base/error.h"
#include "base/filter.h"
#include "base/text/text_encoding.h"
#include "renderer/image/image_io.h"
#include "renderer/image/label_image.h"
#include "renderer/image/picture_formats.h"
#include "renderer/image/rows/picture_rows.h"
#include "texture/statistical/band_pyramid.h"
#include "texture/statistical/make_texture.h"
#include "tools/cli/commands.h"
#include "tools/options/options.h"
#include "tools/report/report_pictures.h"

namespace belvedere::tools {

Grid<std::uint8_t> read_mask_of(const std::string& path, const std::string& picture_path,
                                const Grid<Rgb8>& picture) {
  const Grid<std::uint16_t> grey = read_grey(path);
  if (!grey.same_size(picture))
    throw Error(
        ErrorKind::input, path, fmt::format("{} × {} pixels", grey.width(), grey.height()),
        fmt::format("the size of {}: {} × {}", picture_path, picture.width(), picture.height()));
  Grid<std::uint8_t> mask(grey.width(), grey.height());
  std::transform(grey.begin(), grey.end(), mask.begin(),
                 [](std::uint16_t v) { return static_cast<std::uint8_t>(v != 0 ? 1 : 0); });
  return mask;
}

TextureCrop read_crop(const std::string& path, const std::string& mask, Grid<glm::vec3>* stored) {
  Grid<float> alpha;
  Grid<glm::vec3> picture = read_picture(path, &alpha);
  TextureCrop crop{Grid<Rgb8>(picture.width(), picture.height()), {}};
  for (std::size_t i = 0; i < picture.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      crop.picture[i][c] = static_cast<std::uint8_t>(
          std::clamp(255.F * picture[i][static_cast<int>(c)] + .5F, 0.F, 255.F));
  const auto leave_out = [&](std::size_t i) {
    if (crop.states.empty())
      crop.states = Grid<std::uint8_t>(picture.width(), picture.height(), pixel_free);
    crop.states[i] = 0;
  };
  for (std::size_t i = 0; i < alpha.size(); ++i) {
    if (alpha[i] >= 1.F) continue;
    leave_out(i);
    ++crop.transparent;
  }
  if (stored != nullptr) *stored = std::move(picture);
  if (mask.empty()) return crop;
  const Grid<std::uint8_t> kept = read_mask_of(mask, path, crop.picture);
  for (std::size_t i = 0; i < kept.size(); ++i)
    if (kept[i] == 0) leave_out(i);
  return crop;
}

Grid<glm::vec3> with_changes(Grid<glm::vec3> stored, const Grid<Rgb8>& before,
                             const Grid<Rgb8>& after) {
  for (std::size_t i = 0; i < stored.size(); ++i)
    if (after[i] != before[i]) stored[i] = glm::vec3(after[i][0], after[i][1], after[i][2]) / 255.F;
  return stored;
}

void note_rounding(const std::string& read, const std::string& out, Progress& progress) {
  const ImageInfo info = read_image_info(read);
  const bool fine = !info.parts.empty() && !info.parts.front().channels.empty() &&
                    info.parts.front().channels.front().type != ChannelType::uint8;
  if (fine && lower_extension(out) == ".png")
    progress.note(
        fmt::format("{} has more than 8 bits, of which a .png keeps 8; use a .tif to keep 16",
                    file_name(read)));
}

void check_texture_name(const std::string& path) {
  if (const std::string extension = lower_extension(path);
      extension != ".png" && extension != ".tif" && extension != ".tiff")
    throw Error(ErrorKind::usage, "--out", path, "a .png or a .tif");
}

void write_texture(const std::string& path, const Grid<Rgb8>& picture, const std::string& note) {
  write_encoded_texture(path, to_picture(picture), note);
}

namespace {

std::unique_ptr<PictureRows> open_texture(const std::string& path, int width, int height,
                                          const std::string& note) {
  PictureFileOptions options;
  options.notes["belvedere:texture"] = note;
  const char* format = lower_extension(path) == ".png" ? "png" : "tif";
  return written_format(format).open(path, width, height, options);
}

}  // namespace

void write_encoded_texture(const std::string& path, const Grid<glm::vec3>& picture,
                           const std::string& note) {
  write_whole(*open_texture(path, picture.width(), picture.height(), note), picture);
}

void write_texture_strips(const std::string& path, int width, int height, const std::string& note,
                          const std::function<Grid<Rgb8>(PixelRect strip)>& make) {
  const std::unique_ptr<PictureRows> file = open_texture(path, width, height, note);
  for (int y = 0; y < height; y += endless_tile_px)
    file->write_rows(to_picture(make({0, y, width, std::min(height, y + endless_tile_px)})));
  file->finish();
  file->commit();
}

Json with_figures(Json object, const TextureFigures& figures) {
  object.add("selected", Json::number(figures.selected))
      .add("held_out", Json::number(figures.held_out))
      .add("worst", Json::number(figures.worst))
      .add("beyond", Json::number(figures.beyond))
      .add("drawn", Json::number(figures.drawn))
      .add("turned", Json::number(figures.turned));
  return object;
}

namespace {

// The colour of a name; numbers are greys.
Rgb8 colour_of(const std::string& name) {
  const bool hex = name.starts_with('#');
  unsigned value = 0;
  std::from_chars(name.data() + (hex ? 1 : 0), name.data() + name.size(), value, hex ? 16 : 10);
  if (!hex)
    return {static_cast<std::uint8_t>(value), static_cast<std::uint8_t>(value),
            static_cast<std::uint8_t>(value)};
  return {static_cast<std::uint8_t>(value >> 16), static_cast<std::uint8_t>(value >> 8 & 255U),
          static_cast<std::uint8_t>(value & 255U)};
}

// The largest difference of a channel.
int steps_between(const Rgb8& a, const Rgb8& b) {
  int steps = 0;
  for (std::size_t c = 0; c < 3; ++c) steps = std::max(steps, std::abs(a[c] - b[c]));
  return steps;
}

std::string hex_of(const Rgb8& c) { return fmt::format("#{:02x}{:02x}{:02x}", c[0], c[1], c[2]); }

}  // namespace

LabelPicture read_label_picture(const std::string& path, Progress& progress) {
  const LabelImages read = read_label_images({path}, progress);
  std::array<std::size_t, 256> pixels{};
  for (const std::uint8_t label : read.labels.front()) ++pixels[label];
  LabelPicture out{read.labels.front(), {}};
  std::array<std::uint8_t, 256> position{};
  position.fill(no_label);
  for (std::size_t label = 0; label < no_label; ++label) {
    if (pixels[label] == 0) continue;
    position[label] = static_cast<std::uint8_t>(out.names.size());
    out.names.push_back(read.colours.empty() ? fmt::format("{}", label)
                                             : hex_of(read.colours[label]));
  }
  for (std::uint8_t& label : out.labels) label = position[label];
  return out;
}

Grid<std::uint8_t> read_drawn_labels(const std::string& path, const std::vector<std::string>& names,
                                     Progress& progress) {
  const LabelPicture drawn = read_label_picture(path, progress);
  std::vector<std::uint8_t> position;
  for (const std::string& name : drawn.names) {
    const auto is = [&](const std::string& known) {
      return known == name || hex_of(colour_of(known)) == name;
    };
    auto found = std::find_if(names.begin(), names.end(), is);
    // The nearest one of a drawing that was compressed with losses.
    if (found == names.end() && name.starts_with('#')) {
      const auto nearer = [&](const std::string& a, const std::string& b) {
        return steps_between(colour_of(a), colour_of(name)) <
               steps_between(colour_of(b), colour_of(name));
      };
      found = std::min_element(names.begin(), names.end(), nearer);
      if (found != names.end()) {
        const int steps = steps_between(colour_of(*found), colour_of(name));
        if (steps > max_lossy_steps)
          found = names.end();
        else
          progress.note(fmt::format("{}: the colour {} is taken as {}, {} steps away", path, name,
                                    *found, steps));
      }
    }
    if (found == names.end())
      throw Error(ErrorKind::input, path, "has a label " + name,
                  fmt::format("those of the composite: {}", fmt::join(names, ", ")));
    position.push_back(static_cast<std::uint8_t>(found - names.begin()));
  }
  Grid<std::uint8_t> known(drawn.labels.width(), drawn.labels.height());
  for (std::size_t i = 0; i < known.size(); ++i) known[i] = drawn.labels[i] != no_label ? 1 : 0;
  if (position.empty())
    throw Error(ErrorKind::input, path, "has no label", "those of the composite");
  const Grid<std::int32_t> nearest = nearest_marked(known);
  Grid<std::uint8_t> out(known.width(), known.height());
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = position[drawn.labels[static_cast<std::size_t>(nearest[i])]];
  return out;
}

Grid<glm::vec3> label_colours(const Grid<std::uint8_t>& labels,
                              const std::vector<std::string>& names) {
  std::vector<glm::vec3> colours;
  for (const std::string& name : names) {
    const Rgb8 c = colour_of(name);
    colours.push_back(glm::vec3(c[0], c[1], c[2]) / 255.F);
  }
  Grid<glm::vec3> out(labels.width(), labels.height(), glm::vec3(.5F));
  for (std::size_t i = 0; i < out.size(); ++i)
    if (labels[i] < colours.size()) out[i] = colours[labels[i]];
  return out;
}

void write_label_picture(const std::string& path, const Grid<std::uint8_t>& labels,
                         const std::vector<std::string>& names) {
  write_png8(path, label_colours(labels, names), {});
}

void add_begin_options(CommandOptions& command, BeginOptions& options, const std::string& meaning) {
  command.add_option("--begin KIND", options.kind, meaning).one_of({"white", "streaks", "discs"});
  command
      .add_option("--begin-px PX", options.px,
                  "With --begin: half length of streaks, radius of discs. Default: 8")
      .range(1.0, 256.0);
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
