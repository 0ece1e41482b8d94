#include <vibrocontact/base/dense_operations.h>
#include <vibrocontact/bodies/passive_fit.h>
#include <vibrocontact/numerics/eigenvalues.h>
#include <vibrocontact/numerics/least_squares.h>
#include <vibrocontact/numerics/nonnegative.h>
#include <vibrocontact/numerics/null_space.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  using Complex = std::complex<double>;

  namespace
  {
    /// of |G|: eigenvalues below count as zero
    constexpr double gain_tolerance = 1e-7;
    constexpr unsigned int most_rounds = 100;

    /// Im G of a fit at one frequency.
    struct ImaginaryPart
    {
      /// ascending eigenvalues over |G|, with their vectors in columns
      std::vector<double> gains;
      DenseMatrix vectors;
      /// |G|, Frobenius [m/N]
      double size = 0;
    };

    ImaginaryPart imaginary_part(const PoleFit &fit, const EntryMap &map, const double omega)
    {
      const unsigned int n = map.n_rows;
      // one division a pole for all entries
      std::vector<Complex> upper, lower;
      for (const Complex &pole : fit.poles)
      {
        upper.push_back(1. / (Complex(0, omega) - pole));
        lower.push_back(1. / (Complex(0, omega) - std::conj(pole)));
      }
      std::vector<Complex> values;
      for (unsigned int e = 0; e < fit.residues.size(); ++e)
      {
        double real = fit.direct[e], imaginary = 0;
        for (unsigned int k = 0; k < fit.poles.size(); ++k)
        {
          const double a = fit.residues[e][k].real(), b = fit.residues[e][k].imag();
          const Complex sum = upper[k] + lower[k], difference = upper[k] - lower[k];
          real += a * sum.real() - b * difference.imag();
          imaginary += a * sum.imag() + b * difference.real();
        }
        values.emplace_back(real, imaginary);
      }
      ImaginaryPart result;
      DenseMatrix imaginary(n, n);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
        {
          const Complex value = values[map.entry[i * n + j]];
          imaginary(i, j) = value.imag();
          result.size += std::norm(value);
        }
      result.size = std::sqrt(result.size);
      result.gains = symmetric_eigenvalues(imaginary, result.vectors);
      for (double &gain : result.gains)
        gain /= std::max(result.size, 1e-300);
      return result;
    }

    /// Where gains are looked for, ascending [rad/s].
    std::vector<double> gain_grid(const std::vector<double> &omega, const std::vector<Complex> &poles)
    {
      std::vector<double> grid;
      const double spacing = omega.back() / omega.size();
      double highest = omega.back();
      for (const double value : omega)
        if (value > 0)
          grid.push_back(value);
      for (const Complex &pole : poles)
      {
        highest = std::max(highest, std::abs(pole));
        for (const double offset : {-3., -1.5, -0.7, -0.3, 0., 0.3, 0.7, 1.5, 3.})
          grid.push_back(pole.imag() + offset * pole.real());
        // of a pole with hardly any damping, up to the next lines
        for (double width = 10 * std::abs(pole.real()); width < spacing; width *= 3)
          for (const double side : {-1., 1.})
            grid.push_back(pole.imag() + side * width);
      }
      const double lowest = grid.front();
      for (unsigned int k = 1; k <= 40; ++k)
        grid.push_back(lowest * std::pow(1e-3, k / 40.));
      for (unsigned int k = 1; k <= 300; ++k)
        grid.push_back(omega.back() * std::pow(1e3 * highest / omega.back(), k / 300.));
      std::sort(grid.begin(), grid.end());
      grid.erase(grid.begin(), std::upper_bound(grid.begin(), grid.end(), 0.));
      grid.erase(std::unique(grid.begin(), grid.end()), grid.end());
      return grid;
    }

    /// Peaks of the largest gain that are above the tolerance; `largest` becomes the highest of all.
    std::vector<double> violations(const PoleFit &fit, const EntryMap &map, const std::vector<double> &grid,
                                   double &largest)
    {
      const auto gain = [&](const double omega) { return imaginary_part(fit, map, omega).gains.back(); };
      std::vector<double> gains, peaks;
      for (const double omega : grid)
        gains.push_back(gain(omega));
      largest = *std::max_element(gains.begin(), gains.end());
      for (std::size_t k = 0; k < grid.size(); ++k)
      {
        const double before = k > 0 ? gains[k - 1] : -1, after = k + 1 < grid.size() ? gains[k + 1] : -1;
        if (gains[k] < before || gains[k] <= after)
          continue;
        // also a peak between lines that are in order themselves
        double left = grid[k > 0 ? k - 1 : 0], right = grid[std::min(k + 1, grid.size() - 1)];
        const double ratio = (std::sqrt(5.) - 1) / 2;
        for (unsigned int round = 0; round < 16; ++round)
        {
          const double a = right - ratio * (right - left), b = left + ratio * (right - left);
          (gain(a) > gain(b) ? right : left) = gain(a) > gain(b) ? b : a;
        }
        const double middle = (left + right) / 2, there = gain(middle);
        largest = std::max(largest, there);
        if (std::max(gains[k], there) > gain_tolerance)
          peaks.push_back(there > gains[k] ? middle : grid[k]);
      }
      return peaks;
    }

    /// The unknowns of an entry in coordinates y whose length is the change of the receptance on the lines: x = T y.
    class Unknowns
    {
    public:
      Unknowns(const Spectra &data, const PoleFit &fit, const ResidueRules &rules)
          : poles(fit.poles), direct(rules.direct)
      {
        for (unsigned int k = 0; k < poles.size(); ++k)
        {
          const bool real = poles[k].imag() == 0;
          for (const bool imaginary : {false, true})
            if (!(imaginary && real))
            {
              if (imaginary || !rules.real_amplitudes)
                kept.push_back({k, imaginary, n_columns});
              ++n_columns;
            }
        }
        // beyond the band the mobility counts, too
        constexpr unsigned int n_beyond = 100;
        const std::vector<double> &omega = data.omega;
        std::vector<double> lines = omega, weights;
        for (unsigned int l = 0; l < omega.size(); ++l)
          weights.push_back(data.weight_of(l));
        for (unsigned int k = 1; k <= n_beyond; ++k)
        {
          lines.push_back(omega.back() * std::pow(300., double(k) / n_beyond));
          weights.push_back(0.1 * lines.back() / omega.back() * std::sqrt(double(omega.size()) / n_beyond));
        }
        const unsigned int n = kept.size() + direct, n_lines = lines.size();
        const DenseMatrix basis = pole_basis(lines, poles);
        DenseMatrix A(2 * n_lines + n, n);
        for (unsigned int c = 0; c < n; ++c)
        {
          double square = 0;
          for (unsigned int l = 0; l < 2 * n_lines; ++l)
          {
            A(l, c) =
                weights[l % n_lines] * (c < kept.size() ? basis(l, kept[c].column) : (l < n_lines ? 1. : 0.));
            square += A(l, c) * A(l, c);
          }
          scale.push_back(1 / std::sqrt(square));
          for (unsigned int l = 0; l < 2 * n_lines; ++l)
            A(l, c) *= scale[c];
          // residues that the lines hardly tell apart stay small
          A(2 * n_lines + c, c) = 1e-6;
        }
        const bool zero = rules.zero_initial_value && !rules.real_amplitudes;
        DenseMatrix equation(n, zero);
        for (unsigned int c = 0; zero && c < kept.size(); ++c)
          equation(c, 0) = kept[c].imaginary ? 0. : scale[c] * (poles[kept[c].pole].imag() == 0 ? 1. : 2.);
        free = *null_space(equation, n);
        triangle = triangular_factor(product(A, free));
      }

      unsigned int n() const { return triangle.n(); }

      /// T^T times the imaginary parts of the functions at a frequency.
      std::vector<double> imaginary_row(const double omega) const
      {
        const DenseMatrix basis = pole_basis({omega}, poles);
        std::vector<double> row(n(), 0.);
        for (unsigned int j = 0; j < n(); ++j)
        {
          for (unsigned int c = 0; c < kept.size(); ++c)
            row[j] += free(c, j) * scale[c] * basis(1, kept[c].column);
          for (unsigned int i = 0; i < j; ++i)
            row[j] -= triangle(i, j) * row[i];
          row[j] /= triangle(j, j);
        }
        return row;
      }

      /// Adds T y to an entry of a fit.
      void change(PoleFit &fit, const unsigned int entry, std::vector<double> y) const
      {
        for (unsigned int i = n(); i-- > 0;)
        {
          for (unsigned int j = i + 1; j < n(); ++j)
            y[i] -= triangle(i, j) * y[j];
          y[i] /= triangle(i, i);
        }
        for (unsigned int c = 0; c < scale.size(); ++c)
        {
          double x = 0;
          for (unsigned int j = 0; j < n(); ++j)
            x += scale[c] * free(c, j) * y[j];
          if (c == kept.size())
            fit.direct[entry] += x;
          else
            fit.residues[entry][kept[c].pole] += (poles[kept[c].pole].imag() == 0 ? 0.5 : 1.) * x *
                                                 (kept[c].imaginary ? Complex(0, 1) : Complex(1));
        }
      }

    private:
      struct Column
      {
        unsigned int pole;
        bool imaginary;
        unsigned int column;
      };

      const std::vector<Complex> poles;
      const bool direct;
      std::vector<Column> kept;
      unsigned int n_columns = 0;
      std::vector<double> scale;
      DenseMatrix free, triangle;
    };

    /// One inequality: sum over entries of weight_e row^T y_e <= -surplus.
    struct Inequality
    {
      std::vector<double> weights, row;
      double surplus;
    };
  } // namespace

  bool PassiveFit::is_passive() const
  {
    return gain <= gain_tolerance;
  }

  PassiveFit nearest_passive_fit(const Spectra &data, const PoleFit &fit, const EntryMap &map,
                                 const ResidueRules &rules)
  {
    const std::vector<double> grid = gain_grid(data.omega, fit.poles);
    const unsigned int n = map.n_rows, n_entries = fit.residues.size();
    PassiveFit result;
    result.fit = fit;
    std::vector<double> peaks = violations(fit, map, grid, result.gain_before);
    result.gain = result.gain_before;
    if (peaks.empty())
      return result;

    const Unknowns unknowns(data, fit, rules);
    std::vector<double> uses(n_entries, 0.), multipliers;
    for (const unsigned int entry : map.entry)
      ++uses[entry];
    std::vector<Inequality> inequalities;
    DenseMatrix K;
    for (; !peaks.empty() && result.n_rounds < most_rounds; ++result.n_rounds)
    {
      for (const double omega : peaks)
      {
        const ImaginaryPart now = imaginary_part(result.fit, map, omega),
                            first = imaginary_part(fit, map, omega);
        std::vector<double> row = unknowns.imaginary_row(omega);
        for (unsigned int k = 0; k < n; ++k)
        {
          if (now.gains[k] < -gain_tolerance)
            continue;
          // v^T Im G v of the first fit
          double gain = 0;
          for (unsigned int c = 0; c < n; ++c)
          {
            double share = 0;
            for (unsigned int i = 0; i < n; ++i)
              share += now.vectors(i, k) * first.vectors(i, c);
            gain += share * share * first.gains[c];
          }
          Inequality one{std::vector<double>(n_entries, 0.), row, (gain + gain_tolerance) * first.size};
          double square = 0, length = 0;
          for (unsigned int i = 0; i < n; ++i)
            for (unsigned int j = 0; j < n; ++j)
              one.weights[map.entry[i * n + j]] += now.vectors(i, k) * now.vectors(j, k);
          for (unsigned int e = 0; e < n_entries; ++e)
            square += uses[e] > 0 ? one.weights[e] * one.weights[e] / uses[e] : 0.;
          for (const double value : row)
            length += value * value;
          // each of length one
          for (double &weight : one.weights)
            weight /= std::sqrt(square);
          for (double &value : one.row)
            value /= std::sqrt(length);
          one.surplus /= std::sqrt(square * length);
          inequalities.push_back(one);
        }
      }
      const unsigned int m = inequalities.size(), known = K.m();
      const DenseMatrix before = K;
      K.reinit(m, m);
      std::vector<double> h(m);
      for (unsigned int a = 0; a < m; ++a)
      {
        h[a] = inequalities[a].surplus;
        for (unsigned int b = 0; b <= a; ++b)
        {
          if (a < known)
          {
            K(a, b) = K(b, a) = before(a, b);
            continue;
          }
          double weights = 0, rows = 0;
          for (unsigned int e = 0; e < n_entries; ++e)
            weights += uses[e] > 0 ? inequalities[a].weights[e] * inequalities[b].weights[e] / uses[e] : 0.;
          for (unsigned int c = 0; c < unknowns.n(); ++c)
            rows += inequalities[a].row[c] * inequalities[b].row[c];
          K(a, b) = K(b, a) = weights * rows;
        }
      }
      multipliers = nonnegative_minimum(K, h, multipliers);
      result.fit = fit;
      for (unsigned int e = 0; e < n_entries; ++e)
      {
        std::vector<double> y(unknowns.n(), 0.);
        for (unsigned int a = 0; a < m; ++a)
          for (unsigned int c = 0; uses[e] > 0 && c < y.size(); ++c)
            y[c] -= multipliers[a] * inequalities[a].weights[e] / uses[e] * inequalities[a].row[c];
        unknowns.change(result.fit, e, y);
      }
      peaks = violations(result.fit, map, grid, result.gain);
    }
    double change = 0, whole = 0;
    for (unsigned int e = 0; e < n_entries; ++e)
      for (unsigned int l = 0; l < data.omega.size(); ++l)
      {
        change += uses[e] * std::norm(result.fit.value(e, data.omega[l]) - fit.value(e, data.omega[l]));
        whole += uses[e] * std::norm(data.values[e][l]);
      }
    result.change = std::sqrt(change / whole);
    return result;
  }
} // namespace vibrocontact
