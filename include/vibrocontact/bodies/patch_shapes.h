#pragma once

#include <vibrocontact/base/dense.h>

namespace vibrocontact
{
  /// The trace of modes or poles at contact points through few shapes: they vary slowly over a contact, so that hundreds of
  /// them move it in some ten or twenty independent ways,
  ///
  ///   Psi = basis * amplitudes,    basis^T basis = I,
  ///
  /// by singular values, those below `tolerance` times the largest left out (the relative error of Psi in the
  /// spectral norm). Contact and modes then exchange `rank()` numbers per time step instead of rows times modes.
  struct PatchShapes
  {
    /// rows x rank [-]
    DenseMatrix basis;
    /// rank x modes, in the trace's unit
    DenseMatrix amplitudes;

    unsigned int rank() const { return basis.n(); }
  };

  /// Relative error of the shapes in time steps: far below what a step makes of them (doc/transient.md).
  constexpr double patch_shape_tolerance = 1e-8;

  /// @param trace rows x modes; without modes the rank is zero
  PatchShapes patch_shapes(const DenseMatrix &trace, double tolerance);
} // namespace vibrocontact
