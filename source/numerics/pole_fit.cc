#include <vibrocontact/numerics/least_squares.h>
#include <vibrocontact/numerics/pole_fit.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  using Complex = std::complex<double>;

  double PoleFit::n_pairs() const
  {
    double n = 0;
    for (const Complex &pole : poles)
      n += pole.imag() == 0 ? 0.5 : 1;
    return n;
  }

  unsigned int PoleFit::n_unstable() const
  {
    return std::count_if(poles.begin(), poles.end(), [](const Complex &pole) { return pole.real() >= 0; });
  }

  Complex PoleFit::value(const unsigned int entry, const double omega) const
  {
    Complex sum = direct[entry];
    for (unsigned int k = 0; k < poles.size(); ++k)
    {
      const Complex s(0, omega), &residue = residues[entry][k];
      sum += residue / (s - poles[k]) + std::conj(residue) / (s - std::conj(poles[k]));
    }
    return sum;
  }

  double PoleFit::initial(const unsigned int entry, const unsigned int order) const
  {
    double sum = 0;
    for (unsigned int k = 0; k < poles.size(); ++k)
      sum += 2 * (residues[entry][k] * std::pow(poles[k], order)).real();
    return sum;
  }

  DenseMatrix pole_basis(const std::vector<double> &omega, const std::vector<Complex> &poles)
  {
    const unsigned int n = omega.size();
    unsigned int columns = 0;
    for (const Complex &pole : poles)
      columns += pole.imag() == 0 ? 1 : 2;
    DenseMatrix basis(2 * n, columns);
    const auto put = [&](const unsigned int line, const unsigned int column, const Complex &value)
    {
      basis(line, column) = value.real();
      basis(n + line, column) = value.imag();
    };
    for (unsigned int l = 0; l < n; ++l)
    {
      unsigned int column = 0;
      for (const Complex &pole : poles)
      {
        const Complex s(0, omega[l]), one = 1. / (s - pole), other = 1. / (s - std::conj(pole));
        if (pole.imag() == 0)
        {
          put(l, column++, one);
          continue;
        }
        put(l, column++, one + other);
        put(l, column++, Complex(0, 1) * (one - other));
      }
    }
    return basis;
  }

  namespace
  {
    DenseMatrix right_hand_sides(const Spectra &data)
    {
      const unsigned int n = data.omega.size();
      DenseMatrix B(2 * n, data.n_entries());
      for (unsigned int i = 0; i < data.n_entries(); ++i)
        for (unsigned int l = 0; l < n; ++l)
        {
          B(l, i) = data.weight_of(l) * data.values[i][l].real();
          B(n + l, i) = data.weight_of(l) * data.values[i][l].imag();
        }
      return B;
    }

    /// unknown of pole k: its column, whether it is the imaginary part of a residue
    struct Unknown
    {
      unsigned int pole;
      bool imaginary;
    };

    std::vector<Unknown> unknowns_of(const std::vector<Complex> &poles)
    {
      std::vector<Unknown> unknowns;
      for (unsigned int k = 0; k < poles.size(); ++k)
      {
        unknowns.push_back({k, false});
        if (poles[k].imag() != 0)
          unknowns.push_back({k, true});
      }
      return unknowns;
    }
  } // namespace

  PoleFit fit_residues(const Spectra &data, const std::vector<Complex> &all_poles, const ResidueRules &rules)
  {
    PoleFit fit;
    for (const Complex &pole : all_poles)
      if (!rules.real_amplitudes || pole.imag() != 0)
        fit.poles.push_back(pole);
    const std::vector<Complex> &poles = fit.poles;
    std::vector<Unknown> unknowns = unknowns_of(poles);
    const DenseMatrix basis = pole_basis(data.omega, poles);
    std::vector<unsigned int> kept;
    for (unsigned int c = 0; c < unknowns.size(); ++c)
      if (!rules.real_amplitudes || unknowns[c].imaginary)
        kept.push_back(c);
    const unsigned int n = kept.size(), n_lines = data.omega.size(), n_entries = data.n_entries();
    DenseMatrix A(2 * n_lines, n + rules.direct);
    for (unsigned int c = 0; c < n; ++c)
      for (unsigned int l = 0; l < 2 * n_lines; ++l)
        A(l, c) = data.weight_of(l % n_lines) * basis(l, kept[c]);
    for (unsigned int l = 0; rules.direct && l < n_lines; ++l)
      A(l, n) = data.weight_of(l);

    // imaginary residues have no initial value anyway
    const bool zero = rules.zero_initial_value && !rules.real_amplitudes;
    const unsigned int n_equations = zero + !rules.initial_slope.empty();
    DenseMatrix C(n_equations, A.n()), D(n_equations, n_entries);
    const auto equation = [&](const unsigned int row, const unsigned int order)
    {
      for (unsigned int c = 0; c < n; ++c)
      {
        const Complex pole = poles[unknowns[kept[c]].pole],
                      unit = unknowns[kept[c]].imaginary ? Complex(0, 1) : Complex(1);
        C(row, c) = (pole.imag() == 0 ? 1 : 2) * (unit * std::pow(pole, order)).real();
      }
    };
    if (zero)
      equation(0, 0);
    if (!rules.initial_slope.empty())
    {
      equation(n_equations - 1, 1);
      for (unsigned int i = 0; i < n_entries; ++i)
        D(n_equations - 1, i) = rules.initial_slope[i];
    }
    const DenseMatrix B = right_hand_sides(data);
    const DenseMatrix x = n_equations == 0 ? least_squares(A, B) : least_squares(A, B, C, D);

    fit.residues.assign(n_entries, std::vector<Complex>(poles.size()));
    fit.direct.assign(n_entries, 0.);
    for (unsigned int i = 0; i < n_entries; ++i)
    {
      for (unsigned int c = 0; c < n; ++c)
      {
        const Unknown &unknown = unknowns[kept[c]];
        const double factor = poles[unknown.pole].imag() == 0 ? 0.5 : 1;
        fit.residues[i][unknown.pole] += factor * x(c, i) * (unknown.imaginary ? Complex(0, 1) : Complex(1));
      }
      if (rules.direct)
        fit.direct[i] = x(n, i);
    }
    return fit;
  }

  double band_error(const std::vector<double> &omega, const std::vector<Complex> &exact,
                    const std::vector<Complex> &other)
  {
    double difference = 0, whole = 0;
    for (unsigned int l = 0; l < omega.size(); ++l)
    {
      const double width =
          (omega[std::min<unsigned int>(l + 1, omega.size() - 1)] - omega[l > 0 ? l - 1 : 0]) / 2;
      difference += width * std::abs(exact[l] - other[l]);
      whole += width * std::abs(exact[l]);
    }
    return whole > 0 ? difference / whole : 0.;
  }

  std::vector<double> fit_errors(const Spectra &data, const PoleFit &fit)
  {
    std::vector<double> errors;
    for (unsigned int i = 0; i < data.n_entries(); ++i)
    {
      std::vector<Complex> exact, values;
      for (unsigned int l = 0; l < data.omega.size(); ++l)
      {
        exact.push_back(data.weight_of(l) * data.values[i][l]);
        values.push_back(data.weight_of(l) * fit.value(i, data.omega[l]));
      }
      errors.push_back(band_error(data.omega, exact, values));
    }
    return errors;
  }

  double worst_error(const Spectra &data, const PoleFit &fit)
  {
    const std::vector<double> errors = fit_errors(data, fit);
    return *std::max_element(errors.begin(), errors.end());
  }
} // namespace vibrocontact
