#include <vibrocontact/bodies/passivity_test.h>
#include <vibrocontact/numerics/eigenvalues.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  using Complex = std::complex<double>;

  namespace
  {
    /// |Re s| / |s| up to which an eigenvalue may lie on the axis; eigenvalue of Im G over |G| that is round-off
    constexpr double near_axis = 1e-3, rounding = 1e-14;

    /// z = a + j b of a pole as real states; b stays zero of a real pole under real shapes.
    struct RealStates
    {
      DenseMatrix A, B, C;
    };

    RealStates real_states(const BodyInContact &body)
    {
      const unsigned int n = body.n_rows();
      std::vector<bool> has_second;
      unsigned int n_states = 0;
      for (unsigned int k = 0; k < body.n_poles(); ++k)
      {
        bool real = body.poles[k].imag() == 0;
        for (unsigned int i = 0; i < n; ++i)
          real = real && body.left(i, k).imag() == 0;
        has_second.push_back(!real);
        n_states += real ? 1 : 2;
      }
      RealStates result{DenseMatrix(n_states, n_states), DenseMatrix(n_states, n), DenseMatrix(n, n_states)};
      unsigned int a = 0;
      for (unsigned int k = 0; k < body.n_poles(); ++k)
      {
        result.A(a, a) = body.poles[k].real();
        for (unsigned int i = 0; i < n; ++i)
        {
          result.B(a, i) = body.left(i, k).real();
          result.C(i, a) = 2 * body.right(i, k).real();
        }
        if (has_second[k])
        {
          result.A(a + 1, a + 1) = body.poles[k].real();
          result.A(a + 1, a) = body.poles[k].imag();
          result.A(a, a + 1) = -body.poles[k].imag();
          for (unsigned int i = 0; i < n; ++i)
          {
            result.B(a + 1, i) = body.left(i, k).imag();
            result.C(i, a + 1) = -2 * body.right(i, k).imag();
          }
        }
        a += has_second[k] ? 2 : 1;
      }
      return result;
    }

    /// Finite eigenvalues of the pencil.
    std::vector<Complex> pencil_eigenvalues(const RealStates &states, const double shift)
    {
      const unsigned int N = states.A.m(), n = states.B.n();
      DenseMatrix M(2 * N + n, 2 * N + n), E(2 * N + n, 2 * N);
      for (unsigned int i = 0; i < N; ++i)
      {
        for (unsigned int j = 0; j < N; ++j)
        {
          M(i, j) = states.A(i, j);
          M(N + i, N + j) = -states.A(j, i);
        }
        for (unsigned int j = 0; j < n; ++j)
        {
          M(i, 2 * N + j) = M(2 * N + j, N + i) = states.B(i, j);
          M(N + i, 2 * N + j) = M(2 * N + j, i) = states.C(j, i);
        }
      }
      for (unsigned int i = 0; i < 2 * N; ++i)
      {
        M(i, i) -= shift;
        E(i, i) = 1;
      }
      M.compute_lu_factorization();
      M.solve(E);
      DenseMatrix inverse(2 * N, 2 * N);
      for (unsigned int i = 0; i < 2 * N; ++i)
        for (unsigned int j = 0; j < 2 * N; ++j)
          inverse(i, j) = E(i, j);
      std::vector<Complex> result;
      for (const Complex &value : general_eigenvalues(inverse))
        if (std::abs(value) > 0)
          result.push_back(shift + 1. / value);
      return result;
    }

    bool gives_energy(const BodyInContact &body, const double omega)
    {
      const ComplexMatrix G = receptance(body, omega);
      DenseMatrix imaginary(G.m(), G.n()), vectors;
      double size = 0;
      for (unsigned int i = 0; i < G.m(); ++i)
        for (unsigned int j = 0; j < G.n(); ++j)
        {
          imaginary(i, j) = G(i, j).imag();
          size += std::norm(G(i, j));
        }
      return symmetric_eigenvalues(imaginary, vectors).back() > rounding * std::sqrt(size);
    }
  } // namespace

  PassivityTest test_passivity(const BodyInContact &body)
  {
    PassivityTest result;
    if (body.n_poles() == 0)
      return result;
    double least = std::abs(body.poles.front()), largest = least;
    for (const Complex &pole : body.poles)
    {
      least = std::min(least, std::abs(pole));
      largest = std::max(largest, std::abs(pole));
    }
    for (const Complex &s : pencil_eigenvalues(real_states(body), 1.37 * std::sqrt(least * largest)))
      if (s.imag() > 0 && std::abs(s.real()) < near_axis * std::abs(s))
        result.crossings.push_back(s.imag());
    std::sort(result.crossings.begin(), result.crossings.end());
    std::vector<double> ends = result.crossings;
    ends.insert(ends.begin(), ends.empty() ? least : ends.front() / 4);
    ends.push_back(ends.back() * 4);
    // below the first, between two, beyond the last
    for (unsigned int k = 0; k + 1 < ends.size(); ++k)
    {
      const double middle = std::sqrt(ends[k] * ends[k + 1]);
      if (gives_energy(body, middle))
        result.active.push_back(middle);
    }
    return result;
  }
} // namespace vibrocontact
