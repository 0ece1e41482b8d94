#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/numerics/eigenvalues.h>
#include <vibrocontact/propagators/step_weights.h>
#include <vibrocontact/propagators/well_posedness.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  using Complex = std::complex<double>;

  namespace
  {
    /// eigenvalues below this share of the largest count as zero
    constexpr double round_off = 1e-12;

    double largest_entry(const DenseMatrix &matrix)
    {
      double largest = 0;
      for (unsigned int i = 0; i < matrix.m(); ++i)
        for (unsigned int j = 0; j < matrix.n(); ++j)
          largest = std::max(largest, std::abs(matrix(i, j)));
      return largest;
    }

    /// The matrix seen by the directions in which S has no compliance; empty if there are none.
    DenseMatrix without_residual(const DenseMatrix &matrix, const DenseMatrix &S)
    {
      const unsigned int n = matrix.m();
      if (S.m() == 0 || largest_entry(S) == 0)
        return matrix;
      DenseMatrix vectors;
      const std::vector<double> values = symmetric_eigenvalues(S, vectors);
      unsigned int n_free = 0;
      while (n_free < n && values[n_free] < round_off * values.back())
        ++n_free;
      DenseMatrix result(n_free, n_free);
      for (unsigned int a = 0; a < n_free; ++a)
        for (unsigned int b = 0; b < n_free; ++b)
          for (unsigned int i = 0; i < n; ++i)
            for (unsigned int j = 0; j < n; ++j)
              result(a, b) += vectors(i, a) * matrix(i, j) * vectors(j, b);
      return result;
    }
  } // namespace

  bool WellPosedness::usable() const
  {
    return limit > round_off && *std::min_element(definiteness.begin(), definiteness.end()) > round_off;
  }

  std::string WellPosedness::reason() const
  {
    if (usable())
      return "";
    const std::string advice =
        ": set Identification/Impose zero initial value = true, ask for more pole pairs or add the "
        "compliance of a tread";
    for (unsigned int k = 0; k < steps.size(); ++k)
      if (!(definiteness[k] > round_off))
        return "its compliance over one step of " + number_text(steps[k]) +
               " s is not positive definite (smallest eigenvalue " + number_text(definiteness[k]) +
               " times the largest), so that contact has no unique force" + advice;
    return "its compliance over one step is not positive definite in the limit of a zero step (smallest "
           "eigenvalue " +
           number_text(limit) + " times the largest), so that contact has no unique force" + advice;
  }

  WellPosedness well_posedness_of_contact(const BodyInContact &model, const double step)
  {
    WellPosedness result;
    result.steps = {{step, step / 2, step / 10}};
    double largest = 0;
    for (unsigned int k = 0; k < 3; ++k)
    {
      result.definiteness[k] = 1;
      for (const ForceInterpolation interpolation :
           {ForceInterpolation::impulse, ForceInterpolation::constant, ForceInterpolation::linear})
        result.definiteness[k] = std::min(
            result.definiteness[k],
            definiteness(one_step_compliance(model, step_weights(model, result.steps[k], interpolation))));
    }
    // the peak of g lies within a few periods of the fastest pole and some of the slowest
    double slowest = 0;
    for (const Complex &pole : model.poles)
      slowest = std::max(slowest, 1 / std::abs(pole));
    for (unsigned int k = 0; k <= 200; ++k)
      largest =
          std::max(largest, largest_entry(impulse_response(model, slowest * std::pow(10., -4 + 0.025 * k))));
    const DenseMatrix value = initial_derivative(model, 0), slope = initial_derivative(model, 1);
    result.initial_value = largest > 0 ? largest_entry(value) / largest : 0;
    const bool starts_at_zero = result.initial_value < 1e-9;
    const DenseMatrix first = without_residual(starts_at_zero ? slope : value, model.residual);
    result.limit = first.m() == 0 ? definiteness(model.residual) : definiteness(first);
    result.impacts = starts_at_zero && definiteness(slope) > round_off;
    return result;
  }

  void check_well_posedness(const BodyInContact &model, const double step, const std::string &body)
  {
    const WellPosedness well_posedness = well_posedness_of_contact(model, step);
    if (!well_posedness.usable())
      throw InputError("The body " + body + " cannot be used in contact: " + well_posedness.reason() + ".");
  }
} // namespace vibrocontact
