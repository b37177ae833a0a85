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
      return fmt::format("HTTP status {}", answer.status);
    case HttpOutcome::busy:
      return fmt::format("HTTP status {}: server temporarily unavailable", answer.status);
    case HttpOutcome::no_name:
      return "cannot resolve host; check that this machine is online" + more;
    case HttpOutcome::no_connection:
      return "connection refused; check network, proxy and firewall" + more;
    case HttpOutcome::silent:
      return "connection timed out" + more;
    case HttpOutcome::cut:
      return "connection closed before the end of the file" + more;
    case HttpOutcome::good:
      return "the server sent other bytes than requested";
    default:
      return "request failed" + more;
  }
}

}  // namespace

HttpClient::HttpClient(const HttpOptions& http_options, Progress& progress)
    : http_options_(http_options), progress_(progress) {
  const auto hold = [](const char* what, double value, double min, double max) {
    if (!(value >= min && value <= max))
      throw Error(ErrorKind::usage, what, fmt::format("{}", value),
                  fmt::format("{} … {}", min, max));
  };
  hold("connection timeout in seconds", http_options.connect_s, 1, 3600);
  hold("read timeout in seconds", http_options.silence_s, 1, 3600);
  hold("response timeout in seconds", http_options.answer_s, 1, 86400);
  hold("retries", http_options.retries, 0, 20);
  hold("retry delay in seconds", http_options.wait_s, 0, 60);
  hold("pause between requests in seconds", http_options.pause_s, 0, 60);
}

// In short steps, so that the user can interrupt it.
void HttpClient::sleep(double seconds) const {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                      std::chrono::duration<double>(seconds));
  for (;;) {
    progress_.advance(0.0);
    const auto now = Clock::now();
    if (now >= end) return;
    std::this_thread::sleep_for(
        std::min<Clock::duration>(end - now, std::chrono::milliseconds(100)));
  }
}

HttpAnswer HttpClient::ask(const std::string& address, std::uint64_t first, std::uint64_t count) {
  if (asked_ > 0) sleep(http_options_.pause_s);
  ++asked_;
  std::exception_ptr stopped;
  HttpRequest request{.address = address,
                      .first = first,
                      .count = count,
                      .connect_s = http_options_.connect_s,
                      .silence_s = http_options_.silence_s,
                      .answer_s = http_options_.answer_s,
                      .agent = http_options_.agent};
  request.go_on = [&] {
    try {
      progress_.advance(0.0);
      return true;
    } catch (...) {  // no exception may pass through a C library
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
  const bool hopeless = outcome == HttpOutcome::missing || outcome == HttpOutcome::refused ||
                        outcome == HttpOutcome::failed || outcome == HttpOutcome::stopped ||
                        (unreachable && !was_there);
  if (hopeless || attempt > http_options_.retries) give_up(address, answer);
  constexpr double longest_s = 120.0;
  double seconds = http_options_.wait_s;
  for (int i = 1; i < attempt && seconds < longest_s; ++i) seconds *= 2.0;
  seconds = std::min(std::max(seconds, answer.retry_after_s), longest_s);
  progress_.note(fmt::format("{}: {}; retrying in {:.0f} s", address, describe(answer), seconds));
  sleep(seconds);
}

void HttpClient::give_up(const std::string& address, const HttpAnswer& answer) const {
  const bool unreachable =
      answer.outcome == HttpOutcome::no_name || answer.outcome == HttpOutcome::no_connection;
  throw Error(ErrorKind::input, unreachable ? server_of(address) : address, describe(answer),
              unreachable ? "a network connection, or a mirror of the service (--mirror URL); "
                            "cached data need neither"
                          : "try again later; data received so far are cached");
}

}  // namespace belvedere
