#pragma once

#include <atomic>
#include <cstdint>
#include <initializer_list>
#include <string>

#include "base/error.h"
#include "base/text/json.h"
#include "tools/studio/http_server.h"

namespace belvedere::tools {

// What the servers of all pages answer alike.

inline HttpAnswer json_answer(const Json& json, int status = 200) {
  return {.status = status, .body = json.str() + "\n"};
}
inline HttpAnswer picture_answer(std::string bytes, const std::string& type) {
  return {.type = type, .body = std::move(bytes)};
}
inline HttpAnswer not_found(const std::string& what) {
  return {.status = 404, .type = "text/plain", .body = "no such " + what + "\n"};
}
// The error as JSON: status 409 for what is no longer wanted, 422 for what is refused.
HttpAnswer error_answer(const Error& error);

// "text/html; charset=utf-8", by the extension.
std::string media_type(const std::string& path);
// A file of a page from the first of these folders of data/ that has it, and what it may load: the
// page's own files alone. An empty name is index.html.
HttpAnswer page_file(std::initializer_list<const char*> folders, const std::string& name);

// Whether a page is still open, by what it asks.
class PageVisits {
 public:
  // Of every request. A page that is loaded again closes first.
  void asked(const HttpRequest& request);
  // Whether the page was closed so many seconds ago, and nothing else was asked for since.
  bool is_left(double wait_s) const;

 private:
  std::atomic<std::int64_t> closed_ms_ = 0;  // when the page said so; 0: it is open
};

}  // namespace belvedere::tools
