#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/reduction/compute_modes.h>
#include <vibrocontact/reduction/reduction_parts.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/timer.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
    using Vector = dealii::PETScWrappers::MPI::Vector;

    DenseMatrix trace_of(const ContactTrace &trace, const std::vector<Vector> &shapes, const unsigned int n)
    {
      DenseMatrix result(trace.rows.size(), n);
      if (!trace.rows.empty())
        for (unsigned int j = 0; j < n; ++j)
        {
          const auto column = contact_trace(trace, shapes[j]);
          std::copy(column.begin(), column.end(), &result(0, j));
        }
      return result;
    }

    std::vector<double> products(const SecondOrderSystem &system, const std::vector<Vector> &shapes,
                                 const unsigned int n)
    {
      std::vector<double> result(n, 0.);
      if (system.has_load)
        for (unsigned int j = 0; j < n; ++j)
          result[j] = shapes[j] * system.load;
      return result;
    }
  } // namespace

  namespace
  {
    DenseMatrix participation(const SecondOrderSystem &system, const std::vector<Vector> &shapes)
    {
      DenseMatrix result(shapes.size(), 3);
      Vector translation(system.locally_owned, system.communicator), inertia(translation);
      for (unsigned int d = 0; d < 3 && !shapes.empty(); ++d)
      {
        translation = 0;
        for (unsigned int i = 0; i < system.dof_direction.size(); ++i)
          if (system.dof_direction[i] == d)
            translation(system.locally_owned.nth_index_in_set(i)) = 1;
        translation.compress(dealii::VectorOperation::insert);
        system.mass.vmult(inertia, system.translations.empty() ? translation : system.translations[d]);
        for (unsigned int k = 0; k < shapes.size(); ++k)
          result(k, d) = shapes[k] * inertia;
      }
      return result;
    }
  } // namespace

  StaticReduction reduce_statically(const SecondOrderSystem &system, Flexibility &flexibility)
  {
    dealii::Timer timer;
    const unsigned int n_rows = system.trace.rows.size(), n_points = n_rows / 3;
    StaticReduction result;
    result.name = system.body;
    result.grid = system.trace.grid;
    result.n_dofs = system.stiffness.m();
    result.surface_height = system.trace.surface_height;
    result.compliance = flexibility.contact_compliance();
    if (!system.local_compliance.empty())
      result.compliance.add(1., system.local_compliance);
    result.load_response.assign(n_rows, 0.);
    if (system.has_load)
    {
      Vector u(system.load);
      flexibility.vmult(u, system.load);
      result.load_response = contact_trace(system.trace, u);
    }
    // A held body without springs follows its held boundary rigidly: exact.
    result.lifting.assign(n_rows, 0.);
    if (system.follows_hub && !system.trace.lifting.empty())
      result.lifting = system.trace.lifting;
    else if (system.follows_hub)
      std::fill_n(result.lifting.begin(), n_points, 1.);
    result.rigid_trace = trace_of(system.trace, flexibility.rigid_modes(), system.n_rigid_modes);
    result.rigid_load = products(system, flexibility.rigid_modes(), system.n_rigid_modes);
    run_log().line("contact compliance of " + std::to_string(n_rows) +
                   " rows: " + time_text(timer.wall_time()));
    if (flexibility.is_iterative())
      run_log().line(flexibility.iterations_text());
    return result;
  }

  ModalReduction modal_reduction(const SecondOrderSystem &system, const Modes &modes)
  {
    ModalReduction result;
    const unsigned int n = modes.omega.size();
    result.n_rigid_modes = modes.n_rigid_modes;
    result.n_dofs = system.stiffness.m();
    result.omega = modes.omega;
    result.trace = trace_of(system.trace, modes.shapes, n);
    result.load = products(system, modes.shapes, n);
    result.participation = participation(system, modes.shapes);
    result.orthonormality_error = modes.orthonormality_error;
    result.residual = modes.residual;
    return result;
  }

  ModalReduction reduce_modally(const SecondOrderSystem &system, Flexibility &flexibility,
                                const ModeParameters &parameters, const std::optional<WheelFrame> &wheel,
                                Modes *const shapes)
  {
    dealii::Timer timer;
    Modes modes = compute_modes(system, flexibility, parameters);
    ModalReduction result = modal_reduction(system, modes);
    const unsigned int n = modes.omega.size();
    result.damping_ratio = strain_energy_damping(system, modes);
    result.loss = coupling_loss(system, modes);
    const ModalDamping viscous = modal_damping(system, modes);
    result.damping_coupling = viscous.coupling;
    for (unsigned int i = 0; i < viscous.ratio.size(); ++i)
    {
      result.damping_ratio[i] += viscous.ratio[i];
      if (result.loss.m() > 0)
        result.loss(i, i) += 2 * viscous.ratio[i] * modes.omega[i] * modes.omega[i];
    }
    if (wheel)
    {
      const auto labels = wheel_labels(system, modes, *wheel);
      result.labels = unique_texts(labels);
      const std::vector<double> by_diameters = wheel_damping(labels, parameters);
      for (unsigned int i = 0; i < n; ++i)
      {
        result.damping_ratio[i] += by_diameters[i];
        if (result.loss.m() > 0)
          result.loss(i, i) += 2 * by_diameters[i] * modes.omega[i] * modes.omega[i];
      }
    }
    else
      for (unsigned int i = 0; i < n; ++i)
        result.labels.push_back("mode " + std::to_string(i + 1 - modes.n_rigid_modes));
    for (unsigned int i = 0; i < modes.n_rigid_modes; ++i)
    {
      result.labels[i] = "rigid " + std::to_string(i + 1);
      result.damping_ratio[i] = 0;
    }
    const auto &factors = flexibility.factorization().statistics();
    result.seconds = timer.wall_time() + factors.seconds_ordering + factors.seconds_analysis +
                     factors.seconds_factorization;
    if (shapes)
      *shapes = std::move(modes);
    return result;
  }

  ReducedBody combine(const StaticReduction &statics, const ModalReduction *const modal)
  {
    const unsigned int n = statics.compliance.m(), n_rigid = statics.rigid_load.size();
    ReducedBody body;
    body.name = statics.name;
    body.grid = statics.grid;
    body.n_dofs = statics.n_dofs;
    body.n_rigid_modes = n_rigid;
    body.lifting = statics.lifting;
    body.surface_height = statics.surface_height;
    body.residual_load = statics.load_response;
    body.residual = statics.compliance;
    if (modal == nullptr)
    {
      body.omega.assign(n_rigid, 0.);
      body.damping_ratio.assign(n_rigid, 0.);
      for (unsigned int i = 0; i < n_rigid; ++i)
        body.labels.push_back("rigid " + std::to_string(i + 1));
      body.trace = statics.rigid_trace;
      body.modal_load = statics.rigid_load;
      return body;
    }

    if (n > 0 && modal->omega.empty())
      throw InputError("No mode of " + body.name + " lies below " + body.name +
                       "/Modes/Upper frequency: raise it or give a Count.");
    AssertThrow(modal->trace.m() == n && modal->n_rigid_modes == n_rigid, dealii::ExcInternalError());
    body.omega = modal->omega;
    body.damping_ratio = modal->damping_ratio;
    body.loss = modal->loss;
    body.labels = modal->labels;
    body.trace = modal->trace;
    body.modal_load = modal->load;
    body.damping_coupling = modal->damping_coupling;
    body.participation = modal->participation;
    const unsigned int n_modes = modal->omega.size();
    if (n == 0 || n_modes == n_rigid)
      return body;

    DenseMatrix scaled(n, n_modes - n_rigid), product(n, n);
    for (unsigned int k = n_rigid; k < n_modes; ++k)
      for (unsigned int i = 0; i < n; ++i)
      {
        scaled(i, k - n_rigid) = modal->trace(i, k) / modal->omega[k];
        body.residual_load[i] -= modal->trace(i, k) * modal->load[k] / (modal->omega[k] * modal->omega[k]);
      }
    scaled.mTmult(product, scaled);
    double largest = 0;
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int i = 0; i <= j; ++i)
      {
        const double value = statics.compliance(i, j) - (product(i, j) + product(j, i)) / 2;
        body.residual(i, j) = body.residual(j, i) = value;
        if (i == j)
          largest = std::max(largest, statics.compliance(i, i));
      }

    DenseMatrix shifted = body.residual;
    for (unsigned int i = 0; i < n; ++i)
      shifted(i, i) += 1e-8 * largest;
    if (!factorise_cholesky(shifted))
      throw ConvergenceError("Body '" + body.name +
                             "': the residual flexibility of the contact is not positive " +
                             "semi-definite to 1e-8; the modes are not those of the matrices.");
    return body;
  }
} // namespace vibrocontact
