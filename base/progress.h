#pragma once

#include <string_view>

namespace belvedere {

// Reports of a long stage. The library calls it, a program shows it; both functions may be called
// from any thread. The default does nothing.
class Progress {
 public:
  virtual ~Progress() = default;
  // A stage begins; `total` is its amount of work in any unit, 0 if unknown. Stages follow each
  // other and never nest.
  virtual void begin(std::string_view /*stage*/, double /*total*/) {}
  // This much of the work is done. Throws Error(interrupted) if the user asked to stop.
  virtual void advance(double /*amount*/) {}
  // A remark worth a line in the log: something was filled, ignored, replaced by a fallback.
  virtual void note(std::string_view /*text*/) {}
};

// For callers that report nothing.
Progress& silent_progress();

}  // namespace belvedere
