#pragma once

#include <vibrocontact/analyses/periodic/forced_body.h>
#include <vibrocontact/base/dense.h>

#include <cmath>

namespace vibrocontact
{
  /// The two cases of the axial bar (Jones & Legrand 2014, corrected): 25 equal two-node elements, clamped at one end, force
  /// and stop at the other, C = beta K.
  struct AxialBarCase
  {
    /// [Hz], penalty [N], [1/m], beta [s], gap [m]
    double frequency, amplitude, exponent, beta, gap;
    /// tip amplitude without contact [m]
    double linear_amplitude;
    static constexpr double force = 250e3, modulus = 70e9, area = 25e-4, density = 2700, length = 1;

    HarmonicForce excitation() const { return {force, frequency}; }
    /// slope of the penalty at touch [N/m]
    double stiffness() const { return amplitude * exponent; }
  };

  inline AxialBarCase axial_bar_150()
  {
    return {150, 1e8, 50, 1e-4, 1e-3, 1.438589e-3};
  }

  inline AxialBarCase axial_bar_1275()
  {
    return {1275, 1e8, 20, 5e-6, 14.5e-3, 28.83517e-3};
  }

  /// All modes of the bar. @param massless the mass of the last element goes to its inner node: one mode less and the
  /// residual of that element
  inline ForcedBody axial_bar(const AxialBarCase &c, const bool massless = false,
                              const unsigned int n_elements = 25)
  {
    const double h = AxialBarCase::length / n_elements, k = AxialBarCase::modulus * AxialBarCase::area / h,
                 m = AxialBarCase::density * AxialBarCase::area * h;
    // node i + 1 is dof i; the last element of the massless bar has neither stiffness nor consistent mass here
    const unsigned int n = massless ? n_elements - 1 : n_elements;
    DenseMatrix K(n, n), M(n, n);
    for (unsigned int i = 0; i < n; ++i)
    {
      K(i, i) += k;
      M(i, i) += m / 3;
      if (i > 0)
      {
        K(i - 1, i - 1) += k;
        M(i - 1, i - 1) += m / 3;
        K(i, i - 1) = K(i - 1, i) = -k;
        M(i, i - 1) = M(i - 1, i) = m / 6;
      }
    }
    if (massless)
      M(n - 1, n - 1) += m;
    std::vector<dealii::Vector<double>> modes(n, dealii::Vector<double>(n));
    K.compute_generalized_eigenvalues_symmetric(M, modes);
    ForcedBody body;
    body.trace.reinit(1, n);
    body.residual.reinit(1, 1);
    body.residual_load.assign(1, 0.);
    body.modal_load.assign(n, 0.);
    for (unsigned int i = 0; i < n; ++i)
    {
      body.omega.push_back(std::sqrt(K.eigenvalue(i).real()));
      body.damping_ratio.push_back(0.5 * c.beta * body.omega.back());
      body.trace(0, i) = modes[i][n - 1];
    }
    body.relaxation = c.beta;
    if (massless)
      body.residual(0, 0) = 1 / k;
    body.gap = {c.gap};
    return body;
  }

  /// The lowest modes of a body. @param residual whether the static answers of the others join the residual
  inline ForcedBody with_modes(const ForcedBody &all, const unsigned int n_modes, const bool residual)
  {
    ForcedBody body = all;
    for (unsigned int k = n_modes; k < all.n_modes() && residual; ++k)
    {
      const double w2 = all.omega[k] * all.omega[k];
      body.residual(0, 0) += all.trace(0, k) * all.trace(0, k) / w2;
    }
    body.omega.resize(n_modes);
    body.damping_ratio.resize(n_modes);
    body.modal_load.resize(n_modes);
    body.trace.reinit(1, n_modes);
    for (unsigned int k = 0; k < n_modes; ++k)
      body.trace(0, k) = all.trace(0, k);
    return body;
  }

  /// Stops at n nodes at equal distances from the tip inwards, each with the gap in which the first mode would reach all at once.
  inline ForcedBody with_points(const AxialBarCase &c, const unsigned int n)
  {
    ForcedBody body = axial_bar(c);
    const DenseMatrix tip = body.trace;
    body.trace.reinit(n, body.n_modes());
    body.residual.reinit(n, n);
    body.residual_load.assign(n, 0.);
    body.gap.resize(n);
    for (unsigned int i = 0; i < n; ++i)
    {
      const double x = 1 - 0.04 * i;
      for (unsigned int k = 0; k < body.n_modes(); ++k)
        body.trace(i, k) = tip(0, k) * std::sin((k + 0.5) * M_PI * x) / std::sin((k + 0.5) * M_PI);
      body.gap[i] = c.gap * std::sin(0.5 * M_PI * x);
    }
    return body;
  }
} // namespace vibrocontact
