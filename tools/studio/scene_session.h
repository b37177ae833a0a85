#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "renderer/scene/edit/scene_edit.h"
#include "renderer/scene/scene_file.h"

namespace belvedere::tools {

// A scene file while somebody composes: its text, which is the truth, the scene that it means, and
// the texts before and after for undo and redo. Not thread-safe.
class SceneSession {
 public:
  // Error as read_scene.
  SceneSession(std::string path, SceneFileOptions options);

  const std::string& path() const { return path_; }
  const std::string& text() const { return text_; }
  const LoadedScene& scene() const { return scene_; }
  // Grows with every change of the text.
  std::uint64_t revision() const { return revision_; }

  // Each change leaves a scene that can be parsed, or throws Error(usage) and changes nothing.
  // Edits with the same `step`, if it is not empty, are one step of undo.
  void edit(std::span<const SceneEdit> edits, const std::string& step);
  void replace(const std::string& text);
  // The scene as it would be.
  LoadedScene edited(std::span<const SceneEdit> edits) const;
  void undo();  // nothing without a step to undo
  void redo();
  bool can_undo() const { return !undo_.empty(); }
  bool can_redo() const { return !redo_.empty(); }

  bool is_saved() const { return text_ == saved_; }
  // Whether another program changed the file since it was read or saved.
  bool is_changed_outside() const;
  // Error(output), also where another program changed the file, unless `over` it.
  void save(bool over);
  // Reads the file again; a step of undo.
  void reload();

 private:
  void change_to(const std::string& text);
  LoadedScene parse(const std::string& text) const;
  std::string read_file() const;

  std::string path_;
  SceneFileOptions options_;
  std::string text_;
  std::string saved_;  // text of the file as it was read or written
  LoadedScene scene_;
  std::uint64_t revision_ = 1;
  std::vector<std::string> undo_;
  std::vector<std::string> redo_;
  std::string last_step_;
};

// Held while a page has a file open, so that a second one is refused; the system drops it whatever
// ends the program.
class FileOwner {
 public:
  // page: what it is, for messages: "studio". Error(usage) where another page has the file open,
  // Error(input) where it cannot be read.
  FileOwner(const std::string& path, const std::string& page);
  ~FileOwner();
  FileOwner(const FileOwner&) = delete;
  FileOwner& operator=(const FileOwner&) = delete;
  // Saving puts another file in the place of the one that is held.
  void renew();

 private:
  std::string path_;
  std::string page_;
  int descriptor_;
};

}  // namespace belvedere::tools
