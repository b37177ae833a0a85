#include "renderer/image/jxl_file.h"

// The one file that uses libjxl.
#include <jxl/decode.h>
#include <jxl/encode.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <new>
#include <vector>

#include "base/error.h"
#include "base/files/output_file.h"
#include "base/parallel.h"
#include "renderer/image/exif.h"
#include "renderer/image/provenance.h"

namespace belvedere {
namespace {

using Bytes = std::vector<std::uint8_t>;

// 1 packs fastest, 9 smallest. Measured on a panorama: 4 takes thrice the time of 3 for 2 % less, 7
// five times for 3 %.
constexpr int effort = 3;
// Measured: the maximum memory per pixel while the library packs or unpacks, including our own
// values.
constexpr double packing_bytes_per_pixel = 90.0;
constexpr double reading_bytes_per_pixel = 50.0;

// Runs the library's loops on the project's threads. Each worker is one of the library's "threads",
// whose memory it requests beforehand; therefore their number is limited.
JxlParallelRetCode run_parallel(void*, void* job, JxlParallelRunInit init,
                                JxlParallelRunFunction work, std::uint32_t begin,
                                std::uint32_t end) {
  constexpr std::uint32_t max_workers = 16;
  const std::uint32_t workers = std::min(max_workers, end - begin);
  if (const JxlParallelRetCode code = init(job, workers); code != 0) return code;
  std::atomic<std::uint32_t> next{begin};
  parallel_rows(static_cast<int>(workers), [&](int worker) {
    for (std::uint32_t i = next++; i < end; i = next++)
      work(job, i, static_cast<std::size_t>(worker));
  });
  return 0;
}

struct FreeEncoder {
  void operator()(JxlEncoder* encoder) const { JxlEncoderDestroy(encoder); }
};
struct FreeDecoder {
  void operator()(JxlDecoder* decoder) const { JxlDecoderDestroy(decoder); }
};

constexpr std::size_t exif_head = 4;  // an Exif box begins with the offset of its bytes, 0

Bytes exif_box(const PictureFileOptions& options) {
  const Bytes exif = write_exif({image_io::join_notes(options.notes),
                                 "Belvedere " + program_version(), options.dots_per_inch});
  Bytes box(exif_head, 0);
  box.insert(box.end(), exif.begin(), exif.end());
  return box;
}

Bytes read_file(const std::string& path) {
  std::error_code code;
  const std::uintmax_t size = std::filesystem::file_size(path, code);
  if (code) throw Error(ErrorKind::input, path, "cannot be opened: " + code.message());
  image_io::check_memory(path, 1, 1, static_cast<double>(size));
  Bytes bytes(size);
  std::ifstream file(path, std::ios::binary);
  if (!file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size)))
    throw Error(ErrorKind::input, path, "cannot be read to its end");
  return bytes;
}

// One JPEG XL file in the decoder.
class JxlReader {
 public:
  // Up to the pixels, or without pixels to the end of the file.
  JxlReader(const std::string& path, bool pixels)
      : path_(path), pixels_(pixels), bytes_(read_file(path)), decoder_(JxlDecoderCreate(nullptr)) {
    if (decoder_ == nullptr) throw std::bad_alloc();
    JxlDecoderSetParallelRunner(decoder_.get(), &run_parallel, nullptr);
    const int events = JXL_DEC_BASIC_INFO | JXL_DEC_COLOR_ENCODING | JXL_DEC_BOX |
                       (pixels ? JXL_DEC_FULL_IMAGE : 0);
    const bool ok =
        JxlDecoderSubscribeEvents(decoder_.get(), events) == JXL_DEC_SUCCESS &&
        JxlDecoderSetDecompressBoxes(decoder_.get(), JXL_TRUE) == JXL_DEC_SUCCESS &&
        JxlDecoderSetUnpremultiplyAlpha(decoder_.get(), JXL_TRUE) == JXL_DEC_SUCCESS &&
        JxlDecoderSetInput(decoder_.get(), bytes_.data(), bytes_.size()) == JXL_DEC_SUCCESS;
    if (!ok) throw Error(ErrorKind::bug, path, "the JPEG XL library cannot be used");
    // The input is not closed, although it is complete: with a truncated file the decoder then asks
    // for more instead of printing a message.
    run();
  }

  const JxlBasicInfo& info() const { return info_; }
  const Bytes& icc() const { return icc_; }
  Bytes exif() const {
    return exif_.size() > exif_head ? Bytes(exif_.begin() + exif_head, exif_.end()) : Bytes();
  }

  // The colours, three values per pixel, and the alpha if the file has one and `alpha` is not null.
  template <class T>
  void read(JxlDataType type, T* colours, T* alpha) {
    const std::size_t pixels = static_cast<std::size_t>(info_.xsize) * info_.ysize;
    const JxlPixelFormat three{3, type, JXL_NATIVE_ENDIAN, 0};
    const JxlPixelFormat one{1, type, JXL_NATIVE_ENDIAN, 0};
    bool ok = JxlDecoderSetImageOutBuffer(decoder_.get(), &three, colours,
                                          pixels * 3 * sizeof(T)) == JXL_DEC_SUCCESS;
    for (std::uint32_t i = 0; ok && alpha != nullptr && i < info_.num_extra_channels; ++i) {
      JxlExtraChannelInfo channel{};
      if (JxlDecoderGetExtraChannelInfo(decoder_.get(), i, &channel) != JXL_DEC_SUCCESS ||
          channel.type != JXL_CHANNEL_ALPHA)
        continue;
      ok = JxlDecoderSetExtraChannelBuffer(decoder_.get(), &one, alpha, pixels * sizeof(T), i) ==
           JXL_DEC_SUCCESS;
      break;
    }
    if (!ok || JxlDecoderProcessInput(decoder_.get()) != JXL_DEC_FULL_IMAGE)
      image_io::throw_damaged(path_, "");
  }

 private:
  void run() {
    for (;;) {
      const JxlDecoderStatus status = JxlDecoderProcessInput(decoder_.get());
      // An Exif box is read in pieces, and is complete when the next event comes.
      if (status == JXL_DEC_BOX_NEED_MORE_OUTPUT) {
        const std::size_t rest = JxlDecoderReleaseBoxBuffer(decoder_.get());
        give_box_buffer(exif_.size() - rest);
        continue;
      }
      finish_box();
      if (status == JXL_DEC_BASIC_INFO) {
        if (JxlDecoderGetBasicInfo(decoder_.get(), &info_) != JXL_DEC_SUCCESS)
          image_io::throw_damaged(path_, "");
        image_io::check_memory(path_, info_.xsize, info_.ysize,
                               pixels_ ? reading_bytes_per_pixel * info_.xsize * info_.ysize : 0.0);
      } else if (status == JXL_DEC_COLOR_ENCODING) {
        read_profile();
      } else if (status == JXL_DEC_BOX) {
        JxlBoxType type{};
        if (JxlDecoderGetBoxType(decoder_.get(), type, JXL_TRUE) == JXL_DEC_SUCCESS &&
            std::memcmp(type, "Exif", 4) == 0 && exif_.empty()) {
          in_box_ = true;
          give_box_buffer(0);
        }
      } else if (pixels_ ? status == JXL_DEC_NEED_IMAGE_OUT_BUFFER
                         : status == JXL_DEC_SUCCESS || status == JXL_DEC_NEED_MORE_INPUT) {
        if (info_.xsize == 0) image_io::throw_damaged(path_, "");
        return;
      } else {
        image_io::throw_damaged(path_, "");
      }
    }
  }
  void give_box_buffer(std::size_t filled) {
    constexpr std::size_t piece = 65536;
    constexpr std::size_t largest = std::size_t{64} << 20;
    if (filled > largest) image_io::throw_damaged(path_, "an Exif box of more than 64 MiB");
    exif_.resize(filled + piece);
    JxlDecoderSetBoxBuffer(decoder_.get(), exif_.data() + filled, piece);
  }
  void finish_box() {
    if (!in_box_) return;
    in_box_ = false;
    exif_.resize(exif_.size() - JxlDecoderReleaseBoxBuffer(decoder_.get()));
  }
  // Until libjxl 0.9 its functions of profiles take a pixel format as well, which they ignore.
  template <class Function, class... More>
  bool has_profile(Function* get, More... more) {
#if JPEGXL_NUMERIC_VERSION < JPEGXL_COMPUTE_NUMERIC_VERSION(0, 9, 0)
    return get(decoder_.get(), nullptr, JXL_COLOR_PROFILE_TARGET_ORIGINAL, more...) ==
           JXL_DEC_SUCCESS;
#else
    return get(decoder_.get(), JXL_COLOR_PROFILE_TARGET_ORIGINAL, more...) == JXL_DEC_SUCCESS;
#endif
  }
  void read_profile() {
    std::size_t size = 0;
    if (!has_profile(JxlDecoderGetICCProfileSize, &size)) return;
    icc_.resize(size);
    if (!has_profile(JxlDecoderGetColorAsICCProfile, icc_.data(), size)) icc_.clear();
    // For colours that the file specifies by name, the library creates a profile.
    if (has_profile(JxlDecoderGetColorAsEncodedProfile, nullptr)) icc_.clear();
  }

  std::string path_;
  bool pixels_;
  Bytes bytes_;
  std::unique_ptr<JxlDecoder, FreeDecoder> decoder_;
  JxlBasicInfo info_{};
  Bytes icc_;
  Bytes exif_;
  bool in_box_ = false;
};

// Packs the picture; throws through `output` with the failed step.
Bytes pack(const OutputFile& output, const std::vector<std::uint16_t>& numbers, int width,
           int height, const PictureFileOptions& options) {
  const std::unique_ptr<JxlEncoder, FreeEncoder> encoder(JxlEncoderCreate(nullptr));
  if (encoder == nullptr) throw std::bad_alloc();
  JxlEncoder* e = encoder.get();
  const auto check = [&](JxlEncoderStatus status, const char* step) {
    if (status != JXL_ENC_SUCCESS) output.fail(std::string("the JPEG XL library refuses ") + step);
  };
  check(JxlEncoderSetParallelRunner(e, &run_parallel, nullptr), "its threads");
  check(JxlEncoderUseContainer(e, JXL_TRUE), "a container");
  check(JxlEncoderUseBoxes(e), "boxes");
  JxlBasicInfo info;
  JxlEncoderInitBasicInfo(&info);
  info.xsize = static_cast<std::uint32_t>(width);
  info.ysize = static_cast<std::uint32_t>(height);
  info.bits_per_sample = 16;
  info.uses_original_profile = JXL_TRUE;  // else colours would be converted
  check(JxlEncoderSetBasicInfo(e, &info), "the size");
  check(JxlEncoderSetCodestreamLevel(e, 10),
        "16 bits");  // the level that has 16-bit numbers without loss
  if (options.icc_profile.empty()) {
    JxlColorEncoding srgb;
    JxlColorEncodingSetToSRGB(&srgb, JXL_FALSE);
    check(JxlEncoderSetColorEncoding(e, &srgb), "sRGB");
  } else {
    // The library prints messages about invalid profiles; data with the signature of a profile
    // (ICC.1, 7.2.11) it accepts.
    const bool marked = options.icc_profile.size() >= 128 &&
                        std::memcmp(options.icc_profile.data() + 36, "acsp", 4) == 0;
    check(marked ? JXL_ENC_SUCCESS : JXL_ENC_ERROR, "the colour profile");
    check(JxlEncoderSetICCProfile(e, options.icc_profile.data(), options.icc_profile.size()),
          "the colour profile");
  }
  // Before the pixels, so that readers of the header need not unpack them.
  const Bytes exif = exif_box(options);
  const JxlBoxType type = {'E', 'x', 'i', 'f'};
  check(JxlEncoderAddBox(e, type, exif.data(), exif.size(), JXL_FALSE), "the notes");
  JxlEncoderCloseBoxes(e);
  JxlEncoderFrameSettings* settings = JxlEncoderFrameSettingsCreate(e, nullptr);
  check(JxlEncoderSetFrameLossless(settings, JXL_TRUE), "to keep every value");
  check(JxlEncoderFrameSettingsSetOption(settings, JXL_ENC_FRAME_SETTING_EFFORT, effort),
        "its effort");
  const JxlPixelFormat format{3, JXL_TYPE_UINT16, JXL_NATIVE_ENDIAN, 0};
  check(JxlEncoderAddImageFrame(settings, &format, numbers.data(), numbers.size() * 2),
        "the pixels");
  JxlEncoderCloseInput(e);
  Bytes packed(std::max<std::size_t>(numbers.size() / 2, 65536));
  for (std::size_t at = 0;;) {
    std::uint8_t* next = packed.data() + at;
    std::size_t room = packed.size() - at;
    const JxlEncoderStatus status = JxlEncoderProcessOutput(e, &next, &room);
    at = packed.size() - room;
    if (status == JXL_ENC_NEED_MORE_OUTPUT) {
      packed.resize(packed.size() * 2);
      continue;
    }
    check(status, "to pack the pixels");
    packed.resize(at);
    return packed;
  }
}

// The library of Debian 12 takes a picture whole and packs it at the end, so all of it is one band.
class JxlRows : public PictureRows {
 public:
  JxlRows(const std::string& path, int width, int height, const PictureFileOptions& options)
      : PictureRows(path, width, height, height), output_(path), options_(options) {
    numbers_.resize(row_values() * static_cast<std::size_t>(height));
  }

 private:
  void take(const Grid<glm::vec3>& from, int first, int rows, int at) override {
    image_io::quantize_rows(from, first, rows, width(),
                            numbers_.data() + row_values() * static_cast<std::size_t>(at));
  }
  void write_band(int, int) override {
    const Bytes packed = pack(output_, numbers_, width(), height(), options_);
    std::ofstream file(output_.temporary(), std::ios::binary);
    file.write(reinterpret_cast<const char*>(packed.data()),
               static_cast<std::streamsize>(packed.size()));
    file.close();
    if (!file) output_.fail({});
  }
  void complete() override {
    const std::string written = hash_numbers();
    try {
      JxlReader reader(output_.temporary(), true);
      if (reader.info().xsize * std::size_t{3} * reader.info().ysize != numbers_.size())
        output_.fail("it has another size");
      std::fill(numbers_.begin(), numbers_.end(),
                std::uint16_t{0});  // the memory is reused, so that there is no second picture
      reader.read<std::uint16_t>(JXL_TYPE_UINT16, numbers_.data(), nullptr);
    } catch (const Error& e) {
      if (e.kind() != ErrorKind::input) throw;
      output_.fail(e.found());
    }
    if (hash_numbers() != written) output_.fail("it reads back differently from what was written");
    numbers_ = {};
    output_.prepare();
  }
  void replace() override { output_.commit(); }

  std::string hash_numbers() const {
    return hash_bytes(
        {reinterpret_cast<const char*>(numbers_.data()), numbers_.size() * sizeof(std::uint16_t)});
  }
  std::size_t row_values() const { return static_cast<std::size_t>(width()) * 3; }

  OutputFile output_;
  PictureFileOptions options_;
  std::vector<std::uint16_t> numbers_;
};

}  // namespace

double jxl16_writer_bytes(int width, int height) {
  return packing_bytes_per_pixel * width * height;
}

std::unique_ptr<PictureRows> open_jxl16(const std::string& path, int width, int height,
                                        const PictureFileOptions& options) {
  if (width > 0 && height > 0)
    image_io::check_memory(path, width, height, jxl16_writer_bytes(width, height));
  return std::make_unique<JxlRows>(path, width, height, options);
}

ImageInfo read_jxl_info(const std::string& path) {
  const JxlReader reader(path, false);
  ImageInfo info;
  info.format = "jpegxl";
  info.width = static_cast<int>(reader.info().xsize);
  info.height = static_cast<int>(reader.info().ysize);
  const bool floating = reader.info().exponent_bits_per_sample > 0;
  const std::uint32_t bits = reader.info().bits_per_sample;
  const ChannelType type = floating ? (bits <= 16 ? ChannelType::half : ChannelType::float32)
                                    : (bits <= 8    ? ChannelType::uint8
                                       : bits <= 16 ? ChannelType::uint16
                                                    : ChannelType::float32);
  PartSpec part;
  const std::vector<const char*> names =
      reader.info().num_color_channels == 1 ? std::vector{"Y"} : std::vector{"R", "G", "B"};
  for (const char* name : names) part.channels.push_back({name, type});
  if (reader.info().alpha_bits > 0) part.channels.push_back({"A", type});
  info.parts.push_back(std::move(part));
  const ExifTags exif = read_exif(reader.exif());
  info.notes = image_io::split_notes(exif.description);
  if (!exif.software.empty()) info.notes.emplace("Software", exif.software);
  info.dots_per_inch = exif.dots_per_inch;
  info.icc_profile = reader.icc();
  return info;
}

Grid<glm::vec3> read_jxl_picture(const std::string& path, Grid<float>* alpha) {
  JxlReader reader(path, true);
  Grid<glm::vec3> picture(static_cast<int>(reader.info().xsize),
                          static_cast<int>(reader.info().ysize));
  Grid<float> own;
  Grid<float>& opacity = alpha != nullptr ? *alpha : own;
  if (alpha != nullptr || reader.info().alpha_bits > 0)
    opacity = Grid<float>(picture.width(), picture.height(), 1.0F);
  static_assert(sizeof(glm::vec3) == 3 * sizeof(float));
  reader.read<float>(JXL_TYPE_FLOAT, &picture.data()->x,
                     opacity.empty() ? nullptr : opacity.data());
  image_io::blacken_transparent(picture, opacity);
  return picture;
}

}  // namespace belvedere
