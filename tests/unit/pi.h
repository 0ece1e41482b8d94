#pragma once

#include <deal.II/base/numbers.h>

/// One name for all tests, several of which are compiled as one.
constexpr double pi = dealii::numbers::PI, two_pi = 2 * pi;
