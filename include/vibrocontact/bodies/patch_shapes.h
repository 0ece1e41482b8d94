#pragma once

#include <vibrocontact/base/dense.h>

namespace vibrocontact
{
  /// The modal trace through few shapes: modes vary slowly over the contact, so that hundreds of them move it
  /// in some ten or twenty independent ways,
  ///
  ///   Psi = basis * amplitudes,    basis^T basis = I,
  ///
  /// by singular values, those below `tolerance` times the largest left out (the relative error of Psi in the
  /// spectral norm). Contact and modes then exchange `rank()` numbers per time step instead of 3 n n_modes.
  struct PatchShapes
  {
    /// 3 n x rank [-]
    DenseMatrix basis;
    /// rank x n_modes [1/sqrt(kg)]
    DenseMatrix amplitudes;

    unsigned int rank() const { return basis.n(); }
  };

  /// Relative error of the shapes in time steps: far below what a step makes of them (doc/transient.md).
  constexpr double patch_shape_tolerance = 1e-8;

  /// @param modal_trace 3 n x n_modes [1/sqrt(kg)]; without modes the rank is zero
  PatchShapes patch_shapes(const DenseMatrix &modal_trace, double tolerance);
} // namespace vibrocontact
