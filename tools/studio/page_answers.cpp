#include "tools/studio/page_answers.h"

#include <algorithm>
#include <chrono>
#include <string_view>
#include <utility>
#include <vector>

#include "base/text/embedded.h"
#include "tools/studio/answers.h"

namespace belvedere::tools {
namespace {

// What a page may load and run: only its own files.
constexpr const char* page_policy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self'; connect-src 'self'; "
    "base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

std::int64_t now_ms() {
  return std::chrono::duration_cast<std::chrono::milliseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

// Name without extension of a kind of file that pages have; empty: no such kind.
std::string stem_of_page_file(const std::string& path) {
  for (const std::string_view extension : {".html", ".css", ".js", ".svg"})
    if (path.ends_with(extension)) return path.substr(0, path.size() - extension.size());
  return {};
}

}  // namespace

HttpAnswer error_answer(const Error& error) {
  const int status = error.kind() == ErrorKind::interrupted ? 409
                     : error.kind() == ErrorKind::bug       ? 500
                                                            : 422;
  return json_answer(error_json(error), status);
}

std::string media_type(const std::string& path) {
  static constexpr std::pair<const char*, const char*> types[] = {
      {".html", "text/html; charset=utf-8"},
      {".css", "text/css"},
      {".js", "text/javascript"},
      {".svg", "image/svg+xml"},
      {".jpg", "image/jpeg"},
      {".png", "image/png"}};
  for (const auto& [extension, type] : types)
    if (path.ends_with(extension)) return type;
  return "application/octet-stream";
}

HttpAnswer page_file(std::initializer_list<const char*> folders, const std::string& name) {
  const std::string path = name.empty() ? "index.html" : name;
  const std::string stem = stem_of_page_file(path);
  for (const std::string folder : folders) {
    const std::vector<std::string> all = embedded_names(folder);
    if (stem.empty() || std::find(all.begin(), all.end(), stem) == all.end()) continue;
    return {.type = media_type(path),
            .body = std::string(embedded_file(folder + "/" + path)),
            .headers = {{"Content-Security-Policy", page_policy}}};
  }
  return not_found("page");
}

void PageVisits::asked(const HttpRequest& request) {
  closed_ms_ = request.path == "api/close" ? now_ms() : 0;
}

bool PageVisits::is_left(double wait_s) const {
  const std::int64_t closed_ms = closed_ms_;
  return closed_ms != 0 && static_cast<double>(now_ms() - closed_ms) >= 1e3 * wait_s;
}

}  // namespace belvedere::tools
