#pragma once

#include <vibrocontact/coupled_bodies/contact_receptance.h>

#include <mpi.h>

#include <complex>
#include <map>
#include <memory>
#include <set>
#include <utility>
#include <vector>

namespace vibrocontact
{
  /// What all but body 1 answers at its patch, T(s) of ContactReceptance::seen_by_first(), as polynomials of s over short pieces
  /// of the imaginary axis: made where it is asked for, halved until they hold to 1e-6, and kept. An evaluation
  /// costs a thousandth of the contact's equations.
  class AnswerOfRest
  {
  public:
    explicit AnswerOfRest(std::shared_ptr<const ContactReceptance> equations)
        : equations(std::move(equations))
    {
    }
    /// Farther off the axis than a quarter of a piece the contact's equations themselves.
    /// @throws ConvergenceError unless Im s > 0, or if pieces of 1e-4 of the frequency do not hold either
    ComplexMatrix at(const std::complex<double> &s);
    const DenseMatrix &basis() const { return equations->basis_of_first(); }
    /// Makes the pieces at these frequencies [rad/s], shared out over the ranks, so that none makes them again. One that does
    /// not hold is left to at(). Collective.
    void make_pieces(std::vector<double> frequencies, MPI_Comm communicator);

  private:
    struct Piece
    {
      double from, to;
      std::vector<double> nodes, weights;
      std::vector<ComplexMatrix> values;
      ComplexMatrix at(const std::complex<double> &s) const;
    };
    /// Its nodes and weights.
    static Piece empty_piece(double from, double to);
    const Piece &piece_of(double frequency);
    Piece made(double from, double to);

    const std::shared_ptr<const ContactReceptance> equations;
    /// by the end of their interval [rad/s]
    std::map<double, Piece> pieces;
    /// intervals over which polynomials do not hold
    std::set<std::pair<double, double>> halved;
  };
} // namespace vibrocontact
