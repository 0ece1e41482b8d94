// Bases in time: shifts, partition of unity, values against their Fourier transforms.
#include "pi.h"

#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/numerics/time_basis.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace vibrocontact;

namespace
{
  using Complex = std::complex<double>;
} // namespace

TEST(TimeBasis, EveryMemberIsShiftedByARotation)
{
  for (const auto &entry : time_bases())
    for (const unsigned int n : {1, 2, 3, 4, 7, 8})
    {
      const auto basis = create_time_basis(entry.name, n);
      EXPECT_EQ(basis->name(), entry.name);
      EXPECT_EQ(basis->n_functions(), n);
      for (const unsigned int d : {0, 1})
      {
        if (d > basis->n_derivatives())
          continue;
        for (const double x : {0., 0.25, 0.71875})
        {
          const auto here = basis->values(x / n, d), next = basis->values((x + 1) / n, d);
          ASSERT_EQ(here.size(), n_orders(n));
          // constants are in every basis
          EXPECT_LT(std::abs(here[0] - (d == 0 ? 1. : 0.)), 1e-9) << entry.name << n;
          for (unsigned int m = 0; m < here.size(); ++m)
            EXPECT_LT(std::abs(next[m] - here[m] * std::polar(1., 2 * pi * m / n)),
                      1e-10 * std::pow(2 * pi * n, d))
                << entry.name << n;
          if (n % 2 == 0)
            EXPECT_EQ(here[n / 2].imag(), 0.);
        }
      }
    }
}

TEST(TimeBasis, FourierCoefficientsAreThoseOfTheValues)
{
  // left points of periodic functions: only frequencies beyond the number of points fold back
  const unsigned int n_points = 4096;
  for (const auto &[name, tolerance] :
       {std::pair<std::string, double>{"fourier", 1e-13}, {"bspline", 1e-11}, {"daubechies20", 1e-7}})
    for (const int n : {1, 2, 5, 8})
    {
      const auto basis = create_time_basis(name, n);
      for (int l = -2; l <= 2; ++l)
      {
        std::vector<Complex> sum(n_orders(n), 0.);
        for (unsigned int i = 0; i < n_points; ++i)
        {
          const double t = static_cast<double>(i) / n_points;
          const auto theta = basis->values(t, 0);
          for (int m = 0; m < static_cast<int>(sum.size()); ++m)
            sum[m] += theta[m] * std::polar(1. / n_points, -2 * pi * (m + l * n) * t);
        }
        for (unsigned int m = 0; m < sum.size(); ++m)
          EXPECT_LT(std::abs(sum[m] - basis->fourier_coefficient(m, l)), tolerance) << name << n << " " << m;
      }
    }
}

TEST(TimeBasis, DerivativesAreThoseOfTheValues)
{
  const double h = 1. / (1 << 16);
  for (const std::string name : {"fourier", "bspline", "daubechies20"})
    for (const unsigned int n : {5, 8})
    {
      const auto basis = create_time_basis(name, n);
      for (const unsigned int d : {1, 2})
      {
        const double t = 0.3125;
        const auto here = basis->values(t, d), before = basis->values(t - h, d - 1),
                   after = basis->values(t + h, d - 1);
        for (unsigned int m = 0; m < here.size(); ++m)
          EXPECT_LT(std::abs((after[m] - before[m]) / (2 * h) - here[m]), 2e-4 * std::pow(2 * pi * n, d))
              << name << n << " " << d;
      }
    }
}

TEST(TimeBasis, SamplesStandInRealArrays)
{
  const std::vector<double> phases{0., 0.1, 0.5, 0.77};
  for (const auto &name : {"fourier", "bspline", "haar", "daubechies6"})
    for (const unsigned int n : {5, 6})
    {
      const auto basis = create_time_basis(name, n);
      const DenseMatrix values = sampled(*basis, phases, 0);
      ASSERT_EQ(values.n(), n);
      for (unsigned int i = 0; i < phases.size(); ++i)
      {
        const Complex a(0.3, -0.8);
        EXPECT_NEAR(values(i, 3) * a.real() + values(i, 4) * a.imag(),
                    2 * (a * basis->value(2, phases[i], 0)).real(), 1e-14);
        if (n == 6)
          EXPECT_EQ(values(i, 5), basis->value(3, phases[i], 0).real());
      }
    }
  // Fourier's lone function of an even number
  EXPECT_NEAR(create_time_basis("fourier", 6)->value(3, 0.1, 0).real(), std::sin(6 * pi * 0.1), 1e-14);
  EXPECT_NEAR(create_time_basis("fourier", 6)->value(3, 0.1, 1).real(), 6 * pi * std::cos(6 * pi * 0.1),
              1e-13);
}

TEST(TimeBasis, HaarCellsBeginAtTheirKnots)
{
  for (const unsigned int n : {3, 49, 64, 127})
  {
    const auto basis = create_time_basis("haar", n);
    for (unsigned int k = 0; k < n; ++k)
      for (const double x : {0., 0.5, 0.999})
        for (unsigned int i = 0; i < n; ++i)
          ASSERT_EQ(basis->function(i, (k + x) / n, 0), i == k ? n : 0.) << n << " " << k << " " << x;
  }
}

TEST(TimeBasis, FigureFunctions)
{
  const auto fourier = create_time_basis("fourier", 7);
  EXPECT_EQ(fourier->function(0, 0.2, 0), 1.);
  EXPECT_NEAR(fourier->function(3, 0.2, 0), std::cos(4 * pi * 0.2), 1e-14);
  EXPECT_NEAR(fourier->function(4, 0.2, 0), std::sin(4 * pi * 0.2), 1e-14);
  // the orthogonal cubic spline: c_0 = 1.96976, c_1 = -0.67243 (the paper's Eq. 30), integral one, orthogonal shifts
  const unsigned int n = 64, n_points = 32 * n;
  const auto spline = create_time_basis("bspline", n);
  EXPECT_NEAR(spline->function(0, 2. / n, 0) / n, 1.96976 * 2 / 3 - 0.67243 / 3, 1e-5);
  double integral = 0, square = 0, product = 0;
  for (unsigned int i = 0; i < n_points; ++i)
  {
    const double t = static_cast<double>(i) / n_points, f = spline->function(0, t, 0);
    integral += f / n_points;
    square += f * f / n_points;
    product += f * spline->function(3, t, 0) / n_points;
  }
  EXPECT_NEAR(integral, 1, 1e-12);
  EXPECT_NEAR(square / n, 1, 1e-6);
  EXPECT_NEAR(product / n, 0, 1e-6);
}

TEST(TimeBasis, RefusesWhatIsNot)
{
  EXPECT_THROW(create_time_basis("fourier", 0), InputError);
  EXPECT_THROW(create_time_basis("daubechies4", 8), InputError);
  EXPECT_THROW(create_time_basis("daubechies40", 8), InputError);
  EXPECT_THROW(create_time_basis("coiflet", 8), InputError);
  EXPECT_THROW(create_time_basis("haar", 8)->value(1, 0.3, 1), InputError);
  EXPECT_THROW(create_time_basis("daubechies6", 8)->value(1, 0.3, 2), InputError);
}
