#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/progress.h"
#include "texture/sheet/synthesis_sheet.h"
#include "texture/synthesis/exemplar.h"
#include "texture/synthesis/guide_stack.h"
#include "texture/synthesis/synthesis_parameters.h"

namespace belvedere {

struct SynthesisPlanData;  // plan_data.h

// What all tiles have in common: matches of the plan's level, and of the exemplars what the finer levels search. It owns its data.
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

// small_view: the guides of the whole sheet at 1 / 2^level, plan_width() × plan_height(). Parameters and notes are those of synthesize;
// where the level is 0, so are the matches.
SynthesisPlan plan_synthesis(const std::vector<Exemplar>& exemplars, const GuideStack& small_view, const SynthesisSheet& sheet,
                             const SynthesisParameters& parameters, Progress& progress);

// The plan without what can be made again from the exemplars: about 4 bytes a pixel of the small view.
std::vector<std::uint8_t> pack_plan(const SynthesisPlan& plan);
// The same plan in another process. Throws Error(input) where the bytes are no plan or damaged, or the exemplars are not those it was made
// with.
SynthesisPlan unpack_plan(const std::vector<std::uint8_t>& bytes, const std::vector<Exemplar>& exemplars);

}  // namespace belvedere
