#include "tools/studio/http_server.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "base/config.h"
#include "base/error.h"
#include "tests/files.h"
#include "tests/tools/studio/connection.h"

namespace belvedere::tools {
namespace {

using namespace std::chrono_literals;
using test::ask_port;
using test::Connection;
using test::http_request;
using test::Reply;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const std::string good_token = "0123456789abcdef0123456789abcdef";

// A server that runs while the object lives.
class Running {
 public:
  explicit Running(std::function<HttpAnswer(const HttpRequest&)> answer,
                   std::uint64_t max_body_bytes = 1000)
      : server_({.port = 0, .token = good_token, .max_body_bytes = max_body_bytes},
                [this, answer = std::move(answer)](const HttpRequest& request) {
                  ++answered;
                  return answer(request);
                }),
        thread_([this] { server_.run(); }) {}
  ~Running() {
    server_.stop();
    thread_.join();
  }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

  int port() const { return server_.port(); }
  HttpServer& server() { return server_; }
  Reply get(const std::string& path) const {
    return ask_port(port(), http_request("GET", "/" + good_token + "/" + path, port()));
  }
  std::atomic<int> answered = 0;

 private:
  HttpServer server_;
  std::thread thread_;
};

// Every request as text.
HttpAnswer echo(const HttpRequest& request) {
  std::string text = request.method + " " + request.path;
  for (const auto& [name, value] : request.query) text += " " + name + "=" + value;
  return {.type = "text/plain", .body = text + " " + request.body, .headers = {{"X-Own", "yes"}}};
}

TEST(HttpServer, PassesOnWhatLiesBelowItsToken) {
  const Running running(echo);
  const Reply reply = running.get("api/picture?rung=2&name=a%20b%2Fc");
  EXPECT_EQ(reply.status, 200);
  EXPECT_EQ(reply.body, "GET api/picture name=a b/c rung=2 ");
  EXPECT_THAT(reply.head, AllOf(HasSubstr("X-Own: yes"), HasSubstr("Content-Type: text/plain"),
                                HasSubstr("Cache-Control: no-store"), HasSubstr("nosniff"),
                                HasSubstr("frame-ancestors 'none'"), HasSubstr("no-referrer")));
  EXPECT_EQ(running.get("").body, "GET  ");
  const int port = running.port();
  EXPECT_EQ(
      ask_port(port, http_request("POST", "/" + good_token + "/api/set", port, "{\"a\": 1}")).body,
      "POST api/set {\"a\": 1}");
}

TEST(HttpServer, ItsAddressIsOfThisMachine) {
  const HttpServer server({.port = 0, .token = good_token}, echo);
  EXPECT_GT(server.port(), 0);
  EXPECT_EQ(server.address(),
            "http://127.0.0.1:" + std::to_string(server.port()) + "/" + good_token + "/");
}

TEST(HttpServer, AnswersNothingWithoutTheToken) {
  const Running running(echo);
  const int port = running.port();
  for (const std::string path :
       {"/", "/api/scene", "/0123456789abcdef0123456789abcdee/api/scene", "/0123/api/scene",
        "/0123456789abcdef0123456789abcdef", "//0123456789abcdef0123456789abcdef/api/scene",
        "/x/../0123456789abcdef0123456789abcdef/api/scene",
        "/?/0123456789abcdef0123456789abcdef/api/scene"})
    for (const char* method : {"GET", "POST"})
      EXPECT_EQ(ask_port(port, http_request(method, path, port)).status, 403) << path;
  EXPECT_EQ(running.answered, 0);
}

TEST(HttpServer, AnswersNothingToOtherHostsAndOrigins) {
  const Running running(echo);
  const std::string port = std::to_string(running.port());
  const auto status = [&](const std::string& lines) {
    return ask_port(running.port(), "GET /" + good_token + "/api/scene HTTP/1.1\r\n" + lines +
                                        "Connection: close\r\n\r\n")
        .status;
  };
  const std::string here = "Host: 127.0.0.1:" + port + "\r\n";
  for (const std::string& lines : {
           std::string(),  // no host
           std::string("Host: example.org\r\n"),
           "Host: example.org:" + port + "\r\n",
           std::string("Host: 127.0.0.1\r\n"),
           std::string("Host: 127.0.0.1:1\r\n"),
           "Host: 127.0.0.1.example.org:" + port + "\r\n",
           here + "Origin: http://example.org\r\n",
           here + "Origin: https://127.0.0.1:" + port + "\r\n",
           here + "Origin: http://localhost:" + port + "\r\n",
           here + "Origin: http://127.0.0.1:1\r\n",
           here + "Origin: null\r\n",
       })
    EXPECT_EQ(status(lines), 403) << lines;
  EXPECT_EQ(running.answered, 0);
  EXPECT_EQ(status(here), 200);
  EXPECT_EQ(status(here + "Origin: http://127.0.0.1:" + port + "\r\n"), 200);
  EXPECT_EQ(status("Host: localhost:" + port + "\r\nOrigin: http://localhost:" + port + "\r\n"),
            200);
}

TEST(HttpServer, OtherMethodsAreNotPassedOn) {
  const Running running(echo);
  const int port = running.port();
  for (const char* method : {"PUT", "DELETE", "OPTIONS", "PATCH", "TRACE", "BREW"})
    EXPECT_EQ(ask_port(port, http_request(method, "/" + good_token + "/api/scene", port)).status,
              std::string(method) == "BREW" ? 400 : 405)
        << method;
  EXPECT_EQ(running.answered, 0);
}

TEST(HttpServer, WhatIsNoRequestDoesNoHarm) {
  const Running running(echo);
  for (const std::string& bytes :
       {std::string("\r\n\r\n"), std::string("GET\r\n\r\n"), std::string(100000, 'a'),
        "GET /" + std::string(100000, 'a') + " HTTP/1.1\r\n\r\n", std::string(64, '\0'),
        std::string("GET / HTTP/9.9\r\nHost\r\n\r\n"),
        std::string("\x16\x03\x01\x02\x00\x01", 6)}) {
    Connection connection(running.port(), 1);
    connection.send(bytes);
    connection.end();
  }
  EXPECT_EQ(running.answered, 0);
  EXPECT_EQ(running.get("api/scene").status, 200);
}

TEST(HttpServer, RefusesTooLargeBodies) {
  const Running running(echo, 1000);
  const int port = running.port();
  const std::string path = "/" + good_token + "/api/files";
  EXPECT_EQ(ask_port(port, http_request("POST", path, port, std::string(1000, 'x'))).status, 200);
  EXPECT_EQ(running.answered, 1);
  EXPECT_EQ(ask_port(port, http_request("POST", path, port, std::string(1001, 'x'))).status, 413);
  EXPECT_EQ(running.answered, 1);
}

// Their size would be known only once they are in memory.
TEST(HttpServer, RefusesBodiesOfUnknownSize) {
  const Running running(echo, 1000);
  const std::string head = "POST /" + good_token + "/api/files HTTP/1.1\r\nHost: 127.0.0.1:" +
                           std::to_string(running.port()) + "\r\nConnection: close\r\n";
  const auto status = [&](const std::string& rest) {
    return ask_port(running.port(), head + rest).status;
  };
  EXPECT_EQ(status("Transfer-Encoding: chunked\r\n\r\n2\r\nab\r\n0\r\n\r\n"), 411);
  EXPECT_EQ(status("Content-Length: 2\r\nContent-Encoding: gzip\r\n\r\nab"), 415);
  EXPECT_EQ(status("\r\n"), 411);
  EXPECT_EQ(running.answered, 0);
}

TEST(HttpServer, ErrorsOfTheProgramTellNoDetails) {
  const Running running([](const HttpRequest&) -> HttpAnswer {
    throw std::runtime_error("the password is swordfish");
  });
  const Reply reply = running.get("api/scene");
  EXPECT_EQ(reply.status, 500);
  EXPECT_THAT(reply.body, AllOf(HasSubstr("\"error\""), Not(HasSubstr("swordfish"))));
}

// ---- streams

TEST(HttpServer, PartsOfAStreamArriveAsTheyAreSent) {
  std::mutex mutex;
  std::condition_variable changed;
  bool seen = false;
  const Running running([&](const HttpRequest&) {
    HttpAnswer answer{.type = "application/octet-stream"};
    answer.stream = [&](const SendPart& send) {
      EXPECT_TRUE(send("first"));
      std::unique_lock lock(mutex);
      EXPECT_TRUE(changed.wait_for(lock, 10s, [&] { return seen; })) << "it waits for the rest";
      EXPECT_TRUE(send(std::string(200000, 'x') + "last"));
    };
    return answer;
  });
  const Connection connection(running.port());
  connection.send(http_request("GET", "/" + good_token + "/api/tiles", running.port()));
  const std::string begin = connection.read("first");
  EXPECT_THAT(begin, AllOf(HasSubstr("Transfer-Encoding: chunked"), HasSubstr("first")));
  {
    const std::lock_guard lock(mutex);
    seen = true;
  }
  changed.notify_all();
  const std::string rest = connection.read();
  EXPECT_EQ(std::count(rest.begin(), rest.end(), 'x'), 200000);
  EXPECT_THAT(rest, AllOf(HasSubstr("last"), testing::EndsWith("0\r\n\r\n")));
}

TEST(HttpServer, AStreamLearnsThatItsReaderIsGone) {
  std::atomic<bool> ended = false;
  const Running running([&](const HttpRequest& request) {
    if (request.path != "api/tiles") return echo(request);
    HttpAnswer answer{.type = "application/octet-stream"};
    answer.stream = [&](const SendPart& send) {
      const auto end = std::chrono::steady_clock::now() + 10s;
      while (std::chrono::steady_clock::now() < end && send(std::string(1000, 'x')))
        std::this_thread::sleep_for(1ms);
      ended = std::chrono::steady_clock::now() < end;
    };
    return answer;
  });
  {
    const Connection connection(running.port());
    connection.send(http_request("GET", "/" + good_token + "/api/tiles", running.port()));
    connection.read("xxx");
  }
  for (int i = 0; i < 5000 && !ended; ++i) std::this_thread::sleep_for(1ms);
  EXPECT_TRUE(ended);
  EXPECT_EQ(running.get("api/scene").status, 200) << "others are answered";
}

// ---- many

// Every one of `count` connections that are open at once is answered.
void expect_answers(int count) {
  const Running running(echo);
  std::vector<std::unique_ptr<Connection>> all;
  for (int i = 0; i < count; ++i) {
    all.push_back(std::make_unique<Connection>(running.port(), 60));
    ASSERT_TRUE(all.back()->is_open()) << i;
    ASSERT_TRUE(all.back()->send(
        http_request("GET", "/" + good_token + "/number?i=" + std::to_string(i), running.port())));
  }
  for (int i = 0; i < count; ++i)
    EXPECT_THAT(all[static_cast<std::size_t>(i)]->read(),
                HasSubstr("GET number i=" + std::to_string(i) + " "));
  EXPECT_EQ(running.answered, count);
}

TEST(HttpServer, TwoHundredAtOnce) { expect_answers(200); }

TEST(HttpServerLong, AThousandAtOnce) { expect_answers(1000); }

// ---- ends

TEST(HttpServer, APortInUseIsAnError) {
  const HttpServer first({.port = 0, .token = good_token}, echo);
  const Error error = test::error_of(
      [&] { const HttpServer second({.port = first.port(), .token = good_token}, echo); });
  EXPECT_EQ(error.kind(), ErrorKind::usage);
  EXPECT_EQ(error.where(), "--port");
  EXPECT_THAT(error.found(), HasSubstr(std::to_string(first.port()) + " is in use"));
}

TEST(HttpServer, ItsPortIsFreeOnceItIsGone) {
  int port = 0;
  {
    const HttpServer server({.port = 0, .token = good_token}, echo);
    port = server.port();
  }
  EXPECT_FALSE(Connection(port).is_open());
  const HttpServer next({.port = port, .token = good_token}, echo);
  EXPECT_EQ(next.port(), port);
}

TEST(HttpServer, StopsWhileARequestIsOpen) {
  std::atomic<bool> streaming = false;
  std::atomic<bool> stopped = false;
  HttpServer server({.port = 0, .token = good_token}, [&](const HttpRequest&) {
    HttpAnswer answer{.type = "application/octet-stream"};
    answer.stream = [&](const SendPart& send) {
      while (!stopped && send("x")) {
        streaming = true;
        std::this_thread::sleep_for(1ms);
      }
    };
    return answer;
  });
  std::thread thread([&] { server.run(); });
  const Connection idle(server.port());
  const Connection reading(server.port());
  reading.send(http_request("GET", "/" + good_token + "/api/tiles", server.port()));
  for (int i = 0; i < 5000 && !streaming; ++i) std::this_thread::sleep_for(1ms);
  ASSERT_TRUE(streaming);
  const auto begin = std::chrono::steady_clock::now();
  stopped = true;  // as the studio cancels its pictures
  server.stop();
  thread.join();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, 8s) << "a connection that idles ends too";
  EXPECT_FALSE(Connection(server.port()).is_open());
}

TEST(HttpServer, StoppedBeforeItRunsItDoesNotRun) {
  HttpServer server({.port = 0, .token = good_token}, echo);
  server.stop();
  std::atomic<bool> ended = false;
  std::thread thread([&] {
    server.run();
    ended = true;
  });
  for (int i = 0; i < 2000 && !ended; ++i) std::this_thread::sleep_for(1ms);
  EXPECT_TRUE(ended);
  if (!ended) server.stop();
  thread.join();
}

TEST(HttpServer, TokensAreLongAndNeverTheSame) {
  const std::string one = random_token();
  EXPECT_EQ(one.size(), 32U);
  EXPECT_EQ(one.find_first_not_of("0123456789abcdef"), std::string::npos);
  EXPECT_NE(one, random_token());
}

// The TOML of one value.
std::string toml_of_json(const std::string& json) {
  const SetBody body = read_set_body(R"({"changes": [{"key": "a.b", "value": )" + json + "}]}");
  EXPECT_EQ(body.edits.size(), 1U);
  parse_config("v = " + body.edits[0].value.value_or(""), "value");
  return body.edits[0].value.value_or("");
}

TEST(RequestBody, ValuesOfEveryKindBecomeToml) {
  for (const auto& [json, toml] : std::initializer_list<std::pair<const char*, const char*>>{
           {"200", "200"},
           {"-3", "-3"},
           {"0.5", "0.5"},
           {"1.0", "1.0"},
           {"-1e-7", "-1e-07"},
           {"1e300", "1e+300"},
           {"9007199254740991", "9007199254740991"},
           {"true", "true"},
           {"false", "false"},
           {R"("summer")", R"("summer")"},
           {R"("")", R"("")"},
           {"\"Zürich \\u00e9\"", "\"Zürich é\""},
           {R"("a \"b\" \\ c\nd\te")", R"("a \"b\" \\ c\nd\te")"},
           {"\"\\u0001\"", "\"\\u0001\""},
           {"[]", "[]"},
           {"[1, 2.5, -3]", "[1, 2.5, -3]"},
           {R"([[1, 2], ["a"]])", R"([[1, 2], ["a"]])"},
           {R"({"rock": 2, "odd name": [1]})", R"({ "rock" = 2, "odd name" = [1] })"},
       })
    EXPECT_EQ(toml_of_json(json), toml);
  EXPECT_EQ(toml_of_json("{}"), "{  }");
}

TEST(RequestBody, ChangesAreEditsInTheirOrder) {
  const SetBody body = read_set_body(R"({"changes": [
    {"key": "sun.azimuth_deg", "value": 200},
    {"key": "sun.time", "remove": true},
    {"key": "deform.handles", "append": {"position": [1, 2], "radius_m": 3000}}],
    "step": "drag-7"})");
  ASSERT_EQ(body.edits.size(), 3U);
  EXPECT_EQ(body.step, "drag-7");
  EXPECT_EQ(body.edits[0].key, "sun.azimuth_deg");
  EXPECT_EQ(body.edits[0].value, "200");
  EXPECT_FALSE(body.edits[0].append);
  EXPECT_EQ(body.edits[1].key, "sun.time");
  EXPECT_FALSE(body.edits[1].value.has_value());
  EXPECT_TRUE(body.edits[2].append);
  EXPECT_EQ(body.edits[2].value, R"({ "position" = [1, 2], "radius_m" = 3000 })");
  EXPECT_EQ(read_set_body(R"({"changes": []})").edits.size(), 0U);
  EXPECT_EQ(read_set_body(R"({"changes": []})").step, "");
}

TEST(RequestBody, RefusesWhatItDoesNotUnderstand) {
  const std::string deep = R"({"changes": [{"key": "a", "value": )" + std::string(50000, '[') +
                           std::string(50000, ']') + "}]}";
  for (const std::string& body : {
           std::string("no JSON"),
           std::string("[1, 2]"),
           std::string("\"text\""),
           std::string("{"),
           std::string("{} {}"),
           std::string(R"({"changes": 1})"),
           std::string(R"({"changes": {"key": "a", "value": 1}})"),
           std::string(R"({"change": []})"),
           std::string(),
           std::string(R"({"changes": [1]})"),
           std::string(R"({"changes": [{"value": 1}]})"),
           std::string(R"({"changes": [{"key": 7, "value": 1}]})"),
           std::string(R"({"changes": [{"key": "a"}]})"),
           std::string(R"({"changes": [{"key": "a", "remove": false}]})"),
           std::string(R"({"changes": [{"key": "a", "value": null}]})"),
           std::string(R"({"changes": [{"key": "a", "value": [1, null]}]})"),
           std::string(R"({"changes": [{"key": "a", "append": null}]})"),
           std::string(R"({"changes": [], "step": 7})"),
           std::string("{\"changes\": [{\"key\": \"a\", \"value\": \"\xff\"}]}"),
           deep,
       }) {
    const Error error = test::error_of([&] { read_set_body(body); });
    EXPECT_EQ(error.kind(), ErrorKind::usage) << body.substr(0, 60);
    EXPECT_FALSE(error.allowed().empty());
  }
}

TEST(RequestBody, MembersThatAreTexts) {
  EXPECT_EQ(read_text_member(R"({"text": "a\nb"})", "text"), "a\nb");
  EXPECT_EQ(read_text_member("{}", "text", "none"), "none");
  EXPECT_EQ(read_text_member("", "text"), "") << "no body is an object without members";
  EXPECT_EQ(test::error_of([] { read_text_member(R"({"text": 1})", "text"); }).kind(),
            ErrorKind::usage);
}

TEST(RequestBody, MembersThatAreWholeNumbers) {
  EXPECT_EQ(read_number_member(R"({"width": 2400})", "width", 7), 2400);
  EXPECT_EQ(read_number_member("{}", "width", 7), 7);
  for (const char* body :
       {R"({"width": "2400"})", R"({"width": 2400.5})", R"({"width": null})",
        R"({"width": 4294967312})", R"({"width": -4294967280})", R"({"width": 1e99})"})
    EXPECT_THAT(test::error_of([&] { read_number_member(body, "width", 7); }).found(),
                HasSubstr("width"))
        << body;
}

TEST(RequestBody, PointsAndFlagsAreThereOrNot) {
  const std::string body = R"({"pixel": [1.5, -2], "sure": true, "one": [1], "text": "yes"})";
  EXPECT_EQ(read_point_member(body, "pixel"), glm::dvec2(1.5, -2.0));
  EXPECT_FALSE(read_point_member(body, "position"));
  EXPECT_EQ(read_flag_member(body, "sure"), true);
  EXPECT_FALSE(read_flag_member(body, "other"));
  for (const char* name : {"one", "sure", "text"})
    EXPECT_EQ(test::kind_of([&] { read_point_member(body, name); }), ErrorKind::usage) << name;
  for (const char* name : {"pixel", "text"})
    EXPECT_EQ(test::kind_of([&] { read_flag_member(body, name); }), ErrorKind::usage) << name;
}

TEST(PageAnswers, FilesComeFromTheFirstFolderThatHasThem) {
  EXPECT_THAT(page_file({"pick", "studio"}, "").body, HasSubstr("Pairs"));
  EXPECT_THAT(page_file({"studio", "pick"}, "index.html").body, HasSubstr("studio"));
  const HttpAnswer shared = page_file({"pick", "studio"}, "dom.js");
  EXPECT_EQ(shared.type, "text/javascript");
  EXPECT_THAT(shared.headers.at("Content-Security-Policy"), HasSubstr("script-src 'self'"));
  EXPECT_EQ(page_file({"pick"}, "dom.js").status, 404);
  EXPECT_EQ(page_file({"pick", "studio"}, "index.toml").status, 404);
}

TEST(PageAnswers, ErrorsHaveTheirStatus) {
  EXPECT_EQ(error_answer(Error(ErrorKind::usage, "x", "wrong", "right")).status, 422);
  EXPECT_EQ(error_answer(Error(ErrorKind::interrupted, "x", "superseded")).status, 409);
  EXPECT_EQ(error_answer(Error(ErrorKind::bug, "x", "impossible")).status, 500);
  EXPECT_THAT(error_answer(Error(ErrorKind::usage, "x", "wrong", "right")).body,
              HasSubstr("\"allowed\": \"right\""));
}

TEST(PageAnswers, APageIsLeftOnceItSaysSoAndNothingElseIsAsked) {
  PageVisits visits;
  EXPECT_FALSE(visits.is_left(0.0)) << "nobody has come yet";
  visits.asked({.method = "POST", .path = "api/close", .query = {}, .body = {}});
  EXPECT_TRUE(visits.is_left(0.0));
  EXPECT_FALSE(visits.is_left(60.0));
  visits.asked({.method = "GET", .path = "", .query = {}, .body = {}});
  EXPECT_FALSE(visits.is_left(0.0));
}

}  // namespace
}  // namespace belvedere::tools
