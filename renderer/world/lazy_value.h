#pragma once

#include <functional>
#include <mutex>
#include <optional>
#include <utility>

namespace belvedere {

// A value that is computed on first use. Thread-safe.
template <class T>
class LazyValue {
 public:
  explicit LazyValue(std::function<T()> make) : make_(std::move(make)) {}
  explicit LazyValue(T made) : value_(std::move(made)) {}
  LazyValue(const LazyValue&) = delete;
  LazyValue& operator=(const LazyValue&) = delete;

  const T& get() const {
    const std::lock_guard lock(mutex_);
    if (!value_) value_ = make_();
    return *value_;
  }

 private:
  std::function<T()> make_;
  mutable std::mutex mutex_;
  mutable std::optional<T> value_;
};

}  // namespace belvedere
