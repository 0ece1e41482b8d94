#include <vibrocontact/analyses/finite_element_pair.h>
#include <vibrocontact/base/petsc_check.h>

#include <deal.II/base/mpi.h>

namespace vibrocontact
{
  namespace
  {
    // number of each dof among those that have mass, all of them on every rank
    std::vector<unsigned int> numbers_with_mass(const SecondOrderSystem &system, unsigned int &n)
    {
      std::vector<unsigned int> number(system.mass.m(), 0);
      for (const auto dof : system.locally_owned)
        number[dof] = system.mass.diag_element(dof) > 0;
      dealii::Utilities::MPI::sum(number, system.communicator, number);
      for (unsigned int &entry : number)
        entry = entry > 0 ? n++ : dealii::numbers::invalid_unsigned_int;
      return number;
    }

    void add_owned_rows(const SecondOrderSystem &system, const Mat matrix,
                        const std::vector<unsigned int> &number, DenseMatrix &into)
    {
      for (const auto dof : system.locally_owned)
      {
        if (number[dof] == dealii::numbers::invalid_unsigned_int)
          continue;
        PetscInt n_columns;
        const PetscInt *columns;
        const PetscScalar *values;
        petsc_check(MatGetRow(matrix, dof, &n_columns, &columns, &values), "MatGetRow");
        for (PetscInt k = 0; k < n_columns; ++k)
          if (number[columns[k]] != dealii::numbers::invalid_unsigned_int)
            into(number[dof], number[columns[k]]) += values[k];
        petsc_check(MatRestoreRow(matrix, dof, &n_columns, &columns, &values), "MatRestoreRow");
      }
    }

    void sum_over_ranks(DenseMatrix &matrix, const MPI_Comm communicator)
    {
      if (matrix.m() > 0 && matrix.n() > 0)
        MPI_Allreduce(MPI_IN_PLACE, &matrix(0, 0), matrix.m() * matrix.n(), MPI_DOUBLE, MPI_SUM,
                      communicator);
    }
  } // namespace

  unsigned int n_moving_dofs(const FiniteElementPair &bodies)
  {
    unsigned int n = 0;
    for (const FiniteElementBody &body : bodies)
      if (body.system)
        numbers_with_mass(*body.system, n);
    return n;
  }

  InertialPair finite_element_pair(const FiniteElementPair &bodies, const ContactPair &pair)
  {
    InertialPair result;
    result.grid = pair.interface.grid;
    result.omega = pair.omega;
    result.labels = pair.labels;
    unsigned int n = 0;
    std::vector<std::vector<unsigned int>> numbers(bodies.size());
    MPI_Comm communicator = MPI_COMM_SELF;
    for (unsigned int b = 0; b < bodies.size(); ++b)
      if (bodies[b].system)
      {
        communicator = bodies[b].system->communicator;
        numbers[b] = numbers_with_mass(*bodies[b].system, n);
      }
    result.mass.reinit(n);
    result.damping.reinit(n);
    result.stiffness.reinit(n);
    result.trace.reinit(3 * pair.n_points(), n);
    result.to_modes.reinit(pair.n_modes(), n);
    unsigned int mode = 0;
    for (unsigned int b = 0; b < bodies.size(); ++b)
    {
      if (!bodies[b].system)
        continue;
      const SecondOrderSystem &system = *bodies[b].system;
      const std::vector<unsigned int> &number = numbers[b];
      add_owned_rows(system, system.mass, number, result.mass);
      add_owned_rows(system, system.stiffness, number, result.stiffness);
      for (unsigned int row = 0; row < system.trace.rows.size(); ++row)
        for (const auto &[dof, weight] : system.trace.rows[row])
          if (number[dof] != dealii::numbers::invalid_unsigned_int)
            result.trace(row, number[dof]) += b == 0 ? weight : -weight;
      dealii::PETScWrappers::MPI::Vector inertia(system.locally_owned, system.communicator);
      for (const auto &shape : bodies[b].modes->shapes)
      {
        system.mass.vmult(inertia, shape);
        for (const auto dof : system.locally_owned)
          if (number[dof] != dealii::numbers::invalid_unsigned_int)
            result.to_modes(mode, number[dof]) = inertia(dof);
        ++mode;
      }
    }
    AssertThrow(mode == pair.n_modes(), dealii::ExcInternalError());
    sum_over_ranks(result.mass, communicator);
    sum_over_ranks(result.stiffness, communicator);
    sum_over_ranks(result.to_modes, communicator);
    DenseMatrix scaled = result.to_modes;
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int k = 0; k < pair.n_modes(); ++k)
        scaled(k, j) *= 2 * pair.damping_ratio[k] * pair.omega[k];
    if (pair.n_modes() > 0)
      result.to_modes.Tmmult(result.damping, scaled);
    return result;
  }
} // namespace vibrocontact
