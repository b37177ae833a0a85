#pragma once

#include <cstdint>
#include <string>

#include "base/progress.h"
#include "terrain/io/http_request.h"

namespace belvedere {

// Client options: one connection at a time, with pauses.
struct HttpOptions {
  int connect_s = 15;  // connection timeout, s; 1…3600
  int silence_s = 30;  // timeout without data, s; 1…3600
  int answer_s = 600;  // timeout for a whole response, s; 1…86400
  int retries = 5;     // retries of a request that made no progress; 0…20
  double wait_s =
      1.0;  // s before the second try, doubled before each further one, or as the server asks; 0…60
  double pause_s = 0.05;                            // s between requests; 0…60
  std::string agent = "Belvedere (panorama maps)";  // user agent: name and version
};

// HTTP client that retries politely and explains failures to users.
class HttpClient {
 public:
  // Error(usage) if options are out of range.
  HttpClient(const HttpOptions& http_options, Progress& progress);

  // The bytes of a file from `first` on, `count` of them (0: to the end), in one try.
  // Error(interrupted) if the user stops.
  HttpAnswer ask(const std::string& address, std::uint64_t first, std::uint64_t count);
  // After an unusable response: waits before the next try, number `attempt` (from 1). Error(input)
  // if there are none left.
  void wait(const std::string& address, const HttpAnswer& answer, int attempt);
  // For responses that are not worth another try.
  [[noreturn]] void give_up(const std::string& address, const HttpAnswer& answer) const;

  // Requests sent, and bytes received.
  std::uint64_t asked() const { return asked_; }
  std::uint64_t bytes() const { return bytes_; }

 private:
  void sleep(double seconds) const;

  HttpOptions http_options_;
  Progress& progress_;
  std::string reached_;  // the server of the last response: a later refusal by it is a lost
                         // connection, not an absent server
  std::uint64_t asked_ = 0;
  std::uint64_t bytes_ = 0;
};

}  // namespace belvedere
