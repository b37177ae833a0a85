#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <string>
#include <vector>

#include "terrain/io/dem.h"
#include "terrain/register/control_pairs.h"
#include "tools/studio/file_owner.h"

namespace belvedere::tools {

// A table of pairs while somebody picks them: its text, which is always what the file has, the
// pairs that it means, and the texts before and after for undo and redo. Not thread-safe.
class PairsSession {
 public:
  // A file that is not there yet is made, without pairs. `dem` must outlive the session. Error as
  // parse_control_pairs, also for columns that would be lost; Error(usage) where another page has
  // the file open.
  PairsSession(std::string path, glm::ivec2 painting_px, const Dem& dem);

  const std::string& path() const { return path_; }
  const std::vector<ControlPair>& pairs() const { return pairs_; }
  // Grows with every change.
  std::uint64_t revision() const { return revision_; }

  // Each change is written at once, complete or not at all. One that is refused, Error(usage) as
  // parse_control_pairs or Error(output), changes nothing; Error(output) also where another program
  // changed the file. Of the pairs their pixel, lonlat, name and sure count.
  void change(std::span<const ControlPair> pairs);
  void undo();  // nothing without a step to undo
  void redo();
  bool can_undo() const { return !undo_.empty(); }
  bool can_redo() const { return !redo_.empty(); }

  // Whether another program changed the file since it was read or written.
  bool is_changed_outside() const;
  // Reads the file again; a step of undo.
  void reload();
  // Writes the pairs over what another program wrote.
  void save_over();

 private:
  std::vector<ControlPair> parse(const std::string& text) const;
  void write(const std::string& text);
  void replace(const std::string& text, std::vector<ControlPair> pairs);

  std::string path_;
  glm::ivec2 painting_px_;
  const Dem& dem_;
  FileOwner owner_;
  std::string text_;
  std::vector<ControlPair> pairs_;
  std::uint64_t revision_ = 1;
  std::vector<std::string> undo_;
  std::vector<std::string> redo_;
};

}  // namespace belvedere::tools
