#include <vibrocontact/base/memory.h>
#include <vibrocontact/base/petsc_check.h>
#include <vibrocontact/base/shared_cases.h>
#include <vibrocontact/fe/material_flow.h>
#include <vibrocontact/reduction/projected_matrix.h>
#include <vibrocontact/reduction/response_reduction.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>
#include <deal.II/base/timer.h>

#include <boost/serialization/complex.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <sstream>

namespace vibrocontact
{
  using Vector = dealii::PETScWrappers::MPI::Vector;

  namespace
  {
    /// Makes `candidate` orthogonal in M to the vectors and of unit length; false if nothing is left of it.
    bool orthonormalise(const SecondOrderSystem &system, const std::vector<Vector> &vectors,
                        Vector &candidate)
    {
      Vector inertia(candidate);
      system.mass.vmult(inertia, candidate);
      const double whole = std::sqrt(inertia * candidate);
      std::vector<Vec> all(vectors.begin(), vectors.end());
      std::vector<double> shares(vectors.size());
      for (unsigned int pass = 0; pass < 3; ++pass)
      {
        system.mass.vmult(inertia, candidate);
        petsc_check(VecMDot(inertia, all.size(), all.data(), shares.data()), "VecMDot");
        for (double &share : shares)
          share *= -1;
        petsc_check(VecMAXPY(candidate, all.size(), shares.data(), all.data()), "VecMAXPY");
      }
      system.mass.vmult(inertia, candidate);
      const double left = std::sqrt(std::max(0., inertia * candidate));
      if (!(left > 1e-7 * whole))
        return false;
      candidate /= left;
      return true;
    }

    /// Static answers to forces on the points, and to the loss in them.
    std::vector<Vector> static_answers(const SecondOrderSystem &system, Flexibility &flexibility,
                                       const std::vector<TraceRow> &points)
    {
      std::vector<Vector> answers, corrections;
      for (const auto &point : points)
      {
        Vector force(system.locally_owned, system.communicator), u(force);
        for (const auto &[dof, weight] : point)
          if (system.locally_owned.is_element(dof))
            force(dof) = weight;
        force.compress(dealii::VectorOperation::insert);
        flexibility.vmult(u, force);
        answers.push_back(u);
        if (!system.has_loss)
          continue;
        system.loss_stiffness.vmult(force, answers.back());
        flexibility.vmult(u, force);
        corrections.push_back(u);
      }
      answers.insert(answers.end(), corrections.begin(), corrections.end());
      return answers;
    }

    /// Turns the vectors from `first` on so that they are orthogonal in K as well; their frequencies.
    std::vector<double> ritz(const SecondOrderSystem &system, std::vector<Vector> &vectors,
                             const unsigned int first)
    {
      const std::vector<Vector> basis(vectors.begin() + first, vectors.end());
      const unsigned int n = basis.size();
      std::vector<double> omega(n);
      if (n == 0)
        return omega;
      DenseMatrix stiffness = projected_matrix(system.stiffness, basis);
      dealii::FullMatrix<double> turn;
      DenseVector squares;
      stiffness.compute_eigenvalues_symmetric(0., 1e300, 0., squares, turn);
      AssertThrow(squares.size() == n, dealii::ExcInternalError());
      for (unsigned int j = 0; j < n; ++j)
      {
        omega[j] = std::sqrt(squares[j]);
        vectors[first + j] = 0;
        for (unsigned int i = 0; i < n; ++i)
          vectors[first + j].add(turn(i, j), basis[i]);
      }
      return omega;
    }
  } // namespace

  ResponseReduction reduce_response(const SecondOrderSystem &system, Flexibility &flexibility,
                                    const Modes &modes, const std::vector<double> &damping_ratio,
                                    const bool wheel, const std::vector<TraceRow> &points,
                                    std::vector<Vector> *const basis)
  {
    dealii::Timer timer;
    ResponseReduction result;
    const unsigned int n = modes.omega.size(), m = points.size();
    result.n_dofs = system.stiffness.m();
    result.n_rigid_modes = modes.n_rigid_modes;
    result.damping_ratio = damping_ratio;
    ContactTrace trace;
    trace.rows = points;

    std::vector<Vector> vectors = modes.shapes;
    const std::vector<Vector> answers = static_answers(system, flexibility, points);
    result.compliance.reinit(m, m);
    for (unsigned int j = 0; j < answers.size(); ++j)
    {
      if (j < m)
      {
        const auto motion = contact_trace(trace, answers[j]);
        std::copy(motion.begin(), motion.end(), &result.compliance(0, j));
      }
      Vector candidate(answers[j]);
      if (orthonormalise(system, vectors, candidate))
        vectors.push_back(candidate);
    }
    result.omega = modes.omega;
    const std::vector<double> others = ritz(system, vectors, n);
    result.omega.insert(result.omega.end(), others.begin(), others.end());

    result.loss.reinit(vectors.size(), vectors.size());
    if (system.has_loss)
      result.loss = projected_matrix(system.loss_stiffness, vectors);
    if (system.has_damping)
      result.damping = projected_matrix(system.damping, vectors);
    if (system.flow && system.flow->turning.m() == 0)
      result.gyroscopic = projected_antisymmetric_matrix(system.flow->fixed, vectors);
    // a wheel's ratios by nodal diameters (Eq. 23) come on top of what its material loses
    for (unsigned int k = 0; k < n && wheel; ++k)
      result.loss(k, k) = 2 * damping_ratio[k] * modes.omega[k] * modes.omega[k];
    result.trace.reinit(m, vectors.size());
    for (unsigned int k = 0; k < vectors.size(); ++k)
    {
      const auto motion = contact_trace(trace, vectors[k]);
      std::copy(motion.begin(), motion.end(), &result.trace(0, k));
    }
    if (basis)
      *basis = std::move(vectors);
    result.seconds = timer.wall_time();
    return result;
  }

  namespace
  {
    /// Of frequencies that ranks share out, if each rank's memory holds the factors; null otherwise. Collective.
    std::unique_ptr<HarmonicSolver> single_rank_solver(const SecondOrderSystem &system,
                                                       const std::size_t n_frequencies, const double rotation)
    {
      if (dealii::Utilities::MPI::n_mpi_processes(system.communicator) == 1 || n_frequencies < 2)
        return nullptr;
      auto solver = std::make_unique<HarmonicSolver>(system, HarmonicSolver::Ranks::alone, nullptr, rotation);
      const bool is_short = !memory_shortage("", solver->factorisation_bytes(), system.communicator).empty();
      return is_short ? nullptr : std::move(solver);
    }
  } // namespace

  std::string key_at(const std::string &key, const std::vector<double> &frequency)
  {
    std::ostringstream text;
    text.precision(17);
    text << key << "frequencies";
    for (const double f : frequency)
      text << ' ' << f;
    return text.str();
  }

  DirectResponse solve_directly(const SecondOrderSystem &system, const std::vector<TraceRow> &points,
                                const std::vector<double> &frequency, const std::function<void()> &advance,
                                const double rotation)
  {
    dealii::Timer timer;
    DirectResponse result;
    result.frequency = frequency;
    const unsigned int m = points.size();
    result.real.reinit(frequency.size(), m * m);
    result.imaginary.reinit(frequency.size(), m * m);
    const auto take = [&](const unsigned int k, const std::vector<std::complex<double>> &receptance)
    {
      for (unsigned int i = 0; i < m * m; ++i)
      {
        result.real(k, i) = receptance[i].real();
        result.imaginary(k, i) = receptance[i].imag();
      }
      advance();
    };
    if (const auto alone = single_rank_solver(system, frequency.size(), rotation))
      share_cases<std::vector<std::complex<double>>>(
          frequency.size(), 1,
          [&]
          {
            return [&](const unsigned int k)
            { return alone->receptance(2 * dealii::numbers::PI * frequency[k], points); };
          },
          [&](const unsigned int k, const std::function<std::vector<std::complex<double>>()> &solved)
          { take(k, solved()); },
          system.communicator);
    else
    {
      HarmonicSolver solver(system, HarmonicSolver::Ranks::together, nullptr, rotation);
      for (unsigned int k = 0; k < frequency.size(); ++k)
        take(k, solver.receptance(2 * dealii::numbers::PI * frequency[k], points));
    }
    result.seconds = timer.wall_time();
    return result;
  }
} // namespace vibrocontact
