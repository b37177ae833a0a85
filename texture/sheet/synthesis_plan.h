#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "base/progress.h"
#include "texture/sheet/synthesis_sheet.h"
#include "texture/synthesis/exemplar.h"

namespace belvedere {

struct SynthesisPlanData;  // plan_data.h

// Shared by all tiles: matches of the plan's level, and the parts of the exemplars that the finer
// levels search. It owns its data.
class SynthesisPlan {
 public:
  explicit SynthesisPlan(std::unique_ptr<SynthesisPlanData> data);
  SynthesisPlan(SynthesisPlan&&) noexcept;
  SynthesisPlan& operator=(SynthesisPlan&&) noexcept;
  ~SynthesisPlan();

  const SynthesisSheet& sheet() const;
  const SynthesisPlanData& data() const { return *data_; }
  SynthesisPlanData& data() { return *data_; }

 private:
  std::unique_ptr<SynthesisPlanData> data_;
};

// small_view: the guides of the whole sheet at 1 / 2^level, plan_width() × plan_height().
// Parameters and notes as for synthesize; matches are final if the level is 0.
SynthesisPlan plan_synthesis(const std::vector<Exemplar>& exemplars, const GuideStack& small_view,
                             const SynthesisSheet& sheet, const SynthesisParameters& parameters,
                             Progress& progress);

// The plan without what can be recomputed from the exemplars: about 4 bytes per pixel of the small
// view.
std::vector<std::uint8_t> pack_plan(const SynthesisPlan& plan);
// The same plan in another process. Throws Error(input) if the bytes are not a plan or damaged, or
// the exemplars are not those it was made with.
SynthesisPlan unpack_plan(const std::vector<std::uint8_t>& bytes,
                          const std::vector<Exemplar>& exemplars);

}  // namespace belvedere
