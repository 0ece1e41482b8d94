#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/coupled_bodies/answer_of_rest.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  using Complex = std::complex<double>;

  namespace
  {
    /// as a share of the frequency, the widest of a piece
    constexpr double width = 0.04;
    constexpr unsigned int n_nodes = 8;

    /// Number of the widest piece that a frequency lies in.
    double widest_of(const double frequency)
    {
      return std::floor(std::log(frequency) / std::log1p(width));
    }

    double largest(const ComplexMatrix &matrix)
    {
      double result = 0;
      for (unsigned int j = 0; j < matrix.n(); ++j)
        for (unsigned int i = 0; i < matrix.m(); ++i)
          result = std::max(result, std::abs(matrix(i, j)));
      return result;
    }
  } // namespace

  ComplexMatrix AnswerOfRest::Piece::at(const Complex &s) const
  {
    // barycentric, in the frequency that s / j is
    const Complex x = s / Complex(0, 1);
    std::vector<Complex> shares;
    Complex all = 0;
    for (unsigned int k = 0; k < nodes.size(); ++k)
    {
      const Complex difference = x - nodes[k];
      if (std::abs(difference) < 1e-13 * std::abs(x))
        return values[k];
      shares.push_back(weights[k] / difference);
      all += shares.back();
    }
    ComplexMatrix sum(values.front().m(), values.front().n());
    for (unsigned int k = 0; k < nodes.size(); ++k)
      sum.add(shares[k] / all, values[k]);
    return sum;
  }

  AnswerOfRest::Piece AnswerOfRest::empty_piece(const double from, const double to)
  {
    Piece piece{from, to, {}, {}, {}};
    for (unsigned int k = 0; k < n_nodes; ++k)
    {
      const double angle = dealii::numbers::PI * (2 * k + 1) / (2 * n_nodes);
      piece.nodes.push_back((from + to) / 2 + (to - from) / 2 * std::cos(angle));
      piece.weights.push_back((k % 2 == 0 ? 1 : -1) * std::sin(angle));
    }
    return piece;
  }

  AnswerOfRest::Piece AnswerOfRest::made(const double from, const double to)
  {
    Piece piece = empty_piece(from, to);
    for (const double node : piece.nodes)
      piece.values.push_back(equations->seen_by_first(Complex(0, node)));
    return piece;
  }

  const AnswerOfRest::Piece &AnswerOfRest::piece_of(const double frequency)
  {
    constexpr double narrowest = 1e-4, tolerance = 1e-6;
    const auto found = pieces.upper_bound(frequency);
    if (found != pieces.end() && found->second.from <= frequency)
      return found->second;
    double from = std::exp(widest_of(frequency) * std::log1p(width)), to = from * (1 + width);
    const auto halve = [&]
    {
      const double middle = (from + to) / 2;
      (frequency < middle ? to : from) = middle;
    };
    for (;;)
    {
      if (halved.count({from, to}) > 0)
      {
        halve();
        continue;
      }
      Piece piece = made(from, to);
      // between two nodes next to an end, where it errs most
      const double between = (piece.nodes[0] + piece.nodes[1]) / 2;
      ComplexMatrix exact = equations->seen_by_first(Complex(0, between)),
                    error = piece.at(Complex(0, between));
      error.add(-1., exact);
      const bool holds = largest(error) < tolerance * largest(exact);
      if (!holds && to - from < narrowest * from)
        throw ConvergenceError("What the other bodies answer at the contact near " +
                               number_text(frequency / (2 * dealii::numbers::PI)) +
                               " Hz is too sharp to be kept from one variant to the next: set "
                               "Stability/Roots to all.");
      if (holds)
        return pieces.emplace(to, std::move(piece)).first->second;
      halved.insert({from, to});
      halve();
    }
  }

  ComplexMatrix AnswerOfRest::at(const Complex &s)
  {
    if (!(s.imag() > 0) || !std::isfinite(s.imag()) || !std::isfinite(s.real()))
      throw ConvergenceError("A root of body 1 with its dampers is sought where it does not oscillate: set "
                             "Stability/Roots to all.");
    const Piece &piece = piece_of(s.imag());
    // farther off the axis its polynomials err more than along it
    return std::abs(s.real()) < (piece.to - piece.from) / 4 ? piece.at(s) : equations->seen_by_first(s);
  }

  void AnswerOfRest::make_pieces(std::vector<double> frequencies, const MPI_Comm communicator)
  {
    const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(communicator),
                       rank = dealii::Utilities::MPI::this_mpi_process(communicator), n = basis().n();
    std::sort(frequencies.begin(), frequencies.end());
    std::vector<double> own;
    double before = -1;
    unsigned int number = 0;
    for (const double frequency : frequencies)
    {
      number += widest_of(frequency) != before;
      before = widest_of(frequency);
      if (number % n_ranks == rank)
        own.push_back(frequency);
    }
    const std::map<double, Piece> known = pieces;
    for (const double frequency : own)
      try
      {
        piece_of(frequency);
      }
      catch (const ConvergenceError &)
      {
      }
    std::vector<double> packed;
    for (const auto &[to, piece] : pieces)
      if (known.count(to) == 0)
      {
        packed.insert(packed.end(), {piece.from, piece.to});
        for (const ComplexMatrix &value : piece.values)
          for (unsigned int j = 0; j < n; ++j)
            for (unsigned int i = 0; i < n; ++i)
              packed.insert(packed.end(), {value(i, j).real(), value(i, j).imag()});
      }
    for (const std::vector<double> &others : dealii::Utilities::MPI::all_gather(communicator, packed))
      for (auto next = others.begin(); next != others.end();)
      {
        const double from = *next++, to = *next++;
        Piece piece = empty_piece(from, to);
        for (unsigned int k = 0; k < n_nodes; ++k)
        {
          piece.values.emplace_back(n, n);
          for (unsigned int j = 0; j < n; ++j)
            for (unsigned int i = 0; i < n; ++i, next += 2)
              piece.values.back()(i, j) = Complex(*next, *(next + 1));
        }
        pieces.emplace(to, std::move(piece));
      }
  }
} // namespace vibrocontact
