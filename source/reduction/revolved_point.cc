#include <vibrocontact/reduction/revolved_point.h>

#include <cmath>

namespace vibrocontact
{
  double wave_weight(const unsigned int n, const bool odd, const double angle, const unsigned int amplitude)
  {
    if (amplitude == 2)
      return odd ? -std::cos(n * angle) : std::sin(n * angle);
    return odd ? std::sin(n * angle) : std::cos(n * angle);
  }

  std::array<double, 3> wave_weights(const unsigned int n, const bool odd, const double angle,
                                     const double half_angle, const unsigned int component)
  {
    // means over the angle of cos(m theta), sin(m theta)
    const auto smooth = [&](const int m)
    { return m == 0 || half_angle == 0 ? 1. : std::sin(m * half_angle) / (m * half_angle); };
    const auto cosine = [&](const int m) { return std::cos(m * angle) * smooth(m); };
    const auto sine = [&](const int m) { return std::sin(m * angle) * smooth(m); };
    const int m = n;
    const double cos_cos = (cosine(m + 1) + cosine(m - 1)) / 2, sin_sin = (cosine(m - 1) - cosine(m + 1)) / 2,
                 // the first of cos(n theta), sin(n theta), the second of cos(theta), sin(theta)
        cos_sin = (sine(m + 1) - sine(m - 1)) / 2, sin_cos = (sine(m + 1) + sine(m - 1)) / 2;
    std::array<double, 3> result{};
    if (!odd || n == 0)
    {
      if (component == 0)
        result = {{0., -cos_cos, sin_sin}};
      else if (component == 1)
        result = {{0., cos_sin, sin_cos}};
      else
        result = {{cosine(m), 0., 0.}};
    }
    if (odd || n == 0)
    {
      if (component == 0)
      {
        result[1] += -sin_cos;
        result[2] += -cos_sin;
      }
      else if (component == 1)
      {
        result[1] += sin_sin;
        result[2] += -cos_cos;
      }
      else
        result[0] += sine(m);
    }
    return result;
  }

  std::array<double, 3> RevolvedPoint::weights(const unsigned int n, const bool odd) const
  {
    std::array<double, 3> result{};
    if (!in_section_axes)
      result = wave_weights(n, odd, angle, half_angle, component);
    else
      result[component] = wave_weight(n, odd, angle, component);
    if (n == 0)
      for (unsigned int c = 0; c < 3; ++c)
        if ((c == 2) != odd)
          result[c] = 0;
    return result;
  }
} // namespace vibrocontact
