#include <vibrocontact/base/named_table.h>
#include <vibrocontact/numerics/time_basis.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
    using Complex = std::complex<double>;
    const double pi = std::acos(-1.);

    double fraction(const double phase)
    {
      const double rest = phase - std::floor(phase);
      return rest < 1 ? rest : 0.;
    }

    class FourierBasis : public TimeBasis
    {
    public:
      explicit FourierBasis(const unsigned int n) : TimeBasis(n) {}
      std::string name() const override { return "fourier"; }
      unsigned int n_derivatives() const override { return smooth; }

      std::vector<Complex> values(const double phase, const unsigned int d) const override
      {
        const unsigned int size = n_orders(n);
        const double t = fraction(phase);
        std::vector<Complex> result(size, 1.);
        if (size > 1)
          result[1] = std::polar(1., 2 * pi * t);
        // products of halves: round-off grows with the logarithm of m
        for (unsigned int m = 2; m < size; ++m)
          result[m] = result[m / 2] * result[m - m / 2];
        for (unsigned int m = 0; d > 0 && m < size; ++m)
          result[m] *= factor(m, d);
        if (n % 2 == 0)
          result.back() = sine(t, d);
        return result;
      }

      Complex fourier_coefficient(const unsigned int m, const int l) const override
      {
        if (2 * m == n)
          return l == 0 ? Complex(0, -0.5) : l == -1 ? Complex(0, 0.5) : 0.;
        return l == 0 ? 1. : 0.;
      }

      double function(const unsigned int k, const double phase, const unsigned int d) const override
      {
        const unsigned int m = (k + 1) / 2;
        if (n % 2 == 0 && k == n - 1)
          return sine(fraction(phase), d);
        const Complex value = values(phase, d)[m];
        return k == 0 || k % 2 == 1 ? value.real() : value.imag();
      }

    private:
      /// (2 pi j m)^d
      static Complex factor(const unsigned int m, const unsigned int d)
      {
        Complex result = 1;
        for (unsigned int i = 0; i < d; ++i)
          result *= Complex(0, 2 * pi * m);
        return result;
      }
      double sine(const double t, const unsigned int d) const
      {
        return (factor(n / 2, d) * std::polar(1., pi * n * t)).imag();
      }
    };

    class WaveletBasis : public TimeBasis
    {
    public:
      WaveletBasis(std::string name, RefinableFunction phi_, const unsigned int n)
          : TimeBasis(n), title(std::move(name)), phi(std::move(phi_)),
            // the largest integer below the exponent
            n_square_integrable(std::ceil(phi.smoothness() - 1e-6) - 1)
      {
        for (unsigned int k = 0; k < n; ++k)
          roots.push_back(std::polar(1., 2 * pi * k / n));
      }
      std::string name() const override { return title; }
      unsigned int n_derivatives() const override { return n_square_integrable; }
      bool is_dyadic() const override { return title.rfind("daubechies", 0) == 0; }
      const RefinableFunction *scaling_function() const override { return &phi; }

      std::vector<Complex> values(const double phase, const unsigned int d) const override
      {
        const auto [cell, v] = local_values(phase, d);
        std::vector<Complex> result(n_orders(n), 0.);
        for (unsigned int i = 0; i < v.size(); ++i)
        {
          const unsigned int k = shift(cell, i);
          unsigned int root = 0;
          for (Complex &value : result)
          {
            value += v[i] * roots[root];
            root += k;
            if (root >= n)
              root -= n;
          }
        }
        if (n % 2 == 0)
          result.back() = result.back().real();
        return result;
      }

      Complex fourier_coefficient(const unsigned int m, const int l) const override
      {
        return phi.fourier_transform(2 * pi * (static_cast<double>(m) / n + l));
      }

      double function(const unsigned int k, const double phase, const unsigned int d) const override
      {
        const auto [cell, v] = local_values(phase, d);
        double result = 0;
        for (unsigned int i = 0; i < v.size(); ++i)
          result += v[i] * coefficient((shift(cell, i) + n - k) % n);
        return n * result;
      }

    protected:
      /// theta_k of the figures is the sum of N phi(N t - k - i) times this, i = 0..N-1
      virtual double coefficient(const unsigned int i) const { return i == 0; }

    private:
      /// N t = cell + x; phi^(d)(x + i) N^d
      std::pair<unsigned int, std::vector<double>> local_values(const double phase,
                                                                const unsigned int d) const
      {
        if (!phi.has_values(d))
          throw InputError("The functions " + title + " have no point values of derivative " +
                           std::to_string(d) +
                           "; choose exact integrals, another form, or smoother functions.");
        double x = n * fraction(phase);
        // k / N is rounded: samples on a knot have to stay there
        const double grid = std::ldexp(1., 20), nearest = std::round(x * grid) / grid;
        if (std::abs(x - nearest) < 1e-11)
          x = nearest;
        const double cell = std::floor(x);
        std::vector<double> v = phi.values(x - cell, d);
        for (unsigned int i = 0; i < d; ++i)
          for (double &value : v)
            value *= n;
        return {static_cast<unsigned int>(cell) % n, v};
      }
      /// k of the function whose argument is x + i in this cell
      unsigned int shift(const unsigned int cell, const unsigned int i) const
      {
        return (cell + n - i % n) % n;
      }

      const std::string title;
      const RefinableFunction phi;
      const unsigned int n_square_integrable;
      /// e^(2 pi j k / N)
      std::vector<Complex> roots;
    };

    /// Cubic splines; their figures show the orthogonal ones, whose coefficients c_k = 1/pi int_0^pi cos(k x) /
    /// sqrt(p_3(cos x)) dx are wrapped around the period.
    class CubicSplineBasis : public WaveletBasis
    {
    public:
      explicit CubicSplineBasis(const unsigned int n) : WaveletBasis("bspline", b_spline(4), n) {}

    private:
      double coefficient(const unsigned int i) const override
      {
        // sum over all k = i + l N of c_k: p_3 at the N points only
        double sum = 0;
        for (unsigned int m = 0; m < n; ++m)
        {
          const double x = 2 * pi * m / n, y = std::cos(x);
          sum += std::cos(i * x) / std::sqrt((((y + 60) * y + 297) * y + 272) / 630);
        }
        return sum / n;
      }
    };

    constexpr unsigned int first_daubechies = 6, last_daubechies = 38;

    template <typename Basis>
    std::unique_ptr<const TimeBasis> create(const unsigned int n)
    {
      return std::make_unique<Basis>(n);
    }
  } // namespace

  Complex TimeBasis::value(const unsigned int m, const double phase, const unsigned int d) const
  {
    return values(phase, d).at(m);
  }

  const TimeBases &time_bases()
  {
    static const TimeBases table = []
    {
      TimeBases entries{
          {"fourier", "1, cos, sin: harmonic balance", create<FourierBasis>},
          {"bspline", "cubic splines, two continuous derivatives", create<CubicSplineBasis>},
          {"haar", "constant on each of N equal parts of the period",
           [](const unsigned int n) { return std::make_unique<WaveletBasis>("haar", b_spline(1), n); }},
      };
      for (unsigned int n = first_daubechies; n <= last_daubechies; n += 2)
        entries.push_back({"daubechies" + std::to_string(n),
                           "Daubechies' scaling function of " + std::to_string(n) +
                               " coefficients (elsewhere db" + std::to_string(n / 2) + ")",
                           [length = n](const unsigned int number)
                           {
                             return std::make_unique<WaveletBasis>("daubechies" + std::to_string(length),
                                                                   daubechies(length), number);
                           }});
      return entries;
    }();
    return table;
  }

  std::unique_ptr<const TimeBasis> create_time_basis(const std::string &name, const unsigned int n,
                                                     const TimeBases &table)
  {
    if (n == 0)
      throw InputError("A basis in time needs at least one function; " + name + " was given 0.");
    return find_named(table, name, "basis in time").create(n);
  }

  DenseMatrix sampled(const TimeBasis &basis, const std::vector<double> &phases, const unsigned int d)
  {
    const unsigned int n = basis.n_functions();
    DenseMatrix result(phases.size(), n);
    // columns lie far apart: a few samples at a time into each
    constexpr unsigned int n_block = 16;
    std::vector<std::vector<Complex>> theta(n_block);
    for (unsigned int begin = 0; begin < phases.size(); begin += n_block)
    {
      const unsigned int end = std::min<unsigned int>(begin + n_block, phases.size());
      for (unsigned int i = begin; i < end; ++i)
        theta[i - begin] = basis.values(phases[i], d);
      for (unsigned int m = 0; m < n_orders(n); ++m)
        for (unsigned int i = begin; i < end; ++i)
        {
          const Complex value = theta[i - begin][m];
          if (m == 0)
            result(i, 0) = value.real();
          else if (2 * m == n)
            result(i, n - 1) = value.real();
          else
          {
            result(i, 2 * m - 1) = 2 * value.real();
            result(i, 2 * m) = -2 * value.imag();
          }
        }
    }
    return result;
  }
} // namespace vibrocontact
