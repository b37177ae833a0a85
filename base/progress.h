#pragma once

#include <set>
#include <string>
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

// Progress of stages that are repeated for each piece. A remark is passed on once. For few pieces
// each stage is reported; for many, all count as one stage that the caller begins, and only a
// request to stop is passed through.
class RepeatedStages final : public Progress {
 public:
  RepeatedStages(Progress& outer, bool tell_each) : outer_(outer), tell_each_(tell_each) {}
  void begin(std::string_view stage, double total) override {
    if (tell_each_) outer_.begin(stage, total);
  }
  void advance(double amount) override { outer_.advance(tell_each_ ? amount : 0.0); }
  void note(std::string_view text) override {
    if (told_.insert(std::string(text)).second) outer_.note(text);
  }

 private:
  Progress& outer_;
  bool tell_each_;
  std::set<std::string> told_;
};

}  // namespace belvedere
