#include "renderer/image/guidance_io.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <glm/geometric.hpp>
#include <type_traits>
#include <variant>

#include "base/error.h"
#include "base/parallel.h"

namespace belvedere {
namespace {

// A component of a grid as one channel of the file.
struct FileChannel {
  const GuidanceChannel* row;
  int component;
  std::string name;
  ChannelType type;
};

ChannelType file_type(ChannelStorage storage) {
  switch (storage) {
    case ChannelStorage::half:
      return ChannelType::half;
    case ChannelStorage::float32:
      return ChannelType::float32;
    case ChannelStorage::uint32:
      return ChannelType::uint32;
  }
  return ChannelType::float32;
}

const std::vector<FileChannel>& file_channels() {
  static const std::vector<FileChannel> all = [] {
    std::vector<FileChannel> list;
    for (const GuidanceChannel& row : guidance_channels())
      for (std::size_t k = 0; k < row.components(); ++k)
        list.push_back({&row, static_cast<int>(k), std::string(row.names[k]), file_type(row.type)});
    return list;
  }();
  return all;
}

template <class G>
constexpr bool has_components = !std::is_arithmetic_v<typename std::decay_t<G>::value_type> &&
                                !std::is_enum_v<typename std::decay_t<G>::value_type>;

// One component in the form of the file. Ids are copied bit by bit, as whole numbers.
float file_value(float value, int) { return value; }
float file_value(const glm::vec2& value, int component) { return value[component]; }
float file_value(const glm::vec3& value, int component) { return value[component]; }
float file_value(LandCoverClass id, int) {
  return std::bit_cast<float>(std::uint32_t{static_cast<std::uint8_t>(id)});
}
float file_value(std::uint32_t id, int) { return std::bit_cast<float>(id); }

// Copies `count` values from index `first` on.
void copy_out(const GuidanceBuffers& guidance, const FileChannel& channel, std::size_t first,
              std::size_t count, float* out) {
  std::visit(
      [&](auto member) {
        const auto* from = (guidance.*member).data() + first;
        for (std::size_t i = 0; i < count; ++i) out[i] = file_value(from[i], channel.component);
      },
      channel.row->member);
}

glm::ivec2 size_of(const GuidanceBuffers& guidance, GuidanceMember member) {
  return std::visit(
      [&](auto grid) { return glm::ivec2((guidance.*grid).width(), (guidance.*grid).height()); },
      member);
}

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

void make_unit(GuidanceBuffers& guidance, const GuidanceChannel& row) {
  std::visit(
      [&](auto member) {
        if constexpr (has_components<decltype(guidance.*member)>) make_unit(guidance.*member);
      },
      row.member);
}

// Stores a component that was read.
void put_numbers(GuidanceBuffers& guidance, const FileChannel& channel, const Grid<float>& values) {
  std::visit(
      [&](auto member) {
        auto& grid = guidance.*member;
        using Values = std::decay_t<decltype(grid)>;
        if constexpr (std::is_same_v<Values, Grid<float>>) {
          grid = values;
        } else if constexpr (has_components<Values>) {
          if (grid.empty()) grid = Values(values.width(), values.height());
          for (std::size_t i = 0; i < values.size(); ++i) grid[i][channel.component] = values[i];
        }
      },
      channel.row->member);
}

Grid<LandCoverClass> make_classes(const std::string& path, const std::string& name,
                                  const Grid<std::uint32_t>& ids) {
  Grid<LandCoverClass> out(ids.width(), ids.height());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (ids[i] >= static_cast<std::uint32_t>(land_cover_class_count)) {
      throw Error(ErrorKind::input, path,
                  fmt::format("channel {} has the class id {}", name, ids[i]),
                  fmt::format("0 to {}", land_cover_class_count - 1));
    }
    out[i] = static_cast<LandCoverClass>(ids[i]);
  }
  return out;
}

void put_ids(const std::string& path, GuidanceBuffers& guidance, const FileChannel& channel,
             const Grid<std::uint32_t>& ids) {
  if (const auto* classes =
          std::get_if<Grid<LandCoverClass> GuidanceBuffers::*>(&channel.row->member))
    guidance.*(*classes) = make_classes(path, channel.name, ids);
  else if (const auto* numbers =
               std::get_if<Grid<std::uint32_t> GuidanceBuffers::*>(&channel.row->member))
    guidance.*(*numbers) = ids;
}

constexpr const char* origin_note = "origin";  // what P is relative to: easting, northing, altitude

glm::dvec3 parse_origin(const std::string& path, const std::string& text) {
  glm::dvec3 origin{0.0};
  const char* at = text.data();
  const char* end = at + text.size();
  for (int k = 0; k < 3; ++k) {
    while (at != end && *at == ' ') ++at;
    const auto [next, fault] = std::from_chars(at, end, origin[k]);
    if (fault != std::errc())
      throw Error(ErrorKind::input, path, "the note \"origin\" is " + text, "three numbers");
    at = next;
  }
  return origin;
}

}  // namespace

GuidanceWriter::GuidanceWriter(const std::string& path, int width, int height,
                               const FileNotes& notes)
    : path_(path), width_(width), height_(height), notes_(notes) {
  notes_["legend"] = make_legend();
}

void GuidanceWriter::write_rows(const GuidanceBuffers& part, int first, int rows, int y0) {
  const std::vector<FileChannel>& channels = file_channels();
  if (!writer_) {
    std::vector<PartSpec> specs;
    for (std::size_t c = 0; c < channels.size(); ++c) {
      const GuidanceChannel& row = *channels[c].row;
      if (size_of(part, row.member).x == 0) continue;
      if (specs.empty() || specs.back().name != row.part) {
        specs.push_back({std::string(row.part), {}});
        parts_.emplace_back();
      }
      specs.back().channels.push_back({channels[c].name, channels[c].type});
      parts_.back().push_back(c);
    }
    if (specs.empty()) throw Error(ErrorKind::bug, path_, "guidance without any channel");
    notes_[origin_note] =
        fmt::format("{:.17g} {:.17g} {:.17g}", part.origin_m.x, part.origin_m.y, part.origin_m.z);
    writer_.emplace(path_, width_, height_, specs, notes_);
  }
  for (const std::vector<std::size_t>& of_part : parts_)
    for (const std::size_t c : of_part) {
      const glm::ivec2 size = size_of(part, channels[c].row->member);
      if (size.x != width_ || size.y < first + rows)
        throw Error(ErrorKind::bug, path_,
                    fmt::format("channel {} differs in size from the picture", channels[c].name));
    }
  // Band by band, so that related data are adjacent in the file, however many rows come at once.
  for (int y = 0; y < rows; y += ExrWriter::band_rows)
    for (std::size_t p = 0; p < parts_.size(); ++p)
      writer_->write_rows(p, y0 + y, std::min(ExrWriter::band_rows, rows - y),
                          [&](std::size_t channel, int x, int row, int count, float* out) {
                            const std::size_t from = static_cast<std::size_t>(first + row - y0) *
                                                         static_cast<std::size_t>(width_) +
                                                     static_cast<std::size_t>(x);
                            copy_out(part, channels[parts_[p][channel]], from,
                                     static_cast<std::size_t>(count), out);
                          });
}

void GuidanceWriter::finish() {
  complete();
  commit();
}

void GuidanceWriter::complete() {
  if (!writer_) throw Error(ErrorKind::bug, path_, "guidance without rows");
  writer_->complete();
}

void GuidanceWriter::commit() { writer_->commit(); }

void write_guidance(const std::string& path, const GuidanceBuffers& guidance,
                    const FileNotes& notes) {
  glm::ivec2 size(0);
  for (const GuidanceChannel& row : guidance_channels())
    size = glm::max(size, size_of(guidance, row.member));
  GuidanceWriter writer(path, size.x, size.y, notes);
  writer.write_rows(guidance, 0, size.y, 0);
  writer.finish();
}

GuidanceBuffers read_guidance(const std::string& path) {
  const ImageInfo info = read_image_info(path);
  GuidanceBuffers out;
  if (const auto note = info.notes.find(origin_note); note != info.notes.end())
    out.origin_m = parse_origin(path, note->second);
  bool found = false;
  const auto check_size = [&](const auto& grid) {
    found = true;
    if (grid.width() != info.width || grid.height() != info.height) {
      throw Error(ErrorKind::input, path, "its parts have different sizes",
                  fmt::format("{} × {} pixels in each", info.width, info.height));
    }
  };
  const auto holds = [&](const GuidanceChannel& row) {
    const auto in_file = [&](std::string_view name) {
      return std::any_of(info.parts.begin(), info.parts.end(), [&](const PartSpec& part) {
        return std::any_of(part.channels.begin(), part.channels.end(),
                           [&](const ChannelSpec& c) { return c.name == name; });
      });
    };
    const auto count =
        static_cast<std::size_t>(std::count_if(row.names.begin(), row.names.end(), in_file));
    if (count > 0 && count < row.components())
      throw Error(ErrorKind::input, path,
                  fmt::format("{} of the channels {}", count, fmt::join(row.names, " ")),
                  "all of them, or none");
    return count > 0;
  };
  // Part by part, so that only one part is in memory twice.
  const std::vector<FileChannel>& channels = file_channels();
  for (auto begin = channels.begin(); begin != channels.end();) {
    const auto end = std::find_if(begin, channels.end(), [&](const FileChannel& c) {
      return c.row->part != begin->row->part;
    });
    std::vector<FileChannel> numbers;
    std::vector<std::string> names;
    for (auto c = begin; c != end; ++c) {
      if (!holds(*c->row)) continue;
      if (c->type == ChannelType::uint32) {
        const Grid<std::uint32_t> ids = read_id_channel(path, c->name);
        check_size(ids);
        put_ids(path, out, *c, ids);
      } else {
        numbers.push_back(*c);
        names.push_back(c->name);
      }
    }
    const std::vector<Grid<float>> grids = read_channels(path, names);
    for (std::size_t i = 0; i < grids.size(); ++i) {
      check_size(grids[i]);
      put_numbers(out, numbers[i], grids[i]);
    }
    begin = end;
  }
  if (!found)
    throw Error(ErrorKind::input, path, "contains no guidance",
                "an OpenEXR file with channels such as Z, altitude.V, landcover.id");
  for (const GuidanceChannel& row : guidance_channels())
    if (row.kind == ChannelKind::direction) make_unit(out, row);
  return out;
}

}  // namespace belvedere
