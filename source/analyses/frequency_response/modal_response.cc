#include <vibrocontact/analyses/frequency_response/modal_response.h>
#include <vibrocontact/base/complex_dense.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/numerics/complex_eigenvectors.h>
#include <vibrocontact/numerics/lu_factors.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace vibrocontact
{
  using Complex = std::complex<double>;

  namespace
  {
    const double two_pi = 2 * dealii::numbers::PI;

    using Indices = std::vector<unsigned int>;

    /// static answer of what is left out by keeping some vectors, without loss
    Receptance real_residual(const ResponseReduction &body, const Indices &kept)
    {
      const unsigned int m = body.trace.m();
      Receptance result(m * m);
      for (unsigned int i = 0; i < m; ++i)
        for (unsigned int j = 0; j < m; ++j)
        {
          double sum = body.compliance(i, j);
          for (const unsigned int k : kept)
            if (k >= body.n_rigid_modes)
              sum -= body.trace(i, k) * body.trace(j, k) / (body.omega[k] * body.omega[k]);
          result[i * m + j] = sum;
        }
      return result;
    }

    Indices first_modes(const unsigned int n)
    {
      Indices result(n);
      std::iota(result.begin(), result.end(), 0);
      return result;
    }
  } // namespace

  void solve_by_columns(std::vector<Complex> A, std::vector<Complex> &B)
  {
    LuFactors<Complex> factors;
    if (!factors.factorise(std::move(A)))
      throw ConvergenceError(
          "Frequency response: the equations at a frequency are singular: leave it out, or "
          "give the bodies damping.");
    factors.solve(B);
  }

  void check_reach_of_modes(const double highest, const std::string &body, const double upper_frequency,
                            const std::string &entry)
  {
    constexpr double usable = 0.75;
    if (highest > usable * upper_frequency * (1 + 1e-9))
      throw InputError("Frequency response/Method is modal and asks for " + number_text(highest) + " Hz of " +
                       body + ", whose modes reach to " + number_text(upper_frequency) +
                       " Hz, but are good for 3/4 of it, " + number_text(usable * upper_frequency) +
                       " Hz: raise " + body + "/Modes/" + entry + ", ask for less, or set Method to direct.");
  }

  unsigned int modes_below(const ResponseReduction &body, const double highest)
  {
    const auto begin = body.omega.begin(), end = begin + body.damping_ratio.size();
    return (highest > 0 ? std::lower_bound(begin, end, two_pi * highest) : end) - begin;
  }

  Receptance static_residual(const ResponseReduction &body, const unsigned int n_modes)
  {
    return real_residual(body, first_modes(n_modes));
  }

  namespace
  {
    /// P A^-1 P^T beside the residual flexibility, P the traces of the kept modes.
    /// @param entry of A between two of the body's modes at a frequency [Hz]: (k, l, f)
    template <typename Entry>
    std::vector<Receptance> coupled_response(const ResponseReduction &body, const Indices &kept,
                                             const std::vector<double> &frequency, const Entry &entry)
    {
      const unsigned int m = body.trace.m(), n = kept.size();
      std::vector<Complex> A(std::size_t(n) * n), forces(std::size_t(n) * m), q;
      for (unsigned int j = 0; j < m; ++j)
        for (unsigned int i = 0; i < n; ++i)
          forces[std::size_t(j) * n + i] = body.trace(j, kept[i]);
      const Receptance residual = real_residual(body, kept);
      std::vector<Receptance> result;
      for (const double f : frequency)
      {
        for (unsigned int j = 0; j < n; ++j)
          for (unsigned int i = 0; i < n; ++i)
            A[std::size_t(j) * n + i] = entry(kept[i], kept[j], f);
        q = forces;
        solve_by_columns(A, q);
        Receptance H = residual;
        for (unsigned int i = 0; i < m; ++i)
          for (unsigned int j = 0; j < m; ++j)
            for (unsigned int k = 0; k < n; ++k)
              H[i * m + j] += forces[std::size_t(i) * n + k] * q[std::size_t(j) * n + k];
        result.push_back(H);
      }
      return result;
    }

    /// The same with forces by the velocity: (diag(w^2) + i D + i omega (C + 2 Omega G) - omega^2) q = P^T f.
    std::vector<Receptance> response_with_rates(const ResponseReduction &body, const Indices &kept,
                                                const std::vector<double> &frequency, const double rotation)
    {
      return coupled_response(body, kept, frequency,
                              [&](const unsigned int k, const unsigned int l, const double f)
                              {
                                const double omega = two_pi * f;
                                double by_rate = body.damping.m() > 0 ? body.damping(k, l) : 0.;
                                if (rotation != 0)
                                  by_rate += 2 * rotation * body.gyroscopic(k, l);
                                return Complex(k == l ? body.omega[k] * body.omega[k] - omega * omega : 0.,
                                               body.loss(k, l) + omega * by_rate);
                              });
    }
  } // namespace

  std::vector<Receptance> hysteretic_response(const ResponseReduction &body, const unsigned int n_modes,
                                              const std::vector<double> &frequency, const double rotation)
  {
    Indices kept = first_modes(n_modes);
    for (unsigned int k = body.damping_ratio.size(); k < body.omega.size(); ++k)
      kept.push_back(k);
    const unsigned int m = body.trace.m();
    const unsigned int n = kept.size();
    if (n == 0)
      return std::vector<Receptance>(frequency.size(), real_residual(body, kept));

    if (body.damping.m() > 0 || rotation != 0)
      return response_with_rates(body, kept, frequency, rotation);

    // diag(w^2) + i D = X diag(mu) X^-1; P X and X^-1 P^T
    ComplexMatrix A(n, n);
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int i = 0; i < n; ++i)
        A(i, j) =
            Complex(i == j ? body.omega[kept[i]] * body.omega[kept[i]] : 0., body.loss(kept[i], kept[j]));
    const ComplexEigenvectors basis = complex_eigenvectors(A, "eigenvalues of the complex modal stiffness");
    std::vector<Complex> shapes(std::size_t(m) * n), weights(shapes.size());
    for (unsigned int i = 0; i < m; ++i)
      for (unsigned int k = 0; k < n; ++k)
        for (unsigned int l = 0; l < n; ++l)
        {
          shapes[std::size_t(i) * n + k] += body.trace(i, kept[l]) * Complex(basis.right(l, k));
          weights[std::size_t(i) * n + k] += Complex(basis.left(k, l)) * body.trace(i, kept[l]);
        }
    const Receptance residual = real_residual(body, kept);
    std::vector<Receptance> result;
    for (const double f : frequency)
    {
      const double square = std::pow(two_pi * f, 2);
      Receptance H = residual;
      for (unsigned int i = 0; i < m; ++i)
        for (unsigned int j = 0; j < m; ++j)
          for (unsigned int k = 0; k < n; ++k)
            H[i * m + j] +=
                shapes[std::size_t(i) * n + k] * weights[std::size_t(j) * n + k] / (basis.values[k] - square);
      result.push_back(H);
    }
    return result;
  }

  std::vector<Receptance> time_domain_response(const ResponseReduction &body, const unsigned int n_modes,
                                               const std::vector<double> &frequency, const double rotation)
  {
    if (rotation != 0)
      return coupled_response(body, first_modes(n_modes), frequency,
                              [&](const unsigned int k, const unsigned int l, const double f)
                              {
                                const double omega = two_pi * f, own = body.omega[k];
                                const Complex coriolis(0, 2 * rotation * omega * body.gyroscopic(k, l));
                                return k != l ? coriolis
                                              : Complex(own * own - omega * omega,
                                                        2 * body.damping_ratio[k] * own * omega);
                              });
    const unsigned int m = body.trace.m();
    const Receptance residual = static_residual(body, n_modes);
    std::vector<Receptance> result;
    for (const double f : frequency)
    {
      const double omega = two_pi * f;
      Receptance H = residual;
      for (unsigned int k = 0; k < n_modes; ++k)
      {
        const double own = body.omega[k];
        const Complex gain = 1. / Complex(own * own - omega * omega, 2 * body.damping_ratio[k] * own * omega);
        for (unsigned int i = 0; i < m; ++i)
          for (unsigned int j = 0; j < m; ++j)
            H[i * m + j] += body.trace(i, k) * body.trace(j, k) * gain;
      }
      result.push_back(H);
    }
    return result;
  }

  std::vector<Receptance> wave_response(const ResponseReduction &body, const WaveRotation &rotation,
                                        const int sense, const bool hysteretic, const unsigned int n_modes,
                                        const std::vector<double> &frequency)
  {
    Indices kept = first_modes(n_modes);
    for (unsigned int k = body.damping_ratio.size(); k < body.omega.size() && hysteretic; ++k)
      kept.push_back(k);
    const double Omega = rotation.speed;
    return coupled_response(
        body, kept, frequency,
        [&](const unsigned int k, const unsigned int l, const double f)
        {
          const double omega = two_pi * f, material = omega - sense * double(rotation.n_waves) * Omega,
                       sign = material < 0 ? -1. : 1.;
          Complex entry =
              Omega * Omega * rotation.of_square(k, l) + 2 * sense * Omega * omega * rotation.coriolis(k, l);
          if (hysteretic)
            entry += Complex(0, sign * body.loss(k, l));
          if (k == l)
            entry += Complex(body.omega[k] * body.omega[k] - omega * omega,
                             hysteretic ? 0. : 2 * body.damping_ratio[k] * body.omega[k] * material);
          return entry;
        });
  }
} // namespace vibrocontact
