#pragma once

#include <vibrocontact/base/dense.h>

#include <vector>

namespace vibrocontact
{
  struct PointReduction;

  /// A linear body under a harmonic force against stops, as the periodic analyses see it (Jones & Legrand 2014, section 1;
  /// doc/theory.md, "Periodic motion"): modes, and for each contact point one row (its motion into the stop) or three
  /// (that and the two tangential ones).
  ///
  ///   q'' + 2 zeta w q' + w^2 q = trace^T p + modal_force s(t) + modal_load
  ///   u = trace q + r,       relaxation r' + r = residual p + residual_force s(t) + residual_load
  ///
  /// u > 0 towards the stop, gap = gap_0 - u_n; p the forces on the body along its rows: p_n = -f_c, f_c >= 0 in
  /// compression, tangential forces as they act. s(t) = F sin(2 pi f t). r is what the modes leave out, static but
  /// for stiffness-proportional damping C = beta K, relaxation = beta; a massless contact node is such a residual, and
  /// there is nothing else if all modes are kept.
  struct PeriodicBody
  {
    /// angular frequencies [rad/s] and damping ratios [-]; n_modes
    std::vector<double> omega, damping_ratio;
    /// n_rows x n_modes [1/sqrt(kg)]
    DenseMatrix trace;
    /// answers of the modes to a unit exciting force and to the constant loads; n_modes [1/sqrt(kg)], [N/sqrt(kg)]
    std::vector<double> modal_force, modal_load;
    /// n_rows square [m/N]; n_rows [m/N]; n_rows [m]
    DenseMatrix residual;
    std::vector<double> residual_force, residual_load;
    /// beta [s]
    double relaxation = 0;
    /// 1, or 3 with friction: normal, two tangential
    unsigned int rows_per_point = 1;
    /// of the undeformed body [m]; n_points; negative: preloaded
    std::vector<double> gap;

    unsigned int n_modes() const { return omega.size(); }
    unsigned int n_rows() const { return trace.m(); }
    unsigned int n_points() const { return gap.size(); }
  };

  /// The body between some points: rows 0 .. n_rows - 1 are its contact rows, `exciting` the row of the force (one of them or
  /// another). Without gaps, rows per point and relaxation.
  /// @param omega [rad/s], @param damping_ratio of the modes of `points`
  PeriodicBody periodic_body(const PointReduction &points, const std::vector<double> &omega,
                             const std::vector<double> &damping_ratio, unsigned int n_rows,
                             unsigned int exciting);

  /// s(t) = F sin(2 pi f t + phase) [N], [Hz], [rad]. Results are read from where the force rises through zero; the phase
  /// only moves the force against the functions of time.
  struct HarmonicForce
  {
    double amplitude = 0, frequency = 1, phase = 0;
  };
} // namespace vibrocontact
