// Integrals between bases in time against Gauss' rule on the cells, Fourier series, closed forms.
#include "pi.h"

#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/numerics/time_pairing.h>

#include <deal.II/base/quadrature_lib.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace vibrocontact;

namespace
{
  using Complex = std::complex<double>;
  const std::vector<TimeForm> forms{TimeForm::strong, TimeForm::weak, TimeForm::distributional};

  /// int conj(Psi_m^(d)) Theta_k^(e) dt for all m, k; smooth on the N cells
  std::vector<std::vector<Complex>> by_gauss(const TimeBasis &trial, const unsigned int e,
                                             const TimeBasis &weighting, const unsigned int d)
  {
    const unsigned int n = trial.n_functions(), size = n_orders(n);
    // polynomials and at most a few waves on a cell: exact to round-off
    const dealii::QGauss<1> rule(24);
    std::vector<std::vector<Complex>> result(size, std::vector<Complex>(size, 0.));
    for (unsigned int cell = 0; cell < n; ++cell)
      for (unsigned int q = 0; q < rule.size(); ++q)
      {
        const double t = (cell + rule.point(q)[0]) / n;
        const auto psi = weighting.values(t, d), theta = trial.values(t, e);
        for (unsigned int m = 0; m < size; ++m)
          for (unsigned int k = 0; k < size; ++k)
            result[m][k] += rule.weight(q) / n * std::conj(psi[m]) * theta[k];
      }
    return result;
  }

  bool admissible(const TimeBasis &trial, const TimeBasis &weighting, const TimeForm form,
                  const unsigned int points = 0)
  {
    try
    {
      pair_time_bases(trial, weighting, form, points);
    }
    catch (const InputError &)
    {
      return false;
    }
    return true;
  }

  TimePairing pair(const std::string &trial, const std::string &weighting, const unsigned int n,
                   const unsigned int points = 0, const TimeForm form = TimeForm::distributional)
  {
    return pair_time_bases(*create_time_basis(trial, n), *create_time_basis(weighting, n), form, points);
  }

  /// entries of the circulant matrix, row 0: 1/N sum_m A(m) e^(-2 pi j m k / N)
  std::vector<double> circulant(const std::vector<Complex> &A, const unsigned int n)
  {
    std::vector<double> row(n, 0.);
    for (unsigned int k = 0; k < n; ++k)
      for (unsigned int m = 0; m < n; ++m)
      {
        const Complex a = m < A.size() ? A[m] : std::conj(A[n - m]);
        row[k] += (a * std::polar(1. / n, -2 * pi * m * k / n)).real();
      }
    return row;
  }
} // namespace

TEST(TimePairing, ThreeFormsAreOneAndTheirIntegrals)
{
  const std::vector<std::string> names{"fourier", "bspline", "haar"};
  for (const auto &trial_name : names)
    for (const auto &weighting_name : names)
      for (const unsigned int n : {1, 2, 3, 4, 5, 8, 9, 16})
      {
        const auto trial = create_time_basis(trial_name, n), weighting = create_time_basis(weighting_name, n);
        for (const TimeForm form : forms)
        {
          if (!admissible(*trial, *weighting, form))
            continue;
          const auto pairing = pair_time_bases(*trial, *weighting, form);
          const bool moves_first = form == TimeForm::distributional;
          const unsigned int moved = form == TimeForm::strong ? 0 : moves_first ? 2 : 1;
          const auto A0 = by_gauss(*trial, 0, *weighting, 0);
          const auto A1 = by_gauss(*trial, moves_first ? 0 : 1, *weighting, moves_first ? 1 : 0);
          const auto A2 = by_gauss(*trial, 2 - moved, *weighting, moved);
          const auto norm = by_gauss(*weighting, 0, *weighting, 0);
          for (unsigned int m = 0; m < n_orders(n); ++m)
            for (unsigned int k = 0; k < n_orders(n); ++k)
            {
              const auto label =
                  trial_name + ":" + weighting_name + " " + std::to_string(n) + " " + name_of(form);
              // relative to the size of the operator
              EXPECT_LT(std::abs(A0[m][k] - (m == k ? pairing.a0[m] : 0.)), 1e-12) << label;
              EXPECT_LT(std::abs((moves_first ? -1. : 1.) * A1[m][k] - (m == k ? pairing.a1[m] : 0.)),
                        1e-12 * 2 * pi * n)
                  << label;
              EXPECT_LT(std::abs((moved == 1 ? -1. : 1.) * A2[m][k] - (m == k ? pairing.a2[m] : 0.)),
                        1e-12 * 4 * pi * pi * n * n)
                  << label;
              EXPECT_LT(std::abs(norm[m][k] - (m == k ? pairing.norm[m] : 0.)), 1e-12) << label;
            }
        }
      }
}

TEST(TimePairing, RecursionIsTheFourierSeries)
{
  // sum over the aliases m + l N of the transforms, of functions smooth enough that it ends soon
  for (const auto &[trial_name, weighting_name] :
       {std::pair<std::string, std::string>{"daubechies12", "bspline"},
        {"haar", "daubechies18"},
        {"daubechies18", "daubechies18"}})
    for (const int n : {1, 4, 9})
    {
      const auto trial = create_time_basis(trial_name, n), weighting = create_time_basis(weighting_name, n);
      const auto pairing = pair_time_bases(*trial, *weighting, TimeForm::distributional);
      for (int m = 0; m < static_cast<int>(n_orders(n)); ++m)
      {
        Complex sum[3] = {0, 0, 0};
        for (int l = -400; l <= 400; ++l)
        {
          Complex term = std::conj(weighting->fourier_coefficient(m, l)) * trial->fourier_coefficient(m, l);
          for (Complex &s : sum)
          {
            s += term;
            term *= Complex(0, 2 * pi * (m + l * n)) / (2 * pi * n);
          }
        }
        EXPECT_LT(std::abs(sum[0] - pairing.a0[m]), 1e-9) << trial_name << n << " " << m;
        EXPECT_LT(std::abs(sum[1] - pairing.a1[m] / (2 * pi * n)), 1e-7) << trial_name << n << " " << m;
        EXPECT_LT(std::abs(sum[2] - pairing.a2[m] / (4 * pi * pi * n * n)), 1e-4)
            << trial_name << n << " " << m;
      }
    }
}

TEST(TimePairing, ConnectionCoefficientsWrapAround)
{
  const double first[] = {0, 272. / 365, -53. / 365, 16. / 1095, 1. / 2920},
               second[] = {-295. / 56, 356. / 105, -92. / 105, 4. / 35, 3. / 560};
  for (const int n : {1, 2, 4, 16})
  {
    const auto pairing = pair("daubechies6", "daubechies6", n, 0, TimeForm::weak);
    std::vector<double> G1(n, 0.), G2(n, 0.);
    for (int k = -4; k <= 4; ++k)
    {
      G1[(k + 4 * n) % n] += k < 0 ? -first[-k] : first[k];
      G2[(k + 4 * n) % n] += second[std::abs(k)];
    }
    const auto A0 = circulant(pairing.a0, n), A1 = circulant(pairing.a1, n), A2 = circulant(pairing.a2, n);
    for (int k = 0; k < n; ++k)
    {
      EXPECT_NEAR(A0[k], k == 0, 1e-13);
      EXPECT_NEAR(A1[k] / n, G1[k], 1e-13);
      EXPECT_NEAR(A2[k] / n / n, G2[k], 1e-13);
    }
  }
}

TEST(TimePairing, MomentsOfTheForce)
{
  const dealii::QGauss<1> rule(24);
  for (const auto &name : {"fourier", "bspline", "haar"})
    for (const unsigned int n : {1, 2, 3, 4, 7, 16})
    {
      const auto basis = create_time_basis(name, n);
      const auto pairing = pair("fourier", name, n, 0, TimeForm::strong);
      for (unsigned int m = 0; m < n_orders(n); ++m)
      {
        Complex sine = 0, cosine = 0;
        for (unsigned int cell = 0; cell < n; ++cell)
          for (unsigned int q = 0; q < rule.size(); ++q)
          {
            const double t = (cell + rule.point(q)[0]) / n;
            const Complex psi = rule.weight(q) / n * std::conj(basis->value(m, t, 0));
            sine += psi * std::sin(2 * pi * t);
            cosine += psi * std::cos(2 * pi * t);
          }
        EXPECT_LT(std::abs(sine - pairing.sine[m]), 1e-13) << name << n << " " << m;
        EXPECT_LT(std::abs(cosine - pairing.cosine[m]), 1e-13) << name << n << " " << m;
      }
    }
}

TEST(TimePairing, HaarByFourierIsCollocationAtTheCentres)
{
  for (const int n : {5, 9, 63})
  {
    const auto haar = create_time_basis("haar", n);
    const auto pairing = pair("haar", "fourier", n);
    for (int m = 0; 2 * m < n; ++m)
    {
      const double x = pi * m / n, sinc = m == 0 ? 1 : std::sin(x) / x;
      // b_m = a_m e^(-j pi m / N) are the coefficients of the trigonometric polynomial through the values at the centres
      const Complex turn = std::polar(1., -x);
      for (int k = 0; k < n; ++k)
      {
        const double centre = (k + 0.5) / n;
        EXPECT_LT(std::abs(haar->value(m, centre, 0) - turn * std::polar(1., 2 * pi * m * centre)), 1e-12);
        // a force constant on the cell k: its moment is sinc times the discrete one at the centre, and cancels
        const auto moment = std::conj(std::polar(1., 2 * pi * m * centre)) * sinc / double(n);
        EXPECT_LT(std::abs(moment - (m == 0 ? Complex(1. / n)
                                            : (std::polar(1., -2 * pi * m * (k + 1.) / n) -
                                               std::polar(1., -2 * pi * m * k / double(n))) /
                                                  Complex(0, -2 * pi * m))),
                  1e-13);
      }
      // so that the harmonic force is divided by sinc(pi/N)
      EXPECT_LT(std::abs(pairing.a0[m] - sinc * turn), 1e-14);
      EXPECT_LT(std::abs(pairing.a1[m] - Complex(0, 2 * pi * m) * sinc * turn), 1e-12 * n);
      EXPECT_LT(std::abs(pairing.a2[m] + 4 * pi * pi * m * m * sinc * turn), 1e-12 * n * n);
      EXPECT_LT(std::abs(pairing.sine[m] - (m == 1 ? Complex(0, -0.5) : 0.)), 1e-15);
    }
  }
}

TEST(TimePairing, StiffnessOfDaubechies6IsTooLarge)
{
  const unsigned int n = 1024;
  const auto pairing = pair("daubechies6", "daubechies6", n, 0, TimeForm::weak);
  double worst = 0;
  for (unsigned int m = 1; m <= n / 2; ++m)
    worst = std::max(worst, std::sqrt(-pairing.a2[m].real() / pairing.a0[m].real()) / (2 * pi * m));
  EXPECT_NEAR(worst, 1.34, 0.01);
  // and undamped at Nyquist
  EXPECT_LT(std::abs(pairing.a1[n / 2]), 1e-10 * n);
  // the error falls with the fourth power of the cell
  const auto error = [&](const unsigned int m)
  { return std::sqrt(-pairing.a2[m].real()) / (2 * pi * m) - 1; };
  EXPECT_LT(error(16), 1e-5);
  EXPECT_NEAR(std::log2(error(32) / error(16)), 4, 0.02);
}

TEST(TimePairing, SymmetricSplinesMissNyquistOnCommonKnots)
{
  for (const unsigned int n : {2, 8, 64})
  {
    const auto haar = pair("haar", "bspline", n), fourier = pair("fourier", "bspline", n);
    for (const TimePairing &pairing : {haar, fourier})
    {
      EXPECT_LT(std::abs(pairing.a0.back()), 1e-14);
      EXPECT_LT(std::abs(pairing.a2.back()), 1e-13 * n * n);
      EXPECT_GT(std::abs(pairing.a1.back()), 0.1 * n);
    }
    // Haar's own first derivative by Fourier's lone sine vanishes instead
    EXPECT_LT(std::abs(pair("haar", "fourier", n).a1.back()), 1e-13 * n);
    EXPECT_NEAR(pair("haar", "fourier", n).a0.back().real(), 2 / pi, 1e-14);
  }
  EXPECT_GT(std::abs(pair("haar", "bspline", 9).a0.back()), 0.03);
}

TEST(TimePairing, Admissibility)
{
  // strong, weak, distributional
  const std::vector<std::tuple<std::string, std::string, std::vector<bool>>> table{
      {"fourier", "fourier", {true, true, true}},
      {"bspline", "bspline", {true, true, true}},
      {"daubechies6", "daubechies6", {true, true, true}},
      {"haar", "fourier", {false, false, true}},
      {"daubechies6", "fourier", {false, true, true}},
      {"haar", "bspline", {false, false, true}},
      {"fourier", "haar", {true, false, false}},
      {"haar", "haar", {false, false, false}},
      {"haar", "daubechies6", {false, false, false}},
      {"daubechies6", "daubechies8", {false, true, false}},
      {"haar", "daubechies10", {false, false, true}},
      {"bspline", "daubechies6", {true, true, false}}};
  for (const auto &[trial, weighting, expected] : table)
    for (unsigned int i = 0; i < 3; ++i)
      EXPECT_EQ(admissible(*create_time_basis(trial, 8), *create_time_basis(weighting, 8), forms[i]),
                expected[i])
          << trial << ":" << weighting << " " << name_of(forms[i]);
  try
  {
    pair("haar", "bspline", 8, 0, TimeForm::weak);
    FAIL();
  }
  catch (const InputError &error)
  {
    EXPECT_EQ(std::string(error.what()),
              "The pair haar:bspline is not admissible in the weak form: it takes the first derivative of "
              "the trial "
              "functions haar, which is not square-integrable; choose the form distributional.");
  }
  const auto db6 = create_time_basis("daubechies6", 8), fourier = create_time_basis("fourier", 8);
  EXPECT_FALSE(admissible(*db6, *db6, TimeForm::strong, 256));
  EXPECT_TRUE(admissible(*db6, *db6, TimeForm::weak, 256));
  EXPECT_FALSE(admissible(*db6, *create_time_basis("fourier", 9), TimeForm::weak));
  EXPECT_FALSE(admissible(*create_time_basis("haar", 9), *create_time_basis("fourier", 9),
                          TimeForm::distributional, 256));
  EXPECT_FALSE(admissible(*fourier, *fourier, TimeForm::weak, 15));
  EXPECT_THROW(time_form("mild"), InputError);
  for (const TimeForm form : forms)
    EXPECT_EQ(time_form(name_of(form)), form);
}

TEST(TimePairing, LeftPoints)
{
  // trigonometric products are summed exactly, also where the points are no multiple
  for (const unsigned int n : {1, 2, 8, 63, 127})
    for (const TimeForm form : forms)
    {
      const auto exact = pair("fourier", "fourier", n), sums = pair("fourier", "fourier", n, 256, form);
      for (unsigned int m = 0; m < n_orders(n); ++m)
      {
        EXPECT_LT(std::abs(exact.a0[m] - sums.a0[m]), 1e-13);
        EXPECT_LT(std::abs(exact.a1[m] - sums.a1[m]), 1e-12 * n);
        EXPECT_LT(std::abs(exact.a2[m] - sums.a2[m]), 1e-12 * n * n);
        EXPECT_LT(std::abs(exact.sine[m] - sums.sine[m]), 1e-13);
        EXPECT_LT(std::abs(exact.norm[m] - sums.norm[m]), 1e-13);
      }
    }
  // Haar is moved by half a sample
  {
    const auto exact = pair("haar", "fourier", 32), sums = pair("haar", "fourier", 32, 256);
    for (unsigned int m = 1; m < 16; ++m)
      EXPECT_NEAR(std::arg(sums.a0[m] / exact.a0[m]), pi * m / 256, 1e-12);
  }
  // the others tend to the exact integrals, slowly: 256 points are 4 on a cell of 64
  for (const auto &[trial, weighting, form] :
       {std::tuple<std::string, std::string, TimeForm>{"bspline", "bspline", TimeForm::weak},
        {"bspline", "bspline", TimeForm::distributional},
        {"daubechies6", "daubechies6", TimeForm::weak},
        {"daubechies6", "fourier", TimeForm::distributional},
        {"haar", "bspline", TimeForm::distributional}})
  {
    double error[2];
    for (const unsigned int i : {0, 1})
    {
      const unsigned int n = 64;
      const auto exact = pair(trial, weighting, n),
                 sums = pair(trial, weighting, n, i == 0 ? 256 : 4096, form);
      error[i] = 0;
      for (unsigned int m = 0; m < n_orders(n); ++m)
        error[i] = std::max(error[i], std::abs(exact.a2[m] - sums.a2[m]) / std::pow(pi * n, 2));
    }
    EXPECT_LT(error[1], 0.6 * error[0]) << trial << ":" << weighting << " " << name_of(form);
    RecordProperty(trial + "_" + weighting, std::to_string(error[0]) + " " + std::to_string(error[1]));
  }
}
