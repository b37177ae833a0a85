// OpenImageIO brings 150 further libraries (OpenVDB, OpenCV, FFmpeg), whose relocation takes .2 s
// of every start of the program; many runs need none of its functions. So the program is not linked
// with it (CMake: BELVEDERE_LATE_OIIO): each of its functions that oiio_file.cpp calls is a jump to
// an address which load_oiio() looks up.
#include "renderer/image/oiio_file.h"

#ifdef BELVEDERE_LATE_OIIO

#include <dlfcn.h>

#include <array>
#include <cstddef>
#include <string>

#include "base/error.h"

// The linker names what is missing here.
#define OIIO_FUNCTIONS(F)                                                                         \
  F("_ZN16OpenImageIO_v2_410ImageInput6createENS_17basic_string_viewIcSt11char_traitsIcEEEb"      \
    "PKNS_9ImageSpecEPNS_10Filesystem7IOProxyES4_")                                               \
  F("_ZN16OpenImageIO_v2_410ParamValue11clear_valueEv")                                           \
  F("_ZN16OpenImageIO_v2_410ParamValue12init_noclearENS_7ustringENS_8TypeDescEiNS0_6InterpEPKv"   \
    "NS0_4CopyENS0_11FromUstringE")                                                               \
  F("_ZN16OpenImageIO_v2_410ParamValueaSERKS0_")                                                  \
  F("_ZN16OpenImageIO_v2_411ImageOutput6createENS_17basic_string_viewIcSt11char_traitsIcEEE"      \
    "PNS_10Filesystem7IOProxyES4_")                                                               \
  F("_ZN16OpenImageIO_v2_49ImageSpec9attributeENS_17basic_string_viewIcSt11char_traitsIcEEE"      \
    "NS_8TypeDescEPKv")                                                                           \
  F("_ZN16OpenImageIO_v2_49ImageSpec9attributeENS_17basic_string_viewIcSt11char_traitsIcEEES4_")  \
  F("_ZN16OpenImageIO_v2_49ImageSpecC1ENS_8TypeDescE")                                            \
  F("_ZN16OpenImageIO_v2_49ImageSpecC1EiiiNS_8TypeDescE")                                         \
  F("_ZNK16OpenImageIO_v2_410ImageInput8geterrorB5cxx11Eb")                                       \
  F("_ZNK16OpenImageIO_v2_411ImageOutput8geterrorB5cxx11Eb")                                      \
  F("_ZNK16OpenImageIO_v2_48TypeDesc8basesizeEv")                                                 \
  F("_ZNK16OpenImageIO_v2_49ImageSpec11image_bytesEb")                                            \
  F("_ZNK16OpenImageIO_v2_49ImageSpec14find_attributeENS_17basic_string_viewIcSt11char_traitsIc"  \
    "EEENS_8TypeDescEb")                                                                          \
  F("_ZNK16OpenImageIO_v2_49ImageSpec17get_int_attributeENS_17basic_string_viewIcSt11char_traits" \
    "IcEEEi")                                                                                     \
  F("_ZNK16OpenImageIO_v2_49ImageSpec19get_float_attributeENS_17basic_string_viewIcSt11char_"     \
    "traitsIcEEEf")                                                                               \
  F("_ZNK16OpenImageIO_v2_49ImageSpec20get_string_attributeENS_17basic_string_viewIcSt11char_"    \
    "traitsIcEEES4_")

#define OIIO_NAME(name) name,
#define OIIO_JUMP(name) "late " name "\n"

namespace {
constexpr std::array names = {OIIO_FUNCTIONS(OIIO_NAME)};
}

extern "C" {
// The addresses, in the order of the names.
__attribute__((visibility("hidden"))) void* belvedere_oiio[std::size(names)] = {};
}

// x86-64: arguments pass through unchanged.
asm(R"(
  .text
  .set late_index, 0
  .macro late name
  .globl \name
  .hidden \name
  .type \name, @function
\name:
  jmp *belvedere_oiio + 8 * late_index(%rip)
  .set late_index, late_index + 1
  .endm
)" OIIO_FUNCTIONS(OIIO_JUMP));

namespace belvedere {

void load_oiio() {
  static const bool loaded = [] {
    void* const library = dlopen(BELVEDERE_LATE_OIIO, RTLD_NOW | RTLD_LOCAL);
    for (std::size_t i = 0; i < names.size(); ++i) {
      belvedere_oiio[i] = library == nullptr ? nullptr : dlsym(library, names[i]);
      if (belvedere_oiio[i] != nullptr) continue;
      const char* why = dlerror();
      throw Error(ErrorKind::limit, "OpenImageIO",
                  "it cannot be loaded: " + std::string(why == nullptr ? "unknown reason" : why),
                  std::string("an installed ") + BELVEDERE_LATE_OIIO);
    }
    return true;
  }();
  static_cast<void>(loaded);
}

}  // namespace belvedere

#else

void belvedere::load_oiio() {}

#endif
