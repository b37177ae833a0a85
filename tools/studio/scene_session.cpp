#include "tools/studio/scene_session.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <utility>

#include "base/error.h"
#include "base/files/output_file.h"

namespace belvedere::tools {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t max_steps = 1000;  // of undo; texts of some kilobytes

}  // namespace

SceneSession::SceneSession(std::string path, SceneFileOptions options)
    : path_(std::move(path)), options_(std::move(options)), scene_(read_scene(path_, options_)) {
  now_.text = read_file();
  const std::string drawn = read_drawn();
  if (drawn.find(drawn_mark) != std::string::npos) now_.drawn = drawn;
  saved_ = now_;
}

std::string SceneSession::read_file() const {
  std::ifstream file(path_, std::ios::binary);
  if (!file)
    throw Error(ErrorKind::input, path_, "cannot be read", "the scene file where it was opened");
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string SceneSession::drawn_file() const {
  return fs::path(path_).stem().string() + "_drawn.geojson";
}

std::string SceneSession::drawn_path() const {
  return (fs::path(path_).parent_path() / drawn_file()).string();
}

std::string SceneSession::read_drawn() const {
  std::ifstream file(drawn_path(), std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

LoadedScene SceneSession::parse(const std::string& text) const {
  const fs::path path(path_);
  return parse_scene(text, path.filename().string(), path.parent_path().string(), options_);
}

void SceneSession::change_to(Version version) {
  if (version == now_) return;
  LoadedScene scene = parse(version.text);
  if (version.drawn != now_.drawn) {
    if (read_drawn() != now_.drawn)
      throw Error(ErrorKind::output, drawn_path(), "was written or changed by another program",
                  "move that file away, or open the studio again");
    if (version.drawn.empty())
      fs::remove(drawn_path());
    else
      write_text_file(drawn_path(), version.drawn);
  }
  scene_ = std::move(scene);
  now_ = std::move(version);
  ++revision_;
}

LoadedScene SceneSession::edited(std::span<const SceneEdit> edits) const {
  return parse(edit_scene_text(now_.text, fs::path(path_).filename().string(), edits));
}

// A step of undo.
void SceneSession::take(Version version, const std::string& step) {
  Version before = now_;
  change_to(std::move(version));
  if (now_ == before) return;
  if (step.empty() || step != last_step_) undo_.push_back(std::move(before));
  if (undo_.size() > max_steps) undo_.erase(undo_.begin());
  redo_.clear();
  last_step_ = step;
}

void SceneSession::edit(std::span<const SceneEdit> edits, const std::string& step) {
  draw(now_.drawn, edits, step);
}

void SceneSession::draw(const std::string& geojson, std::span<const SceneEdit> edits,
                        const std::string& step) {
  take({edit_scene_text(now_.text, fs::path(path_).filename().string(), edits), geojson}, step);
}

void SceneSession::replace(const std::string& text) { take({text, now_.drawn}, ""); }

void SceneSession::revert() { take(saved_, ""); }

void SceneSession::undo() {
  if (undo_.empty()) return;
  Version now = now_;
  change_to(undo_.back());
  undo_.pop_back();
  redo_.push_back(std::move(now));
  last_step_.clear();
}

void SceneSession::redo() {
  if (redo_.empty()) return;
  Version now = now_;
  change_to(redo_.back());
  redo_.pop_back();
  undo_.push_back(std::move(now));
  last_step_.clear();
}

bool SceneSession::is_changed_outside() const {
  std::ifstream file(path_, std::ios::binary);
  return file && std::string(std::istreambuf_iterator<char>(file), {}) != saved_.text;
}

void SceneSession::save(bool over) {
  if (!over && is_changed_outside())
    throw Error(ErrorKind::output, path_, "another program changed the file",
                "reload it, or save over it");
  write_text_file(path_, now_.text);
  saved_ = now_;
}

void SceneSession::reload() {
  const std::string text = read_file();
  replace(text);
  saved_ = now_;
}

FileOwner::FileOwner(const std::string& path, const std::string& page)
    : path_(path), page_(page), descriptor_(open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
  if (descriptor_ < 0)
    throw Error(ErrorKind::input, path, "cannot be read", "a file that you may read");
  if (flock(descriptor_, LOCK_EX | LOCK_NB) == 0) return;
  close(descriptor_);
  throw Error(ErrorKind::usage, path, "is open in another " + page,
              "close that one, or work on a copy of the file");
}

FileOwner::~FileOwner() { close(descriptor_); }

void FileOwner::renew() {
  struct stat held {};
  struct stat there {};
  if (fstat(descriptor_, &held) == 0 && stat(path_.c_str(), &there) == 0 &&
      held.st_dev == there.st_dev && held.st_ino == there.st_ino)
    return;
  FileOwner next(path_, page_);
  std::swap(descriptor_, next.descriptor_);
}

}  // namespace belvedere::tools
