#include <vibrocontact/propagators/modal_step.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace vibrocontact
{
  ModalStep theta_step(const double omega, const double zeta, const double theta, const double step,
                       const ReactionWeighting weighting)
  {
    const double h = step, c = 2 * zeta * omega, k = omega * omega;
    const double mass = 1 + h * theta * c + h * h * theta * theta * k;
    const bool at_end = weighting == ReactionWeighting::end_of_step;
    ModalStep s;
    s.T[1][0] = -h * k / mass;
    s.T[1][1] = (1 - h * (1 - theta) * c - h * h * theta * (1 - theta) * k) / mass;
    s.g0[1] = at_end ? 0 : h * (1 - theta) / mass;
    s.g1[1] = h * (at_end ? 1 : theta) / mass;
    s.T[0][0] = 1 + h * theta * s.T[1][0];
    s.T[0][1] = h * (1 - theta) + h * theta * s.T[1][1];
    s.g0[0] = h * theta * s.g0[1];
    s.g1[0] = h * theta * s.g1[1];
    return s;
  }

  namespace
  {
    using LongMatrix = std::array<std::array<long double, 4>, 4>;

    LongMatrix long_product(const LongMatrix &a, const LongMatrix &b)
    {
      LongMatrix c{};
      for (unsigned int i = 0; i < 4; ++i)
        for (unsigned int j = 0; j < 4; ++j)
          for (unsigned int k = 0; k < 4; ++k)
            c[i][j] += a[i][k] * b[k][j];
      return c;
    }

    // exp(a) by its series on a / 2^k and k squarings
    LongMatrix exponential(LongMatrix a)
    {
      long double norm = 0;
      for (const auto &row : a)
        for (const long double value : row)
          norm = std::max(norm, std::abs(value));
      const int squarings = std::max(0, int(std::ceil(std::log2(norm + 1e-300L))) + 4);
      for (auto &row : a)
        for (long double &value : row)
          value = std::ldexp(value, -squarings);
      LongMatrix sum{}, term{};
      for (unsigned int i = 0; i < 4; ++i)
        sum[i][i] = term[i][i] = 1;
      for (unsigned int k = 1; k < 16; ++k)
      {
        term = long_product(term, a);
        for (unsigned int i = 0; i < 4; ++i)
          for (unsigned int j = 0; j < 4; ++j)
            sum[i][j] += (term[i][j] /= k);
      }
      for (int k = 0; k < squarings; ++k)
        sum = long_product(sum, sum);
      return sum;
    }
  } // namespace

  ModalStep exact_step(const double omega, const double zeta, const double step,
                       const ReactionWeighting weighting)
  {
    // State (s q, h v, h^2 p, h^2 (p1 - p0)) over the step scaled to one. With s = max(1, w h) entries are of the order of w h at
    // most: unscaled, (w h)^2 would cost digits in long steps.
    const long double wh = static_cast<long double>(omega) * step, scale = std::max(1.L, wh);
    LongMatrix a{};
    a[0][1] = scale;
    a[1][0] = -wh * wh / scale;
    a[1][1] = -2 * zeta * wh;
    a[1][2] = 1;
    a[2][3] = 1;
    LongMatrix e = exponential(a);
    for (unsigned int j = 1; j < 4; ++j)
      e[0][j] /= scale;
    e[1][0] *= scale;
    const long double h = step;
    ModalStep s;
    for (unsigned int i = 0; i < 2; ++i)
    {
      const long double row = i == 0 ? 1 : 1 / h;
      s.T[i][0] = row * e[i][0];
      s.T[i][1] = row * e[i][1] * h;
      const long double constant = row * e[i][2] * h * h, ramp = row * e[i][3] * h * h;
      const bool at_end = weighting == ReactionWeighting::end_of_step;
      s.g0[i] = at_end ? 0.L : constant - ramp;
      s.g1[i] = at_end ? constant : ramp;
    }
    return s;
  }
} // namespace vibrocontact
