#pragma once

// what the test of include_circles.py has to find: first.cc includes this header
#include <vibrocontact/base/first.h>
