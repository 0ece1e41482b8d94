#pragma once

#include <vibrocontact/waveguide/section_matrices.h>

#include <vector>

namespace vibrocontact
{
  /// Which smooth shapes of a section are kept.
  struct SmoothShapesSettings
  {
    /// motions up to this frequency [Hz]
    double up_to = 6000;
    /// smallest share of a motion's energy norm that gets a shape of its own
    double tolerance = 1e-2;
  };

  /// The shapes in which a section moves below a frequency under some loads, so that a few stand for all of its dofs.
  ///
  /// The section's answers (K(k) - w^2 M)^-1 f to each load are taken at wavenumbers from 0 to those of the loads' own size
  /// and at decaying ones (imaginary k), at frequencies from 0 to `up_to`; waves, their near fields and the indentation
  /// under the loads are among them. A section that keeps its form (it shifts, turns, stays plane) is kept exactly, the rest by its own size. Axial and other displacements have shapes of their own: along the axis they go as
  /// sine and cosine. A proper orthogonal decomposition in the norm w^2 M + K0 + kappa^2 K2 keeps what matters.
  ///
  /// @param loads forces on the section, each with components of one direction or of y and z
  /// @param springs below the section, under which it is answering as well [N/m^2]; empty matrix: none
  SectionShapes smooth_shapes(const SectionElements &elements,
                              const std::vector<dealii::Vector<double>> &loads,
                              const dealii::SparseMatrix<double> &springs,
                              const SmoothShapesSettings &settings);
} // namespace vibrocontact
