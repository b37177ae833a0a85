#pragma once

#include <string>
#include <string_view>

#include "base/progress.h"

namespace belvedere::tools {

// Stages of a sweep name the result they belong to; notes, the same for all, are printed once.
class SweepProgress : public Progress {
 public:
  SweepProgress(Progress& whole, std::size_t result, std::size_t results)
      : whole_(whole), result_(result), results_(results) {}
  void begin(std::string_view stage, double total) override {
    whole_.begin(
        std::to_string(result_) + " of " + std::to_string(results_) + ": " + std::string(stage),
        total);
  }
  void advance(double amount) override { whole_.advance(amount); }
  void note(std::string_view text) override {
    if (result_ == 1) whole_.note(text);
  }

 private:
  Progress& whole_;
  std::size_t result_;
  std::size_t results_;
};

}  // namespace belvedere::tools
