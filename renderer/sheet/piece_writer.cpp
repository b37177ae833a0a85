#include "renderer/sheet/piece_writer.h"

#include <cstddef>
#include <utility>

namespace belvedere {
namespace {

constexpr std::size_t max_bytes_beside = std::size_t{256} << 20U;

}  // namespace

PieceWriter::~PieceWriter() {
  if (writing_.valid()) writing_.wait();
}

void PieceWriter::keep(const std::string& product, PixelRect rect, const Planes& planes,
                       std::shared_ptr<const void> holder) {
  finish();
  std::size_t bytes = 0;
  for (const Plane& plane : planes) bytes += plane.bytes();
  writing_ = std::async(std::launch::async,
                        [&work = work_, product, rect, planes, kept = std::move(holder)] {
                          work.keep(product, rect, planes);
                        });
  if (bytes > max_bytes_beside) finish();
}

void PieceWriter::finish() {
  if (writing_.valid()) writing_.get();
}

}  // namespace belvedere
