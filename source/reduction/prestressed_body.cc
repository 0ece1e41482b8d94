#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/fe/prestress.h>
#include <vibrocontact/reduction/flexibility.h>
#include <vibrocontact/reduction/prestressed_body.h>

namespace vibrocontact
{
  namespace
  {
    /// of the displacement: terms of second order are of this share
    constexpr double large_gradient = 0.05;

    void check_definite(const SecondOrderSystem &system, const double speed)
    {
      SymmetricFactorization::Options options;
      options.name = system.body + ": prestressed stiffness";
      options.definite = false;
      options.keep_factors = false;
      const unsigned int n_negative =
          SymmetricFactorization(system.stiffness, nullptr, 0., options).n_negative();
      if (n_negative > 0)
        throw ConvergenceError(
            "Body '" + system.body + "': under the stress of its loads its stiffness has " +
            std::to_string(n_negative) + " negative eigenvalue" + (n_negative > 1 ? "s" : "") + ": it " +
            (speed != 0 ? "flies apart or buckles at " + number_text(speed) +
                              " rad/s; lower Rotation/Speed or hold it more stiffly."
                        : std::string("buckles; lower its Loads or hold it more stiffly.")));
    }
  } // namespace

  void prestress(const ElasticBody<3> &body, const StiffnessSolver solver, SecondOrderSystem &system)
  {
    if (!system.has_load)
      return;
    if (system.n_rigid_modes > 0)
      throw InputError("Body '" + system.body + "' is held in some directions alone, which leave it " +
                       std::to_string(system.n_rigid_modes) + " rigid motion" +
                       (system.n_rigid_modes > 1 ? "s" : "") +
                       ": nothing holds it there against the loads whose stress stiffens it; hold more.");
    using Vector = dealii::PETScWrappers::MPI::Vector;
    Vector u(system.locally_owned, system.communicator);
    Flexibility(system, solver).vmult(u, system.load);
    const PrestressNumbers numbers = add_prestress(body, u, system);
    Log &log = run_log();
    log.value(system.body + ": largest displacement under its loads", u.linfty_norm(), "m");
    log.value(system.body + ": largest equivalent stress of its loads", numbers.largest_stress, "Pa");
    if (numbers.largest_gradient > large_gradient)
      log.warning("Body '" + system.body + "': its loads deform it by up to " +
                  number_text(100 * numbers.largest_gradient) +
                  " %, but the stiffness under their stress is of first order in that.");
    if (solver == StiffnessSolver::direct)
      check_definite(system, body.model.rotation.speed);
    system.stiffness.vmult(system.load, u);
    if (body.model.turns() && body.model.rotation.coriolis)
      system.flow = coriolis_of(body, system);
  }
} // namespace vibrocontact
