#include "renderer/sheet/work_folder.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <future>
#include <sstream>
#include <system_error>
#include <utility>

#include "base/error.h"
#include "base/text/text_encoding.h"
#include "renderer/image/provenance.h"

namespace belvedere {
namespace {

namespace fs = std::filesystem;

constexpr const char* identity_file = "job.txt";
constexpr const char* lock_file = "lock";

std::string read_text(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

// The names of the differing entries.
std::string differences(const JobIdentity& a, const JobIdentity& b) {
  std::string names;
  const auto add = [&](const std::string& name) { names += (names.empty() ? "" : ", ") + name; };
  for (const auto& [name, value] : a)
    if (const auto other = b.find(name); other == b.end() || other->second != value) add(name);
  for (const auto& [name, value] : b)
    if (a.find(name) == a.end()) add(name);
  return names;
}

void require_same(const std::string& folder, const JobIdentity& known, const JobIdentity& asked) {
  if (const std::string names = differences(known, asked); !names.empty())
    throw Error(ErrorKind::usage, folder,
                "the existing pieces are of another picture: " + names +
                    (names.find(',') == std::string::npos ? " differs" : " differ"),
                "the scene, inputs, program and settings that they were begun with, or a run "
                "without --resume");
}

// Does not wait. The file may have been removed by the run that held it: then a new one is made.
int take_lock(const std::string& folder, bool alone) {
  const std::string path = (fs::path(folder) / lock_file).string();
  for (;;) {
    const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (file < 0)
      throw Error(ErrorKind::output, folder,
                  "cannot create a file in this folder: " + std::generic_category().message(errno));
    if (::flock(file, (alone ? LOCK_EX : LOCK_SH) | LOCK_NB) != 0) {
      const int code = errno;
      ::close(file);
      if (code == EWOULDBLOCK)
        throw Error(ErrorKind::output, fs::path(folder).parent_path().string(),
                    "another run works in this folder",
                    "another --out, or wait until it has ended");
      return -1;  // a file system without locks
    }
    struct ::stat held {};
    struct ::stat named {};
    if (::fstat(file, &held) == 0 && ::stat(path.c_str(), &named) == 0 &&
        held.st_ino == named.st_ino)
      return file;
    ::close(file);
  }
}

void make_folder(const std::string& folder) {
  std::error_code code;
  fs::create_directories(folder, code);
  if (code) throw Error(ErrorKind::output, folder, "cannot create this folder: " + code.message());
}

void write_identity(const std::string& folder, const JobIdentity& identity) {
  const std::string path = (fs::path(folder) / identity_file).string();
  const std::string temporary = fmt::format("{}.{}.tmp", path, static_cast<long>(::getpid()));
  std::ofstream file(temporary, std::ios::binary);
  file << to_text(identity);
  file.close();
  std::error_code code;
  if (file) fs::rename(temporary, path, code);
  if (file && !code) return;
  std::error_code ignored;
  fs::remove(temporary, ignored);
  throw Error(ErrorKind::output, path,
              "cannot be written" + (code ? ": " + code.message() : std::string()),
              "free space on this disk");
}

void remove_all_but_lock(const std::string& folder) {
  std::error_code code;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, code))
    if (entry.path().filename() != lock_file) fs::remove_all(entry.path(), code);
}

// Whether there is something that a resumed run would not have to make again: more than headers.
bool holds_pieces(const std::string& folder) {
  std::error_code code;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, code)) {
    const fs::path name = entry.path().filename();
    if (name.extension() == ".piece" && !name.string().starts_with("notes")) return true;
  }
  return false;
}

}  // namespace

WorkFolder::WorkFolder(std::string folder, const JobIdentity& identity, WorkMode mode)
    : folder_(std::move(folder)), job_(hash_bytes(to_text(identity))) {
  const std::string known = (fs::path(folder_) / identity_file).string();
  if (mode == WorkMode::join) {
    if (!fs::exists(known))
      throw Error(ErrorKind::usage, folder_, "no work is planned in this folder",
                  "a folder made by belvedere plan");
    require_same(folder_, job_from_text(read_text(known)), identity);
    return;
  }
  make_folder(folder_);
  lock_ = take_lock(folder_, true);
  alone_ = true;
  try {
    if (mode == WorkMode::resume && fs::exists(known)) {
      require_same(folder_, job_from_text(read_text(known)), identity);
    } else {
      remove_all_but_lock(folder_);
      write_identity(folder_, identity);
    }
  } catch (...) {
    if (lock_ >= 0) ::close(lock_);
    throw;
  }
}

WorkFolder::~WorkFolder() {
  // A run without results leaves no folder.
  try {
    if (alone_ && !holds_pieces(folder_)) clear();
  } catch (const std::bad_alloc&) {  // it stays, and is begun again
  }
  if (lock_ >= 0) ::close(lock_);
}

std::string WorkFolder::path(const std::string& product, PixelRect rect) const {
  return (fs::path(folder_) / fmt::format("{}_{}_{}.piece", product, rect.x0, rect.y0)).string();
}

bool WorkFolder::has(const std::string& product, PixelRect rect) const {
  const std::string file = path(product, rect);
  if (!fs::exists(file)) return false;
  if (is_whole_piece(file, key(product, rect))) return true;
  std::error_code code;
  fs::remove(file, code);
  return false;
}

void WorkFolder::keep(const std::string& product, PixelRect rect, const Planes& planes) const {
  write_piece(path(product, rect), key(product, rect), planes);
}

void WorkFolder::keep_bytes(const std::string& product, const std::string& bytes) const {
  std::string copy = bytes;
  write_piece(path(product, {}), key(product, {}),
              {{reinterpret_cast<std::byte*>(copy.data()), 1, static_cast<int>(copy.size()), 1}});
}

void WorkFolder::clear() {
  std::error_code code;
  fs::remove_all(folder_, code);
}

// One line per entry; line feeds in values (a scene has many) are escaped.
std::string to_text(const JobIdentity& identity) {
  std::string text = "belvedere job 1\n";
  for (const auto& [name, value] : identity) text += name + "\t" + on_one_line(value) + "\n";
  return text;
}

JobIdentity job_from_text(const std::string& text) {
  JobIdentity identity;
  std::istringstream lines(text);
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    const std::size_t tab = line.find('\t');
    if (tab == std::string::npos) continue;
    identity[line.substr(0, tab)] = from_one_line(line.substr(tab + 1));
  }
  return identity;
}

bool holds_work(const std::string& folder) {
  std::error_code code;
  return fs::exists(fs::path(folder) / identity_file, code);
}

void begin_shared_work(const std::string& folder, const JobIdentity& identity) {
  const std::string known = (fs::path(folder) / identity_file).string();
  make_folder(folder);
  if (fs::exists(known))
    require_same(folder, job_from_text(read_text(known)), identity);
  else
    write_identity(folder, identity);
}

namespace {

Planes from_row(const Planes& planes, int row) {
  Planes rows = planes;
  for (Plane& plane : rows) plane.values += plane.row_bytes() * static_cast<std::size_t>(row);
  return rows;
}

}  // namespace

void JoinedPieces::read(const std::string& product, int y0, int y1, const Planes& to) const {
  for (const PixelRect& piece : pieces) {
    if (piece.y0 >= y1 || piece.y1 <= y0) continue;
    const int first = std::max(y0, piece.y0);
    read_piece_rows(work.path(product, piece), work.key(product, piece), first,
                    std::min(y1, piece.y1), region.x0, from_row(to, first - y0));
  }
}

namespace {

constexpr std::size_t max_bytes_beside = std::size_t{256} << 20U;

}  // namespace

struct PieceWriter::Writing {
  std::future<void> done;
};

PieceWriter::PieceWriter(const WorkFolder& work)
    : work_(work), writing_(std::make_unique<Writing>()) {}

PieceWriter::~PieceWriter() {
  if (writing_->done.valid()) writing_->done.wait();
}

void PieceWriter::keep(const std::string& product, PixelRect rect, const Planes& planes,
                       std::shared_ptr<const void> holder) {
  finish();
  std::size_t bytes = 0;
  for (const Plane& plane : planes) bytes += plane.bytes();
  writing_->done = std::async(std::launch::async,
                              [&work = work_, product, rect, planes, kept = std::move(holder)] {
                                work.keep(product, rect, planes);
                              });
  if (bytes > max_bytes_beside) finish();
}

void PieceWriter::finish() {
  if (writing_->done.valid()) writing_->done.get();
}

}  // namespace belvedere
