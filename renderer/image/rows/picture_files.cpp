#include "renderer/image/rows/picture_files.h"

#include <fmt/core.h>

#include <algorithm>

#include "base/error.h"
#include "base/parallel.h"
#include "renderer/image/picture_formats.h"
#include "renderer/image/rows/picture_rows.h"
#include "renderer/image/tiff_file.h"

namespace belvedere {
namespace {

constexpr int rows_per_read = 64;  // are converted at once

struct OneFile {
  const PictureFormat* format;
  bool device;  // converted to the printer's colours
  std::optional<RowReducer> reducer;
  std::unique_ptr<PictureRows> rows;
};

std::vector<const PictureFormat*> formats_of(const std::vector<std::string>& extensions) {
  std::vector<const PictureFormat*> formats;
  for (const std::string& extension : extensions) formats.push_back(&written_format(extension));
  return formats;
}

int reduced(int pixels, int factor) { return (pixels + factor - 1) / factor; }

Image copy_rows(const Image& from, int first, int rows) {
  Image out(from.width(), rows);
  std::copy(from.row(first), from.row(first) + out.size(), out.data());
  return out;
}

}  // namespace

struct PictureFiles::State {
  std::optional<DisplayConversion> display;
  std::optional<ProfileConversion> device;
  std::optional<PressConversion> press;
  std::optional<InkCount> ink;
  std::vector<OneFile> files;

  // Files are independent: each is packed by its own thread, and most of them by more.
  void write_band(const Image& linear) {
    const bool any_whole = std::any_of(files.begin(), files.end(), [](const OneFile& f) {
      return !f.format->linear && !f.reducer.has_value();
    });
    const Grid<glm::vec3> encoded = any_whole ? display->convert(linear) : Grid<glm::vec3>();
    parallel_rows(static_cast<int>(files.size()), [&](int i) {
      OneFile& file = files[static_cast<std::size_t>(i)];
      Image small;
      if (file.reducer) {
        small = file.reducer->reduce(linear);
        if (small.empty()) return;
        if (!file.format->linear) small = display->convert(std::move(small));
      }
      const Grid<glm::vec3>& picture = file.reducer          ? small
                                       : file.format->linear ? linear
                                                             : encoded;
      if (file.device && device)
        file.rows->write_rows(device->convert(picture));
      else
        file.rows->write_rows(picture);
    });
  }
};

PictureFiles::PictureFiles(const std::string& stem, const std::vector<std::string>& extensions,
                           int width, int height, const PictureColours& colours,
                           double dots_per_inch, const FileNotes& notes)
    : state_(std::make_unique<State>()) {
  const std::vector<const PictureFormat*> formats = formats_of(extensions);
  if (std::any_of(formats.begin(), formats.end(),
                  [](const PictureFormat* f) { return !f->linear; }))
    state_->display.emplace(colours.display);
  for (const PictureFormat* format : formats) {
    const bool device = format->device && !colours.device_profile.empty();
    const bool press = device && is_cmyk_profile(colours.device_profile);
    if (press) {
      state_->press.emplace(colours.device_profile, colours.device);
      state_->ink.emplace(colours.ink_limit_percent > 0.0
                              ? colours.ink_limit_percent
                              : press_ink_limit_percent(colours.device_profile));
    } else if (device && !state_->device) {
      state_->device.emplace(colours.device_profile, colours.device);
    }
    const int factor = reduction_factor(*format, width, height);
    PictureFileOptions options;
    options.dots_per_inch = dots_per_inch / factor;
    options.icc_profile = !format->profile ? std::vector<std::uint8_t>{}
                          : device         ? colours.device_profile
                                           : srgb_profile();
    options.notes = notes;
    if (factor > 1)
      options.notes["belvedere:reduced"] =
          fmt::format("by {}, from {} × {} pixels", factor, width, height);
    const std::string path = fmt::format("{}.{}", stem, format->extension);
    const int file_width = reduced(width, factor);
    const int file_height = reduced(height, factor);
    const auto make_inks = [state = state_.get()](const Grid<glm::vec3>& rows) {
      Grid<Inks> inks = state->press->convert(rows);
      state->ink->add(inks);
      return inks;
    };
    OneFile file{
        format,
        device,
        {},
        press ? open_tiff_inks(path, file_width, file_height, format->bits, options, make_inks)
              : format->open(path, file_width, file_height, options)};
    if (factor > 1) file.reducer.emplace(width, height, factor);
    state_->files.push_back(std::move(file));
  }
}

PictureFiles::~PictureFiles() = default;

void PictureFiles::write_rows(const Image& linear) {
  if (linear.height() <= rows_per_read) {
    if (!linear.empty()) state_->write_band(linear);
    return;
  }
  for (int y = 0; y < linear.height(); y += rows_per_read)
    state_->write_band(copy_rows(linear, y, std::min(rows_per_read, linear.height() - y)));
}

void PictureFiles::finish() {
  std::vector<OneFile>& files = state_->files;
  parallel_rows(static_cast<int>(files.size()),
                [&](int i) { files[static_cast<std::size_t>(i)].rows->finish(); });
  for (OneFile& file : files) file.rows->commit();
}

std::optional<InkCoverage> PictureFiles::ink() const {
  return state_->ink ? std::optional(state_->ink->coverage()) : std::nullopt;
}

std::string ink_note(const std::string& file, const InkCoverage& ink) {
  return fmt::format(
      "{} uses up to {:.0f} % of ink, {:.0f} % on average; {:.2g} % of its pixels exceed {:.0f} %",
      file, ink.highest_percent, ink.mean_percent, 100.0 * ink.above_share(), ink.limit_percent);
}

std::vector<std::string> reduction_notes(const std::string& name,
                                         const std::vector<std::string>& extensions, int width,
                                         int height) {
  std::vector<std::string> notes;
  for (const PictureFormat* format : formats_of(extensions)) {
    const int factor = reduction_factor(*format, width, height);
    if (factor > 1)
      notes.push_back(fmt::format("{}.{} is {} × {} pixels, the picture reduced by {}", name,
                                  format->extension, reduced(width, factor),
                                  reduced(height, factor), factor));
  }
  return notes;
}

}  // namespace belvedere
