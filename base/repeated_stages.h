#pragma once

#include <set>
#include <string>
#include <string_view>

#include "base/progress.h"

namespace belvedere {

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
