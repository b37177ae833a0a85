#include "tools/synthesis_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>

#include "renderer/base/error.h"

namespace belvedere::tools {
namespace {

std::string size_text(int width, int height) { return fmt::format("{} × {}", width, height); }

template <class T>
void require_size(const Grid<T>& grid, const std::string& file, int width, int height, const std::string& of) {
  if (grid.width() != width || grid.height() != height)
    throw Error(ErrorKind::usage, file, fmt::format("has {} pixels", size_text(grid.width(), grid.height())),
                fmt::format("{}, as {}", size_text(width, height), of));
}

Grid<std::uint8_t> read_labels(const std::string& file) {
  const Grid<std::uint16_t> grey = read_grey(file);
  Grid<std::uint8_t> labels(grey.width(), grey.height());
  for (std::size_t i = 0; i < grey.size(); ++i) {
    if (grey[i] > unused_label)
      throw Error(ErrorKind::input, file, fmt::format("has a label {}", grey[i]), "0 … 254, and 255 for what must not be used");
    labels[i] = static_cast<std::uint8_t>(grey[i]);
  }
  return labels;
}

// Guides are compared in 8 bits; 16-bit images lose their lower half, on both sides alike.
Grid<std::uint8_t> read_guide(const std::string& file) {
  const ImageInfo info = read_image_info(file);
  const bool wide =
      !info.parts.empty() && !info.parts.front().channels.empty() && info.parts.front().channels.front().type == ChannelType::uint16;
  const Grid<std::uint16_t> grey = read_grey(file);
  Grid<std::uint8_t> values(grey.width(), grey.height());
  for (std::size_t i = 0; i < grey.size(); ++i) values[i] = static_cast<std::uint8_t>(wide ? (grey[i] + 128) / 257 : grey[i]);
  return values;
}

Rgb8 to_rgb8(glm::vec3 encoded) {
  Rgb8 out{};
  for (int c = 0; c < 3; ++c)
    out[static_cast<std::size_t>(c)] = static_cast<std::uint8_t>(std::lround(std::clamp(encoded[c], 0.F, 1.F) * 255.F));
  return out;
}

Exemplar make_exemplar(const std::string& file, const Grid<glm::vec3>& picture, const Grid<float>& alpha, Grid<std::uint8_t> labels) {
  Exemplar exemplar{.name = file, .picture = Grid<Rgb8>(picture.width(), picture.height()), .guides = {}};
  for (std::size_t i = 0; i < picture.size(); ++i) {
    exemplar.picture[i] = to_rgb8(picture[i]);
    if (alpha[i] < 0.5F) labels[i] = unused_label;  // what is cut out of a picture is no paint
  }
  exemplar.guides.label = std::move(labels);
  return exemplar;
}

}  // namespace

SynthesisInputs read_synthesis(const SynthesisFiles& files) {
  const auto refuse = [](const std::string& found, const std::string& allowed) {
    throw Error(ErrorKind::usage, "command line", found, allowed);
  };
  if (files.pictures.empty()) refuse("there is no --picture", "at least one");
  if (files.labels.size() != files.pictures.size())
    refuse(fmt::format("there are {} --picture and {} --label", files.pictures.size(), files.labels.size()),
           "one --label for each --picture");

  SynthesisInputs inputs;
  const std::string& target_file = files.labels.front().second;
  inputs.target.label = read_labels(target_file);
  inputs.profile = read_image_info(files.pictures.front()).icc_profile;
  for (std::size_t i = 0; i < files.pictures.size(); ++i) {
    if (files.labels[i].second != target_file)
      refuse(fmt::format("the labels name two targets, {} and {}", target_file, files.labels[i].second),
             "the same target for every picture");
    Grid<float> alpha;
    inputs.pictures.push_back(read_picture(files.pictures[i], &alpha));
    const Grid<glm::vec3>& picture = inputs.pictures.back();
    Grid<std::uint8_t> labels = read_labels(files.labels[i].first);
    require_size(labels, files.labels[i].first, picture.width(), picture.height(), files.pictures[i]);
    inputs.exemplars.push_back(make_exemplar(files.pictures[i], picture, alpha, std::move(labels)));
  }

  std::map<std::string, std::size_t> seen;  // how many pictures have that guide
  std::map<std::string, const GuidePair*> first;
  for (const GuidePair& guide : files.guides) {
    const std::size_t i = seen[guide.name]++;
    if (i >= inputs.exemplars.size())
      refuse(fmt::format("--guide {} stands more often than --picture", guide.name), "one for each picture");
    Exemplar& exemplar = inputs.exemplars[i];
    exemplar.guides.guides.push_back({guide.name, read_guide(guide.source)});
    require_size(exemplar.guides.guides.back().values, guide.source, exemplar.picture.width(), exemplar.picture.height(),
                 files.pictures[i]);
    if (i == 0) {
      first[guide.name] = &guide;
      inputs.target.guides.push_back({guide.name, read_guide(guide.target)});
      require_size(inputs.target.guides.back().values, guide.target, inputs.target.width(), inputs.target.height(), target_file);
      inputs.weights.emplace_back(guide.name, guide.weight);
    } else if (guide.target != first[guide.name]->target || guide.weight != first[guide.name]->weight) {
      refuse(fmt::format("--guide {} has two targets or two weights", guide.name), "the same target and weight for every picture");
    }
  }
  for (const auto& [name, count] : seen)
    if (count != inputs.exemplars.size())
      refuse(fmt::format("--guide {} is there for {} of {} pictures", name, count, inputs.exemplars.size()), "one for each picture");
  return inputs;
}

void write_matches(const std::string& path, const MatchField& matches, const FileNotes& notes) {
  const int width = matches.width();
  ExrWriter writer(
      path, width, matches.height(),
      {{.name = "match", .channels = {{"exemplar", ChannelType::uint32}, {"x", ChannelType::uint32}, {"y", ChannelType::uint32}}}}, notes);
  for (int y0 = 0; y0 < matches.height(); y0 += ExrWriter::band_rows) {
    const int rows = std::min(ExrWriter::band_rows, matches.height() - y0);
    std::vector<float> values;
    values.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(rows) * 3);
    for (int y = y0; y < y0 + rows; ++y)
      for (int x = 0; x < width; ++x) {
        const Match& match = matches(x, y);
        for (const std::uint32_t value : {std::uint32_t{match.exemplar}, std::uint32_t{match.x}, std::uint32_t{match.y}})
          values.push_back(std::bit_cast<float>(value));
      }
    writer.write_rows(0, y0, rows, values);
  }
  writer.finish();
}

}  // namespace belvedere::tools
