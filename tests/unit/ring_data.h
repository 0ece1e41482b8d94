#pragma once

#include <vibrocontact/numerics/pole_fit.h>

#include <cmath>
#include <random>

/// The tyre paper's ring on an elastic foundation at rest (doc/theory.md), written anew from its 2 x 2 system for every
/// wave number: radial displacement at theta under a radial unit force at 0, with L_n of follower pressure and
/// D_n = 2 xi sqrt(m) sqrt(L_n).
namespace ring_data
{
  using Complex = std::complex<double>;

  inline Complex receptance(const double omega, const double theta, const int n_max = 400)
  {
    const double E = 1e8, rho = 2280, R = 0.285, h = 0.01, b = 0.16, k_z = 1.64e6, k_theta = 2.19e5, p = 2e5,
                 xi = 0.05;
    const double m = rho * b * h, B = E * b * h * h * h / 12 / std::pow(R, 4), k = E * b * h / (R * R),
                 t = p * b / R;
    Complex sum = 0;
    for (int n = 0; n <= n_max; ++n)
    {
      const double square = double(n) * n, L11 = (B + k + t) * square + k_theta,
                   L22 = B * square * square + t * square + k + k_z, coupling = B * square * n + (k + t) * n;
      // square root of a positive 2 x 2 matrix; off the diagonal stands -j coupling and its conjugate
      const double root = std::sqrt(L11 * L22 - coupling * coupling),
                   scale = 1 / std::sqrt(L11 + L22 + 2 * root);
      const Complex s(0, omega), d = 2 * xi * std::sqrt(m) * s;
      const Complex A11 = -omega * omega * m + d * (L11 + root) * scale + L11,
                    A22 = -omega * omega * m + d * (L22 + root) * scale + L22,
                    A12 = coupling * (1. + d * scale);
      sum += (n == 0 ? 1 : 2) * std::cos(n * theta) * A11 / (A11 * A22 - A12 * A12);
    }
    return sum / (2 * M_PI * R);
  }

  /// entries 0, pi/100, 2 pi/100 from 0 to 1000 Hz by 1 Hz
  inline vibrocontact::Spectra spectra()
  {
    vibrocontact::Spectra data;
    data.values.resize(3);
    for (unsigned int l = 0; l <= 1000; ++l)
    {
      data.omega.push_back(2 * M_PI * l);
      for (unsigned int i = 0; i < 3; ++i)
        data.values[i].push_back(receptance(data.omega.back(), i * M_PI / 100));
    }
    return data;
  }

  /// complex Gaussian noise, its rms a share of that of each entry
  inline vibrocontact::Spectra with_noise(vibrocontact::Spectra data, const double share,
                                          const unsigned int seed)
  {
    std::mt19937_64 generator(seed);
    std::normal_distribution<double> normal;
    for (auto &entry : data.values)
    {
      double square = 0;
      for (const Complex &value : entry)
        square += std::norm(value);
      const double size = share * std::sqrt(square / entry.size() / 2);
      for (Complex &value : entry)
      {
        const double real = normal(generator);
        value += size * Complex(real, normal(generator));
      }
    }
    return data;
  }
} // namespace ring_data
