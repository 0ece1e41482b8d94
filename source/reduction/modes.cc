#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/reduction/modes.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>
#include <deal.II/base/timer.h>

#include <slepceps.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

namespace vibrocontact
{
  using Vector = dealii::PETScWrappers::MPI::Vector;

  void ModeParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.add_parameter("Upper frequency", upper_frequency,
                      "All modes up to this frequency are computed; 0: as many as Count says. Units: Hz.",
                      Double(0, 1e6));
    prm.add_parameter(
        "Count", count,
        "Number of elastic modes, one more if it would split a pair; 0: go by Upper frequency. Units: none.",
        Integer(0, 20000));
    prm.add_parameter("Damping ratio 0 nodal diameters", damping_0,
                      "Modal damping ratio of a wheel's modes without nodal diameter (Eq. 23). Units: none.",
                      Double(0, 1));
    prm.add_parameter("Damping ratio 1 nodal diameter", damping_1,
                      "Modal damping ratio of a wheel's modes with one nodal diameter (Eq. 23). Units: none.",
                      Double(0, 1));
    prm.add_parameter(
        "Damping ratio 2 nodal diameters", damping_2,
        "Modal damping ratio of a wheel's modes with two or more nodal diameters (Eq. 23). Units: none.",
        Double(0, 1));
    prm.add_parameter(
        "Rim radius", rim_radius,
        "Points of a wheel further than this from its axle are its rim, whose motion names the family of a "
        "mode. Units: m.",
        Double(0, 100));
  }

  void ModeParameters::check(const std::string &section) const
  {
    if (upper_frequency > 0 && count > 0)
      throw InputError("Section '" + section + "': Upper frequency = " + std::to_string(upper_frequency) +
                       " Hz and Count = " + std::to_string(count) +
                       " contradict each other; set one of them to 0.");
    if (!(rim_radius > 0))
      throw InputError("Section '" + section + "': Rim radius must be positive.");
  }

  std::string ModeParameters::key() const
  {
    std::ostringstream text;
    text.precision(17);
    text << upper_frequency << ' ' << count << ' ' << damping_0 << ' ' << damping_1 << ' ' << damping_2 << ' '
         << rim_radius;
    return text.str();
  }

  namespace
  {
    constexpr double pair_tolerance = 1e-3;
    constexpr double tolerance = 1e-10;
    const double two_pi = 2 * dealii::numbers::PI;

    void check_error(const PetscErrorCode error, const char *what)
    {
      AssertThrow(error == 0, dealii::ExcMessage(std::string("SLEPc failed: ") + what));
    }

    struct InverseContext
    {
      const SecondOrderSystem &system;
      Flexibility &flexibility;
      Progress &progress;
      Vector in, out;
      unsigned int n_solves = 0;
    };

    PetscErrorCode apply_flexibility(PC pc, Vec x, Vec y)
    {
      void *context = nullptr;
      PCShellGetContext(pc, &context);
      auto &my = *static_cast<InverseContext *>(context);
      VecCopy(x, my.in);
      my.flexibility.vmult(my.out, my.in);
      VecCopy(my.out, y);
      ++my.n_solves;
      return 0;
    }

    PetscErrorCode report(EPS, PetscInt, PetscInt n_converged, PetscScalar *, PetscScalar *, PetscReal *,
                          PetscInt, void *context)
    {
      auto &[progress, done] = *static_cast<std::pair<Progress *, PetscInt> *>(context);
      if (n_converged > done)
        progress->advance(n_converged - done);
      done = n_converged;
      return 0;
    }

    // The mass matrix without the zeros that it inherits from the stiffness's pattern (two thirds of it): a
    // third of the time. To be destroyed by the caller.
    Mat compact(Mat mass)
    {
      PetscInt begin = 0, end = 0, n = 0;
      MatGetOwnershipRange(mass, &begin, &end);
      MatGetSize(mass, &n, nullptr);
      const PetscInt n_local = end - begin;
      std::vector<PetscInt> n_own(n_local, 0), n_other(n_local, 0), columns;
      std::vector<PetscScalar> values;
      const auto read_row = [&](const PetscInt row)
      {
        PetscInt m = 0;
        const PetscInt *c = nullptr;
        const PetscScalar *v = nullptr;
        columns.clear();
        values.clear();
        MatGetRow(mass, row, &m, &c, &v);
        for (PetscInt k = 0; k < m; ++k)
          if (v[k] != 0 || c[k] == row)
          {
            columns.push_back(c[k]);
            values.push_back(v[k]);
          }
        MatRestoreRow(mass, row, &m, &c, &v);
      };
      for (PetscInt row = begin; row < end; ++row)
      {
        read_row(row);
        for (const PetscInt c : columns)
          ++(c >= begin && c < end ? n_own : n_other)[row - begin];
      }
      Mat result;
      check_error(MatCreateAIJ(PetscObjectComm(reinterpret_cast<PetscObject>(mass)), n_local, n_local, n, n,
                               0, n_own.data(), 0, n_other.data(), &result),
                  "MatCreateAIJ");
      for (PetscInt row = begin; row < end; ++row)
      {
        read_row(row);
        MatSetValues(result, 1, &row, columns.size(), columns.data(), values.data(), INSERT_VALUES);
      }
      MatAssemblyBegin(result, MAT_FINAL_ASSEMBLY);
      MatAssemblyEnd(result, MAT_FINAL_ASSEMBLY);
      return result;
    }

    // Number of modes below an angular frequency, rigid ones included.
    unsigned int count_below(const SecondOrderSystem &system, const double omega, Modes &modes)
    {
      dealii::Timer timer;
      SymmetricFactorization::Options options;
      options.definite = false;
      options.keep_factors = false;
      const SymmetricFactorization shifted(system.stiffness, &system.mass, omega * omega, options);
      modes.seconds_count += timer.wall_time();
      modes.megabytes_count = shifted.statistics().megabytes_rank;
      return shifted.n_negative();
    }

    // The `n_wanted` lowest elastic modes (perhaps some more), ascending, appended to `modes`.
    void solve(const SecondOrderSystem &system, Flexibility &flexibility, const unsigned int n_wanted,
               Modes &modes)
    {
      dealii::Timer timer;
      const unsigned int n_first = modes.omega.size();
      Vector prototype(system.locally_owned, system.communicator);
      Progress progress(system.body + ": modes", n_wanted);
      InverseContext inverse{system, flexibility, progress, prototype, prototype};
      std::pair<Progress *, PetscInt> monitor(&progress, 0);

      EPS eps;
      ST st;
      KSP ksp;
      PC pc;
      check_error(EPSCreate(system.communicator, &eps), "EPSCreate");
      Mat mass = compact(system.mass);
      EPSSetOperators(eps, system.stiffness, mass);
      EPSSetProblemType(eps, EPS_GHEP);
      EPSSetType(eps, EPSKRYLOVSCHUR);
      EPSSetWhichEigenpairs(eps, EPS_TARGET_MAGNITUDE);
      EPSSetTarget(eps, 0.);
      EPSGetST(eps, &st);
      STSetType(st, STSINVERT);
      STSetMatMode(st, ST_MATMODE_SHELL);
      STGetKSP(st, &ksp);
      KSPSetType(ksp, KSPPREONLY);
      KSPGetPC(ksp, &pc);
      PCSetType(pc, PCSHELL);
      PCShellSetContext(pc, &inverse);
      PCShellSetApply(pc, apply_flexibility);
      const PetscInt n = system.stiffness.m();
      // Modes converge at about two solves each. Convergence is looked at when the basis is full; keeping
      // nearly all of it at a restart makes the steps after that short.
      const PetscInt basis = std::min<PetscInt>(n, std::max<PetscInt>(1.9 * n_wanted, n_wanted + 20));
      EPSKrylovSchurSetRestart(eps, 0.9);
      EPSSetDimensions(eps, n_wanted, basis, PETSC_DEFAULT);
      EPSSetTolerances(eps, tolerance, 200);
      EPSMonitorSet(eps, report, &monitor, nullptr);

      Vector start(prototype);
      for (unsigned int i = 0; i < system.locally_owned.n_elements(); ++i)
      {
        const auto dof = system.locally_owned.nth_index_in_set(i);
        start(dof) = std::sin(1. + n_first + 0.7390851 * dof * (1. + 1e-3 * (dof % 97)));
      }
      start.compress(dealii::VectorOperation::insert);
      system.mass.vmult(inverse.in, start);
      flexibility.vmult(start, Vector(inverse.in));
      Vec start_vec = start;
      EPSSetInitialSpace(eps, 1, &start_vec);
      std::vector<Vec> known(modes.shapes.begin() + modes.n_rigid_modes, modes.shapes.end());
      if (!known.empty())
        EPSSetDeflationSpace(eps, known.size(), known.data());

      check_error(EPSSolve(eps), "EPSSolve");
      PetscInt n_converged = 0;
      EPSGetConverged(eps, &n_converged);
      if (n_converged < static_cast<PetscInt>(n_wanted))
      {
        EPSDestroy(&eps);
        MatDestroy(&mass);
        throw ConvergenceError("Body '" + system.body + "': only " + std::to_string(n_converged) + " of " +
                               std::to_string(n_wanted) + " modes converged to " + std::to_string(tolerance) +
                               ".");
      }
      for (PetscInt i = 0; i < n_converged; ++i)
      {
        PetscScalar lambda = 0, imaginary = 0;
        modes.shapes.push_back(prototype);
        EPSGetEigenpair(eps, i, &lambda, &imaginary, modes.shapes.back(), nullptr);
        modes.omega.push_back(std::sqrt(lambda));
      }
      EPSDestroy(&eps);
      MatDestroy(&mass);
      modes.n_solves += inverse.n_solves;

      std::vector<unsigned int> order(modes.omega.size());
      std::iota(order.begin(), order.end(), 0);
      std::stable_sort(order.begin(), order.end(),
                       [&](unsigned int a, unsigned int b) { return modes.omega[a] < modes.omega[b]; });
      Modes sorted = modes;
      for (unsigned int i = 0; i < order.size(); ++i)
      {
        sorted.omega[i] = modes.omega[order[i]];
        sorted.shapes[i] = modes.shapes[order[i]];
      }
      modes = std::move(sorted);
      modes.seconds_solver += timer.wall_time();
    }

    // Mass-normalises, then measures orthonormality and residuals.
    void verify(const SecondOrderSystem &system, Modes &modes)
    {
      Vector mass_shape(system.locally_owned, system.communicator), force(mass_shape);
      for (unsigned int i = 0; i < modes.shapes.size(); ++i)
      {
        system.mass.vmult(mass_shape, modes.shapes[i]);
        const double norm = std::sqrt(mass_shape * modes.shapes[i]);
        modes.shapes[i] /= norm;
        mass_shape /= norm;
        for (unsigned int j = 0; j <= i; ++j)
          modes.orthonormality_error = std::max(modes.orthonormality_error,
                                                std::abs(mass_shape * modes.shapes[j] - (i == j ? 1. : 0.)));
        if (i >= modes.n_rigid_modes)
        {
          const double lambda = modes.omega[i] * modes.omega[i];
          system.stiffness.vmult(force, modes.shapes[i]);
          force.add(-lambda, mass_shape);
          modes.residual = std::max(modes.residual, force.l2_norm() / (lambda * mass_shape.l2_norm()));
        }
      }
      std::ostringstream text;
      text << "orthonormality error " << modes.orthonormality_error << ", residual " << modes.residual;
      run_log().line(text.str());
      if (!(modes.orthonormality_error < 1e-8) || !(modes.residual < 1e-4))
        throw ConvergenceError("Body '" + system.body + "': the modes are not accurate: " + text.str() + ".");
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

    unsigned int n_below = 0; // elastic modes wanted
    if (by_frequency)
    {
      n_below = count_below(system, limit, modes) - n_rigid;
      run_log().line(std::to_string(n_below) + " elastic modes below " +
                     std::to_string(parameters.upper_frequency) + " Hz (inertia count, " +
                     time_text(modes.seconds_count) + ")");
    }
    else
      n_below = parameters.count;
    const unsigned int n_dynamic = system.stiffness.m() - n_rigid;
    if (n_below + 2 > n_dynamic)
      throw InputError("Body '" + system.body + "': " + std::to_string(n_below) +
                       " modes are more than its " + std::to_string(system.stiffness.m()) +
                       " dofs can tell; ask for fewer.");

    // A single Krylov sequence sees one mode of an exactly double frequency: what the count misses is sought
    // again, next to the modes found so far.
    unsigned int n_kept = 0, n_missing = n_below;
    for (unsigned int attempt = 0;; ++attempt)
    {
      solve(system, flexibility, n_missing + 2, modes);
      // The pair of the last mode comes along.
      n_kept = n_rigid + n_below;
      while (n_kept > n_rigid && n_kept + 1 < modes.omega.size() &&
             modes.omega[n_kept] < modes.omega[n_kept - 1] * (1 + pair_tolerance))
        ++n_kept;
      double bound = limit;
      unsigned int expected = n_rigid + n_below;
      if (!by_frequency)
      {
        bound = (modes.omega[n_kept - 1] + modes.omega[n_kept]) / 2;
        expected = count_below(system, bound, modes);
      }
      const unsigned int found =
          std::count_if(modes.omega.begin(), modes.omega.end(), [&](double omega) { return omega < bound; });
      if (found == expected)
        break;
      const std::string text = std::to_string(found) + " modes found below " +
                               std::to_string(bound / two_pi) + " Hz, but there are " +
                               std::to_string(expected);
      if (found > expected || attempt == 4)
        throw ConvergenceError("Body '" + system.body + "': " + text + ".");
      run_log().line(text + ": the others are sought beside them");
      n_missing = expected - found;
    }
    modes.omega.resize(n_kept);
    modes.shapes.resize(n_kept);
    verify(system, modes);
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
} // namespace vibrocontact
