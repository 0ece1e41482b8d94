#pragma once

#include <vibrocontact/base/dense.h>
#include <vibrocontact/numerics/refinable_function.h>

#include <complex>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// N functions on the circle of phases [0, 1), written so that every basis looks like Fourier's (Jones &
  /// Legrand 2014, section 3; doc/theory.md, "Periodic motion").
  ///
  /// The scaling functions of a wavelet, theta_k(t) = N sum_l phi(N (t - l) - k), k = 0..N-1, are shifts of one
  /// function by 1/N. Their discrete Fourier transform
  ///
  ///   Theta_m(t) = 1/N sum_k e^(2 pi j m k / N) theta_k(t) = sum_l phi^(2 pi (m + l N) / N) e^(2 pi j (m + l N) t)
  ///
  /// (phi^ the Fourier transform of phi, phi^(0) = 1) is multiplied by e^(2 pi j m / N) by such a shift, so that
  /// Theta_m of one basis is orthogonal to Theta_m' of any other unless m = m': every weighted residual is
  /// diagonal in m. Fourier's own Theta_m is e^(2 pi j m t). A real motion is
  ///
  ///   u(t) = a_0 Theta_0 + sum_{0 < m < N/2} 2 Re(a_m Theta_m) [+ a_{N/2} Theta_{N/2} if N is even]
  ///
  /// and stands in real arrays as [a_0, Re a_1, Im a_1, ..., (a_{N/2})], N numbers. Theta_{N/2} is real; of Fourier's
  /// basis it is sin(pi N t), as cos(pi N t) is orthogonal to every function that is constant on the cells [k/N,
  /// (k+1)/N). The spaces are those of the usual functions, so the solution is theirs.
  class TimeBasis
  {
  public:
    virtual ~TimeBasis() = default;

    /// fourier, bspline, daubechies6 (daubechies8, ...), haar
    virtual std::string name() const = 0;
    unsigned int n_functions() const { return n; }
    /// how many derivatives are square-integrable: 3 for cubic splines, 0 for Haar, `smooth` for Fourier
    virtual unsigned int n_derivatives() const = 0;
    static constexpr unsigned int smooth = 1000;
    /// whether samples belong at dyadic points, N t 2^k integer: Daubechies' functions have values at every number, but
    /// the derivative of the roughest is continuous only like the 0.09th power of the distance, so that round-off in
    /// other phases is felt
    virtual bool is_dyadic() const { return false; }
    /// phi of a wavelet basis; none for Fourier
    virtual const RefinableFunction *scaling_function() const { return nullptr; }

    /// d-th derivative of every Theta_m with respect to the phase t: n_orders values. @param phase any, of period 1
    /// @throws InputError if that derivative has no point values
    virtual std::vector<std::complex<double>> values(double phase, unsigned int d) const = 0;
    /// of one of them, m = 0..N/2
    std::complex<double> value(unsigned int m, double phase, unsigned int d) const;

    /// int over the period of e^(-2 pi j h t) Theta_m(t) dt, h = m + l N: phi^(2 pi h / N); zero for Fourier unless l = 0
    /// (even N: the last function as above). @param l any integer
    virtual std::complex<double> fourier_coefficient(unsigned int m, int l) const = 0;

    /// Usual functions of the family for figures, k = 0..N-1: theta_k for wavelets, of the cubic spline its orthogonal
    /// companion (paper, Eqs 28-31, the same space); 1, cos, sin, ... for Fourier. d-th derivative at a phase.
    virtual double function(unsigned int k, double phase, unsigned int d) const = 0;

  protected:
    explicit TimeBasis(const unsigned int n) : n(n) {}
    const unsigned int n;
  };

  /// Number of m: N/2 + 1, rounded down.
  inline unsigned int n_orders(const unsigned int n)
  {
    return n / 2 + 1;
  }

  /// One row of the table of bases.
  struct TimeBasisEntry
  {
    std::string name, help;
    /// of so many functions, > 0
    std::function<std::unique_ptr<const TimeBasis>(unsigned int)> create;
  };
  using TimeBases = std::vector<TimeBasisEntry>;
  /// The shipped ones: fourier, bspline, haar, daubechies6 and the other even numbers of coefficients to 38. A program
  /// may have more (run/tables.h).
  const TimeBases &time_bases();

  /// @throws InputError if the name is unknown or n is 0
  std::unique_ptr<const TimeBasis> create_time_basis(const std::string &name, unsigned int n,
                                                     const TimeBases &table = time_bases());

  /// Values of the real functions behind [a_0, Re a_1, Im a_1, ...] at phases: n_phases x N, row-wise samples, d-th
  /// derivative with respect to the phase.
  DenseMatrix sampled(const TimeBasis &basis, const std::vector<double> &phases, unsigned int d);
} // namespace vibrocontact
