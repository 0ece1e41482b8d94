#include <vibrocontact/numerics/phi_functions.h>

namespace vibrocontact
{
  std::complex<double> phi(const unsigned int n, const std::complex<double> x)
  {
    if (std::abs(x) < 1.5)
    {
      std::complex<double> term = 1;
      for (unsigned int k = 2; k <= n; ++k)
        term /= k;
      std::complex<double> sum = term;
      for (unsigned int k = 1; std::abs(term) > 1e-18 * std::abs(sum); ++k)
        sum += term *= x / double(k + n);
      return sum;
    }
    std::complex<double> value = std::exp(x);
    double factor = 1;
    for (unsigned int k = 1; k <= n; ++k)
    {
      value = (value - factor) / x;
      factor /= k;
    }
    return value;
  }
} // namespace vibrocontact
