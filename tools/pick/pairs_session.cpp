#include "tools/pick/pairs_session.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <utility>

#include "base/error.h"
#include "base/files/output_file.h"
#include "base/text/missing_file.h"

namespace belvedere::tools {
namespace {

std::string read_text(const std::string& path) {
  require_file(path, "a table of pairs");
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Error(ErrorKind::input, path, "cannot be read", "a table of pairs");
  return {std::istreambuf_iterator<char>(file), {}};
}

// The path, whose file is made if it is missing.
const std::string& with_file(const std::string& path) {
  if (!std::filesystem::exists(path)) write_text_file(path, control_pairs_text({}));
  return path;
}

}  // namespace

PairsSession::PairsSession(std::string path, glm::ivec2 painting_px, const Dem& dem)
    : path_(std::move(path)),
      painting_px_(painting_px),
      dem_(dem),
      owner_(with_file(path_), "page that picks pairs"),
      text_(read_text(path_)),
      pairs_(parse(text_)) {}

std::vector<ControlPair> PairsSession::parse(const std::string& text) const {
  return parse_control_pairs(text, path_, painting_px_, dem_,
                             {.min_pairs = 0, .other_columns = false});
}

bool PairsSession::is_changed_outside() const {
  std::ifstream file(path_, std::ios::binary);
  return !file || !std::filesystem::is_regular_file(path_) ||
         std::string(std::istreambuf_iterator<char>(file), {}) != text_;
}

void PairsSession::write(const std::string& text) {
  write_text_file(path_, text);
  owner_.renew();
}

void PairsSession::replace(const std::string& text, std::vector<ControlPair> pairs) {
  if (is_changed_outside())
    throw Error(ErrorKind::output, path_, "another program changed the file",
                "reload it, or write over it");
  write(text);
  text_ = text;
  pairs_ = std::move(pairs);
  ++revision_;
}

void PairsSession::change(std::span<const ControlPair> pairs) {
  const std::string text = control_pairs_text(pairs);
  if (text == text_) return;
  const std::string before = text_;
  replace(text, parse(text));
  undo_.push_back(before);
  redo_.clear();
}

void PairsSession::undo() {
  if (undo_.empty()) return;
  const std::string before = text_;
  replace(undo_.back(), parse(undo_.back()));
  undo_.pop_back();
  redo_.push_back(before);
}

void PairsSession::redo() {
  if (redo_.empty()) return;
  const std::string before = text_;
  replace(redo_.back(), parse(redo_.back()));
  redo_.pop_back();
  undo_.push_back(before);
}

void PairsSession::reload() {
  const std::string text = read_text(path_);
  if (text == text_) return;
  std::vector<ControlPair> pairs = parse(text);
  owner_.renew();
  undo_.push_back(std::exchange(text_, text));
  redo_.clear();
  pairs_ = std::move(pairs);
  ++revision_;
}

void PairsSession::save_over() { write(text_); }

}  // namespace belvedere::tools
