#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/reduction/all_modes.h>
#include <vibrocontact/reduction/block_product.h>
#include <vibrocontact/reduction/compute_modes.h>
#include <vibrocontact/reduction/krylov_schur.h>
#include <vibrocontact/reduction/locally_owned_values.h>
#include <vibrocontact/reduction/orient_modes.h>
#include <vibrocontact/reduction/projected_matrix.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>
#include <deal.II/base/timer.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace vibrocontact
{
  using Vector = dealii::PETScWrappers::MPI::Vector;

  namespace
  {
    constexpr double pair_tolerance = 1e-3;
    const double two_pi = 2 * dealii::numbers::PI;

    unsigned int n_dofs_with_mass(const SecondOrderSystem &system)
    {
      Vector diagonal(system.locally_owned, system.communicator);
      MatGetDiagonal(system.mass, diagonal);
      const std::vector<double> masses = locally_owned_values(diagonal);
      const unsigned int n_own =
          std::count_if(masses.begin(), masses.end(), [](const double m) { return m > 0; });
      return dealii::Utilities::MPI::sum(n_own, system.communicator);
    }

    // Number of modes below an angular frequency, rigid ones included.
    unsigned int count_below(const SecondOrderSystem &system, const double omega, Modes &modes)
    {
      dealii::Timer timer;
      SymmetricFactorization::Options options;
      options.name = system.body + ": count of modes";
      options.definite = false;
      options.keep_factors = false;
      const SymmetricFactorization shifted(system.stiffness, &system.mass, omega * omega, options);
      modes.seconds_count += timer.wall_time();
      return shifted.n_negative();
    }

    // Without factors that count: whether a second search, beside the modes found, meets another one below an angular
    // frequency. It need not be exact: pairs are never split, so that such a one lies further below than that.
    bool has_others_below(const SecondOrderSystem &system, Flexibility &flexibility, const double omega,
                          const unsigned int n_massive, Modes &modes)
    {
      if (modes.omega.size() + krylov_dimension(1) > n_massive)
        return false; // all of them are there
      constexpr double tolerance = 1e-3;
      dealii::Timer timer;
      Modes beside = modes;
      krylov_schur(system, flexibility, 1, beside, tolerance);
      modes.n_solves = beside.n_solves;
      modes.seconds_count += timer.wall_time();
      const auto number = [omega](const Modes &some)
      {
        return std::count_if(some.omega.begin(), some.omega.end(),
                             [omega](double other) { return other < omega; });
      };
      const auto found = number(beside) - number(modes);
      run_log().line("a second search beside the modes met " + (found > 0 ? std::to_string(found) : "no") +
                     " other below " + number_text(omega / two_pi) + " Hz (" + time_text(timer.wall_time()) +
                     "); iterative solves cannot count them");
      return found > 0;
    }

    // Mass-normalises, then measures orthonormality and residuals.
    void verify(const SecondOrderSystem &system, Modes &modes)
    {
      constexpr unsigned int block_size = 16;
      const PetscInt n_rows = system.locally_owned.n_elements();
      Vector mass_shape(system.locally_owned, system.communicator), force(mass_shape);
      for (unsigned int first = 0; first < modes.shapes.size(); first += block_size)
      {
        const unsigned int n = std::min<unsigned int>(block_size, modes.shapes.size() - first);
        const std::vector<double> columns = locally_owned_values(modes.shapes, first, n);
        const auto inertia = block_product(system.mass, columns, n),
                   elastic = block_product(system.stiffness, columns, n);
        for (unsigned int k = 0; k < n; ++k)
        {
          const unsigned int i = first + k;
          set_locally_owned_values(inertia.data() + k * n_rows, mass_shape);
          set_locally_owned_values(elastic.data() + k * n_rows, force);
          const double norm = std::sqrt(mass_shape * modes.shapes[i]);
          modes.shapes[i] /= norm;
          mass_shape /= norm;
          force /= norm;
          for (unsigned int j = 0; j <= i; ++j)
            modes.orthonormality_error = std::max(
                modes.orthonormality_error, std::abs(mass_shape * modes.shapes[j] - (i == j ? 1. : 0.)));
          if (i >= modes.n_rigid_modes)
          {
            const double lambda = modes.omega[i] * modes.omega[i];
            force.add(-lambda, mass_shape);
            modes.residual = std::max(modes.residual, force.l2_norm() / (lambda * mass_shape.l2_norm()));
          }
        }
      }
      std::ostringstream text;
      text << modes.n_solves << " solves, orthonormality error " << modes.orthonormality_error
           << ", residual " << modes.residual;
      run_log().line(text.str());
      if (!(modes.orthonormality_error < 1e-8) || !(modes.residual < 1e-4))
        throw ConvergenceError(
            "Body '" + system.body + "': the modes are not accurate: " + text.str() +
            "; rounding of the stiffness is more than its weakest motions resist: it or its "
            "cells are too slender, or its materials too unlike.");
    }
  } // namespace

  Modes compute_modes(const SecondOrderSystem &system, Flexibility &flexibility,
                      const ModeParameters &parameters)
  {
    Modes modes;
    modes.shapes = flexibility.rigid_modes();
    modes.n_rigid_modes = modes.shapes.size();
    modes.omega.assign(modes.n_rigid_modes, 0.);
    if (!parameters.any())
      return modes;
    const unsigned int n_rigid = modes.n_rigid_modes;
    const double limit = two_pi * parameters.upper_frequency;
    const bool by_frequency = parameters.upper_frequency > 0;
    if (by_frequency && flexibility.is_iterative())
      throw InputError(
          "Body '" + system.body +
          "': iterative solves cannot count the modes below Modes/Upper frequency; set that to 0 "
          "and give a Count.");

    unsigned int n_below = 0; // elastic modes wanted
    if (by_frequency)
    {
      const unsigned int n_all = count_below(system, limit, modes);
      n_below = n_all > n_rigid ? n_all - n_rigid : 0;
      run_log().line(std::to_string(n_below) + " elastic modes below " +
                     number_text(parameters.upper_frequency) + " Hz (inertia count, " +
                     time_text(modes.seconds_count) + ")");
    }
    else
      n_below = parameters.count;
    const unsigned int n_massive = n_dofs_with_mass(system);
    if (n_below + n_rigid > n_massive)
      throw InputError("Body '" + system.body + "': " + std::to_string(n_below) +
                       " modes are more than its " + std::to_string(system.stiffness.m()) +
                       " dofs can tell; ask for fewer.");

    // A Krylov sequence sees as many modes of one frequency as its blocks have columns: what the count misses
    // is sought again, next to the modes found so far. LAPACK solves bodies of few dofs.
    // A body reduced before is asked for all it has.
    const bool wants_all = n_below + 2 + n_rigid > n_massive;
    unsigned int n_kept = 0, n_missing = n_below;
    for (unsigned int attempt = 0;; ++attempt)
    {
      if (wants_all || modes.omega.size() + krylov_dimension(n_missing + 2) > n_massive)
        modes = all_modes(system, modes);
      else
        krylov_schur(system, flexibility, n_missing + 2, modes);
      // The pair of the last mode comes along.
      n_kept = n_rigid + n_below;
      while (n_kept > n_rigid && n_kept + 1 < modes.omega.size() &&
             modes.omega[n_kept] < modes.omega[n_kept - 1] * (1 + pair_tolerance))
        ++n_kept;
      if (wants_all)
        break;
      // equal ones up to the last that was found: there may be more of them
      if (!by_frequency && attempt < 4 && n_kept > n_rigid &&
          modes.omega[n_kept] < modes.omega[n_kept - 1] * (1 + pair_tolerance))
      {
        run_log().line("the last modes found are equal: more are sought beside them");
        n_missing = n_below;
        continue;
      }
      double bound = limit;
      unsigned int expected = n_rigid + n_below;
      if (!by_frequency)
        bound = (modes.omega[n_kept - 1] + modes.omega[n_kept]) / 2;
      if (flexibility.is_iterative())
      {
        if (!has_others_below(system, flexibility, bound, n_massive, modes))
          break;
        if (attempt == 4)
          throw ConvergenceError("Body '" + system.body + "': beside the modes found below " +
                                 number_text(bound / two_pi) + " Hz there are always others.");
        n_missing = 1;
        continue;
      }
      if (!by_frequency)
        expected = count_below(system, bound, modes);
      const unsigned int found =
          std::count_if(modes.omega.begin(), modes.omega.end(), [&](double omega) { return omega < bound; });
      if (found == expected)
        break;
      const std::string text = std::to_string(found) + " modes found below " + number_text(bound / two_pi) +
                               " Hz, but there are " + std::to_string(expected);
      if (found > expected || attempt == 4)
        throw ConvergenceError("Body '" + system.body + "': " + text + ".");
      run_log().line(text + ": the others are sought beside them");
      n_missing = expected - found;
    }
    if (n_kept > n_rigid + n_below)
      run_log().line(std::to_string(n_kept - n_rigid - n_below) + " more than the " +
                     std::to_string(n_below) + " asked for: equal frequencies (to " +
                     number_text(pair_tolerance) + "), at " + number_text(modes.omega[n_kept - 1] / two_pi) +
                     " Hz, stay together");
    modes.omega.resize(n_kept);
    modes.shapes.resize(n_kept);
    verify(system, modes);
    if (flexibility.is_iterative())
      run_log().line(flexibility.iterations_text());
    orient_modes(system, modes);
    return modes;
  }

  std::vector<double> strain_energy_damping(const SecondOrderSystem &system, const Modes &modes)
  {
    std::vector<double> zeta(modes.omega.size(), 0.);
    if (!system.has_loss || modes.shapes.empty())
      return zeta;
    Vector force(modes.shapes[0]);
    for (unsigned int i = modes.n_rigid_modes; i < zeta.size(); ++i)
    {
      system.loss_stiffness.vmult(force, modes.shapes[i]);
      zeta[i] = (force * modes.shapes[i]) / (2 * modes.omega[i] * modes.omega[i]);
    }
    return zeta;
  }

  ModalDamping modal_damping(const SecondOrderSystem &system, const Modes &modes)
  {
    ModalDamping result;
    if (!system.has_damping || modes.shapes.empty())
      return result;
    const DenseMatrix c = projected_matrix(system.damping, modes.shapes);
    const unsigned int n = modes.shapes.size();
    double largest = 0;
    for (unsigned int i = 0; i < n; ++i)
      largest = std::max(largest, std::abs(c(i, i)));
    result.ratio.assign(n, 0.);
    // of the text of a file
    constexpr double rounding = 1e-9;
    for (unsigned int i = 0; i < n; ++i)
    {
      if (i < modes.n_rigid_modes && std::abs(c(i, i)) > rounding * largest)
        throw InputError("Body '" + system.body +
                         "': its damping resists a rigid motion, which has no damping ratio: hold the body, "
                         "or leave dampers to the ground out of its damping.");
      if (i >= modes.n_rigid_modes && c(i, i) < -rounding * largest)
        throw InputError("Body '" + system.body + "': its damping feeds energy into mode " +
                         std::to_string(i + 1 - modes.n_rigid_modes) + " (" +
                         number_text(modes.omega[i] / two_pi) +
                         " Hz): a damping matrix is positive semi-definite; mend its file.");
      if (i >= modes.n_rigid_modes)
        result.ratio[i] = std::max(0., c(i, i)) / (2 * modes.omega[i]);
    }
    for (unsigned int i = modes.n_rigid_modes; i < n; ++i)
      for (unsigned int j = modes.n_rigid_modes; j < i; ++j)
        if (std::min(c(i, i), c(j, j)) > rounding * largest)
          result.coupling = std::max(result.coupling, std::abs(c(i, j)) / std::sqrt(c(i, i) * c(j, j)));
    return result;
  }

  std::vector<double> damping_ratios(const SecondOrderSystem &system, const Modes &modes)
  {
    std::vector<double> zeta = strain_energy_damping(system, modes);
    const std::vector<double> viscous = modal_damping(system, modes).ratio;
    for (unsigned int i = 0; i < viscous.size(); ++i)
      zeta[i] += viscous[i];
    return zeta;
  }

  DenseMatrix coupling_loss(const SecondOrderSystem &system, const Modes &modes)
  {
    constexpr double least_coupling = 1e-6;
    if (!system.has_loss || modes.shapes.empty())
      return DenseMatrix();
    const DenseMatrix loss = projected_matrix(system.loss_stiffness, modes.shapes);
    for (unsigned int j = 0; j < loss.n(); ++j)
      for (unsigned int i = 0; i < j; ++i)
        if (std::abs(loss(i, j)) > least_coupling * std::sqrt(std::abs(loss(i, i) * loss(j, j))))
          return loss;
    return DenseMatrix();
  }
} // namespace vibrocontact
