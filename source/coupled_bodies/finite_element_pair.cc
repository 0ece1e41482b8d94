#include <vibrocontact/base/dense_operations.h>
#include <vibrocontact/coupled_bodies/finite_element_pair.h>

namespace vibrocontact
{
  unsigned int n_moving_dofs(const FiniteElementPair &bodies)
  {
    unsigned int n = 0;
    for (const FiniteElementBody &body : bodies)
      if (body.system)
        n += n_moving_dofs(*body.system);
    return n;
  }

  InertialPair finite_element_pair(const FiniteElementPair &bodies, const ContactPair &pair)
  {
    InertialPair result;
    result.contacts = pair.interface.contacts;
    result.omega = pair.omega;
    result.labels = pair.labels;
    const unsigned int n = n_moving_dofs(bodies);
    result.mass.reinit(n);
    result.damping.reinit(n);
    result.stiffness.reinit(n);
    result.trace.reinit(3 * pair.n_points(), n);
    result.to_modes.reinit(pair.n_modes(), n);
    unsigned int mode = 0, first = 0;
    for (unsigned int b = 0; b < bodies.size(); ++b)
    {
      if (!bodies[b].system)
        continue;
      const SecondOrderSystem &system = *bodies[b].system;
      const DenseSystem dense = dense_system(system);
      const PlacedContacts::Rows own = result.contacts.rows_of(b);
      add_block(result.mass, dense.mass, first, first);
      add_block(result.stiffness, dense.stiffness, first, first);
      for (unsigned int i = 0; i < own.rows.size(); ++i)
        for (const auto &[dof, weight] : system.trace.rows[i])
          if (dense.place[dof] != dealii::numbers::invalid_unsigned_int)
            result.trace(own.rows[i], first + dense.place[dof]) += own.sign[i] * weight;
      const unsigned int n_modes = bodies[b].modes->shapes.size();
      if (n_modes > 0)
      {
        DenseMatrix to_modes(n_modes, dense.n_dofs());
        dense_vectors(system, dense, bodies[b].modes->shapes).Tmmult(to_modes, dense.mass);
        add_block(result.to_modes, to_modes, mode, first);
      }
      mode += n_modes;
      first += dense.n_dofs();
    }
    AssertThrow(mode == pair.n_modes(), dealii::ExcInternalError());
    DenseMatrix scaled = result.to_modes;
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int k = 0; k < pair.n_modes(); ++k)
        scaled(k, j) *= 2 * pair.damping_ratio[k] * pair.omega[k];
    if (pair.n_modes() > 0)
      result.to_modes.Tmmult(result.damping, scaled);
    return result;
  }
} // namespace vibrocontact
