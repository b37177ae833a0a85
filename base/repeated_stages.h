#pragma once

#include <set>
#include <string>
#include <string_view>

#include "base/progress.h"

namespace belvedere {

// Stages that are gone through again and again, one piece after the other. What they remark is passed on once. Of few pieces each stage
// may be told of; of many, all are one stage, begun by whoever calls them, and only a wish to stop comes through to them.
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
