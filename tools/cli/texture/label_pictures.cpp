#include "tools/cli/texture/label_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdlib>

#include "base/error.h"
#include "base/filter.h"
#include "renderer/image/image_io.h"
#include "renderer/image/label_image.h"
#include "texture/statistical/label_borders.h"

namespace belvedere::tools {
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

}  // namespace belvedere::tools
