#include "tools/studio/http_server.h"

#include <fmt/format.h>
#include <httplib.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>
#include <utility>

#include "base/text/embedded.h"
#include "tools/studio/answers.h"

namespace belvedere::tools {
namespace {

constexpr std::size_t connections = 24;  // served at once; a page opens six
constexpr int waiting = 512;             // connections that wait for one of those
constexpr int silence_s = 5;             // a request that stops in its middle is given up
constexpr int idle_s = 1;                // a connection without requests is closed; so stop() waits

// The whole address must be right, so that a page of another site, or a name that was pointed at
// this machine, reaches nothing.
bool is_allowed(const httplib::Request& request, const std::string& token, int port) {
  const std::string here = fmt::format("127.0.0.1:{}", port);
  const std::string host = request.get_header_value("Host");
  if (host != here && host != fmt::format("localhost:{}", port)) return false;
  if (request.has_header("Origin") && request.get_header_value("Origin") != "http://" + host)
    return false;
  return request.path.starts_with("/" + token + "/");
}

// The status of a request that is refused before its body is read, whose size must be known; 0:
// none.
int refused(const httplib::Request& request) {
  if (request.method != "GET" && request.method != "POST") return 405;
  if (request.has_header("Content-Encoding")) return 415;
  const bool sized = request.has_header("Content-Length");
  return request.has_header("Transfer-Encoding") || (request.method == "POST" && !sized) ? 411 : 0;
}

}  // namespace

std::string HttpRequest::value(const std::string& name) const {
  const auto found = query.find(name);
  return found == query.end() ? "" : found->second;
}

struct HttpServer::State {
  httplib::Server server;
  std::string token;
  int port = 0;
  std::function<HttpAnswer(const HttpRequest&)> answer;
  // A server can be stopped only while it listens, which begins some time after run().
  std::atomic<bool> running = false;
  std::atomic<bool> stopped = false;
  std::atomic<bool> listened = false;
  socket_t socket = INVALID_SOCKET;

  void handle(const httplib::Request& request, httplib::Response& response) const {
    HttpRequest read{request.method, request.path.substr(token.size() + 2), {}, request.body};
    for (const auto& [name, value] : request.params) read.query[name] = value;
    HttpAnswer made = answer(read);
    response.status = made.status;
    made.headers.try_emplace("Content-Security-Policy",
                             "default-src 'none'; frame-ancestors 'none'");
    for (const auto& [name, value] : made.headers) response.set_header(name, value);
    if (!made.stream) {
      // With a parameter the library does not compress JSON, which takes longer than sending it.
      if (made.type == json_type) made.type += "; charset=utf-8";
      response.set_content(std::move(made.body), made.type);
      return;
    }
    response.set_chunked_content_provider(
        made.type, [stream = std::move(made.stream)](std::size_t, httplib::DataSink& sink) {
          stream([&](std::string_view bytes) {
            return sink.is_writable() && sink.write(bytes.data(), bytes.size());
          });
          sink.done();
          return true;
        });
  }
};

HttpServer::HttpServer(const HttpParameters& parameters,
                       std::function<HttpAnswer(const HttpRequest&)> answer)
    : state_(std::make_unique<State>()) {
  State& state = *state_;
  state.token = parameters.token;
  state.answer = std::move(answer);
  httplib::Server& server = state.server;
  server.new_task_queue = [] { return new httplib::ThreadPool(connections); };
  server.set_payload_max_length(parameters.max_body_bytes);
  server.set_read_timeout(silence_s);
  server.set_keep_alive_timeout(idle_s);
  server.set_keep_alive_max_count(1000000);
  server.set_tcp_nodelay(true);
  server.set_default_headers({{"Cache-Control", "no-store"},
                              {"X-Content-Type-Options", "nosniff"},
                              {"Referrer-Policy", "no-referrer"},
                              {"Cross-Origin-Resource-Policy", "same-origin"}});
  server.set_pre_routing_handler([&state](const httplib::Request& request,
                                          httplib::Response& response) {
    const bool allowed = is_allowed(request, state.token, state.port);
    const int status = allowed ? refused(request) : 403;
    if (status == 0) return httplib::Server::HandlerResponse::Unhandled;
    response.status = status;
    response.set_content(allowed ? "not a request of the studio\n" : "not allowed\n", "text/plain");
    return httplib::Server::HandlerResponse::Handled;
  });
  server.set_exception_handler(
      [](const httplib::Request&, httplib::Response& response, const std::exception_ptr&) {
        response.status = 500;
        response.set_content("{\"error\": {\"message\": \"an error of the program\"}}",
                             "application/json");
      });
  const auto handle = [&state](const httplib::Request& request, httplib::Response& response) {
    state.handle(request, response);
  };
  server.Get(".*", handle);
  server.Post(".*", handle);
  // Without SO_REUSEPORT, which would let a second server share the port unnoticed.
  server.set_socket_options([&state](socket_t socket) {
    state.socket = socket;
    const int yes = 1;
    setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  state.port = parameters.port == 0
                   ? server.bind_to_any_port("127.0.0.1")
                   : (server.bind_to_port("127.0.0.1", parameters.port) ? parameters.port : -1);
  if (state.port <= 0)
    throw Error(ErrorKind::usage, "--port", fmt::format("{} is in use", parameters.port),
                "another port, or 0 for any that is free");
  // The library lets five wait; others would try again after seconds.
  listen(state.socket, waiting);
}

HttpServer::~HttpServer() {
  stop();
  if (!state_->listened) close(state_->socket);  // the library does not
}

int HttpServer::port() const { return state_->port; }

std::string HttpServer::address() const {
  return fmt::format("http://127.0.0.1:{}/{}/", state_->port, state_->token);
}

void HttpServer::run() {
  state_->running = true;
  if (!state_->stopped) {
    state_->listened = true;
    state_->server.listen_after_bind();
  }
  state_->running = false;
}

void HttpServer::stop() {
  state_->stopped = true;
  while (state_->running && !state_->server.is_running())
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  state_->server.stop();
}

std::string random_token() {
  std::random_device source;
  std::string token;
  for (int i = 0; i < 4; ++i) token += fmt::format("{:08x}", source());
  return token;
}

namespace {

using Value = nlohmann::ordered_json;  // as it was written

Error not_understood(const std::string& found) {
  return {ErrorKind::usage, "request", found, "JSON as in the documentation of the page"};
}

Value parse_body(const std::string& body) {
  if (body.empty()) return Value::object();
  Value value = Value::parse(body, nullptr, false);
  if (!value.is_object()) throw not_understood("the body is not a JSON object");
  return value;
}

constexpr int max_depth = 16;  // of lists in lists; scenes need 4

// JSON as TOML: only objects are written differently.
std::string toml_of(const Value& value, int depth = 0) {
  if (depth > max_depth) throw not_understood("a value is nested too deeply");
  if (value.is_null()) throw not_understood("null is no value of a scene");
  if (value.is_array()) {
    std::string list;
    for (const Value& element : value)
      list += (list.empty() ? "" : ", ") + toml_of(element, depth + 1);
    return "[" + list + "]";
  }
  if (value.is_object()) {
    std::string list;
    for (const auto& [name, member] : value.items())
      list += fmt::format("{}{} = {}", list.empty() ? "" : ", ", json_quoted(name),
                          toml_of(member, depth + 1));
    return "{ " + list + " }";
  }
  if (value.is_string()) return json_quoted(value.get<std::string>());
  return value.dump();
}

}  // namespace

SetBody read_set_body(const std::string& body) {
  const Value read = parse_body(body);
  const auto changes = read.find("changes");
  if (changes == read.end() || !changes->is_array()) throw not_understood("no list of changes");
  SetBody out;
  out.step = read_text_member(body, "step");
  for (const Value& change : *changes) {
    if (!change.is_object() || !change.contains("key") || !change["key"].is_string())
      throw not_understood("a change without a key");
    SceneEdit& edit = out.edits.emplace_back();
    edit.key = change["key"].get<std::string>();
    edit.append = change.contains("append");
    if (edit.append)
      edit.value = toml_of(change["append"]);
    else if (change.contains("value"))
      edit.value = toml_of(change["value"]);
    else if (change.value("remove", Value()) != true)
      throw not_understood(edit.key + " has neither value nor append nor remove");
  }
  return out;
}

std::string read_text_member(const std::string& body, const std::string& name,
                             const std::string& otherwise) {
  const Value read = parse_body(body);
  const auto member = read.find(name);
  if (member == read.end()) return otherwise;
  if (!member->is_string()) throw not_understood(name + " is not a text");
  return member->get<std::string>();
}

bool is_json(const std::string& text) { return Value::accept(text); }

std::string read_geojson_member(const std::string& body, const std::string& name) {
  const Value read = parse_body(body);
  const auto member = read.find(name);
  if (member == read.end() || member->is_null()) return {};
  const auto features = member->find("features");
  if (!member->is_object() || features == member->end() || !features->is_array())
    throw not_understood(name + " is no feature collection");
  if (features->empty()) return {};
  std::string out =
      "{\"type\": \"FeatureCollection\", " + std::string(drawn_mark) + ", \"features\": [\n";
  for (std::size_t i = 0; i < features->size(); ++i)
    out += (*features)[i].dump() + (i + 1 < features->size() ? ",\n" : "\n");
  return out + "]}\n";
}

int read_number_member(const std::string& body, const std::string& name, int otherwise) {
  const Value read = parse_body(body);
  const auto member = read.find(name);
  if (member == read.end()) return otherwise;
  if (!member->is_number_integer() || *member < std::numeric_limits<int>::min() ||
      *member > std::numeric_limits<int>::max())
    throw not_understood(name + " is not a whole number");
  return member->get<int>();
}

std::optional<glm::dvec2> read_point_member(const std::string& body, const std::string& name) {
  const Value read = parse_body(body);
  const auto member = read.find(name);
  if (member == read.end()) return std::nullopt;
  if (!member->is_array() || member->size() != 2 || !(*member)[0].is_number() ||
      !(*member)[1].is_number())
    throw not_understood(name + " is not a list of two numbers");
  return glm::dvec2((*member)[0].get<double>(), (*member)[1].get<double>());
}

std::optional<bool> read_flag_member(const std::string& body, const std::string& name) {
  const Value read = parse_body(body);
  const auto member = read.find(name);
  if (member == read.end()) return std::nullopt;
  if (!member->is_boolean()) throw not_understood(name + " is neither true nor false");
  return member->get<bool>();
}

namespace {

// Content security policy of pages: they load and run only their own files.
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
  closed_ms_ = request.path.ends_with("api/close") ? now_ms() : 0;
}

bool PageVisits::is_left(double wait_s) const {
  const std::int64_t closed_ms = closed_ms_;
  return closed_ms != 0 && static_cast<double>(now_ms() - closed_ms) >= 1e3 * wait_s;
}

}  // namespace belvedere::tools
