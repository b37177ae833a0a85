#include "renderer/image/icc/lcms.h"

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <new>
#include <system_error>

#include "base/error.h"
#include "base/text/missing_file.h"

namespace belvedere::icc {
namespace {

constexpr std::uintmax_t largest_profile_bytes = std::uintmax_t{64} << 20;

void keep_message(cmsContext context, cmsUInt32Number, const char* text) {
  if (auto* kept = static_cast<std::string*>(cmsGetContextUserData(context));
      kept != nullptr && kept->empty())
    *kept = text;
}

std::vector<std::uint8_t> save_profile(const Profile& profile) {
  cmsUInt32Number size = 0;
  std::vector<std::uint8_t> bytes;
  if (cmsSaveProfileToMem(profile.get(), nullptr, &size) != 0) bytes.resize(size);
  if (size == 0 || cmsSaveProfileToMem(profile.get(), bytes.data(), &size) == 0)
    throw Error(ErrorKind::bug, "ICC profile", "lcms2 cannot make it");
  return bytes;
}

void set_text(const Context& context, const Profile& profile, cmsTagSignature tag,
              const char* text) {
  const std::unique_ptr<cmsMLU, void (*)(cmsMLU*)> words(cmsMLUalloc(context, 1), cmsMLUfree);
  cmsMLUsetASCII(words.get(), "en", "US", text);
  cmsWriteTag(profile.get(), tag, words.get());
}

// "RGB", "CMYK", "Lab" as profiles spell it; of a damaged file "?GB".
std::string space_name(std::uint32_t space) {
  std::string name;
  for (int shift = 24; shift >= 0; shift -= 8) {
    const std::uint32_t letter = space >> shift & 0xff;
    name += letter >= ' ' && letter <= '~' ? static_cast<char>(letter) : '?';
  }
  return name.substr(0, name.find_last_not_of(' ') + 1);
}

// Names of profile classes that pictures cannot be printed with.
const char* other_kind(std::uint32_t kind) {
  if (kind == cmsSigLinkClass) return "a device link, which joins two devices and is none itself";
  if (kind == cmsSigAbstractClass)
    return "an abstract profile, which changes colours and is of no device";
  if (kind == cmsSigNamedColorClass) return "a list of named colours";
  return nullptr;
}

}  // namespace

Context::Context() : context_(cmsCreateContext(nullptr, &message_)) {
  if (context_ == nullptr) throw std::bad_alloc();
  cmsSetLogErrorHandlerTHR(context_, keep_message);
}

Profile open_profile(const Context& context, const std::vector<std::uint8_t>& bytes) {
  return Profile(
      cmsOpenProfileFromMemTHR(context, bytes.data(), static_cast<cmsUInt32Number>(bytes.size())));
}

std::vector<std::uint8_t> save_dated(const Context& context, Profile profile, const char* name) {
  if (profile == nullptr) throw std::bad_alloc();
  set_text(context, profile, cmsSigProfileDescriptionTag, name);
  set_text(context, profile, cmsSigCopyrightTag, "Public domain");
  std::vector<std::uint8_t> bytes = save_profile(profile);
  profile.reset();
  // lcms2 writes the present time; bytes 24 to 35 of the header hold it as six 16-bit numbers
  // (ICC.1, 7.2.8). It is replaced by the date of the sRGB standard.
  constexpr std::uint8_t date[12] = {0x07, 0xcf, 0, 10, 0, 18, 0, 0, 0, 0, 0, 0};  // 1999-10-18
  if (bytes.size() < 128)
    throw Error(ErrorKind::bug, "ICC profile", "lcms2 made too short a profile");
  std::copy(std::begin(date), std::end(date), bytes.begin() + 24);
  const Profile dated = open_profile(context, bytes);
  if (dated == nullptr || cmsMD5computeID(dated.get()) == 0)
    throw Error(ErrorKind::bug, "ICC profile", context.message());
  return save_profile(dated);
}

std::string name_of(const Profile& profile) {
  std::string name(256, '\0');
  const cmsUInt32Number size =
      cmsGetProfileInfoASCII(profile.get(), cmsInfoDescription, "en", "US", name.data(),
                             static_cast<cmsUInt32Number>(name.size()));
  name.resize(std::min<std::size_t>(size, name.size()));
  name.resize(std::min(name.find('\0'), name.size()));
  return name.empty() ? "without a name" : name;
}

std::uint32_t class_of(const Profile& profile) {
  return static_cast<std::uint32_t>(cmsGetDeviceClass(profile.get()));
}

std::uint32_t colours_of(const Profile& profile) {
  return static_cast<std::uint32_t>(cmsGetColorSpace(profile.get()));
}

std::vector<std::uint8_t> read_profile_bytes(const std::string& path) {
  require_file(path, "an ICC profile (.icc)");
  std::error_code code;
  const std::uintmax_t size = std::filesystem::file_size(path, code);
  if (code)
    throw Error(ErrorKind::input, path, "this ICC profile cannot be opened: " + code.message());
  if (size > largest_profile_bytes)
    throw Error(ErrorKind::input, path, "is not an ICC profile: it is too large", "up to 64 MiB");
  std::vector<std::uint8_t> bytes(size);
  std::ifstream file(path, std::ios::binary);
  if (!file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size())))
    throw Error(ErrorKind::input, path,
                "this ICC profile cannot be read: " + std::generic_category().message(errno));
  return bytes;
}

void require_device(const std::string& where, const Context& context, const Profile& profile,
                    cmsColorSpaceSignature space, const char* allowed) {
  if (profile == nullptr)
    throw Error(ErrorKind::input, where, "is not an ICC profile: " + context.message(), allowed);
  const std::uint32_t kind = class_of(profile);
  if (const char* other = other_kind(kind))
    throw Error(ErrorKind::input, where, std::string("is ") + other, allowed);
  const std::uint32_t found = colours_of(profile);
  if (found != space)
    throw Error(ErrorKind::input, where, "is a profile of colours in " + space_name(found),
                allowed);
  const bool device = kind == cmsSigDisplayClass || kind == cmsSigOutputClass ||
                      kind == cmsSigColorSpaceClass || kind == cmsSigInputClass;
  if (!device || cmsIsIntentSupported(profile.get(), INTENT_PERCEPTUAL, LCMS_USED_AS_OUTPUT) == 0)
    throw Error(ErrorKind::input, where, "is a profile that nothing can be converted to", allowed);
}

static_assert(static_cast<int>(RenderingIntent::perceptual) == INTENT_PERCEPTUAL);
static_assert(static_cast<int>(RenderingIntent::relative) == INTENT_RELATIVE_COLORIMETRIC);
static_assert(static_cast<int>(RenderingIntent::saturation) == INTENT_SATURATION);
static_assert(static_cast<int>(RenderingIntent::absolute) == INTENT_ABSOLUTE_COLORIMETRIC);

Transform make_transform(const Context& context, const Profile& from, cmsUInt32Number from_type,
                         const Profile& to, cmsUInt32Number to_type,
                         const DeviceParameters& parameters) {
  // Without the one-pixel cache a transform may be used by all threads at once; lcms2's shortcuts
  // would round to 16 bits in between.
  const cmsUInt32Number flags = cmsFLAGS_NOCACHE | cmsFLAGS_NOOPTIMIZE |
                                (parameters.black_point ? cmsFLAGS_BLACKPOINTCOMPENSATION : 0U);
  Transform transform(cmsCreateTransformTHR(context, from.get(), from_type, to.get(), to_type,
                                            static_cast<cmsUInt32Number>(parameters.intent),
                                            flags));
  if (transform == nullptr)
    throw Error(ErrorKind::input, "ICC profile", "cannot be used: " + context.message());
  return transform;
}

}  // namespace belvedere::icc
