#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/coupled_bodies/stability_roots.h>
#include <vibrocontact/numerics/complex_eigenvectors.h>
#include <vibrocontact/numerics/eigenvalues.h>

#include <deal.II/base/numbers.h>
#include <deal.II/lac/lapack_templates.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace vibrocontact
{
  bool StabilityRoot::grows() const
  {
    return growth > least_divergence_rate * 2 * dealii::numbers::PI * frequency;
  }

  namespace
  {
    /// of a motion that nothing holds, a root of 0 to round-off [1/s]
    constexpr double least_rate = 1e-5;
  } // namespace

  bool is_listed(const std::complex<double> &lambda)
  {
    return std::abs(lambda) > least_rate && (lambda.imag() > 0 || (lambda.imag() == 0 && lambda.real() > 0));
  }

  StabilityRoot named_root(const std::complex<double> &lambda, std::vector<std::complex<double>> amplitudes,
                           const std::vector<double> &omega, const std::vector<std::string> &labels)
  {
    StabilityRoot root;
    root.frequency = lambda.imag() / (2 * dealii::numbers::PI);
    root.growth = lambda.real();
    root.divergence_rate = lambda.imag() > 0 ? lambda.real() / lambda.imag() : 0;
    double sum = 0, largest = 0;
    for (unsigned int i = 0; i < amplitudes.size(); ++i)
    {
      const double energy = std::norm(amplitudes[i]) * (omega[i] * omega[i] + std::norm(lambda));
      sum += energy;
      if (energy > largest)
      {
        largest = energy;
        root.label = labels[i];
      }
    }
    root.share = sum > 0 ? largest / sum : 0;
    root.shape = std::move(amplitudes);
    return root;
  }

  void sort_roots(std::vector<StabilityRoot> &roots)
  {
    const auto still = std::stable_partition(roots.begin(), roots.end(),
                                             [](const StabilityRoot &root) { return root.frequency > 0; });
    std::stable_sort(roots.begin(), still,
                     [](const StabilityRoot &a, const StabilityRoot &b)
                     { return a.frequency < b.frequency; });
    // roots that differ by growth alone, as undamped ones that couple do: round-off does not choose
    for (auto first = roots.begin(); first != still;)
    {
      const double above = first->frequency * (1 + 1e-7);
      const auto last =
          std::find_if(first, still, [&](const StabilityRoot &root) { return root.frequency >= above; });
      std::stable_sort(first, last,
                       [](const StabilityRoot &a, const StabilityRoot &b) { return a.growth > b.growth; });
      first = last;
    }
  }

  namespace
  {
    /// A root of the eigenvector with components x(i).
    StabilityRoot root_of_pair(const ContactPair &pair, const std::vector<double> &omega,
                               const std::complex<double> &lambda,
                               const std::function<std::complex<double>(unsigned int)> &x)
    {
      std::vector<std::complex<double>> amplitudes, states;
      for (unsigned int i = 0; i < pair.n_modes(); ++i)
        amplitudes.push_back(x(i));
      for (unsigned int i = 0; i < 2 * pair.n_poles(); ++i)
        states.push_back(x(2 * pair.n_modes() + i));
      for (unsigned int i = 0; i < pair.n_poles(); ++i)
      {
        const std::complex<double> a = states[i], b = states[pair.n_poles() + i];
        amplitudes.push_back(std::polar(
            amplitude_per_state(pair, i) * std::sqrt(2 * (std::norm(a) + std::norm(b))), std::arg(a)));
      }
      StabilityRoot root = named_root(lambda, std::move(amplitudes), omega, pair.labels);
      root.states = std::move(states);
      return root;
    }
  } // namespace

  std::vector<StabilityRoot> stability_roots(const ContactPair &pair, DenseMatrix linearised)
  {
    const Eigenvalues lambda = eigenvalues(std::move(linearised));
    const std::vector<double> omega = pair.frequencies();
    std::vector<StabilityRoot> roots;
    for (unsigned int k = 0; k < lambda.values.size(); ++k)
    {
      // gaps that are not closed decay by 1 / beta
      const bool is_closing = std::any_of(
          pair.relaxing.begin(), pair.relaxing.end(),
          [&](const RelaxingRest &rest) { return std::abs(lambda.values[k] * rest.relaxation + 1.) < 1e-6; });
      if (is_listed(lambda.values[k]) && !is_closing)
        roots.push_back(root_of_pair(pair, omega, lambda.values[k],
                                     [&](const unsigned int i) { return lambda.component(i, k); }));
    }
    sort_roots(roots);
    return roots;
  }

  std::vector<StabilityRoot> hysteretic_roots(const ContactPair &pair, const HystereticLoss &loss,
                                              const CreepScheme &scheme,
                                              const RollingEquilibrium &equilibrium,
                                              const LinearisationOptions &options)
  {
    constexpr double least_oscillation = 1e-3;
    const ComplexEigenvectors lambda =
        complex_eigenvectors(linearised_contact(pair, loss, scheme, equilibrium, options),
                             "eigenvalues of the linearised contact");
    const std::vector<double> omega = pair.frequencies();
    std::vector<StabilityRoot> roots;
    for (unsigned int k = 0; k < lambda.values.size(); ++k)
      if (is_listed(lambda.values[k]) &&
          lambda.values[k].imag() > least_oscillation * std::abs(lambda.values[k].real()))
        roots.push_back(root_of_pair(pair, omega, lambda.values[k],
                                     [&](const unsigned int i) { return lambda.right(i, k); }));
    for (StabilityRoot &root : stability_roots(pair, linearised_contact(pair, scheme, equilibrium, options)))
      if (root.frequency == 0)
        roots.push_back(std::move(root));
    sort_roots(roots);
    return roots;
  }
} // namespace vibrocontact
