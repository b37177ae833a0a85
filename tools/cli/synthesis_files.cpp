#include "tools/cli/synthesis_files.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>
#include <map>

#include "base/error.h"
#include "renderer/exemplar/harmonize.h"
#include "renderer/image/display_conversion.h"
#include "renderer/image/icc/painting_file.h"
#include "renderer/image/label_image.h"
#include "tools/cli/commands.h"

namespace belvedere::tools {
namespace {

std::string size_text(int width, int height) { return fmt::format("{} × {}", width, height); }

template <class T>
void require_size(const Grid<T>& grid, const std::string& file, int width, int height,
                  const std::string& of) {
  if (grid.width() != width || grid.height() != height)
    throw Error(ErrorKind::usage, file,
                fmt::format("has {} pixels", size_text(grid.width(), grid.height())),
                fmt::format("{}, as {}", size_text(width, height), of));
}

// Guides are compared in 8 bits; 16-bit images lose their lower half, on both sides alike.
Grid<std::uint8_t> read_guide(const std::string& file) {
  const ImageInfo info = read_image_info(file);
  const bool wide = !info.parts.empty() && !info.parts.front().channels.empty() &&
                    info.parts.front().channels.front().type == ChannelType::uint16;
  const Grid<std::uint16_t> grey = read_grey(file);
  Grid<std::uint8_t> values(grey.width(), grey.height());
  for (std::size_t i = 0; i < grey.size(); ++i)
    values[i] = static_cast<std::uint8_t>(wide ? (grey[i] + 128) / 257 : grey[i]);
  return values;
}

// Mask pixels that are not black are never copied from.
void leave_out(const std::string& mask_file, const std::string& picture_file,
               Grid<std::uint8_t>& labels) {
  if (mask_file == "-") return;
  const Grid<std::uint16_t> mask = read_grey(mask_file);
  require_size(mask, mask_file, labels.width(), labels.height(), picture_file);
  for (std::size_t i = 0; i < mask.size(); ++i)
    if (mask[i] > 0) labels[i] = unused_label;
}

}  // namespace

SynthesisInputs read_synthesis(const SynthesisFiles& files, Progress& progress) {
  const auto refuse = [](const std::string& found, const std::string& allowed) {
    throw Error(ErrorKind::usage, "command line", found, allowed);
  };
  if (files.pictures.empty()) refuse("--picture is missing", "at least one");
  if (files.labels.size() != files.pictures.size())
    refuse(fmt::format("{} --picture but {} --label are given", files.pictures.size(),
                       files.labels.size()),
           "one --label for each --picture");

  SynthesisInputs inputs;
  const std::string& target_file = files.labels.front().second;
  std::vector<std::string> label_files;
  for (const auto& [source, target] : files.labels) label_files.push_back(source);
  if (!target_file.empty()) label_files.push_back(target_file);
  LabelImages labels = read_label_images(label_files, progress);
  inputs.label_colours = std::move(labels.colours);
  if (!target_file.empty()) inputs.target.label = std::move(labels.labels.back());
  if (files.exclusions.size() > files.pictures.size())
    refuse(fmt::format("{} --exclude but {} --picture are given", files.exclusions.size(),
                       files.pictures.size()),
           "one --exclude for each --picture, or fewer");
  // Pictures in one colour space stay in it, and so does the result; several meet in sRGB.
  inputs.profile = read_image_info(files.pictures.front()).icc_profile;
  const bool mixed = std::any_of(
      files.pictures.begin(), files.pictures.end(),
      [&](const std::string& file) { return read_image_info(file).icc_profile != inputs.profile; });
  if (mixed) inputs.profile = srgb_profile();
  for (std::size_t i = 0; i < files.pictures.size(); ++i) {
    if (files.labels[i].second != target_file)
      refuse(fmt::format("the labels name two targets, {} and {}", target_file,
                         files.labels[i].second),
             "the same target for every picture");
    Grid<float> alpha;
    inputs.pictures.push_back(mixed ? read_painting(files.pictures[i], silent_progress(), &alpha)
                                    : read_picture(files.pictures[i], &alpha));
    const Grid<glm::vec3>& picture = inputs.pictures.back();
    Grid<std::uint8_t>& own = labels.labels[i];
    require_size(own, files.labels[i].first, picture.width(), picture.height(), files.pictures[i]);
    for (std::size_t k = 0; k < own.size(); ++k)
      if (alpha[k] < 0.5F) own[k] = unused_label;  // what is cut out of a picture is not paint
    if (i < files.exclusions.size()) leave_out(files.exclusions[i], files.pictures[i], own);
  }
  if (files.harmonize != "off") {
    std::vector<LabelledPicture> painted;
    for (std::size_t i = 0; i < inputs.pictures.size(); ++i)
      painted.push_back({&inputs.pictures[i], &labels.labels[i]});
    inputs.pictures = harmonize_as(files.harmonize, painted);
  }
  for (std::size_t i = 0; i < inputs.pictures.size(); ++i) {
    inputs.exemplars.push_back({.name = file_name(files.pictures[i]),
                                .picture = to_rgb8(inputs.pictures[i]),
                                .guides = {}});
    inputs.exemplars.back().guides.label = std::move(labels.labels[i]);
  }

  std::map<std::string, std::size_t> seen;  // how many pictures have that guide
  std::map<std::string, const GuidePair*> first;
  for (const GuidePair& guide : files.guides) {
    const std::size_t i = seen[guide.name]++;
    if (i >= inputs.exemplars.size())
      refuse(fmt::format("--guide {} is given more often than --picture", guide.name),
             "one for each picture");
    Exemplar& exemplar = inputs.exemplars[i];
    exemplar.guides.guides.push_back({guide.name, read_guide(guide.source)});
    require_size(exemplar.guides.guides.back().values, guide.source, exemplar.picture.width(),
                 exemplar.picture.height(), files.pictures[i]);
    if (i == 0) {
      first[guide.name] = &guide;
      if (!guide.target.empty()) {
        inputs.target.guides.push_back({guide.name, read_guide(guide.target)});
        require_size(inputs.target.guides.back().values, guide.target, inputs.target.width(),
                     inputs.target.height(), target_file);
      }
      inputs.weights.emplace_back(guide.name, guide.weight);
    } else if (guide.target != first[guide.name]->target ||
               guide.weight != first[guide.name]->weight) {
      refuse(fmt::format("--guide {} has two targets or two weights", guide.name),
             "the same target and weight for every picture");
    }
  }
  for (const auto& [name, count] : seen)
    if (count != inputs.exemplars.size())
      refuse(fmt::format("--guide {} is given for {} of {} pictures", name, count,
                         inputs.exemplars.size()),
             "one for each picture");
  return inputs;
}

void write_matches(const std::string& path, const MatchField& matches,
                   const std::vector<MatchedPicture>& pictures, const FileNotes& notes) {
  MatchWriter writer(path, matches.width(), matches.height(), to_note(pictures), notes);
  for (int y0 = 0; y0 < matches.height(); y0 += ExrWriter::band_rows) {
    const int rows = std::min(ExrWriter::band_rows, matches.height() - y0);
    MatchField band(matches.width(), rows);
    std::copy_n(matches.row(y0), band.size(), band.data());
    writer.write_rows(band, y0);
  }
  writer.finish();
}

StoredMatches read_matches(const std::string& path) {
  const ImageInfo info = read_image_info(path);
  const std::string allowed =
      "a file written by --match: OpenEXR with the channels exemplar, x and y of 32-bit whole "
      "numbers";
  if (info.format != "openexr")
    throw Error(ErrorKind::input, path, "is not a match field but " + info.format, allowed);
  StoredMatches stored;
  if (const auto note = info.notes.find(matched_pictures_note); note != info.notes.end())
    stored.pictures = parse_matched_pictures(path, note->second);
  for (const char* name : {"exemplar", "x", "y"}) {
    bool found = false;
    for (const PartSpec& part : info.parts)
      for (const ChannelSpec& channel : part.channels)
        found = found || channel == ChannelSpec{name, ChannelType::uint32};
    if (!found)
      throw Error(ErrorKind::input, path,
                  fmt::format("is not a match field: it has no channel {} of whole numbers", name),
                  allowed);
  }
  const Grid<std::uint32_t> exemplar = read_id_channel(path, "exemplar");
  const Grid<std::uint32_t> x = read_id_channel(path, "x");
  const Grid<std::uint32_t> y = read_id_channel(path, "y");
  if (!x.same_size(exemplar) || !y.same_size(exemplar))
    throw Error(ErrorKind::input, path, "its channels exemplar, x and y differ in size", allowed);
  stored.matches = MatchField(exemplar.width(), exemplar.height());
  for (std::size_t i = 0; i < exemplar.size(); ++i) {
    if (exemplar[i] == Match::none) continue;
    const bool known = stored.pictures.empty() || exemplar[i] < stored.pictures.size();
    const glm::ivec2 max =
        !known || stored.pictures.empty()
            ? glm::ivec2(Exemplar::largest_side)
            : glm::ivec2(stored.pictures[exemplar[i]].width, stored.pictures[exemplar[i]].height);
    if (!known || exemplar[i] > Match::none || x[i] >= static_cast<std::uint32_t>(max.x) ||
        y[i] >= static_cast<std::uint32_t>(max.y))
      throw Error(
          ErrorKind::input, path,
          fmt::format("pixel {}, {} copies texel {}, {} of picture {}",
                      i % static_cast<std::size_t>(exemplar.width()),
                      i / static_cast<std::size_t>(exemplar.width()), x[i], y[i], exemplar[i]),
          known ? fmt::format("texels of a picture of {}", size_text(max.x, max.y))
                : fmt::format("pictures 0 … {}, and 65535 for none", stored.pictures.size() - 1));
    stored.matches[i] = {static_cast<std::uint16_t>(exemplar[i]), static_cast<std::uint16_t>(x[i]),
                         static_cast<std::uint16_t>(y[i])};
  }
  return stored;
}

std::uint8_t to_label(const std::string& option, int number) {
  if (number < 0 || number >= unused_label)
    throw Error(ErrorKind::usage, option, fmt::format("{} is not a label", number), "0 … 254");
  return static_cast<std::uint8_t>(number);
}

Grid<Rgb8> to_rgb8(const Grid<glm::vec3>& encoded) {
  Grid<Rgb8> out(encoded.width(), encoded.height());
  std::transform(encoded.begin(), encoded.end(), out.begin(), [](const glm::vec3& colour) {
    const auto level = [](float v) {
      return static_cast<std::uint8_t>(std::lround(std::clamp(v, 0.F, 1.F) * 255.F));
    };
    return Rgb8{level(colour.x), level(colour.y), level(colour.z)};
  });
  return out;
}

}  // namespace belvedere::tools
