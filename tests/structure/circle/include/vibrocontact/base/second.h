#pragma once

// what the test of includes.py has to find: first.cc includes this header
#include <vibrocontact/base/first.h>
