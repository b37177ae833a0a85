#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/pixel_rect.h"
#include "renderer/graph/tile_store.h"
#include "renderer/sheet/piece_file.h"

namespace belvedere {

// Everything that the pixels of a job depend on, as text: version of the program, scene, inputs,
// size, part. Two jobs with the same entries have the same pieces.
using JobIdentity = std::map<std::string, std::string>;

// How a folder of pieces is opened.
enum class WorkMode {
  begin,   // pieces of another run are discarded; exclusive access
  resume,  // complete pieces are kept; exclusive access
  join,    // many may work here at once, each on its own pieces; the job must exist
};

// The pieces of a job beside its results, so that an interrupted run can be resumed, and several
// machines can work on one sheet. Throws Error(output) where another run works in the folder,
// Error(usage) where the pieces are of another job, naming the differences, Error(output) where the
// folder cannot be written.
class WorkFolder {
 public:
  WorkFolder(std::string folder, const JobIdentity& identity, WorkMode mode);
  ~WorkFolder();
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;

  const std::string& folder() const { return folder_; }
  PieceKey key(const std::string& product, PixelRect rect) const { return {job_, product, rect}; }
  std::string path(const std::string& product, PixelRect rect) const;
  // Whether the piece is there and complete: read and hashed. A damaged one is removed.
  bool has(const std::string& product, PixelRect rect) const;
  void keep(const std::string& product, PixelRect rect, const Planes& planes) const;
  // Bytes that are not a picture: the plan.
  bool has_bytes(const std::string& product) const { return has(product, {}); }
  std::string read_bytes(const std::string& product) const {
    return read_piece_bytes(path(product, {}));
  }
  void keep_bytes(const std::string& product, const std::string& bytes) const;
  // Removes the folder: the job is done.
  void clear();

 private:
  std::string folder_;
  std::string job_;
  int lock_ = -1;
  bool alone_ = false;
};

// Entries as text, one line each, and back.
std::string to_text(const JobIdentity& identity);
JobIdentity job_from_text(const std::string& text);

// Whether some run left its job in a folder.
bool holds_work(const std::string& folder);
// Writes the identity of a job to a new folder for WorkMode::join; Error(usage) where another job
// is there.
void begin_shared_work(const std::string& folder, const JobIdentity& identity);

// The finished pieces of a part of the sheet, read as rows over its whole width.
struct JoinedPieces {
  const WorkFolder& work;
  std::vector<PixelRect> pieces;  // that cover the region, and perhaps more
  PixelRect region;               // px of the sheet

  // Rows [y0, y1) of the sheet of a product, into planes of the region's width and that many rows.
  // Error(input) where a piece is incomplete.
  void read(const std::string& product, int y0, int y1, const Planes& to) const;
};

// Writes finished pieces to disk while the next ones are made: a piece is copied, hashed and
// flushed, which takes up to a tenth of its making. One piece is being written at a time; for large
// ones, which would take too much memory beside the next, the caller waits.
class PieceWriter {
 public:
  explicit PieceWriter(const WorkFolder& work);
  ~PieceWriter();  // waits; errors are then lost: call finish() first
  PieceWriter(const PieceWriter&) = delete;
  PieceWriter& operator=(const PieceWriter&) = delete;

  // `holder` keeps the planes' values alive until they are written. Throws the error of the
  // previous piece.
  void keep(const std::string& product, PixelRect rect, const Planes& planes,
            std::shared_ptr<const void> holder);
  // Waits until all is written; throws its error.
  void finish();

 private:
  const WorkFolder& work_;
  struct Writing;
  std::unique_ptr<Writing> writing_;
};

}  // namespace belvedere
