#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <string>
#include <vector>

#include "tests/paths.h"

namespace belvedere::test {

// Whether there is what HttpServer needs.
inline bool has_python() {
  static const bool has = std::system("python3 -c pass > /dev/null 2>&1") == 0;
  return has;
}

// tests/http_server.py: one process of all servers of a test program, which ends with it.
class HttpServers {
 public:
  // The answer to a line of words between tabs: a port; empty where there is none.
  static std::string ask(const std::string& line) {
    static HttpServers servers;
    const std::string all = line + "\n";
    if (servers.child_ <= 0 ||
        write(servers.to_, all.data(), all.size()) != static_cast<ssize_t>(all.size()))
      return {};
    std::string answer;
    for (char c = 0; read(servers.from_, &c, 1) == 1 && c != '\n';) answer += c;
    return answer;
  }
  ~HttpServers() {
    if (child_ <= 0) return;
    kill(child_, SIGKILL);
    waitpid(child_, nullptr, 0);
  }
  HttpServers(const HttpServers&) = delete;
  HttpServers& operator=(const HttpServers&) = delete;

 private:
  HttpServers() {
    std::array<int, 2> in{};
    std::array<int, 2> out{};
    if (pipe2(in.data(), O_CLOEXEC) != 0 || pipe2(out.data(), O_CLOEXEC) != 0) return;
    const std::string script = source_folder() + "/tests/http_server.py";
    child_ = fork();
    if (child_ == 0) {
      dup2(in[0], STDIN_FILENO);
      dup2(out[1], STDOUT_FILENO);
      execlp("python3", "python3", script.c_str(), static_cast<char*>(nullptr));
      _exit(127);
    }
    close(in[0]);
    close(out[1]);
    to_ = in[1];
    from_ = out[0];
  }
  pid_t child_ = -1;
  int to_ = -1;
  int from_ = -1;
};

// A server of a folder, which takes calls as long as the object is there. Modes as
// tests/http_server.py says.
class HttpServer {
 public:
  explicit HttpServer(const std::string& folder, const std::vector<std::string>& modes = {}) {
    std::string line = "start\t" + folder;
    for (const std::string& mode : modes) line += "\t" + mode;
    port_ = HttpServers::ask(line);
    EXPECT_FALSE(port_.empty()) << "the server did not start";
  }
  ~HttpServer() {
    if (!port_.empty()) HttpServers::ask("stop\t" + port_);
  }
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  std::string address(const std::string& file) const {
    return "http://127.0.0.1:" + port_ + "/" + file;
  }

 private:
  std::string port_;
};

}  // namespace belvedere::test
