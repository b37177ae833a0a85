#include "terrain/io/stream_file.h"

#include <cpl_vsi.h>
#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <string_view>
#include <utility>

namespace belvedere {
namespace {

struct Stream {
  std::string path;
  ByteSource source;
  std::exception_ptr failure;
};

constexpr std::string_view prefix = "/vsibelvedere/";

// Registered streams: the library opens "12/name.tif" of the path "/vsibelvedere/12/name.tif".
std::mutex streams_mutex;
std::map<std::string, Stream*, std::less<>>& streams() {
  static std::map<std::string, Stream*, std::less<>> all;
  return all;
}

// Position of one reader of a stream.
struct Cursor {
  Stream* stream;
  std::uint64_t at = 0;
  bool past_end = false;
};

Stream* find_stream(std::string_view name) {
  if (name.starts_with(prefix)) name.remove_prefix(prefix.size());
  const std::lock_guard lock(streams_mutex);
  const auto found = streams().find(name);
  return found == streams().end() ? nullptr : found->second;
}

int stat_stream(void*, const char* name, VSIStatBufL* out, int) {
  const Stream* stream = find_stream(name);
  if (stream == nullptr) return -1;
  *out = {};
  out->st_mode = S_IFREG;
  out->st_size = static_cast<decltype(out->st_size)>(stream->source.bytes);
  return 0;
}

void* open_stream(void*, const char* name, const char* access) {
  Stream* stream = find_stream(name);
  if (stream == nullptr || std::string_view(access).find_first_of("wa+") != std::string_view::npos)
    return nullptr;
  return std::make_unique<Cursor>(Cursor{stream}).release();
}

vsi_l_offset tell(void* file) { return static_cast<Cursor*>(file)->at; }

int seek(void* file, vsi_l_offset offset, int whence) {
  Cursor& cursor = *static_cast<Cursor*>(file);
  cursor.at = offset + (whence == SEEK_SET   ? 0
                        : whence == SEEK_CUR ? cursor.at
                                             : cursor.stream->source.bytes);
  cursor.past_end = false;
  return 0;
}

std::size_t read(void* file, void* to, std::size_t size, std::size_t count) {
  Cursor& cursor = *static_cast<Cursor*>(file);
  Stream& stream = *cursor.stream;
  const std::uint64_t left = cursor.at < stream.source.bytes ? stream.source.bytes - cursor.at : 0;
  const std::uint64_t wanted = static_cast<std::uint64_t>(size) * count;
  const std::uint64_t bytes = std::min(wanted, left);
  cursor.past_end = bytes < wanted;
  if (bytes == 0 || stream.failure) return 0;
  try {
    stream.source.read(cursor.at, static_cast<std::size_t>(bytes), static_cast<char*>(to));
  } catch (...) {  // no exception may pass through a C library
    stream.failure = std::current_exception();
    return 0;
  }
  cursor.at += bytes;
  return static_cast<std::size_t>(bytes / size);
}

int is_at_end(void* file) { return static_cast<Cursor*>(file)->past_end ? 1 : 0; }

int close(void* file) {
  const std::unique_ptr<Cursor> ends(static_cast<Cursor*>(file));
  return 0;
}

void install() {
  static std::once_flag installed;
  std::call_once(installed, [] {
    VSIFilesystemPluginCallbacksStruct* callbacks = VSIAllocFilesystemPluginCallbacksStruct();
    callbacks->stat = &stat_stream;
    callbacks->open = &open_stream;
    callbacks->tell = &tell;
    callbacks->seek = &seek;
    callbacks->read = &read;
    callbacks->eof = &is_at_end;
    callbacks->close = &close;
    VSIInstallPluginHandler(prefix.data(),
                            callbacks);  // the pointer is kept: it must be of a literal
    VSIFreeFilesystemPluginCallbacksStruct(callbacks);
  });
}

}  // namespace

struct StreamFile::State {
  Stream stream;
};

StreamFile::StreamFile(const std::string& name, ByteSource source)
    : state_(std::make_unique<State>()) {
  install();
  // A unique number, because libraries cache by name.
  static std::atomic<std::uint64_t> number = 0;
  const std::string key = fmt::format("{}/{}", number.fetch_add(1), name);
  state_->stream = {std::string(prefix) + key, std::move(source), nullptr};
  const std::lock_guard lock(streams_mutex);
  streams()[key] = &state_->stream;
}

StreamFile::~StreamFile() {
  const std::lock_guard lock(streams_mutex);
  streams().erase(state_->stream.path.substr(prefix.size()));
}

const std::string& StreamFile::path() const { return state_->stream.path; }

void StreamFile::rethrow() const {
  if (state_->stream.failure) std::rethrow_exception(state_->stream.failure);
}

bool is_stream(const std::string& path) { return std::string_view(path).starts_with(prefix); }

}  // namespace belvedere
