#include "terrain/fetch/http_client.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <thread>

#include "base/error.h"

namespace belvedere {
namespace {

std::string server_of(const std::string& address) {
  const std::size_t from = address.find("//") + 2;
  return address.substr(from, address.find('/', from) - from);
}

std::string describe(const HttpAnswer& answer) {
  const std::string more = answer.reason.empty() ? "" : " (" + answer.reason + ")";
  switch (answer.outcome) {
    case HttpOutcome::missing:
    case HttpOutcome::refused:
      return fmt::format("the server answers {}", answer.status);
    case HttpOutcome::busy:
      return fmt::format("the server answers {}, that it cannot now", answer.status);
    case HttpOutcome::no_name:
      return "nobody knows the name of the server; is this machine offline?" + more;
    case HttpOutcome::no_connection:
      return "the server does not take calls; is there a network, a proxy, a firewall?" + more;
    case HttpOutcome::silent:
      return "the server is silent or too slow" + more;
    case HttpOutcome::cut:
      return "the connection was cut" + more;
    case HttpOutcome::good:
      return "the server sent other bytes than it was asked for";
    default:
      return "the server cannot be asked" + more;
  }
}

}  // namespace

HttpClient::HttpClient(const HttpManners& manners, Progress& progress) : manners_(manners), progress_(progress) {
  const auto hold = [](const char* what, double value, double least, double most) {
    if (!(value >= least && value <= most))
      throw Error(ErrorKind::usage, what, fmt::format("{}", value), fmt::format("{} … {}", least, most));
  };
  hold("seconds to connect", manners.connect_s, 1, 3600);
  hold("seconds of silence", manners.silence_s, 1, 3600);
  hold("seconds for an answer", manners.answer_s, 1, 86400);
  hold("retries", manners.retries, 0, 20);
  hold("seconds to wait", manners.wait_s, 0, 60);
  hold("seconds of pause", manners.pause_s, 0, 60);
}

// In short steps, so that the user may stop it.
void HttpClient::sleep(double seconds) const {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  for (;;) {
    progress_.advance(0.0);
    const auto now = Clock::now();
    if (now >= end) return;
    std::this_thread::sleep_for(std::min<Clock::duration>(end - now, std::chrono::milliseconds(100)));
  }
}

HttpAnswer HttpClient::ask(const std::string& address, std::uint64_t first, std::uint64_t count) {
  if (asked_ > 0) sleep(manners_.pause_s);
  ++asked_;
  std::exception_ptr stopped;
  HttpRequest request{.address = address,
                      .first = first,
                      .count = count,
                      .connect_s = manners_.connect_s,
                      .silence_s = manners_.silence_s,
                      .answer_s = manners_.answer_s,
                      .agent = manners_.agent};
  request.go_on = [&] {
    try {
      progress_.advance(0.0);
      return true;
    } catch (...) {  // nothing may pass through a library that is written in C
      stopped = std::current_exception();
      return false;
    }
  };
  HttpAnswer answer = ask_server(request);
  if (stopped) std::rethrow_exception(stopped);
  bytes_ += answer.bytes.size();
  if (answer.status != 0 || !answer.bytes.empty()) reached_ = server_of(address);
  return answer;
}

void HttpClient::wait(const std::string& address, const HttpAnswer& answer, int attempt) {
  const HttpOutcome outcome = answer.outcome;
  const bool was_there = reached_ == server_of(address);
  const bool unreachable = outcome == HttpOutcome::no_name || outcome == HttpOutcome::no_connection;
  const bool hopeless = outcome == HttpOutcome::missing || outcome == HttpOutcome::refused || outcome == HttpOutcome::failed ||
                        outcome == HttpOutcome::stopped || (unreachable && !was_there);
  if (hopeless || attempt > manners_.retries) give_up(address, answer);
  constexpr double longest_s = 120.0;
  double seconds = manners_.wait_s;
  for (int i = 1; i < attempt && seconds < longest_s; ++i) seconds *= 2.0;
  seconds = std::min(std::max(seconds, answer.retry_after_s), longest_s);
  progress_.note(fmt::format("{}: {}; asked again in {:.0f} s", address, describe(answer), seconds));
  sleep(seconds);
}

void HttpClient::give_up(const std::string& address, const HttpAnswer& answer) const {
  const bool unreachable = answer.outcome == HttpOutcome::no_name || answer.outcome == HttpOutcome::no_connection;
  throw Error(ErrorKind::input, unreachable ? server_of(address) : address, describe(answer),
              unreachable ? "a network, or a copy of the service: --mirror URL. What is in the cache needs neither"
                          : "once more, later: what came is kept and not asked for again");
}

}  // namespace belvedere
