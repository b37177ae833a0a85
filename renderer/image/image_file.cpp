#include "renderer/image/image_file.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <fstream>
#include <limits>
#include <string_view>
#include <system_error>

#include "base/memory_limit.h"
#include "base/parallel.h"
#include "base/text/missing_file.h"
#include "base/text/text_encoding.h"

namespace belvedere {
namespace {

constexpr std::string_view notes_mark = "Belvedere notes\n";

}  // namespace

namespace image_io {

std::string first_bytes(const std::string& path) {
  require_file(path, "a picture");
  std::ifstream file(path, std::ios::binary);
  if (!file)
    throw Error(ErrorKind::input, path,
                "cannot be opened: " + std::generic_category().message(errno));
  std::string head(16, '\0');
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(file.gcount()));
  return head;
}

Error no_grey_picture(const std::string& path) {
  return {ErrorKind::input, path, "is not a grey or palette picture of at most 16 bits",
          "PNG or TIFF, grey, 1 to 16 bits; PNG with a palette"};
}

void throw_damaged(const std::string& path, const std::string& reason) {
  const std::string first =
      reason.substr(0, reason.find('\n'));  // libraries report the same for each row
  throw Error(ErrorKind::input, path,
              "is damaged or truncated" + (first.empty() ? std::string() : " (" + first + ")"));
}

void check_memory(const std::string& path, std::int64_t width, std::int64_t height, double bytes) {
  if (width < 1 || height < 1) throw_damaged(path, "a picture without pixels");
  const double limit = static_cast<double>(memory_budget_bytes());
  constexpr std::int64_t longest = std::numeric_limits<int>::max() / 64;
  if (bytes <= limit && width <= longest && height <= longest) return;
  const auto mib = [](double b) {
    return std::to_string(static_cast<std::int64_t>(std::ceil(std::min(b, 1e18) / 1048576.0))) +
           " MiB";
  };
  throw Error(ErrorKind::limit, path,
              "its " + std::to_string(width) + " × " + std::to_string(height) + " pixels need " +
                  mib(bytes) + " of memory",
              "up to " + mib(limit) + " (set by BELVEDERE_MEMORY_MIB)");
}

void blacken_transparent(Grid<glm::vec3>& picture, const Grid<float>& alpha) {
  for (std::size_t i = 0; i < alpha.size(); ++i)
    if (alpha[i] <= 0.F) picture[i] = glm::vec3(0.F);
}

std::string join_notes(const FileNotes& notes) {
  if (notes.empty()) return {};
  std::string text(notes_mark);
  for (const auto& [key, value] : notes) {
    if (key.empty() || key.find(": ") != std::string::npos ||
        key.find_first_of("\n\\") != std::string::npos) {
      throw Error(ErrorKind::bug, "notes", "the key \"" + key + "\" cannot be written");
    }
    std::string line = on_one_line(value);
    std::erase(line, '\0');  // would end the text in TIFF and PNG
    text += key + ": " + line + "\n";
  }
  return text;
}

FileNotes split_notes(const std::string& text) {
  FileNotes notes;
  if (text.empty()) return notes;
  if (!text.starts_with(notes_mark)) {
    notes["ImageDescription"] = text;
    return notes;
  }
  std::string_view rest = std::string_view(text).substr(notes_mark.size());
  while (!rest.empty()) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(rest.size(), line.size() + 1));
    const std::size_t colon = line.find(": ");
    if (colon != std::string_view::npos)
      notes[std::string(line.substr(0, colon))] = from_one_line(line.substr(colon + 2));
  }
  return notes;
}

template <class Number>
void quantize_rows(const Grid<glm::vec3>& encoded, int first, int rows, int row_pixels,
                   Number* out) {
  constexpr double highest = static_cast<double>(std::numeric_limits<Number>::max());
  const std::size_t row_values = static_cast<std::size_t>(row_pixels) * 3;
  parallel_rows(rows, [&](int r) {
    const glm::vec3* from = encoded.row(first + r);
    Number* to = out + row_values * static_cast<std::size_t>(r);
    for (int x = 0; x < encoded.width(); ++x) {
      for (int c = 0; c < 3; ++c) {
        const double v = from[x][c];
        const double cut =
            v > 0.0 ? (v < 1.0 ? v : 1.0) : 0.0;  // NaN fails the comparison and becomes 0
        // NOLINTNEXTLINE(bugprone-incorrect-roundings): never negative, and lround would be a call
        // for each value
        to[3 * x + c] = static_cast<Number>(cut * highest + 0.5);
      }
    }
  });
}
template void quantize_rows(const Grid<glm::vec3>&, int, int, int, std::uint8_t*);
template void quantize_rows(const Grid<glm::vec3>&, int, int, int, std::uint16_t*);

}  // namespace image_io

}  // namespace belvedere
