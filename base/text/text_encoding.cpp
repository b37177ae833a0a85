#include "base/text/text_encoding.h"

#include <fmt/core.h>
#include <iconv.h>

#include <cerrno>
#include <memory>
#include <type_traits>

#include "base/error.h"

namespace belvedere {
namespace {

struct CloseIconv {
  void operator()(void* converter) const { iconv_close(converter); }
};
using Converter = std::unique_ptr<std::remove_pointer_t<iconv_t>, CloseIconv>;

Converter converter_from(const std::string& encoding, const std::string& path) {
  iconv_t converter = iconv_open("UTF-8", encoding.c_str());
  if (converter == reinterpret_cast<iconv_t>(-1))
    throw Error(ErrorKind::usage, path, fmt::format("the encoding \"{}\" is not known", encoding),
                "such as UTF-8, ISO-8859-1, windows-1252 or windows-1251");
  return Converter(converter);
}

}  // namespace

void check_text_encoding(const std::string& encoding, const std::string& path) {
  converter_from(encoding, path);
}

std::string text_to_utf8(const std::string& text, const std::string& encoding,
                         const std::string& path) {
  const Converter converter = converter_from(encoding, path);
  std::string from = text;
  std::string to(4 * text.size() + 4, '\0');  // no letter takes more bytes
  char* in = from.data();
  char* out = to.data();
  std::size_t left = from.size();
  std::size_t room = to.size();
  if (iconv(converter.get(), &in, &left, &out, &room) == static_cast<std::size_t>(-1))
    throw Error(ErrorKind::input, path,
                fmt::format("byte {} is no text in {}", from.size() - left, encoding),
                "the encoding in which it was saved");
  to.resize(to.size() - room);
  return to;
}

}  // namespace belvedere
