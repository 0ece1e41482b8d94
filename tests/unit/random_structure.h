#pragma once

#include <vibrocontact/coupled_bodies/contact_pair.h>
#include <vibrocontact/coupled_bodies/rolling_equilibrium.h>

#include <cmath>
#include <random>

namespace vibrocontact
{
  /// A random structure of many dofs whose first 3 n dofs are the contact's: n points in a row along x.
  struct Structure
  {
    unsigned int n_dofs, n_points;
    DenseMatrix stiffness;
    std::vector<double> omega;
    std::vector<dealii::Vector<double>> modes;
  };

  inline Structure structure(const unsigned int n_dofs, const unsigned int n_points)
  {
    Structure s{n_dofs,
                n_points,
                DenseMatrix(n_dofs),
                {},
                std::vector<dealii::Vector<double>>(n_dofs, dealii::Vector<double>(n_dofs))};
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(-1, 1);
    // a chain of springs with random couplings: unit mass
    DenseMatrix factor(n_dofs);
    for (unsigned int i = 0; i < n_dofs; ++i)
      for (unsigned int j = 0; j < n_dofs; ++j)
        factor(i, j) = (i == j ? 3 + 40. * i / n_dofs : 0) + uniform(random) * 8 / std::sqrt(n_dofs);
    factor.mTmult(s.stiffness, factor);
    s.stiffness *= 1e4;
    DenseMatrix K = s.stiffness, M(n_dofs);
    for (unsigned int i = 0; i < n_dofs; ++i)
      M(i, i) = 1;
    K.compute_generalized_eigenvalues_symmetric(M, s.modes);
    for (unsigned int i = 0; i < n_dofs; ++i)
      s.omega.push_back(std::sqrt(K.eigenvalue(i).real()));
    return s;
  }

  inline ContactPair reduce(const Structure &s, const unsigned int n_modes, const double zeta)
  {
    ContactPair pair;
    ContactGrid &grid = pair.interface.contacts.only();
    grid.n_x = s.n_points;
    grid.n_y = 1;
    grid.spacing_x = grid.spacing_y = 1e-3;
    pair.interface.gap.assign(s.n_points, 0.);
    const unsigned int rows = 3 * s.n_points;
    pair.trace.reinit(rows, n_modes);
    pair.residual.reinit(rows, rows);
    for (unsigned int k = 0; k < s.n_dofs; ++k)
    {
      if (k < n_modes)
      {
        pair.omega.push_back(s.omega[k]);
        pair.damping_ratio.push_back(zeta);
        pair.labels.push_back("body:" + std::to_string(k));
        pair.body.push_back(1);
        pair.modal_load.push_back(0);
        for (unsigned int i = 0; i < rows; ++i)
          pair.trace(i, k) = s.modes[k][i];
      }
      else
        for (unsigned int i = 0; i < rows; ++i)
          for (unsigned int j = 0; j < rows; ++j)
            pair.residual(i, j) += s.modes[k][i] * s.modes[k][j] / (s.omega[k] * s.omega[k]);
    }
    return pair;
  }

  /// All points slide along -y with a slip velocity and a normal force.
  inline RollingEquilibrium sliding(const unsigned int n, const double mu, const double force,
                                    const double slip)
  {
    RollingEquilibrium e;
    e.contact.R.reinit(3 * n);
    e.contact.y.reinit(3 * n);
    e.contact.status.assign(n, ContactStatus::slip);
    e.friction.assign(n, mu);
    for (unsigned int i = 0; i < n; ++i)
    {
      e.contact.R[i] = force;
      e.contact.y[2 * n + i] = slip;
      e.contact.R[2 * n + i] = -mu * force;
    }
    return e;
  }
} // namespace vibrocontact
