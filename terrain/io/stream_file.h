#pragma once

#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <string>

namespace belvedere {

// Where the bytes of a file come from that lies in no folder. `read` fills what is asked for, which lies inside, or throws.
struct ByteSource {
  std::uint64_t bytes = 0;
  std::function<void(std::uint64_t offset, std::size_t count, char* to)> read;
};

// Such a file under a name by which rasters of it can be opened (raster_io.h, raster_file.h) while it lives: only those parts are read that
// are needed. Private to terrain/. For one thread.
class StreamFile {
 public:
  // name: what the file is called, with its ending.
  StreamFile(const std::string& name, ByteSource source);
  ~StreamFile();
  StreamFile(const StreamFile&) = delete;
  StreamFile& operator=(const StreamFile&) = delete;

  const std::string& path() const;
  // What `read` threw first. Raster readers cannot let it through: they say that the file is damaged.
  void rethrow() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// Whether a path is the name of such a file.
bool is_stream(const std::string& path);

}  // namespace belvedere
