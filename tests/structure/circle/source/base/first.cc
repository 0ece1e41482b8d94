#include <vibrocontact/base/first.h>
#include <vibrocontact/base/second.h>
