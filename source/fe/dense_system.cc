#include <vibrocontact/base/petsc_check.h>
#include <vibrocontact/fe/dense_system.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace vibrocontact
{
  namespace
  {
    constexpr unsigned int none = dealii::numbers::invalid_unsigned_int;

    /// Whether the stiffness couples a dof to others: a held one has its diagonal entry only.
    bool is_coupled(const SecondOrderSystem &system, const dealii::types::global_dof_index dof)
    {
      PetscInt n_columns;
      const PetscInt *columns;
      const PetscScalar *values;
      petsc_check(MatGetRow(system.stiffness, dof, &n_columns, &columns, &values), "MatGetRow");
      bool result = false;
      for (PetscInt k = 0; k < n_columns; ++k)
        result = result || (columns[k] != PetscInt(dof) && values[k] != 0);
      petsc_check(MatRestoreRow(system.stiffness, dof, &n_columns, &columns, &values), "MatRestoreRow");
      return result;
    }

    std::vector<unsigned int> places(const SecondOrderSystem &system)
    {
      std::vector<unsigned int> place(system.mass.m(), 0);
      // a coordinate of its own that a contact moves (residual flexibility of a body reduced before) is not held
      for (const TraceRow &row : system.trace.rows)
        for (const auto &[dof, weight] : row)
          if (system.locally_owned.is_element(dof))
            place[dof] = 1;
      for (const auto dof : system.locally_owned)
        place[dof] = place[dof] || system.mass.diag_element(dof) > 0 || is_coupled(system, dof);
      dealii::Utilities::MPI::sum(place, system.communicator, place);
      unsigned int n = 0;
      for (unsigned int &entry : place)
        entry = entry > 0 ? n++ : none;
      return place;
    }

    unsigned int count(const std::vector<unsigned int> &place)
    {
      return place.size() - std::count(place.begin(), place.end(), none);
    }

    void sum_over_ranks(DenseMatrix &matrix, const MPI_Comm communicator)
    {
      if (matrix.m() > 0 && matrix.n() > 0)
        MPI_Allreduce(MPI_IN_PLACE, &matrix(0, 0), matrix.m() * matrix.n(), MPI_DOUBLE, MPI_SUM,
                      communicator);
    }

    DenseMatrix dense(const SecondOrderSystem &system, const Mat matrix,
                      const std::vector<unsigned int> &place)
    {
      DenseMatrix result(count(place));
      for (const auto dof : system.locally_owned)
      {
        if (place[dof] == none)
          continue;
        PetscInt n_columns;
        const PetscInt *columns;
        const PetscScalar *values;
        petsc_check(MatGetRow(matrix, dof, &n_columns, &columns, &values), "MatGetRow");
        for (PetscInt k = 0; k < n_columns; ++k)
          if (place[columns[k]] != none)
            result(place[dof], place[columns[k]]) += values[k];
        petsc_check(MatRestoreRow(matrix, dof, &n_columns, &columns, &values), "MatRestoreRow");
      }
      sum_over_ranks(result, system.communicator);
      return result;
    }
  } // namespace

  unsigned int n_moving_dofs(const SecondOrderSystem &system)
  {
    return count(places(system));
  }

  DenseSystem dense_system(const SecondOrderSystem &system)
  {
    DenseSystem result;
    result.place = places(system);
    result.mass = dense(system, system.mass, result.place);
    result.stiffness = dense(system, system.stiffness, result.place);
    return result;
  }

  DenseMatrix dense_vectors(const SecondOrderSystem &system, const DenseSystem &dense,
                            const std::vector<dealii::PETScWrappers::MPI::Vector> &vectors)
  {
    DenseMatrix result(dense.n_dofs(), vectors.size());
    for (unsigned int k = 0; k < vectors.size(); ++k)
      for (const auto dof : system.locally_owned)
        if (dense.place[dof] != none)
          result(dense.place[dof], k) = vectors[k](dof);
    sum_over_ranks(result, system.communicator);
    return result;
  }
} // namespace vibrocontact
