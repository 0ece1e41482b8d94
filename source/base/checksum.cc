#include <vibrocontact/base/checksum.h>

#include <cstdio>

namespace vibrocontact
{
  std::string hexadecimal(const unsigned long long value)
  {
    char digits[17];
    std::snprintf(digits, sizeof digits, "%016llx", value);
    return digits;
  }

  std::string digits_of_key(const std::string &key)
  {
    Checksum sum;
    for (const char c : key)
      sum.add(&c, 1);
    return hexadecimal(sum.value());
  }
} // namespace vibrocontact
