#pragma once

#include <gtest/gtest.h>

#include <cstdio>

/// Prints what a hard case is off its truth by, for doc/hard_cases.md.
inline void report(const char *what, const double error)
{
  const auto *test = testing::UnitTest::GetInstance()->current_test_info();
  std::printf("%s.%s: %s %.2g\n", test->test_suite_name(), test->name(), what, error);
}
