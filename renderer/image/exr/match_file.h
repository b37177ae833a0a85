#pragma once

#include <string>
#include <vector>

#include "renderer/image/exr/exr_writer.h"
#include "texture/synthesis/exemplar.h"

namespace belvedere {

// A picture that a stored match field copies from.
struct MatchedPicture {
  std::string name;  // without folders
  int width = 0;
  int height = 0;
};
// As in the note of the header: a line per picture, width, height, name.
std::string to_note(const std::vector<MatchedPicture>& pictures);
// Error(input) naming the file.
std::vector<MatchedPicture> parse_matched_pictures(const std::string& file,
                                                   const std::string& note);
constexpr const char* matched_pictures_note = "belvedere:matched_pictures";

// Writes a match field, rows from top to bottom: channels exemplar, x and y (uint) of each pixel;
// exemplar is 65535 where nothing was copied. The note `pictures` in the header names the pictures.
class MatchWriter {
 public:
  MatchWriter(const std::string& path, int width, int height, const std::string& pictures,
              FileNotes notes);
  // Bands as in ExrWriter::write_rows.
  void write_rows(const MatchField& rows, int y0);
  void finish() { writer_.finish(); }
  // The same in two steps, for files that appear together.
  void complete() { writer_.complete(); }
  void commit() { writer_.commit(); }

 private:
  ExrWriter writer_;
};

}  // namespace belvedere
