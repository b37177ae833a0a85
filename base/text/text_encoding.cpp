#include "base/text/text_encoding.h"

#include <fmt/core.h>
#include <glib.h>
#include <iconv.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <type_traits>

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

std::string shell_word(const std::string& text) {
  return text.find(' ') == std::string::npos ? text : "'" + text + "'";
}

std::string advice_to_convert(const std::string& encoding, const std::string& name,
                              const std::string& or_else) {
  std::filesystem::path to(name);
  to.replace_filename(to.stem().string() + "_utf8" + to.extension().string());
  return fmt::format("text saved as UTF-8, for instance by `iconv -f {} -t UTF-8 {} > {}`{}",
                     encoding, shell_word(name), shell_word(to.string()),
                     or_else.empty() ? "" : ", or " + or_else);
}

// "UTF-16LE" … by the byte order mark, or by where zero bytes lie: most letters of a scene or table
// are ASCII, even in other scripts. Empty for other text.
std::string wide_encoding(std::string_view text) {
  using namespace std::string_view_literals;
  if (text.starts_with("\xff\xfe\0\0"sv)) return "UTF-32LE";
  if (text.starts_with("\0\0\xfe\xff"sv)) return "UTF-32BE";
  if (text.starts_with("\xff\xfe"sv)) return "UTF-16LE";
  if (text.starts_with("\xfe\xff"sv)) return "UTF-16BE";
  const std::string_view head = text.substr(0, 4096);
  std::array<std::size_t, 2> zeros{};
  for (std::size_t i = 0; i < head.size(); ++i) zeros[i % 2] += head[i] == '\0' ? 1 : 0;
  if (zeros[0] + zeros[1] <= head.size() / 8) return {};
  if (zeros[0] == 0) return "UTF-16LE";
  if (zeros[1] == 0) return "UTF-16BE";
  return {};
}

// The letter of a byte in Windows-1252, in quotes; empty where it has none.
std::string western_letter(char byte) {
  try {
    return "\"" + text_to_utf8({byte}, "WINDOWS-1252", "") + "\"";
  } catch (const Error&) {
    return {};
  }
}

// A name in the normal form of composed letters; empty if it is not UTF-8.
std::string normalized(const std::string& name, GNormalizeMode form) {
  const std::unique_ptr<char, void (*)(gpointer)> text(
      g_utf8_normalize(name.data(), static_cast<gssize>(name.size()), form), g_free);
  return text == nullptr ? std::string() : text.get();
}

}  // namespace

void refuse_wide_text(std::string_view beginning, const std::string& name,
                      const std::string& or_else, ErrorKind kind) {
  const std::string wide = wide_encoding(beginning);
  if (wide.empty()) return;
  const std::size_t zero = beginning.find('\0');
  const bool marked = beginning.find_first_of("\xff\xfe") < 4;
  throw Error(kind, name + ":1:1",
              marked ? fmt::format("the text is {}, as its byte order mark at byte 0 says", wide)
                     : fmt::format("the text is {}: byte {} is zero, and so on", wide, zero),
              advice_to_convert(wide, name, or_else));
}

std::string_view require_utf8(std::string_view text, const std::string& name,
                              const std::string& or_else, ErrorKind kind) {
  refuse_wide_text(text, name, or_else, kind);
  const char* stop = nullptr;
  if (g_utf8_validate_len(text.data(), text.size(), &stop) != 0) {
    constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
    if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
    return text;
  }
  const auto at = static_cast<std::size_t>(stop - text.data());
  const std::string_view before = text.substr(0, at);
  const std::string_view line = before.substr(before.rfind('\n') + 1);  // npos + 1 is 0
  const auto column = 1 + std::count_if(line.begin(), line.end(), [](char c) {
                        return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
                      });
  const std::string where =
      fmt::format("{}:{}:{}", name, 1 + std::count(before.begin(), before.end(), '\n'), column);
  const auto byte = static_cast<unsigned char>(text[at]);
  if (byte == 0)
    throw Error(kind, where, fmt::format("byte {} is zero: this is no text", at),
                "a text file in UTF-8");
  const std::string letter = western_letter(text[at]);
  throw Error(kind, where,
              fmt::format("the text is not UTF-8: byte {} is 0x{:02X}{}", at, byte,
                          letter.empty() ? "" : ", in Windows-1252 " + letter),
              advice_to_convert("WINDOWS-1252", name, or_else));
}

std::string folded_letters(const std::string& name) {
  const std::unique_ptr<char, void (*)(gpointer)> text(
      g_utf8_casefold(normalized(name, G_NORMALIZE_NFC).c_str(), -1), g_free);
  return normalized(text.get(), G_NORMALIZE_NFC);
}

bool same_letters(const std::string& a, const std::string& b) {
  return a == b || (normalized(a, G_NORMALIZE_NFC) == normalized(b, G_NORMALIZE_NFC) &&
                    !normalized(a, G_NORMALIZE_NFC).empty());
}

bool is_composed(const std::string& name) { return normalized(name, G_NORMALIZE_NFC) == name; }

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

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return text;
}

std::string lower_extension(const std::string& path) {
  return lower_case(std::filesystem::path(path).extension().string());
}

std::string grouped(std::size_t number) {
  std::string digits = fmt::format("{}", number);
  for (std::size_t i = digits.size(); i > 3; i -= 3) digits.insert(i - 3, " ");
  return digits;
}

namespace {

constexpr std::string_view digits =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

}  // namespace

std::string base64(std::string_view bytes) {
  std::string out;
  out.reserve(bytes.size() / 3 * 4 + 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = (group << 8) | (i + k < bytes.size() ? static_cast<std::uint8_t>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      out += i + k > bytes.size() ? '=' : digits[(group >> (18 - 6 * k)) & 63U];
  }
  return out;
}

std::optional<std::string> base64_bytes(std::string_view text) {
  if (text.size() % 4 != 0) return std::nullopt;
  const std::size_t padding = text.ends_with("==") ? 2 : text.ends_with('=') ? 1 : 0;
  std::string out;
  out.reserve(text.size() / 4 * 3);
  for (std::size_t i = 0; i < text.size(); i += 4) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const bool padded = i + k >= text.size() - padding;
      const std::size_t digit = padded ? 0 : digits.find(text[i + k]);
      if (digit == std::string_view::npos) return std::nullopt;
      group = (group << 6) | static_cast<std::uint32_t>(digit);
    }
    for (int shift = 16; shift >= 0; shift -= 8) out += static_cast<char>((group >> shift) & 255U);
  }
  for (std::size_t i = 0; i < padding; ++i) out.pop_back();
  if (base64(out) != text) return std::nullopt;  // bits beyond the last byte
  return out;
}

std::string on_one_line(std::string_view text) {
  std::string out;
  for (const char c : text)
    out += c == '\n' ? std::string("\\n") : std::string(c == '\\' ? 2 : 1, c);
  return out;
}

std::string from_one_line(std::string_view line) {
  std::string out;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '\\' && i + 1 < line.size())
      out += line[++i] == 'n' ? '\n' : line[i];
    else
      out += line[i];
  }
  return out;
}

std::string markup_text(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t' ? ' ' : c;
    }
  }
  return out;
}

std::string script_json(std::string_view json) {
  std::string out;
  for (const char c : json)  // a < occurs only in texts
    c == '<' ? out += "\\u003c" : out += c;
  return out;
}

std::string filled_page(std::string_view page, const std::map<std::string, std::string>& texts) {
  std::string out;
  for (std::size_t at = 0; at < page.size();) {
    const std::size_t end = page[at] == '{' ? page.find('}', at) : std::string_view::npos;
    const auto text = end == std::string_view::npos
                          ? texts.end()
                          : texts.find(std::string(page.substr(at + 1, end - at - 1)));
    if (text != texts.end()) {
      out += text->second;
      at = end + 1;
    } else {
      out += page[at++];
    }
  }
  return out;
}

}  // namespace belvedere
