#include "renderer/image/oiio_file.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/files/output_file.h"
#include "base/parallel.h"
#include "renderer/image/png_palette.h"
#include "renderer/image/provenance.h"
#include "renderer/image/srgb.h"
#include "renderer/image/tiff_file.h"

namespace belvedere {
namespace {

constexpr int band_rows = 64;

class OiioReader {
 public:
  // `header_only`: CMYK is accepted as well, with its own four channels.
  OiioReader(const std::string& path, const std::string& format, bool header_only = false)
      : path_((load_oiio(), path)), format_(format) {  // before its first member of OpenImageIO
    if (format_ == "png" && !image_io::is_png_complete(path))
      image_io::throw_damaged(path, "a piece is missing or has a wrong checksum");
    if (format_ == "tiff") page_ = largest_tiff_page(path);
    input_ = OIIO::ImageInput::create(format_);
    if (input_ == nullptr) throw Error(ErrorKind::bug, path, "OpenImageIO cannot read " + format_);
    OIIO::ImageSpec settings;
    settings.attribute("oiio:UnassociatedAlpha",
                       1);  // colours as in the file, not multiplied by alpha
    open(settings);
    image_io::check_memory(path, spec_.width, spec_.height, 0.0);
    const std::string coding = spec_.get_string_attribute("jpeg:ColorSpace");
    const bool separated = spec_.get_int_attribute("tiff:PhotometricInterpretation") == 5;
    if (separated || coding == "CMYK" || coding == "YCbCrK") {
      if (header_only && separated) {
        settings.attribute("oiio:RawColor", 1);
        if (!open_page(settings)) image_io::throw_damaged(path, input_->geterror());
        return;
      }
      throw Error(ErrorKind::input, path, "is a CMYK picture",
                  "RGB or grey: convert it with its own profile first");
    }
  }

  const OIIO::ImageSpec& spec() const { return spec_; }
  const TiffPage& page() const { return page_; }
  // The picture's colours are CIE L*a*b*, as stored.
  bool is_lab() const { return photometric() == cie_lab || photometric() == icc_lab; }
  // A pixel as it is read in floats, in encoded sRGB; black where it is fully transparent.
  glm::vec3 colour(const float* from) const {
    if (spec_.alpha_channel >= 0 && from[spec_.alpha_channel] <= 0.F) return glm::vec3(0.F);
    const glm::vec3 as_read =
        spec_.nchannels >= 3 ? glm::vec3(from[0], from[1], from[2]) : glm::vec3(from[0]);
    if (!is_lab()) return as_read;
    const int bits = spec_.format == OIIO::TypeDesc::UINT16 ? 16 : 8;
    return srgb_from_lab(lab_of_tiff(glm::round(glm::dvec3(as_read) * ((1 << bits) - 1.0)), bits,
                                     photometric() == icc_lab));
  }

  void check_memory(double bytes_a_pixel) const {
    const double pixels = static_cast<double>(spec_.width) * static_cast<double>(spec_.height);
    // The file's own pixels once more: a TIFF may be one strip, which is unpacked whole.
    image_io::check_memory(path_, spec_.width, spec_.height,
                           pixels * bytes_a_pixel + static_cast<double>(spec_.image_bytes(true)));
  }

  // Calls use(y0, y1, values) for bands of rows from top to bottom: all channels of a pixel
  // together.
  template <class T, class F>
  void read_bands(OIIO::TypeDesc type, F&& use) {
    const int step = spec_.tile_height > 0 ? spec_.tile_height : band_rows;
    std::vector<T> band(static_cast<std::size_t>(spec_.width) *
                        static_cast<std::size_t>(spec_.nchannels) * static_cast<std::size_t>(step));
    for (int y = 0; y < spec_.height; y += step) {
      const int end = std::min(y + step, spec_.height);
      const int top = spec_.y;
      const bool ok =
          spec_.tile_width > 0
              ? input_->read_tiles(page_.index, 0, spec_.x, spec_.x + spec_.width, top + y,
                                   top + end, 0, 1, 0, spec_.nchannels, type, band.data())
              : input_->read_scanlines(page_.index, 0, top + y, top + end, 0, 0, spec_.nchannels,
                                       type, band.data());
      // Reading half a file returns true: only the message reveals it.
      if (const std::string message = input_->geterror(); !ok || !message.empty())
        image_io::throw_damaged(path_, message);
      use(y, end, band.data());
    }
  }

 private:
  static constexpr int cie_lab = 8, icc_lab = 9, itu_lab = 10;  // TIFF 6, tag 262

  int photometric() const { return spec_.get_int_attribute("tiff:PhotometricInterpretation"); }

  bool open_page(const OIIO::ImageSpec& settings) {
    input_->close();
    if (!input_->open(path_, spec_, settings)) return false;
    if (page_.index == 0) return true;
    if (!input_->seek_subimage(page_.index, 0)) return false;
    spec_ = input_->spec();
    return true;
  }

  // OpenImageIO would convert Lab without its white point, and 8 bits only: it is read as stored.
  void open(OIIO::ImageSpec& settings) {
    const bool plain = open_page(settings);
    const std::string problem = plain ? std::string() : input_->geterror();
    if (format_ == "tiff" && (!plain || (photometric() >= cie_lab && photometric() <= itu_lab))) {
      settings.attribute("oiio:RawColor", 1);
      const bool raw = open_page(settings);
      const bool whole_steps =
          spec_.format == OIIO::TypeDesc::UINT8 || spec_.format == OIIO::TypeDesc::UINT16;
      if (raw && (photometric() == itu_lab || (is_lab() && !whole_steps)))
        throw Error(ErrorKind::input, path_, "is a picture in CIE Lab of a kind that is not read",
                    "a picture in RGB: convert it to sRGB in a picture editor");
      if (raw && is_lab() && spec_.nchannels >= 3) return;
    }
    if (!plain) image_io::throw_damaged(path_, problem);
  }

  std::string path_;
  std::string format_;
  TiffPage page_;
  OIIO::ImageSpec spec_;
  std::unique_ptr<OIIO::ImageInput> input_;
};

ChannelType channel_type(const OIIO::TypeDesc& type) {
  switch (type.basetype) {
    case OIIO::TypeDesc::UINT8:
      return ChannelType::uint8;
    case OIIO::TypeDesc::UINT16:
      return ChannelType::uint16;
    case OIIO::TypeDesc::UINT32:
      return ChannelType::uint32;
    case OIIO::TypeDesc::HALF:
      return ChannelType::half;
    default:
      return ChannelType::float32;
  }
}

// Exif orientation: 1 upright, 2…8 mirrored or turned; 5 and more swap width and height.
int orientation_of(const OIIO::ImageSpec& spec) {
  const int found = spec.get_int_attribute("Orientation", 1);
  return found >= 1 && found <= 8 ? found : 1;
}

// The picture as its camera or scanner meant it to be seen: pixel (x, y) is taken from the stored
// one that the orientation of Exif 2.32, 4.6.4 A, names.
template <class T>
Grid<T> upright(Grid<T> stored, int orientation) {
  if (orientation == 1) return stored;
  const bool swaps = orientation >= 5;
  const int w = stored.width();
  const int h = stored.height();
  Grid<T> out(swaps ? h : w, swaps ? w : h);
  parallel_rows(out.height(), [&](int y) {
    for (int x = 0; x < out.width(); ++x) {
      int u = swaps ? y : x;
      int v = swaps ? x : y;
      if (orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8)
        u = w - 1 - u;
      if (orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7)
        v = h - 1 - v;
      out(x, y) = stored(u, v);
    }
  });
  return out;
}

double dots_per_inch(const OIIO::ImageSpec& spec) {
  const double resolution = spec.get_float_attribute("XResolution");
  const std::string unit = spec.get_string_attribute("ResolutionUnit");
  if (unit == "in" || unit == "inch") return resolution;
  if (unit == "cm") return resolution * 2.54;
  if (unit == "m" || unit == "meter") return resolution * 0.0254;
  return 0.0;
}

}  // namespace

ImageInfo read_oiio_info(const std::string& path, const std::string& format) {
  const OiioReader reader(path, format, true);
  const OIIO::ImageSpec& spec = reader.spec();
  ImageInfo info;
  info.format = format;
  info.width = spec.width;
  info.height = spec.height;
  if (orientation_of(spec) >= 5) std::swap(info.width, info.height);
  PartSpec part;
  for (int c = 0; c < spec.nchannels; ++c)
    part.channels.push_back({spec.channel_name(c), channel_type(spec.channelformat(c))});
  info.parts.push_back(std::move(part));
  info.notes = image_io::split_notes(spec.get_string_attribute("ImageDescription"));
  for (const char* key : {"Software", "Artist", "Copyright", "DateTime", "DocumentName"}) {
    if (const std::string value = spec.get_string_attribute(key); !value.empty())
      info.notes.emplace(key, value);
  }
  if (const int orientation = orientation_of(spec); orientation != 1)
    info.notes.emplace(image_io::orientation_note, std::to_string(orientation));
  if (const TiffPage& page = reader.page(); page.index > 0 || page.of_its_size.size() > 1)
    info.notes.emplace(image_io::page_note,
                       page.of_its_size.size() > 1
                           ? fmt::format("{} of {}; pages {} have the same size", page.index + 1,
                                         page.pages, fmt::join(page.of_its_size, ", "))
                           : fmt::format("{} of {}, the largest", page.index + 1, page.pages));
  info.dots_per_inch = dots_per_inch(spec);
  if (reader.is_lab()) info.notes.emplace(image_io::lab_note, "read in sRGB");
  if (const OIIO::ParamValue* icc = spec.find_attribute("ICCProfile");
      icc != nullptr && icc->type().elementsize() == 1 && !reader.is_lab()) {
    const auto* bytes = static_cast<const std::uint8_t*>(icc->data());
    info.icc_profile.assign(bytes, bytes + icc->datasize());
  }
  return info;
}

Grid<glm::vec3> read_oiio_picture(const std::string& path, const std::string& format,
                                  Grid<float>* alpha) {
  OiioReader reader(path, format);
  const int channels = reader.spec().nchannels;
  reader.check_memory(alpha != nullptr ? 16.0 : 12.0);
  Grid<glm::vec3> picture(reader.spec().width, reader.spec().height);
  const int alpha_channel = reader.spec().alpha_channel;
  if (alpha != nullptr) *alpha = Grid<float>(picture.width(), picture.height(), 1.0f);
  reader.read_bands<float>(OIIO::TypeDesc::FLOAT, [&](int y0, int y1, const float* from) {
    for (std::size_t i = picture.index(0, y0); i < picture.index(0, y1); ++i, from += channels) {
      picture[i] = reader.colour(from);
      if (alpha != nullptr && alpha_channel >= 0) (*alpha)[i] = from[alpha_channel];
    }
  });
  const int orientation = orientation_of(reader.spec());
  if (alpha != nullptr) *alpha = upright(std::move(*alpha), orientation);
  return upright(std::move(picture), orientation);
}

void read_oiio_rows(const std::string& path, const std::string& format, const UsePictureRows& use) {
  OiioReader reader(path, format);
  if (orientation_of(reader.spec()) != 1) {
    use(0, read_oiio_picture(path, format, nullptr));
    return;
  }
  const int channels = reader.spec().nchannels;
  reader.read_bands<float>(OIIO::TypeDesc::FLOAT, [&](int y0, int y1, const float* from) {
    Grid<glm::vec3> rows(reader.spec().width, y1 - y0);
    for (glm::vec3& pixel : rows) {
      pixel = reader.colour(from);
      from += channels;
    }
    use(y0, rows);
  });
}

Grid<std::uint16_t> read_oiio_grey(const std::string& path, const std::string& format) {
  const Error refused = image_io::no_grey_picture(path);
  if (format == "png" && image_io::read_png_kind(path).palette)
    return image_io::read_palette_png(path);
  OiioReader reader(path, format);
  const OIIO::ImageSpec& spec = reader.spec();
  const bool wide = spec.format == OIIO::TypeDesc::UINT16;
  const bool grey = spec.nchannels == 1 || (spec.nchannels == 2 && spec.alpha_channel == 1);
  if (!grey || (!wide && spec.format != OIIO::TypeDesc::UINT8) ||
      spec.get_string_attribute("tiff:ColorSpace") == "palette")
    throw refused;
  reader.check_memory(2.0);
  // Samples of fewer than 8 bits are returned stretched to 0…255 (10 and 12 bits to 0…65535): this
  // undoes it.
  const int bits = format == "png" ? image_io::read_png_kind(path).bits
                                   : spec.get_int_attribute("oiio:BitsPerSample", wide ? 16 : 8);
  const int full_bits = wide ? 16 : 8;
  const int full = (1 << full_bits) - 1;
  const int highest = bits > 0 && bits < full_bits ? (1 << bits) - 1 : full;
  Grid<std::uint16_t> out(spec.width, spec.height);
  const auto use = [&](int y0, int y1, const auto* from) {
    for (std::size_t i = out.index(0, y0); i < out.index(0, y1); ++i, from += spec.nchannels) {
      out[i] = static_cast<std::uint16_t>(
          (static_cast<std::uint32_t>(*from) * static_cast<std::uint32_t>(highest) +
           static_cast<std::uint32_t>(full) / 2) /
          static_cast<std::uint32_t>(full));
    }
  };
  if (wide) {
    reader.read_bands<std::uint16_t>(OIIO::TypeDesc::UINT16, use);
  } else {
    reader.read_bands<std::uint8_t>(OIIO::TypeDesc::UINT8, use);
  }
  return upright(std::move(out), orientation_of(spec));
}

namespace {

OIIO::ImageSpec make_png_spec(int width, int height, const PictureFileOptions& options) {
  OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("png:compressionLevel",
                 4);  // measured: 3.5 times as fast as the default 6, the same size
  spec.attribute("Software", "Belvedere " + program_version());
  if (const std::string notes = image_io::join_notes(options.notes); !notes.empty())
    spec.attribute("ImageDescription", notes);
  if (options.dots_per_inch > 0.0) {
    // PNG counts whole pixels a metre.
    const auto per_metre = static_cast<float>(std::lround(options.dots_per_inch / 0.0254));
    spec.attribute("XResolution", per_metre);
    spec.attribute("YResolution", per_metre);
    spec.attribute("ResolutionUnit", "m");
  }
  if (options.icc_profile.empty()) {
    spec.attribute("oiio:ColorSpace", "sRGB");
  } else {
    const OIIO::TypeDesc bytes(OIIO::TypeDesc::UINT8, static_cast<int>(options.icc_profile.size()));
    spec.attribute("ICCProfile", bytes, options.icc_profile.data());
  }
  return spec;
}

class PngRows : public PictureRows {
 public:
  PngRows(const std::string& path, int width, int height, const PictureFileOptions& options)
      : PictureRows(path, width, height, band_rows),
        output_(path),
        file_(OIIO::ImageOutput::create("png")),
        spec_(make_png_spec(width, height, options)) {
    if (file_ == nullptr) throw Error(ErrorKind::bug, path, "OpenImageIO cannot write PNG");
    band_.resize(row_bytes() * band_rows);
  }
  // libpng prints a message where an open file has too few rows for its first piece of data: the
  // rest of an abandoned file is filled with black.
  ~PngRows() override {
    try {
      std::fill(band_.begin(), band_.end(), std::uint8_t{0});
      for (bool ok = true; ok && rows_ > 0 && rows_ < height();) {
        const int end = std::min(rows_ + band_rows, height());
        ok = file_->write_scanlines(rows_, end, 0, OIIO::TypeDesc::UINT8, band_.data()) &&
             file_->geterror().empty();
        rows_ = end;
      }
    } catch (const std::bad_alloc&) {  // the file is removed
    }
  }
  PngRows(const PngRows&) = delete;
  PngRows& operator=(const PngRows&) = delete;

 private:
  void take(const Grid<glm::vec3>& from, int first, int rows, int at) override {
    image_io::quantize_rows(from, first, rows, width(),
                            band_.data() + row_bytes() * static_cast<std::size_t>(at));
  }
  void write_band(int y0, int rows) override {
    if (y0 == 0 && !file_->open(output_.temporary(), spec_)) output_.fail(file_->geterror());
    written_.add(text_of(band_.data(), rows));
    rows_ = y0 + rows;
    check(file_->write_scanlines(y0, rows_, 0, OIIO::TypeDesc::UINT8, band_.data()));
  }
  void complete() override {
    check(file_->close());
    // On a full disk all of the above reports success, so every row is read again.
    ContentHash read;
    try {
      OiioReader reader(output_.temporary(), "png");
      if (reader.spec().width != width() || reader.spec().height != height() ||
          reader.spec().nchannels != 3)
        output_.fail("it has another size");
      reader.read_bands<std::uint8_t>(
          OIIO::TypeDesc::UINT8,
          [&](int y0, int y1, const std::uint8_t* from) { read.add(text_of(from, y1 - y0)); });
    } catch (const Error& e) {
      if (e.kind() != ErrorKind::input) throw;
      output_.fail(e.found());
    }
    if (read.digits() != written_.digits())
      output_.fail("it reads back differently from what was written");
    output_.prepare();
  }
  void replace() override { output_.commit(); }

  void check(bool ok) const {
    if (const std::string message = file_->geterror(); !ok || !message.empty())
      output_.fail(message);
  }
  std::size_t row_bytes() const { return static_cast<std::size_t>(width()) * 3; }
  std::string_view text_of(const std::uint8_t* first, int rows) const {
    return {reinterpret_cast<const char*>(first), row_bytes() * static_cast<std::size_t>(rows)};
  }

  OutputFile output_;
  std::unique_ptr<OIIO::ImageOutput> file_;
  OIIO::ImageSpec spec_;
  std::vector<std::uint8_t> band_;
  int rows_ = 0;         // that were written; the file is open from the first on
  ContentHash written_;  // of the values, row by row
};

}  // namespace

std::unique_ptr<PictureRows> open_png8(const std::string& path, int width, int height,
                                       const PictureFileOptions& options) {
  load_oiio();
  return std::make_unique<PngRows>(path, width, height, options);
}

double png8_writer_bytes(int width, int) {
  constexpr double libraries = 4.0 * 1024 * 1024;
  return 3.0 * 2 * band_rows * width + libraries;  // a band for writing, another for reading back
}

void write_png8(const std::string& path, const Grid<glm::vec3>& encoded,
                const PictureFileOptions& options) {
  write_whole(*open_png8(path, encoded.width(), encoded.height(), options), encoded);
}

void write_jpeg(const std::string& path, const Grid<glm::vec3>& encoded, int quality) {
  load_oiio();
  OutputFile file(path);
  const auto output = OIIO::ImageOutput::create("jpeg");
  if (output == nullptr) throw Error(ErrorKind::bug, path, "OpenImageIO cannot write JPEG");
  OIIO::ImageSpec spec(encoded.width(), encoded.height(), 3, OIIO::TypeDesc::UINT8);
  spec.attribute("Compression", "jpeg:" + std::to_string(quality));
  std::vector<std::uint8_t> bytes;
  bytes.reserve(3 * encoded.size());
  for (const glm::vec3& pixel : encoded)
    for (int c = 0; c < 3; ++c)
      bytes.push_back(static_cast<std::uint8_t>(std::clamp(pixel[c], 0.0F, 1.0F) * 255.0F + 0.5F));
  const bool written = output->open(file.temporary(), spec) &&
                       output->write_image(OIIO::TypeDesc::UINT8, bytes.data()) && output->close();
  if (!written) file.fail(output->geterror());
  file.commit();
}

}  // namespace belvedere
