#include "terrain/fetch/remote_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstring>
#include <span>

#include "base/cache/cache.h"
#include "base/error.h"

namespace belvedere {
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
