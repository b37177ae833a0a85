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
inline bool has_python() { return std::system("python3 -c pass > /dev/null 2>&1") == 0; }

// tests/http_server.py as a process of its own, which ends with the object. Modes as it says.
class HttpServer {
 public:
  explicit HttpServer(const std::string& folder, const std::vector<std::string>& modes = {}) {
    std::array<int, 2> ends{};
    if (pipe(ends.data()) != 0) return;
    const std::string script = source_folder() + "/tests/http_server.py";
    std::vector<std::string> words = {"python3", script, folder};
    words.insert(words.end(), modes.begin(), modes.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    child_ = fork();
    if (child_ == 0) {
      dup2(ends[1], STDOUT_FILENO);
      close(ends[0]);
      close(ends[1]);
      execvp(argv[0], argv.data());
      _exit(127);
    }
    close(ends[1]);
    for (char c = 0; read(ends[0], &c, 1) == 1 && c != '\n';) port_ += c;
    close(ends[0]);
    EXPECT_FALSE(port_.empty()) << "the server did not start";
  }
  ~HttpServer() {
    if (child_ <= 0) return;
    kill(child_, SIGKILL);
    waitpid(child_, nullptr, 0);
  }
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  std::string address(const std::string& file) const { return "http://127.0.0.1:" + port_ + "/" + file; }

 private:
  pid_t child_ = -1;
  std::string port_;
};

}  // namespace belvedere::test
