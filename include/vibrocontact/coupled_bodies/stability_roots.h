#pragma once

#include <vibrocontact/coupled_bodies/linearised_contact.h>

#include <complex>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// A root with a smaller divergence rate does not grow: round-off of an undamped root.
  constexpr double least_divergence_rate = 1e-9;

  /// A complex eigenvalue lambda = growth + i 2 pi frequency of a linearised contact.
  struct StabilityRoot
  {
    /// [Hz] >= 0, [1/s]
    double frequency = 0, growth = 0;
    /// Re(lambda) / Im(lambda); positive: unstable
    double divergence_rate = 0;
    /// the free mode with the largest share of its energy, and that share
    std::string label;
    double share = 0;
    /// whether it is a root with what poles only stand for (exact_roots.h)
    bool exact = false;
    /// the free mode that the root began as, see RootPaths; empty if not followed
    std::string path;
    /// modal amplitudes, then those of the poles as if they were modes; n_modes + n_poles
    std::vector<std::complex<double>> shape;
    /// of the same motion the real parts of the states of the poles, then their imaginary parts, each by its complex amplitude;
    /// 2 n_poles, empty if they were not kept: of exact roots, and in sweeps
    std::vector<std::complex<double>> states;

    /// growth > least_divergence_rate times 2 pi frequency
    bool grows() const;

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &frequency &growth &divergence_rate &label &share &exact &path &shape &states;
    }
  };

  /// A root of given modal amplitudes: its name is that of the free mode with the largest share of
  /// sum (w^2 + |lambda|^2) |q|^2.
  StabilityRoot named_root(const std::complex<double> &lambda, std::vector<std::complex<double>> amplitudes,
                           const std::vector<double> &omega, const std::vector<std::string> &labels);
  /// Whether a root is listed: frequency > 0, or growth without oscillation.
  bool is_listed(const std::complex<double> &lambda);
  /// By ascending frequency (of equal ones the faster growing first), those without oscillation last.
  void sort_roots(std::vector<StabilityRoot> &roots);

  /// All roots with frequency > 0 by ascending frequency (one of each conjugate pair), then those without
  /// oscillation that grow. @throws ConvergenceError if LAPACK finds no eigenvalues
  std::vector<StabilityRoot> stability_roots(const ContactPair &pair, DenseMatrix linearised);

  /// All roots with Im s > 0, complete (zgeev), by ascending frequency, then those of the elastic bodies that grow without
  /// oscillation. Nearer to the real axis than 1e-3 |Re s| a root is the image of one without oscillation and not listed.
  /// @throws ConvergenceError if LAPACK finds no eigenvalues
  std::vector<StabilityRoot> hysteretic_roots(const ContactPair &pair, const HystereticLoss &loss,
                                              const CreepScheme &scheme,
                                              const RollingEquilibrium &equilibrium,
                                              const LinearisationOptions &options);
} // namespace vibrocontact
