#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/base/petsc_check.h>
#include <vibrocontact/reduction/krylov_schur.h>

#include <slepceps.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <numeric>

namespace vibrocontact
{
  using Vector = dealii::PETScWrappers::MPI::Vector;

  namespace
  {
    constexpr double tolerance = 1e-10;

    struct InverseContext
    {
      const SecondOrderSystem &system;
      Flexibility &flexibility;
      Progress &progress;
      Vector in, out;
      unsigned int n_solves = 0;
      /// what a solve threw: it must not cross PETSc, which is C
      std::exception_ptr failure;
    };

    /// Errors are returned only; otherwise PETSc prints the stack of its calls as well.
    struct Quiet
    {
      Quiet() { PetscPushErrorHandler(PetscIgnoreErrorHandler, nullptr); }
      ~Quiet() { PetscPopErrorHandler(); }
    };

    /// The eigensolver, given back at the end of the scope.
    struct Solver
    {
      explicit Solver(const MPI_Comm communicator)
      {
        petsc_check(EPSCreate(communicator, &eps), "EPSCreate");
      }
      ~Solver()
      {
        const Quiet quiet; // after a failed solve its parts are not in order
        EPSDestroy(&eps);
      }
      Solver(const Solver &) = delete;
      Solver &operator=(const Solver &) = delete;

      EPS eps = nullptr;
    };

    PetscErrorCode apply_flexibility(PC pc, Vec x, Vec y)
    {
      void *context = nullptr;
      if (const PetscErrorCode error = PCShellGetContext(pc, &context))
        return error;
      auto &my = *static_cast<InverseContext *>(context);
      try
      {
        petsc_check(VecCopy(x, my.in), "VecCopy");
        my.flexibility.vmult(my.out, my.in);
        petsc_check(VecCopy(my.out, y), "VecCopy");
      }
      catch (...)
      {
        my.failure = std::current_exception();
        return PETSC_ERR_LIB;
      }
      ++my.n_solves;
      my.progress.advance();
      return 0;
    }

    void sort_modes(Modes &modes)
    {
      std::vector<unsigned int> order(modes.omega.size());
      std::iota(order.begin(), order.end(), 0);
      std::stable_sort(order.begin(), order.end(),
                       [&](unsigned int a, unsigned int b) { return modes.omega[a] < modes.omega[b]; });
      std::vector<double> omega;
      std::vector<Vector> shapes;
      for (const unsigned int i : order)
      {
        omega.push_back(modes.omega[i]);
        shapes.push_back(modes.shapes[i]);
      }
      modes.omega = std::move(omega);
      modes.shapes = std::move(shapes);
    }
  } // namespace

  void krylov_schur(const SecondOrderSystem &system, Flexibility &flexibility, Mat mass,
                    const unsigned int n_wanted, Modes &modes)
  {
    const unsigned int n_first = modes.omega.size();
    Vector prototype(system.locally_owned, system.communicator);
    const PetscInt n = system.stiffness.m();
    // Modes converge at about two solves each. Convergence is looked at when the basis is full; keeping
    // nearly all of it at a restart makes the steps after that short.
    const PetscInt basis = std::min<PetscInt>(n, std::max<PetscInt>(1.9 * n_wanted, n_wanted + 20));
    // solves are what takes time: the basis once, and a tenth of it after a restart
    Progress progress(system.body + ": " + std::to_string(n_wanted) + " modes", 1.1 * basis);
    InverseContext inverse{system, flexibility, progress, prototype, prototype, 0, nullptr};

    const Solver solver(system.communicator);
    const EPS eps = solver.eps;
    ST st;
    KSP ksp;
    PC pc;
    petsc_check(EPSSetOperators(eps, system.stiffness, mass), "EPSSetOperators");
    EPSSetProblemType(eps, EPS_GHEP);
    EPSSetType(eps, EPSKRYLOVSCHUR);
    EPSSetWhichEigenpairs(eps, EPS_TARGET_MAGNITUDE);
    EPSSetTarget(eps, 0.);
    petsc_check(EPSGetST(eps, &st), "EPSGetST");
    STSetType(st, STSINVERT);
    STSetMatMode(st, ST_MATMODE_SHELL);
    petsc_check(STGetKSP(st, &ksp), "STGetKSP");
    KSPSetType(ksp, KSPPREONLY);
    petsc_check(KSPGetPC(ksp, &pc), "KSPGetPC");
    PCSetType(pc, PCSHELL);
    PCShellSetContext(pc, &inverse);
    PCShellSetApply(pc, apply_flexibility);
    EPSKrylovSchurSetRestart(eps, 0.9);
    EPSSetDimensions(eps, n_wanted, basis, PETSC_DEFAULT);
    EPSSetTolerances(eps, tolerance, 200);

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

    PetscErrorCode error = 0;
    {
      const Quiet quiet;
      error = EPSSolve(eps);
    }
    if (inverse.failure)
      std::rethrow_exception(inverse.failure);
    petsc_check(error, "EPSSolve");
    PetscInt n_converged = 0;
    petsc_check(EPSGetConverged(eps, &n_converged), "EPSGetConverged");
    if (n_converged < static_cast<PetscInt>(n_wanted))
      throw ConvergenceError("Body '" + system.body + "': only " + std::to_string(n_converged) + " of " +
                             std::to_string(n_wanted) + " modes converged to " + number_text(tolerance) +
                             ".");
    for (PetscInt i = 0; i < n_converged; ++i)
    {
      PetscScalar lambda = 0, imaginary = 0;
      modes.shapes.push_back(prototype);
      petsc_check(EPSGetEigenpair(eps, i, &lambda, &imaginary, modes.shapes.back(), nullptr),
                  "EPSGetEigenpair");
      if (!(lambda > 0))
        throw ConvergenceError("Body '" + system.body + "': a mode has the squared frequency " +
                               number_text(lambda) +
                               " (rad/s)^2, which is not positive; is the body held, and does its mesh have "
                               "cells of reasonable shape?");
      modes.omega.push_back(std::sqrt(lambda));
    }
    modes.n_solves += inverse.n_solves;

    sort_modes(modes);
  }
} // namespace vibrocontact
