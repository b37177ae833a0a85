#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <initializer_list>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/text/json.h"
#include "renderer/scene/edit/scene_edit.h"

namespace belvedere::tools {

struct HttpRequest {
  std::string method;                        // GET or POST
  std::string path;                          // below the token, without it: "api/scene"
  std::map<std::string, std::string> query;  // decoded
  std::string body;

  // A value of the query; empty: not given.
  std::string value(const std::string& name) const;
};

// Sends a part of a streamed answer; false once the reader is gone.
using SendPart = std::function<bool(std::string_view bytes)>;

constexpr const char* json_type = "application/json";

struct HttpAnswer {
  int status = 200;
  std::string type = json_type;
  std::string body = {};
  std::map<std::string, std::string> headers = {};
  std::function<void(const SendPart& send)> stream = {};  // instead of a body
};

struct HttpParameters {
  int port = 0;                                // of 127.0.0.1; 0: any that is free
  std::string token;                           // first part of every address
  std::uint64_t max_body_bytes = 1ULL << 30U;  // larger requests are refused
};

// A server for programs of this machine alone: it listens on 127.0.0.1, and answers only requests
// whose address begins with the token, whose Host is this machine, and whose Origin, if they have
// one, is the server itself. Everything else gets status 403. The only code that uses cpp-httplib.
// `answer` is called from several threads; what it throws becomes status 500 without details.
class HttpServer {
 public:
  // Error(usage) where the port is in use.
  HttpServer(const HttpParameters& parameters,
             std::function<HttpAnswer(const HttpRequest&)> answer);
  ~HttpServer();
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  int port() const;
  // "http://127.0.0.1:PORT/TOKEN/"
  std::string address() const;
  // Answers until stop() is called, from another thread or by `answer`.
  void run();
  void stop();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// 32 hexadecimal digits from the system's source of randomness.
std::string random_token();

// Bodies of requests, which are JSON. The only code that reads it with nlohmann-json. Error(usage)
// for what is not JSON or lacks a member.

struct SetBody {
  std::vector<SceneEdit> edits;
  std::string step;
};
SetBody read_set_body(const std::string& body);
// A member that is a text, or a whole number; `otherwise` where there is none.
std::string read_text_member(const std::string& body, const std::string& name,
                             const std::string& otherwise = {});
bool is_json(const std::string& text);
// A member that is a GeoJSON feature collection, as text, one feature per line; empty for null and
// for one without features.
std::string read_geojson_member(const std::string& body, const std::string& name);
int read_number_member(const std::string& body, const std::string& name, int otherwise);
// A member that is a list of two numbers, or true or false; nothing where there is none.
std::optional<glm::dvec2> read_point_member(const std::string& body, const std::string& name);
std::optional<bool> read_flag_member(const std::string& body, const std::string& name);

// Answers that the servers of all pages share.

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
  // Records a request; to be called for every one. A page that is loaded again closes first.
  void asked(const HttpRequest& request);
  // Whether the page was closed so many seconds ago, and nothing else was asked for since.
  bool is_left(double wait_s) const;

 private:
  std::atomic<std::int64_t> closed_ms_ = 0;  // when the page said so; 0: it is open
};

}  // namespace belvedere::tools
