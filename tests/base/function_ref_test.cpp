#include "base/function_ref.h"

#include <gtest/gtest.h>

namespace belvedere {
namespace {

int twice(FunctionRef<int(int)> f, int value) { return f(f(value)); }

TEST(FunctionRef, CallsWhatItRefersTo) {
  int calls = 0;
  const auto add = [&calls](int value) {
    ++calls;
    return value + 10;
  };
  EXPECT_EQ(twice(add, 1), 21);
  EXPECT_EQ(calls, 2);
}

TEST(FunctionRef, CopiesReferToTheSameFunction) {
  int count = 0;
  auto counter = [count]() mutable { return ++count; };  // a copy of it would count by itself
  const FunctionRef<int()> first = counter;
  const FunctionRef<int()> second = first;
  EXPECT_EQ(first(), 1);
  EXPECT_EQ(second(), 2);
  EXPECT_EQ(counter(), 3);
}

}  // namespace
}  // namespace belvedere
