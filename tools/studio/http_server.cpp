#include "tools/studio/http_server.h"

#include <fmt/format.h>
#include <httplib.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <random>
#include <thread>
#include <utility>

#include "base/error.h"

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

}  // namespace belvedere::tools
