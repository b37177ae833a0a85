#include "renderer/image/exr/match_file.h"

#include <fmt/core.h>

#include <bit>
#include <cstdint>
#include <sstream>
#include <utility>

#include "base/error.h"

namespace belvedere {
namespace {

FileNotes with_pictures(FileNotes notes, const std::string& pictures) {
  notes[matched_pictures_note] = pictures;
  return notes;
}

}  // namespace

std::string to_note(const std::vector<MatchedPicture>& pictures) {
  std::string note;
  for (const MatchedPicture& picture : pictures)
    note += fmt::format("{} {} {}\n", picture.width, picture.height, picture.name);
  return note;
}

std::vector<MatchedPicture> parse_matched_pictures(const std::string& file,
                                                   const std::string& note) {
  std::vector<MatchedPicture> pictures;
  std::istringstream lines(note);
  for (std::string line; std::getline(lines, line);) {
    MatchedPicture picture;
    std::istringstream words(line);
    if (!(words >> picture.width >> picture.height) || picture.width < 1 || picture.height < 1)
      throw Error(ErrorKind::input, file, fmt::format("its header contains a picture \"{}\"", line),
                  "width, height and name");
    std::getline(words >> std::ws, picture.name);
    pictures.push_back(std::move(picture));
  }
  return pictures;
}

MatchWriter::MatchWriter(const std::string& path, int width, int height,
                         const std::string& pictures, FileNotes notes)
    : writer_(path, width, height,
              {{.name = "match",
                .channels = {{"exemplar", ChannelType::uint32},
                             {"x", ChannelType::uint32},
                             {"y", ChannelType::uint32}}}},
              with_pictures(std::move(notes), pictures)) {}

void MatchWriter::write_rows(const MatchField& rows, int y0) {
  writer_.write_rows(0, y0, rows.height(),
                     [&](std::size_t channel, int x, int y, int count, float* out) {
                       const Match* match = rows.row(y - y0) + x;
                       for (int i = 0; i < count; ++i) {
                         const std::uint16_t value = channel == 0   ? match[i].exemplar
                                                     : channel == 1 ? match[i].x
                                                                    : match[i].y;
                         out[i] = std::bit_cast<float>(std::uint32_t{value});
                       }
                     });
}

}  // namespace belvedere
