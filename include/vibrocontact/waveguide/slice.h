#pragma once

#include <vibrocontact/waveguide/section_matrices.h>

#include <deal.II/lac/lapack_full_matrix.h>

#include <complex>
#include <optional>
#include <vector>

namespace vibrocontact
{
  using ComplexMatrix = dealii::LAPACKFullMatrix<std::complex<double>>;

  /// A piece of a waveguide between two sections, at one frequency, with n loads in it:
  ///
  ///      q1 -> |=======| <- q2        forces on the ends  f = S q - F c,   q, f: 2 m (left end, right end)
  ///            left  right            motions at loads    d = F^T q + C c,   c amplitudes, d: n
  ///
  /// All of it is symmetric, not Hermitian: hysteretic losses are complex stiffnesses. Two pieces in a row are a piece
  /// again (join()), so that equal ones double: a thousand spans take ten steps.
  struct Slice
  {
    /// dynamic stiffness of the ends [N/m per shape]; 2 m square
    ComplexMatrix stiffness;
    /// forces that unit loads put on held ends; 2 m x n
    ComplexMatrix forces;
    /// motions at the loads under them with held ends [m/N]; n square
    ComplexMatrix compliance;

    unsigned int n_shapes() const { return stiffness.m() / 2; }
    unsigned int n_loads() const { return compliance.m(); }
  };

  /// A load on a piece of a body along its axis: constant + linear (x - centre), each of them forces of the shapes per
  /// length [N/m]. Its motion is the same weighted mean of the body's.
  struct AxialLoad
  {
    /// place along the axis; length, 0: it acts on a section, with constant [N] [m]
    double centre = 0, length = 0;
    /// m
    DenseVector constant, linear;
  };

  /// Complex dynamic stiffness of the section per length: K0 + i H0 - w^2 M, with springs to the ground beside it, and
  /// K1 + i H1, K2 + i H2. A complex w = -i s is growing motion e^{st}, whose losses stay those of the stiffness alone.
  struct SectionAtFrequency
  {
    /// @param springs complex, added to K0 [N/m^2]; empty: none
    SectionAtFrequency(const SectionMatrices &section, std::complex<double> omega,
                       const ComplexMatrix &springs = ComplexMatrix());

    ComplexMatrix K0, K1, K2;
    unsigned int n_shapes() const { return K0.m(); }
  };

  /// An element along the axis: polynomials of a degree, inner nodes condensed. Loads that reach over it act on their part
  /// of it (those that end within it must not be there: divide there). Loads of no length are put in by add_section_load().
  /// @param from, length of the element [m]
  Slice element_slice(const SectionAtFrequency &section, double from, double length, unsigned int degree,
                      const std::vector<AxialLoad> &loads);

  /// A uniform piece of any length without loads, from equal elements not longer than one_element by doubling.
  Slice uniform_slice(const SectionAtFrequency &section, double length, double one_element,
                      unsigned int degree);

  /// A piece without loads among so many that do nothing in it.
  Slice with_loads(Slice slice, unsigned int n_loads);

  /// right follows left.
  Slice join(const Slice &left, const Slice &right);
  /// What there is so far, if anything, and behind it the next.
  inline void follow(std::optional<Slice> &whole, const Slice &next)
  {
    whole = whole ? join(*whole, next) : next;
  }

  /// A load on the right end.
  void add_section_load(Slice &slice, unsigned int load, const DenseVector &force);

  /// The ends of infinitely many equal spans in a row: dynamic stiffness of what follows to the right, and to the left; m
  /// square.
  struct InfiniteEnds
  {
    ComplexMatrix right, left;
  };
  /// @throws ConvergenceError if waves do not decay within 2^40 spans: nothing takes energy
  InfiniteEnds infinite_ends(const Slice &span);

  /// Motions of the ends under each load, in a track that goes on; 2 m x n.
  ComplexMatrix end_motions(const Slice &slice, const InfiniteEnds &ends);

  /// Motions at the loads of a piece whose ends go on with these dynamic stiffnesses [m/N]; n square.
  /// @param left, right m square; empty: free end
  ComplexMatrix receptance(const Slice &slice, const ComplexMatrix &left, const ComplexMatrix &right);
} // namespace vibrocontact
