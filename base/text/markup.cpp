#include "base/text/markup.h"

namespace belvedere {

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
