#include <vibrocontact/numerics/delay.h>
#include <vibrocontact/numerics/vector_fitting.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace vibrocontact
{
  using Complex = std::complex<double>;

  namespace
  {
    constexpr unsigned int most_lines = 500, most_pairs = 40, lines_per_pair = 10;

    /// Orthonormal columns of what real modes and a constant can be: Gram and Schmidt, twice; columns that the
    /// others hold are left out.
    class RealModes
    {
    public:
      RealModes(const std::vector<double> &omega, const std::vector<Complex> &poles)
      {
        const unsigned int n = omega.size();
        const DenseMatrix basis = pole_basis(omega, poles);
        std::vector<double> column(2 * n, 0.);
        std::fill_n(column.begin(), n, 1.);
        add(column);
        for (unsigned int k = 0, c = 0; k < poles.size(); ++k)
        {
          c += poles[k].imag() == 0 ? 1 : 2;
          if (poles[k].imag() == 0)
            continue;
          for (unsigned int l = 0; l < 2 * n; ++l)
            column[l] = basis(l, c - 1);
          add(column);
        }
      }

      /// Part of a vector that they cannot have, over the whole.
      double distance(const std::vector<double> &vector) const
      {
        double rest = product(vector, vector);
        const double whole = rest;
        for (const std::vector<double> &column : columns)
          rest -= std::pow(product(column, vector), 2);
        return std::sqrt(std::max(rest, 0.) / whole);
      }

    private:
      static double product(const std::vector<double> &a, const std::vector<double> &b)
      {
        double sum = 0;
        for (unsigned int l = 0; l < a.size(); ++l)
          sum += a[l] * b[l];
        return sum;
      }

      void add(std::vector<double> column)
      {
        const double size = std::sqrt(product(column, column));
        for (unsigned int pass = 0; pass < 2; ++pass)
          for (const std::vector<double> &other : columns)
          {
            const double share = product(other, column);
            for (unsigned int l = 0; l < column.size(); ++l)
              column[l] -= share * other[l];
          }
        const double left = std::sqrt(product(column, column));
        if (!(left > 1e-7 * size))
          return;
        for (double &value : column)
          value /= left;
        columns.push_back(column);
      }

      std::vector<std::vector<double>> columns;
    };
  } // namespace

  std::optional<DelayEstimate> estimate_delay(const std::vector<double> &omega,
                                              const std::vector<Complex> &response)
  {
    Spectra lines;
    lines.values.resize(1);
    const std::size_t stride = (omega.size() + most_lines - 1) / most_lines;
    for (std::size_t l = 0; l < omega.size(); l += stride)
    {
      lines.omega.push_back(omega[l]);
      lines.values[0].push_back(response[l]);
    }
    const unsigned int n = lines.omega.size(), n_pairs = std::min(most_pairs, n / lines_per_pair);
    if (n_pairs < 3)
      return {};
    VectorFittingOptions options;
    options.n_iterations = 10;
    const RealModes modes(lines.omega, vector_fit(lines, n_pairs, options).poles);

    const auto error = [&](const double delay)
    {
      std::vector<double> turned(2 * n);
      for (unsigned int l = 0; l < n; ++l)
      {
        const Complex value = lines.values[0][l] * std::polar(1., lines.omega[l] * delay);
        turned[l] = value.real();
        turned[n + l] = value.imag();
      }
      return modes.distance(turned);
    };
    // two turns at the end of the band, in steps of a fiftieth of one
    const double step = 2 * M_PI / (50 * lines.omega.back());
    DelayEstimate result;
    result.error = result.error_without = error(0);
    for (int k = -100; k <= 100; ++k)
      if (const double here = error(k * step); here < result.error)
      {
        result.error = here;
        result.delay = k * step;
      }
    // golden section between the neighbours
    double left = result.delay - step, right = result.delay + step;
    const double ratio = (std::sqrt(5.) - 1) / 2;
    for (unsigned int round = 0; round < 40; ++round)
    {
      const double a = right - ratio * (right - left), b = left + ratio * (right - left);
      (error(a) < error(b) ? right : left) = error(a) < error(b) ? b : a;
    }
    result.delay = (left + right) / 2;
    result.error = error(result.delay);
    return result;
  }
} // namespace vibrocontact
