#pragma once

#include <future>
#include <memory>
#include <string>

#include "renderer/sheet/work_folder.h"

namespace belvedere {

// Writes finished pieces to disk while the next ones are made: a piece is copied, hashed and
// flushed, which takes up to a tenth of its making. One piece is being written at a time; for large
// ones, which would take too much memory beside the next, the caller waits.
class PieceWriter {
 public:
  explicit PieceWriter(const WorkFolder& work) : work_(work) {}
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
  std::future<void> writing_;
};

}  // namespace belvedere
