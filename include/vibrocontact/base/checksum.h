#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// Sum over bytes by which a reader sees that they are those that were written: FNV-1a on words of eight bytes,
  ///
  ///     s <- (s xor word) p   mod 2^64,   p = 1099511628211 (odd, so that no two s become one):
  ///
  /// a change inside one word never stays unseen. 10 ms for a compliance of 1,800 rows. Not against malice.
  class Checksum
  {
  public:
    Checksum() = default;
    /// Goes on from the sum of what stands before.
    explicit Checksum(const unsigned long long before) : sum(before) {}

    void add(const void *const data, const std::size_t n_bytes)
    {
      const auto *const bytes = static_cast<const unsigned char *>(data);
      for (std::size_t i = 0; i < n_bytes; i += 8)
      {
        unsigned long long word = 0;
        std::copy_n(bytes + i, std::min<std::size_t>(8, n_bytes - i),
                    reinterpret_cast<unsigned char *>(&word));
        sum = (sum ^ word) * 1099511628211ull;
      }
    }
    template <typename T>
    void add(const std::vector<T> &values)
    {
      add(values.data(), values.size() * sizeof(T));
    }

    unsigned long long value() const { return sum; }

  private:
    unsigned long long sum = 1469598103934665603ull;
  };

  /// A sum as sixteen digits.
  std::string hexadecimal(unsigned long long value);
  /// Sixteen digits for the name of a file that depends on a key: FNV-1a on its bytes, one by one.
  std::string digits_of_key(const std::string &key);
} // namespace vibrocontact
