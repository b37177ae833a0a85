#include "texture/synthesis/synth_texels.h"

#include <algorithm>

#include "base/memory/zeroed_memory.h"
#include "base/parallel.h"

namespace belvedere::synth {

namespace {

constexpr int texels_per_task = 4096;  // texels a task

}  // namespace

TexelRecords::TexelRecords(const Plane& exemplars, const std::vector<std::uint8_t>& bins,
                           const std::vector<Surroundings>& around) {
  const std::size_t guides = static_cast<std::size_t>(exemplars.guide_count);
  record_words_ = guides <= 1 ? 2 : 2 + (guides - 1 + 7) / 8 * 2;
  const std::size_t count = exemplars.words.size();
  assign_in_large_pages(words_, count * record_words_ + 2,
                        0U);  // eight guides may be read from the last one, too
  parallel_ranges(
      static_cast<int>((count + texels_per_task - 1) / texels_per_task), 1,
      [&](int begin, int end) {
        const std::size_t last = std::min(count, static_cast<std::size_t>(end) * texels_per_task);
        for (std::size_t i = static_cast<std::size_t>(begin) * texels_per_task; i < last; ++i) {
          std::uint8_t* bytes = reinterpret_cast<std::uint8_t*>(words_.data() + i * record_words_);
          bytes[4] = bins[i];
          if (!exemplars.cuts.empty())
            bytes[4] = static_cast<std::uint8_t>(bytes[4] | exemplars.cuts[i] << bin_width);
          if (!around.empty()) {
            bytes[5] = around[i].others;
            bytes[6] = around[i].commonest;
          }
          const std::uint8_t* values = exemplars.guides_at(static_cast<std::uint32_t>(i));
          for (std::size_t g = 0; g < guides; ++g) bytes[guides_from + g] = values[g];
        }
      });
}

void TexelRecords::forget_uses() {
  const std::size_t count = words_.size() / record_words_;
  for (std::size_t i = 0; i < count; ++i) words_[i * record_words_] = 0;
}

}  // namespace belvedere::synth
