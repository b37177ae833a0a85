#include "renderer/image/guidance_io.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>

#include "base/error.h"
#include "base/parallel.h"

namespace belvedere {
namespace {

// One channel of the file and how it hangs together with the buffers. `component` of a vector, 0 for numbers.
struct Channel {
  const char* part;
  const char* name;
  ChannelType type;
  bool (*present)(const GuidanceBuffers&);
  int (*width)(const GuidanceBuffers&);
  int (*height)(const GuidanceBuffers&);
  // Copies `count` values from index `first` on to out, out + step, …
  void (*get)(const GuidanceBuffers&, std::size_t first, std::size_t count, float* out, std::size_t step);
  // Puts a grid that was read in its place.
  void (*set)(GuidanceBuffers&, const Grid<float>&);
};

template <class T, int component>
auto& part_of(T& value) {
  if constexpr (requires { value[component]; }) {
    return value[component];
  } else {
    return value;
  }
}

template <auto member, int component = 0>
constexpr Channel channel(const char* part, const char* name, ChannelType type) {
  return {part,
          name,
          type,
          [](const GuidanceBuffers& g) { return !(g.*member).empty(); },
          [](const GuidanceBuffers& g) { return (g.*member).width(); },
          [](const GuidanceBuffers& g) { return (g.*member).height(); },
          [](const GuidanceBuffers& g, std::size_t first, std::size_t count, float* out, std::size_t step) {
            const auto* from = (g.*member).data() + first;
            for (std::size_t i = 0; i < count; ++i, out += step) {
              if constexpr (std::is_same_v<std::decay_t<decltype(*from)>, LandCoverClass>) {
                *out = std::bit_cast<float>(std::uint32_t{static_cast<std::uint8_t>(from[i])});
              } else if constexpr (std::is_same_v<std::decay_t<decltype(*from)>, std::uint32_t>) {
                *out = std::bit_cast<float>(from[i]);
              } else {
                *out = part_of<decltype(*from), component>(from[i]);
              }
            }
          },
          [](GuidanceBuffers& g, const Grid<float>& values) {
            auto& grid = g.*member;
            using Value = typename std::decay_t<decltype(grid)>::value_type;
            if constexpr (!std::is_same_v<Value, LandCoverClass> && !std::is_same_v<Value, std::uint32_t>) {
              if (grid.empty()) grid = std::decay_t<decltype(grid)>(values.width(), values.height());
              for (std::size_t i = 0; i < values.size(); ++i) part_of<Value, component>(grid[i]) = values[i];
            }
          }};
}

constexpr const char* class_channel = "landcover.id";
constexpr const char* painted_channel = "painted.id";

// Numbers that are written bit by bit and read by their own function.
struct IdChannel {
  const char* name;
  Grid<std::uint32_t> GuidanceBuffers::*member;
};
constexpr IdChannel id_channels[] = {
    {"painted.from", &GuidanceBuffers::painted_from},
    {"stroke.id", &GuidanceBuffers::stroke},
    {"ground.from", &GuidanceBuffers::ground_from},
};

using B = GuidanceBuffers;
using enum ChannelType;
const Channel channels[] = {
    channel<&B::depth_m>("depth", "Z", float32),
    channel<&B::coverage>("depth", "coverage.A", half),
    channel<&B::front>("depth", "front.A", half),
    channel<&B::silhouette>("depth", "silhouette.V", half),
    channel<&B::footprint_m>("depth", "footprint.V", float32),
    channel<&B::position_m, 0>("position", "P.X", float32),
    channel<&B::position_m, 1>("position", "P.Y", float32),
    channel<&B::position_m, 2>("position", "P.Z", float32),
    channel<&B::altitude_m>("position", "altitude.V", float32),
    channel<&B::normal, 0>("normal", "N.X", half),
    channel<&B::normal, 1>("normal", "N.Y", half),
    channel<&B::normal, 2>("normal", "N.Z", half),
    channel<&B::normal_detail, 0>("normal", "Nd.X", half),
    channel<&B::normal_detail, 1>("normal", "Nd.Y", half),
    channel<&B::normal_detail, 2>("normal", "Nd.Z", half),
    channel<&B::normal_smooth, 0>("normal", "Ns.X", half),
    channel<&B::normal_smooth, 1>("normal", "Ns.Y", half),
    channel<&B::normal_smooth, 2>("normal", "Ns.Z", half),
    channel<&B::land_cover>("class", class_channel, uint32),
    channel<&B::slope_deg>("terrain", "slope.V", half),
    channel<&B::aspect_deg>("terrain", "aspect.V", half),
    channel<&B::fall_line, 0>("terrain", "fallline.X", half),
    channel<&B::fall_line, 1>("terrain", "fallline.Y", half),
    channel<&B::ridge>("terrain", "ridge.V", half),
    channel<&B::relief_s_m>("terrain", "relief.S", half),
    channel<&B::relief_m_m>("terrain", "relief.M", half),
    channel<&B::relief_l_m>("terrain", "relief.L", half),
    channel<&B::valley_height_m>("terrain", "valley.V", half),
    channel<&B::rim_m>("terrain", "rim.V", float32),
    channel<&B::built>("terrain", "built.V", half),
    channel<&B::grain, 0>("terrain", "grain.X", half),
    channel<&B::grain, 1>("terrain", "grain.Y", half),
    channel<&B::shadow>("light", "shadow.V", half),
    channel<&B::sky_view>("light", "skyview.V", half),
    channel<&B::tone>("light", "tone.V", half),
    channel<&B::base, 0>("base", "base.R", half),
    channel<&B::base, 1>("base", "base.G", half),
    channel<&B::base, 2>("base", "base.B", half),
    channel<&B::painted_class>("paint", painted_channel, uint32),
    channel<&B::painted_from>("paint", "painted.from", uint32),
    channel<&B::stroke>("paint", "stroke.id", uint32),
    channel<&B::ground_from>("paint", "ground.from", uint32),
};

std::string make_legend() {
  std::string legend;
  for (const LandCoverClassInfo& info : land_cover_classes()) {
    legend += fmt::format("{} {} {:06x}\n", static_cast<int>(info.id), info.name, info.rgb);
  }
  return legend;
}

// Lengths within half's precision of 1 become 1; zero (flat ground has no fall line) stays.
template <class V>
void make_unit(Grid<V>& directions) {
  parallel_rows(directions.height(), [&](int y) {
    V* row = directions.row(y);
    for (int x = 0; x < directions.width(); ++x) {
      const float length = glm::length(row[x]);
      if (std::abs(length - 1.0f) < 0.01f) row[x] /= length;
    }
  });
}

Grid<LandCoverClass> make_classes(const std::string& path, const char* name, const Grid<std::uint32_t>& ids) {
  Grid<LandCoverClass> out(ids.width(), ids.height());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (ids[i] >= static_cast<std::uint32_t>(land_cover_class_count)) {
      throw Error(ErrorKind::input, path, fmt::format("channel {} has the class id {}", name, ids[i]),
                  fmt::format("0 to {}", land_cover_class_count - 1));
    }
    out[i] = static_cast<LandCoverClass>(ids[i]);
  }
  return out;
}

}  // namespace

namespace {

constexpr const char* origin_note = "origin";  // what P is relative to: easting, northing, altitude

glm::dvec3 parse_origin(const std::string& path, const std::string& text) {
  glm::dvec3 origin{0.0};
  const char* at = text.data();
  const char* end = at + text.size();
  for (int k = 0; k < 3; ++k) {
    while (at != end && *at == ' ') ++at;
    const auto [next, fault] = std::from_chars(at, end, origin[k]);
    if (fault != std::errc()) throw Error(ErrorKind::input, path, "the note \"origin\" is " + text, "three numbers");
    at = next;
  }
  return origin;
}

}  // namespace

GuidanceWriter::GuidanceWriter(const std::string& path, int width, int height, const FileNotes& notes)
    : path_(path), width_(width), height_(height), notes_(notes) {
  notes_["legend"] = make_legend();
}

void GuidanceWriter::write_rows(const GuidanceBuffers& part, int first, int rows, int y0) {
  if (!writer_) {
    std::vector<PartSpec> specs;
    for (std::size_t c = 0; c < std::size(channels); ++c) {
      if (!channels[c].present(part)) continue;
      if (specs.empty() || specs.back().name != channels[c].part) {
        specs.push_back({channels[c].part, {}});
        parts_.emplace_back();
      }
      specs.back().channels.push_back({channels[c].name, channels[c].type});
      parts_.back().push_back(c);
    }
    if (specs.empty()) throw Error(ErrorKind::bug, path_, "guidance without any channel");
    notes_[origin_note] = fmt::format("{:.17g} {:.17g} {:.17g}", part.origin_m.x, part.origin_m.y, part.origin_m.z);
    writer_.emplace(path_, width_, height_, specs, notes_);
  }
  std::vector<float> band;
  for (int y = 0; y < rows; y += ExrWriter::band_rows) {
    const int band_rows = std::min(ExrWriter::band_rows, rows - y);
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      const std::size_t step = parts_[p].size();
      const std::size_t row_values = step * static_cast<std::size_t>(width_);
      band.resize(row_values * static_cast<std::size_t>(band_rows));
      for (const std::size_t c : parts_[p]) {
        if (channels[c].width(part) != width_ || channels[c].height(part) < first + rows) {
          throw Error(ErrorKind::bug, path_, fmt::format("channel {} has not the size of the picture", channels[c].name));
        }
      }
      parallel_rows(band_rows, [&](int r) {
        const std::size_t from = static_cast<std::size_t>(first + y + r) * static_cast<std::size_t>(width_);
        float* to = band.data() + row_values * static_cast<std::size_t>(r);
        for (const std::size_t c : parts_[p]) channels[c].get(part, from, static_cast<std::size_t>(width_), to++, step);
      });
      writer_->write_rows(p, y0 + y, band_rows, band);
    }
  }
}

void GuidanceWriter::finish() {
  if (!writer_) throw Error(ErrorKind::bug, path_, "guidance without rows");
  writer_->finish();
}

void write_guidance(const std::string& path, const GuidanceBuffers& guidance, const FileNotes& notes) {
  int width = 0;
  int height = 0;
  for (const Channel& c : channels) {
    width = std::max(width, c.width(guidance));
    height = std::max(height, c.height(guidance));
  }
  GuidanceWriter writer(path, width, height, notes);
  writer.write_rows(guidance, 0, height, 0);
  writer.finish();
}

GuidanceBuffers read_guidance(const std::string& path) {
  const ImageInfo info = read_image_info(path);
  GuidanceBuffers out;
  if (const auto note = info.notes.find(origin_note); note != info.notes.end()) out.origin_m = parse_origin(path, note->second);
  bool found = false;
  const auto check_size = [&](const auto& grid) {
    found = true;
    if (grid.width() != info.width || grid.height() != info.height) {
      throw Error(ErrorKind::input, path, "its parts have different sizes", fmt::format("{} × {} pixels in each", info.width, info.height));
    }
  };
  // Part by part, so that only one part is there twice.
  const std::span<const Channel> all(channels);
  for (auto begin = all.begin(); begin != all.end();) {
    const auto end = std::find_if(begin, all.end(), [&](const Channel& c) { return std::string_view(c.part) != begin->part; });
    std::vector<std::string> names;
    if (begin->type != uint32) {
      for (auto c = begin; c != end; ++c) names.emplace_back(c->name);
    }
    const std::vector<Grid<float>> grids = read_channels(path, names);
    for (std::size_t i = 0; i < grids.size(); ++i) {
      if (grids[i].empty()) continue;
      check_size(grids[i]);
      begin[static_cast<std::ptrdiff_t>(i)].set(out, grids[i]);
    }
    begin = end;
  }
  const auto holds = [&](const char* name) {
    return std::any_of(info.parts.begin(), info.parts.end(), [&](const PartSpec& part) {
      return std::any_of(part.channels.begin(), part.channels.end(), [&](const ChannelSpec& c) { return c.name == name; });
    });
  };
  const auto read_ids = [&](const char* name) {
    Grid<std::uint32_t> ids = read_id_channel(path, name);
    check_size(ids);
    return ids;
  };
  if (holds(class_channel)) out.land_cover = make_classes(path, class_channel, read_ids(class_channel));
  if (holds(painted_channel)) out.painted_class = make_classes(path, painted_channel, read_ids(painted_channel));
  for (const IdChannel& c : id_channels)
    if (holds(c.name)) out.*c.member = read_ids(c.name);
  if (!found) throw Error(ErrorKind::input, path, "holds no guidance", "an OpenEXR file with channels such as Z, altitude.V, landcover.id");
  make_unit(out.normal);
  make_unit(out.normal_detail);
  make_unit(out.normal_smooth);
  make_unit(out.fall_line);
  return out;
}

}  // namespace belvedere
