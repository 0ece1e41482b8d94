#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/numerics/time_pairing.h>

#include <deal.II/base/numbers.h>

#include <cmath>

namespace vibrocontact
{
  namespace
  {
    using Complex = std::complex<double>;
    using dealii::numbers::PI;

    constexpr TimeForm forms[] = {TimeForm::strong, TimeForm::weak, TimeForm::distributional};

    /// The highest derivatives of the trial and of the weighting functions that a form asks for.
    std::pair<unsigned int, unsigned int> highest_derivatives(const TimeForm form)
    {
      const unsigned int on_weighting = static_cast<unsigned int>(form);
      return {2 - on_weighting, on_weighting};
    }

    /// How many of the d derivatives in A_d stand on the weighting functions: int p q' is kept in the weak form.
    unsigned int on_weighting(const TimeForm form, const unsigned int d)
    {
      switch (form)
      {
      case TimeForm::strong:
        return 0;
      case TimeForm::weak:
        return d == 2;
      default:
        return d;
      }
    }

    bool is_fourier(const TimeBasis &basis)
    {
      return basis.scaling_function() == nullptr;
    }

    bool is_admissible(const TimeBasis &trial, const TimeBasis &weighting, const TimeForm form,
                       const bool by_quadrature)
    {
      const auto [on_trial, on_weighting] = highest_derivatives(form);
      if (trial.n_derivatives() >= on_trial && weighting.n_derivatives() >= on_weighting)
        return true;
      // one derivative on each side defines the integrals; the recursion is the same for all forms
      return !by_quadrature && trial.name() == weighting.name() && trial.n_derivatives() >= 1;
    }

    std::string ordinal(const unsigned int d)
    {
      return d == 1 ? "first" : "second";
    }

    void check(const TimeBasis &trial, const TimeBasis &weighting, const TimeForm form,
               const unsigned int quadrature_points)
    {
      const std::string pair = trial.name() + ":" + weighting.name();
      const unsigned int n = trial.n_functions();
      if (n != weighting.n_functions())
        throw InputError("The pair " + pair + " has " + std::to_string(n) + " trial and " +
                         std::to_string(weighting.n_functions()) +
                         " weighting functions; give equal numbers.");
      const bool by_quadrature = quadrature_points > 0;
      if (!is_admissible(trial, weighting, form, by_quadrature))
      {
        const auto [on_trial, on_weighting] = highest_derivatives(form);
        const bool trial_fails = trial.n_derivatives() < on_trial;
        std::string allowed;
        for (const TimeForm other : forms)
          if (is_admissible(trial, weighting, other, by_quadrature))
            allowed += (allowed.empty() ? "" : " or ") + name_of(other);
        throw InputError(
            "The pair " + pair + " is not admissible in the " + name_of(form) + " form" +
            (by_quadrature ? " with quadrature" : "") + ": it takes the " +
            ordinal(trial_fails ? on_trial : on_weighting) + " derivative of the " +
            (trial_fails ? "trial functions " + trial.name() : "weighting functions " + weighting.name()) +
            ", which is not square-integrable; " +
            (allowed.empty() ? "no form admits this pair, choose smoother functions."
                             : "choose the form " + allowed + "."));
      }
      if (by_quadrature && quadrature_points < 2 * n)
        throw InputError("Quadrature with " + std::to_string(quadrature_points) +
                         " points is too coarse for " + std::to_string(n) +
                         " functions in time; give at least twice as many, or 0 for exact "
                         "integrals.");
      if (by_quadrature && quadrature_points % n != 0 && !(is_fourier(trial) && is_fourier(weighting)))
        throw InputError("Quadrature with " + std::to_string(quadrature_points) + " points does not fit " +
                         std::to_string(n) + " functions of the pair " + pair +
                         ": give a multiple of that number, or 0 for exact integrals.");
    }

    /// A_d(m) = N^d sum_k e^(2 PI j m k / N) G_k
    std::vector<Complex> by_recursion(const TimeBasis &trial, const TimeBasis &weighting,
                                      const unsigned int d)
    {
      const int n = trial.n_functions();
      const auto G = connection_coefficients(*trial.scaling_function(), *weighting.scaling_function(), d);
      std::vector<double> wrapped(n, 0.);
      for (unsigned int i = 0; i < G.values.size(); ++i)
        wrapped[((G.first + static_cast<int>(i)) % n + n) % n] += std::pow(n, d) * G.values[i];
      std::vector<Complex> result(n_orders(n), 0.);
      for (int k = 0; k < n; ++k)
        if (wrapped[k] != 0)
          for (unsigned int m = 0; m < result.size(); ++m)
            result[m] += wrapped[k] * std::polar(1., 2 * PI * (static_cast<long>(m) * k % n) / n);
      return result;
    }

    /// sum over the few frequencies that Fourier's functions hold
    std::vector<Complex> by_fourier(const TimeBasis &trial, const TimeBasis &weighting, const unsigned int d)
    {
      const int n = trial.n_functions();
      std::vector<Complex> result(n_orders(n), 0.);
      for (int m = 0; m < static_cast<int>(result.size()); ++m)
        for (const int l : {0, -1})
        {
          const TimeBasis &fourier = is_fourier(trial) ? trial : weighting;
          if (fourier.fourier_coefficient(m, l) == 0.)
            continue;
          Complex term = std::conj(weighting.fourier_coefficient(m, l)) * trial.fourier_coefficient(m, l);
          for (unsigned int i = 0; i < d; ++i)
            term *= Complex(0, 2 * PI * (m + l * n));
          result[m] += term;
        }
      return result;
    }

    std::vector<Complex> exact(const TimeBasis &trial, const TimeBasis &weighting, const unsigned int d)
    {
      return is_fourier(trial) || is_fourier(weighting) ? by_fourier(trial, weighting, d)
                                                        : by_recursion(trial, weighting, d);
    }

    std::vector<double> real_part(const std::vector<Complex> &values)
    {
      std::vector<double> result;
      for (const Complex &value : values)
        result.push_back(value.real());
      return result;
    }

    /// int conj(Psi_m) e^(2 PI j h t) dt, h = 1 or -1
    void exact_moments(const TimeBasis &weighting, TimePairing &pairing)
    {
      const int n = weighting.n_functions();
      for (int m = 0; m < static_cast<int>(n_orders(n)); ++m)
        for (const int h : {1, -1})
          if ((h - m) % n == 0)
          {
            const Complex moment = std::conj(weighting.fourier_coefficient(m, (h - m) / n));
            pairing.cosine[m] += moment / 2.;
            pairing.sine[m] += moment / Complex(0, 2 * h);
          }
    }

    using Samples = std::vector<std::vector<Complex>>;

    Samples left_points(const TimeBasis &basis, const unsigned int n_points, const unsigned int d)
    {
      Samples samples;
      for (unsigned int i = 0; i < n_points; ++i)
        samples.push_back(basis.values(static_cast<double>(i) / n_points, d));
      return samples;
    }

    std::vector<Complex> summed(const Samples &weighting, const Samples &trial, const double sign)
    {
      std::vector<Complex> result(trial[0].size(), 0.);
      for (unsigned int i = 0; i < trial.size(); ++i)
        for (unsigned int m = 0; m < result.size(); ++m)
          result[m] += std::conj(weighting[i][m]) * trial[i][m];
      for (Complex &value : result)
        value *= sign / trial.size();
      return result;
    }

    void by_left_points(const TimeBasis &trial, const TimeBasis &weighting, const TimeForm form,
                        const unsigned int n_points, TimePairing &pairing)
    {
      for (const unsigned int d : {0, 1, 2})
      {
        const unsigned int moved = on_weighting(form, d);
        (d == 0   ? pairing.a0
         : d == 1 ? pairing.a1
                  : pairing.a2) = summed(left_points(weighting, n_points, moved),
                                         left_points(trial, n_points, d - moved), moved % 2 == 1 ? -1. : 1.);
      }
      const Samples psi = left_points(weighting, n_points, 0);
      pairing.norm = real_part(summed(psi, psi, 1.));
      for (unsigned int i = 0; i < n_points; ++i)
        for (unsigned int m = 0; m < pairing.sine.size(); ++m)
        {
          const double t = 2 * PI * i / n_points;
          pairing.sine[m] += std::conj(psi[i][m]) * (std::sin(t) / n_points);
          pairing.cosine[m] += std::conj(psi[i][m]) * (std::cos(t) / n_points);
        }
    }
  } // namespace

  bool TimePairing::holds_harmonic() const
  {
    for (unsigned int m = 1; 2 * m < n_functions; ++m)
      if (std::abs(sine[m]) > 1e-10 * std::sqrt(norm[m]) && std::abs(a0[m]) > 0)
        return true;
    return false;
  }

  TimeForm time_form(const std::string &name)
  {
    for (const TimeForm form : forms)
      if (name == name_of(form))
        return form;
    throw InputError("There is no form called " + name + ": choose strong, weak or distributional.");
  }

  std::string name_of(const TimeForm form)
  {
    return form == TimeForm::strong ? "strong" : form == TimeForm::weak ? "weak" : "distributional";
  }

  TimePairing pair_time_bases(const TimeBasis &trial, const TimeBasis &weighting, const TimeForm form,
                              const unsigned int quadrature_points)
  {
    check(trial, weighting, form, quadrature_points);
    TimePairing pairing;
    pairing.n_functions = trial.n_functions();
    pairing.sine.assign(n_orders(pairing.n_functions), 0.);
    pairing.cosine = pairing.sine;
    if (quadrature_points > 0)
    {
      by_left_points(trial, weighting, form, quadrature_points, pairing);
      return pairing;
    }
    // integration by parts on the circle: the forms have the same integrals
    pairing.a0 = exact(trial, weighting, 0);
    pairing.a1 = exact(trial, weighting, 1);
    pairing.a2 = exact(trial, weighting, 2);
    pairing.norm = real_part(exact(weighting, weighting, 0));
    exact_moments(weighting, pairing);
    return pairing;
  }
} // namespace vibrocontact
