#include "terrain/fetch/remote_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <exception>
#include <span>
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

namespace {

constexpr const char* product = "fetched file";
constexpr std::uint64_t max_pieces_at_once = 8;
constexpr std::size_t max_held = 64;  // pieces in memory that are also in the cache

std::string file_of(const std::string& address) { return address.substr(address.rfind('/') + 1); }

std::span<const std::byte> as_bytes(std::string_view text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}

}  // namespace

CacheKey RemoteFile::about_key() const {
  return {product, file_of(address_), "about 1\n" + address_};
}

CacheKey RemoteFile::piece_key(std::uint64_t index) const {
  return {product, file_of(address_),
          fmt::format("piece 1\n{}\n{}\n{}\n{} of {}", address_, about_->bytes, about_->tag, index,
                      piece_bytes)};
}

std::uint64_t RemoteFile::piece_size(std::uint64_t index) const {
  return std::min(piece_bytes, about_->bytes - index * piece_bytes);
}

void RemoteFile::forget() {
  pieces_.clear();
  fetched_.clear();
  about_.reset();
  distrust_ = true;
}

// Pieces farthest from the current position are dropped first. Whole files are kept, because
// another request would transfer all of them.
void RemoteFile::make_room(std::uint64_t for_index) {
  if (!context_.cache.is_on() || only_whole_ || pieces_.size() < max_held) return;
  const std::uint64_t low = pieces_.begin()->first;
  const std::uint64_t high = pieces_.rbegin()->first;
  const auto from = [&](std::uint64_t index) {
    return index < for_index ? for_index - index : index - for_index;
  };
  pieces_.erase(from(low) >= from(high) ? low : high);
}

void RemoteFile::keep(std::uint64_t index, std::string_view bytes) {
  const std::span<const std::byte> payload = as_bytes(bytes);
  context_.cache.store(piece_key(index), payload, context_.progress);
  make_room(index);
  pieces_[index] = Bytes(payload.begin(), payload.end());
  fetched_.insert(index);
}

const Bytes* RemoteFile::held(std::uint64_t index) {
  if (const auto found = pieces_.find(index); found != pieces_.end()) return &found->second;
  if (distrust_ && !fetched_.contains(index)) return nullptr;
  std::optional<Bytes> kept = context_.cache.find(piece_key(index), context_.progress);
  if (!kept || kept->size() != piece_size(index)) return nullptr;
  make_room(index);
  return &(pieces_[index] = std::move(*kept));
}

// Whole pieces of a response; an incomplete one at its end is requested again.
void RemoteFile::take(const HttpAnswer& answer) {
  const std::uint64_t first = answer.is_part ? answer.first : 0;
  const std::string_view bytes = answer.bytes;
  if (!answer.is_part && about_->bytes > piece_bytes) only_whole_ = true;
  for (std::uint64_t index = (first + piece_bytes - 1) / piece_bytes;
       index * piece_bytes < about_->bytes; ++index) {
    const std::uint64_t from = index * piece_bytes - first;
    if (from + piece_size(index) > bytes.size()) return;
    keep(index, bytes.substr(from, piece_size(index)));
  }
}

// The first piece, whose response contains the properties of the file.
void RemoteFile::ask_about() {
  for (int attempt = 1;; ++attempt) {
    const HttpAnswer answer = context_.client.ask(address_, 0, piece_bytes);
    RemoteDescription found;
    found.asked_unix_s = context_.now_unix_s;
    if (answer.outcome == HttpOutcome::missing) {
      found.missing = true;
    } else if (answer.outcome == HttpOutcome::good && !answer.bytes.empty() && answer.first == 0 &&
               (answer.is_part
                    ? answer.total.has_value() &&
                          answer.bytes.size() == std::min(piece_bytes, *answer.total)
                    : answer.total.value_or(answer.bytes.size()) == answer.bytes.size())) {
      found.bytes = answer.is_part ? *answer.total : answer.bytes.size();
      found.tag = answer.tag;
    } else {
      context_.client.wait(address_, answer, attempt);
      continue;
    }
    about_ = found;
    ByteWriter writer;
    writer(found);
    context_.cache.store(about_key(), writer.parts(), context_.progress);
    if (!found.missing) take(answer);
    return;
  }
}

const RemoteDescription& RemoteFile::describe() {
  if (about_) return *about_;
  std::optional<RemoteDescription> kept;
  RemoteDescription found;
  if (context_.cache.read(
          about_key(), [&](ByteReader& bytes) { bytes(found); }, context_.progress))
    kept = found;
  const bool fresh = kept && context_.now_unix_s - kept->asked_unix_s < trusted_s &&
                     !context_.refresh && !distrust_;
  if (fresh) {
    about_ = kept;
    return *about_;
  }
  try {
    ask_about();
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::input || !kept || distrust_) {
      lost_ = error.kind() == ErrorKind::input;
      throw;
    }
    context_.progress.note(
        fmt::format("{}: {}; using cached properties", error.where(), error.found()));
    about_ = kept;
  }
  return *about_;
}

void RemoteFile::fetch(std::uint64_t first_piece, std::uint64_t count) {
  const std::uint64_t first = first_piece * piece_bytes;
  const std::uint64_t end = std::min(first + count * piece_bytes, about_->bytes);
  std::uint64_t next = first;
  for (int attempt = 1; next < end; ++attempt) {
    const HttpAnswer answer = context_.client.ask(address_, next, end - next);
    const bool usable = answer.outcome == HttpOutcome::good || answer.outcome == HttpOutcome::cut ||
                        answer.outcome == HttpOutcome::silent;
    const bool placed =
        usable && !answer.bytes.empty() && (!answer.is_part || answer.first == next);
    if (placed && answer.total &&
        (*answer.total != about_->bytes || (!answer.tag.empty() && answer.tag != about_->tag)))
      throw Error(ErrorKind::input, address_, "the file changed on the server during the download",
                  "try again");
    if (placed) take(answer);
    std::uint64_t whole = next;
    while (whole < end && held(whole / piece_bytes) != nullptr)
      whole = std::min(end, (whole / piece_bytes + 1) * piece_bytes);
    if (whole >= end) return;
    if (whole > next) attempt = 0;  // some progress
    next = whole;
    try {
      context_.client.wait(address_, answer, std::max(attempt, 1));
    } catch (const Error&) {
      lost_ = true;
      throw;
    }
  }
}

void RemoteFile::read(std::uint64_t offset, std::size_t count, char* to) {
  describe();
  const std::uint64_t end = offset + count;
  if (about_->missing || end > about_->bytes)
    throw Error(ErrorKind::bug, address_, "read beyond the end of the file");
  for (std::uint64_t index = offset / piece_bytes; index * piece_bytes < end; ++index) {
    const Bytes* piece = held(index);
    if (piece == nullptr) {
      // All following pieces that are needed and missing come in one response.
      std::uint64_t run = 1;
      while (run < max_pieces_at_once && (index + run) * piece_bytes < end &&
             held(index + run) == nullptr)
        ++run;
      fetch(index, run);
      piece = held(index);
      if (piece == nullptr) throw Error(ErrorKind::bug, address_, "a downloaded piece is missing");
    }
    const std::uint64_t begin = index * piece_bytes;
    const std::uint64_t from = std::max(offset, begin);
    const std::uint64_t until = std::min(end, begin + piece->size());
    std::memcpy(to + (from - offset), piece->data() + (from - begin), until - from);
  }
}

}  // namespace belvedere
