#pragma once

#include <vibrocontact/bodies/body_in_contact.h>

#include <vector>

namespace vibrocontact
{
  /// A body under a harmonic force s(t) against stops (Jones & Legrand 2014, section 1; doc/theory.md, "Periodic motion").
  /// Its first rows are contact rows, point by point: the motion into the stop, with friction then the two tangential ones;
  /// another row, or one of them, is that of the force.
  ///
  /// u_n > 0 towards the stop, gap = gap_0 - u_n; p_n = -f_c, f_c >= 0 in compression, tangential forces as they act on the body.
  /// A massless contact node is a residual of the body, and there is nothing else if all modes are kept.
  struct ForcedBody : BodyInContact
  {
    /// row that s(t) acts on
    unsigned int force_row = 0;
    /// 1, or 3 with friction: normal, two tangential
    unsigned int rows_per_point = 1;
    /// of the undeformed body [m]; n_points; negative: preloaded
    std::vector<double> gap = {};

    unsigned int n_points() const { return gap.size(); }
    unsigned int n_contact_rows() const { return rows_per_point * n_points(); }
    /// of a unit exciting force: on a mode [1/sqrt(kg)], and the answer of the rest at a row [m/N]
    double modal_force(const unsigned int mode) const { return trace(force_row, mode); }
    double residual_force(const unsigned int row) const { return residual(row, force_row); }
    /// of the contact rows, n_contact_rows square [m/N]
    DenseMatrix contact_residual() const
    {
      DenseMatrix block(n_contact_rows(), n_contact_rows());
      for (unsigned int i = 0; i < block.m(); ++i)
        for (unsigned int j = 0; j < block.n(); ++j)
          block(i, j) = residual(i, j);
      return block;
    }
  };

  /// s(t) = F sin(2 pi f t + phase) [N], [Hz], [rad]. Results are read from where the force rises through zero; the phase
  /// only moves the force against the functions of time.
  struct HarmonicForce
  {
    double amplitude = 0, frequency = 1, phase = 0;
  };
} // namespace vibrocontact
