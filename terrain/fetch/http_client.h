#pragma once

#include <cstdint>
#include <string>

#include "base/progress.h"
#include "terrain/io/http_request.h"

namespace belvedere {

// How a service is asked: by one connection at a time, with pauses.
struct HttpManners {
  int connect_s = 15;     // s until a server must have taken the call; 1…3600
  int silence_s = 30;     // s that it may send next to nothing; 1…3600
  int answer_s = 600;     // s that one answer may take; 1…86400
  int retries = 5;        // times that what failed is asked again, unless something came of it; 0…20
  double wait_s = 1.0;    // s before the second try, twice as long before each further one, or as long as the server asks; 0…60
  double pause_s = 0.05;  // s between questions; 0…60
  std::string agent = "Belvedere (panorama maps)";  // who asks, as services want to know it: name and version
};

// Asks servers politely, and says in a user's words what went wrong.
class HttpClient {
 public:
  // Error(usage) where manners are out of range.
  HttpClient(const HttpManners& manners, Progress& progress);

  // The bytes of a file from `first` on, `count` of them (0: to the end), in one try. Error(interrupted) where the user stops.
  HttpAnswer ask(const std::string& address, std::uint64_t first, std::uint64_t count);
  // After an answer of which nothing can be used: waits for the next try, the attempt-th (from 1). Error(input) where there is none.
  void wait(const std::string& address, const HttpAnswer& answer, int attempt);
  // Where no answer is worth another try.
  [[noreturn]] void give_up(const std::string& address, const HttpAnswer& answer) const;

  // Questions asked, and bytes that came.
  std::uint64_t asked() const { return asked_; }
  std::uint64_t bytes() const { return bytes_; }

 private:
  void sleep(double seconds) const;

  HttpManners manners_;
  Progress& progress_;
  std::string reached_;  // the server that answered last: what it does not take later was cut, not absent
  std::uint64_t asked_ = 0;
  std::uint64_t bytes_ = 0;
};

}  // namespace belvedere
