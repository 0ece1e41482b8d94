#pragma once

#include <vibrocontact/numerics/pole_fit.h>

namespace vibrocontact
{
  struct VectorFittingOptions
  {
    /// relocations of the poles at most
    unsigned int n_iterations = 30;
    ResidueRules rules;
  };

  /// Relaxed vector fitting (Gustavsen 2006, IEEE Trans. Power Delivery 21, 1587) with poles common to all
  /// entries. From poles a_k, least squares over all lines and entries i for
  ///
  ///   sum_k c_ik / (s - a_k) + d_i = G_i(s) [ sum_k c_k / (s - a_k) + d ],      Re sum over the lines of [..] = n_lines
  ///
  /// (the last equation keeps the bracket from vanishing without fixing d); the zeros of the bracket,
  /// eig(A - b c^T / d), are the new poles, those with Re > 0 mirrored. The c_ik and d_i are eliminated entry by entry through
  /// QR (Deschrijver et al. 2008, IEEE Microw. Wireless Compon. Lett. 18, 383): only triangles of the size of the bracket
  /// meet in one system. Entries weigh 1 / mean |G_i|. With zero_initial_value the c_ik keep sum c_ik = 0,
  /// as G_i and so its product with the bracket falls like 1 / s^2: the poles then know of the rule.
  ///
  /// Cost of a relocation: n_entries QR of 2 n_lines x (4 n_pairs + 1).

  /// Pairs spread evenly over the axis, damping ratio 5 %.
  std::vector<std::complex<double>> starting_poles(const std::vector<double> &omega, unsigned int n_pairs);

  /// One relocation; as many poles come out as went in, a pair may become two real ones.
  std::vector<std::complex<double>> relocate_poles(const Spectra &data,
                                                   const std::vector<std::complex<double>> &poles,
                                                   const ResidueRules &rules);

  /// Relocates until the worst E stands still (1e-4 in three relocations) or is round-off in three, and returns the best fit on the way: E is no
  /// monotonic function of the relocations. If it moves to the last relocation, the fit is marked as not converged.
  PoleFit vector_fit(const Spectra &data, unsigned int n_pairs, const VectorFittingOptions &options = {});
} // namespace vibrocontact
