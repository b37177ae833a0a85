#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "renderer/scene/edit/scene_edit.h"
#include "renderer/scene/scene_file.h"

namespace belvedere::tools {

// In every file of drawn features, so that those of other programs are told from them.
inline constexpr const char* drawn_mark = "\"written_by\": \"belvedere studio\"";

// A scene file while somebody composes: its text, which is the truth, the features that were drawn
// on the page, the scene that they mean, and the versions before and after for undo and redo. The
// drawn features are a GeoJSON file beside the scene, SCENE_drawn.geojson, which follows each step
// at once, because pictures read it. Not thread-safe.
class SceneSession {
 public:
  // Error as read_scene.
  SceneSession(std::string path, SceneFileOptions options);

  const std::string& path() const { return path_; }
  const std::string& text() const { return now_.text; }
  const std::string& drawn() const { return now_.drawn; }
  std::string drawn_file() const;  // its name
  const LoadedScene& scene() const { return scene_; }
  // Grows with every change of the text.
  std::uint64_t revision() const { return revision_; }

  // Each change leaves a scene that can be parsed, or throws Error(usage) and changes nothing.
  // Edits with the same `step`, if it is not empty, are one step of undo.
  void edit(std::span<const SceneEdit> edits, const std::string& step);
  // The same with other drawn features, a text with drawn_mark; empty: no file. Error(output) where
  // the file there is not the one that was written last, here and wherever that file changes.
  void draw(const std::string& geojson, std::span<const SceneEdit> edits, const std::string& step);
  void replace(const std::string& text);
  // The scene as it would be.
  LoadedScene edited(std::span<const SceneEdit> edits) const;
  void undo();  // nothing without a step to undo
  void redo();
  bool can_undo() const { return !undo_.empty(); }
  bool can_redo() const { return !redo_.empty(); }

  bool is_saved() const { return now_ == saved_; }
  // Whether another program changed the file since it was read or saved.
  bool is_changed_outside() const;
  // Error(output), also where another program changed the file, unless `over` it.
  void save(bool over);
  // Reads the file again; a step of undo.
  void reload();
  // Back to what was last saved; a step of undo.
  void revert();

 private:
  struct Version {
    std::string text;
    std::string drawn;
    bool operator==(const Version&) const = default;
  };
  void change_to(Version version);
  void take(Version version, const std::string& step);
  std::string drawn_path() const;
  std::string read_drawn() const;
  LoadedScene parse(const std::string& text) const;
  std::string read_file() const;

  std::string path_;
  SceneFileOptions options_;
  Version now_;
  Version saved_;  // of the files as they were read or written
  LoadedScene scene_;
  std::uint64_t revision_ = 1;
  std::vector<Version> undo_;
  std::vector<Version> redo_;
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
