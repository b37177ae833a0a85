#pragma once

#include <future>
#include <memory>
#include <string>

#include "renderer/sheet/work_folder.h"

namespace belvedere {

// Brings finished pieces to disk while the next ones are made: a piece is copied, hashed and waited for until the disk has it, which takes
// as long as a tenth of its making. One piece is on its way at a time; large ones, which would take too much memory beside the next, are
// waited for.
class PieceWriter {
 public:
  explicit PieceWriter(const WorkFolder& work) : work_(work) {}
  ~PieceWriter();  // waits; what fails then is lost: finish() first
  PieceWriter(const PieceWriter&) = delete;
  PieceWriter& operator=(const PieceWriter&) = delete;

  // `holder` keeps the planes' values alive until they are written. Throws what went wrong with the piece before.
  void keep(const std::string& product, PixelRect rect, const Planes& planes, std::shared_ptr<const void> holder);
  // Waits until all is written; throws what went wrong.
  void finish();

 private:
  const WorkFolder& work_;
  std::future<void> writing_;
};

}  // namespace belvedere
