// The one file that knows lcms2.
#include <lcms2.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <memory>
#include <new>
#include <system_error>

#include "base/error.h"
#include "base/parallel.h"
#include "renderer/image/color.h"

namespace belvedere {
namespace {

constexpr std::uintmax_t largest_profile_bytes = std::uintmax_t{64} << 20;

void keep_message(cmsContext context, cmsUInt32Number, const char* text) {
  if (auto* kept = static_cast<std::string*>(cmsGetContextUserData(context)); kept != nullptr && kept->empty()) *kept = text;
}

// A context of its own keeps messages apart from other threads.
class Context {
 public:
  Context() : context_(cmsCreateContext(nullptr, &message_)) {
    if (context_ == nullptr) throw std::bad_alloc();
    cmsSetLogErrorHandlerTHR(context_, keep_message);
  }
  ~Context() { cmsDeleteContext(context_); }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  operator cmsContext() const { return context_; }
  const std::string& message() const { return message_; }

 private:
  std::string message_;
  cmsContext context_;
};

struct CloseProfile {
  void operator()(void* profile) const { cmsCloseProfile(profile); }
};
using Profile = std::unique_ptr<void, CloseProfile>;

Profile open_profile(const Context& context, const std::vector<std::uint8_t>& bytes) {
  return Profile(cmsOpenProfileFromMemTHR(context, bytes.data(), static_cast<cmsUInt32Number>(bytes.size())));
}

std::vector<std::uint8_t> save_profile(const Profile& profile) {
  cmsUInt32Number size = 0;
  std::vector<std::uint8_t> bytes;
  if (cmsSaveProfileToMem(profile.get(), nullptr, &size) != 0) bytes.resize(size);
  if (size == 0 || cmsSaveProfileToMem(profile.get(), bytes.data(), &size) == 0) {
    throw Error(ErrorKind::bug, "sRGB profile", "lcms2 cannot make it");
  }
  return bytes;
}

void set_text(const Context& context, const Profile& profile, cmsTagSignature tag, const char* text) {
  const std::unique_ptr<cmsMLU, void (*)(cmsMLU*)> words(cmsMLUalloc(context, 1), cmsMLUfree);
  cmsMLUsetASCII(words.get(), "en", "US", text);
  cmsWriteTag(profile.get(), tag, words.get());
}

// Error(input) unless pictures can be converted to it.
void require_rgb(const std::string& where, const Context& context, const Profile& profile) {
  constexpr const char* allowed = "the ICC profile of an RGB monitor, printer or colour space";
  if (profile == nullptr) throw Error(ErrorKind::input, where, "is no ICC profile: " + context.message(), allowed);
  const cmsColorSpaceSignature space = cmsGetColorSpace(profile.get());
  if (space != cmsSigRgbData) {
    std::string name;
    for (int shift = 24; shift >= 0; shift -= 8) name += static_cast<char>(static_cast<std::uint32_t>(space) >> shift & 0x7f);
    throw Error(ErrorKind::input, where, "is a profile of colours in " + name, allowed);
  }
  const cmsProfileClassSignature kind = cmsGetDeviceClass(profile.get());
  const bool device = kind == cmsSigDisplayClass || kind == cmsSigOutputClass || kind == cmsSigColorSpaceClass || kind == cmsSigInputClass;
  if (!device || cmsIsIntentSupported(profile.get(), INTENT_PERCEPTUAL, LCMS_USED_AS_OUTPUT) == 0) {
    throw Error(ErrorKind::input, where, "is a profile that nothing can be converted to", allowed);
  }
}

}  // namespace

std::vector<std::uint8_t> srgb_profile() {
  const Context context;
  std::vector<std::uint8_t> bytes;
  {
    const Profile profile(cmsCreate_sRGBProfileTHR(context));
    if (profile == nullptr) throw std::bad_alloc();
    set_text(context, profile, cmsSigProfileDescriptionTag, "sRGB");
    set_text(context, profile, cmsSigCopyrightTag, "Public domain");
    bytes = save_profile(profile);
  }
  // lcms2 writes the present time; bytes 24 to 35 of the header hold it as six 16-bit numbers (ICC.1, 7.2.8). Here the date of the
  // standard.
  constexpr std::uint8_t date[12] = {0x07, 0xcf, 0, 10, 0, 18, 0, 0, 0, 0, 0, 0};  // 1999-10-18
  if (bytes.size() < 128) throw Error(ErrorKind::bug, "sRGB profile", "lcms2 made too short a profile");
  std::copy(std::begin(date), std::end(date), bytes.begin() + 24);
  const Profile dated = open_profile(context, bytes);
  if (dated == nullptr || cmsMD5computeID(dated.get()) == 0) throw Error(ErrorKind::bug, "sRGB profile", context.message());
  return save_profile(dated);
}

std::vector<std::uint8_t> read_icc_profile(const std::string& path) {
  std::error_code code;
  const std::uintmax_t size = std::filesystem::file_size(path, code);
  if (code) throw Error(ErrorKind::input, path, "this ICC profile cannot be opened: " + code.message());
  if (size > largest_profile_bytes) throw Error(ErrorKind::input, path, "is no ICC profile: it is too large", "up to 64 MiB");
  std::vector<std::uint8_t> bytes(size);
  std::ifstream file(path, std::ios::binary);
  if (!file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()))) {
    throw Error(ErrorKind::input, path, "this ICC profile cannot be read: " + std::generic_category().message(errno));
  }
  const Context context;
  const Profile profile = open_profile(context, bytes);
  require_rgb(path, context, profile);
  return bytes;
}

struct ProfileConversion::State {
  Context context;
  std::unique_ptr<void, void (*)(void*)> transform{nullptr, cmsDeleteTransform};
};

ProfileConversion::ProfileConversion(const std::vector<std::uint8_t>& profile) : state_(std::make_unique<State>()) {
  const Context& context = state_->context;
  // The saved profile and not lcms2's own in memory: its numbers are rounded as in files, so that sRGB to sRGB changes nothing.
  const std::vector<std::uint8_t> srgb = srgb_profile();
  const Profile from = open_profile(context, srgb);
  const Profile to = open_profile(context, profile);
  require_rgb("ICC profile", context, to);
  // Without the one-pixel cache a transform may be used by all threads at once.
  constexpr cmsUInt32Number flags = cmsFLAGS_BLACKPOINTCOMPENSATION | cmsFLAGS_NOCACHE | cmsFLAGS_NOOPTIMIZE;
  state_->transform.reset(cmsCreateTransformTHR(context, from.get(), TYPE_RGB_FLT, to.get(), TYPE_RGB_FLT, INTENT_PERCEPTUAL, flags));
  if (state_->transform == nullptr) throw Error(ErrorKind::input, "ICC profile", "cannot be used: " + context.message());
}
ProfileConversion::~ProfileConversion() = default;
ProfileConversion::ProfileConversion(ProfileConversion&&) noexcept = default;
ProfileConversion& ProfileConversion::operator=(ProfileConversion&&) noexcept = default;

Grid<glm::vec3> ProfileConversion::convert(const Grid<glm::vec3>& encoded_srgb) const {
  Grid<glm::vec3> out(encoded_srgb.width(), encoded_srgb.height());
  parallel_rows(out.height(), [&](int y) {
    glm::vec3* row = out.row(y);
    cmsDoTransform(state_->transform.get(), encoded_srgb.row(y), row, static_cast<cmsUInt32Number>(out.width()));
    for (int x = 0; x < out.width(); ++x) {
      for (int c = 0; c < 3; ++c) row[x][c] = std::clamp(row[x][c], 0.0f, 1.0f);
    }
  });
  return out;
}

Grid<glm::vec3> to_profile(const Grid<glm::vec3>& encoded_srgb, const std::vector<std::uint8_t>& profile) {
  return ProfileConversion(profile).convert(encoded_srgb);
}

}  // namespace belvedere
