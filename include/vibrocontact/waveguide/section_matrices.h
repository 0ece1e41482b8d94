#pragma once

#include <vibrocontact/base/dense.h>
#include <vibrocontact/waveguide/section_elements.h>

#include <array>
#include <vector>

namespace vibrocontact
{
  /// The matrices of a section (section_elements.h), dense, in some m shapes of it: all of its dofs, a few smooth shapes
  /// (section_basis.h), or the fields of a beam, whose K0, K1, K2, M are written down by hand.
  struct SectionMatrices
  {
    /// K0, K1, K2, and with the loss factors of the materials; m square [N/m^2, N/m, N]
    std::array<DenseMatrix, 3> stiffness, loss_stiffness;
    /// m square [kg/m]
    DenseMatrix mass;
    /// whether a shape moves along the axis; shapes that do are coupled with those that do not by K1 alone
    std::vector<bool> axial;

    unsigned int n_shapes() const { return axial.size(); }
  };

  /// m shapes of a section.
  struct SectionShapes
  {
    /// n_dofs x m
    DenseMatrix shapes;
    std::vector<bool> axial;
    /// of smooth shapes: how much of the motions each holds, beyond all bounds if it is always kept (section_basis.h); else empty
    std::vector<double> shares;
    /// SectionElements::mark_of_dofs() of those whose shapes they are; empty: not said
    std::string dofs;

    unsigned int n() const { return axial.size(); }
    /// S^T f of a load on the section
    DenseVector reduced(const dealii::Vector<double> &load) const;
  };

  /// The numbers of the smooth shapes that hold no less than this.
  std::vector<unsigned int> shapes_with_share(const SectionShapes &shapes, double share);
  /// Every dof a shape of its own.
  SectionShapes all_shapes(const SectionElements &elements);
  /// S^T A S
  DenseMatrix reduced_matrix(const dealii::SparseMatrix<double> &matrix, const SectionShapes &shapes);
  SectionMatrices reduced_section(const SectionElements &elements, const SectionShapes &shapes);

  /// K(k) of a free wave in real form: with i times the axial displacements as unknowns it is symmetric,
  ///
  ///   K0 + k B + k^2 K2,   B_rc = s_r (K1 - K1^T)_rc, s_r = 1 for axial rows and -1 for others. [N/m^2]
  ///
  /// @param k wavenumber [rad/m]
  DenseMatrix wave_stiffness(const SectionMatrices &section, double k);

  /// A wave of the free, lossless body, u e^{i (w t - k x)} or any other sign: of its own frequency at a wavenumber.
  struct FreeWave
  {
    double frequency = 0;      ///< [Hz]
    double group_velocity = 0; ///< d omega / d k [m/s]
    /// amplitudes of the shapes, i times those of axial ones; of unit mass per length
    DenseVector shape;
  };

  /// All free waves of a wavenumber up to a frequency, ascending. @param k [rad/m] @param up_to [Hz]
  std::vector<FreeWave> free_waves(const SectionMatrices &section, double k, double up_to);
} // namespace vibrocontact
