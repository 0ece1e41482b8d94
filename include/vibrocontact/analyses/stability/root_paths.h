#pragma once

#include <vibrocontact/coupled_bodies/stability_roots.h>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// Follows the roots of a linearised contact from case to case, so that a root keeps the name of the free
  /// mode it began as, whatever it becomes: two that veer exchange neither names nor places.
  ///
  /// Two roots are alike by the modal assurance criterion of their shapes in the energy norm, each amplitude
  /// weighted by sqrt(w_i^2 + |lambda|^2), and by their frequencies:
  ///
  ///   likeness = |x_a^H x_b|^2 (1 - |f_a - f_b| / (0.15 max(f_a, f_b))),   |x| = 1
  ///
  /// The most alike are paired first, each root once. At the start of a path x_a is a free mode.
  class RootPaths
  {
  public:
    /// Fills `path` of the roots of a case, which follow those of the case before. Other modes than before
    /// begin new paths.
    /// @param mode_labels, omega of the modes that the shapes are amplitudes of [rad/s]
    void follow(const std::vector<std::string> &mode_labels, const std::vector<double> &omega,
                std::vector<StabilityRoot> &roots);

  private:
    /// labels of the modes of the case before, and its roots: names, [Hz], weighted shapes of unit length
    std::vector<std::string> labels, names;
    std::vector<double> frequencies;
    std::vector<std::vector<std::complex<double>>> shapes;
  };
} // namespace vibrocontact
