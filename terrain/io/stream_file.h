#pragma once

#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <string>

namespace belvedere {

// Source of the bytes of a virtual file. `read` fills the requested range, which lies inside the
// file, or throws.
struct ByteSource {
  std::uint64_t bytes = 0;
  std::function<void(std::uint64_t offset, std::size_t count, char* to)> read;
};

// Registers such a file under a name by which its rasters can be opened (raster_io.h,
// raster_file.h) while it lives; only the needed parts are read. Private to terrain/. Not
// thread-safe.
class StreamFile {
 public:
  // name: name of the file, with its extension.
  StreamFile(const std::string& name, ByteSource source);
  ~StreamFile();
  StreamFile(const StreamFile&) = delete;
  StreamFile& operator=(const StreamFile&) = delete;

  const std::string& path() const;
  // The first exception of `read`. Raster readers cannot pass it on and report a damaged file
  // instead.
  void rethrow() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// Whether a path is the name of such a file.
bool is_stream(const std::string& path);

}  // namespace belvedere
