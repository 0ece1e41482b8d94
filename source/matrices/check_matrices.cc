#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/base/petsc_check.h>
#include <vibrocontact/matrices/check_matrices.h>
#include <vibrocontact/reduction/symmetric_factorization.h>

#include <deal.II/base/mpi.h>

#include <cmath>

namespace vibrocontact
{
  void check_diagonals(const std::vector<StoredEntry> &triangle, const std::string &file,
                       const unsigned int n, const std::vector<MatrixDof> &dofs)
  {
    std::vector<double> diagonal(n, 0.);
    for (const StoredEntry &entry : triangle)
      if (entry.row == entry.column)
      {
        diagonal[entry.row] = entry.value;
        if (entry.value < 0)
          throw InputError(file + ", line " + std::to_string(entry.line) + ", has " +
                           number_text(entry.value) + " on the diagonal, in row " +
                           std::to_string(entry.row + 1) +
                           ": masses and stiffnesses are not negative; mend the matrix.");
      }
    for (const StoredEntry &entry : triangle)
      if (entry.value != 0 && (diagonal[entry.row] == 0 || diagonal[entry.column] == 0))
        throw InputError(
            file + ", line " + std::to_string(entry.line) + ", couples row " + std::to_string(entry.row + 1) +
            " to column " + std::to_string(entry.column + 1) +
            ", one of which has 0 on the diagonal: the matrix is not positive semi-definite, or the "
            "file is cut off.");
    for (unsigned int i = 0; i < dofs.size(); ++i)
      if (diagonal[i] == 0 && dofs[i].direction != MatrixDof::modal)
        throw InputError(file + " gives no stiffness to row " + std::to_string(i + 1) + ", " +
                         dofs[i].text() +
                         ": nothing holds it, or the file is cut off; take the dof out or mend the file.");
  }

  void check_semidefinite(const dealii::PETScWrappers::MPI::SparseMatrix &matrix,
                          const SecondOrderSystem &system, const std::string &file, const std::string &what)
  {
    dealii::PETScWrappers::MPI::SparseMatrix shifted;
    shifted.reinit(matrix);
    shifted.copy_from(matrix);
    bool is_diagonal = true;
    std::vector<double> added;
    for (const auto row : system.locally_owned)
    {
      PetscInt n_columns;
      const PetscInt *columns;
      const PetscScalar *values;
      petsc_check(MatGetRow(matrix, row, &n_columns, &columns, &values), "MatGetRow");
      double diagonal = 0;
      for (PetscInt k = 0; k < n_columns; ++k)
        if (columns[k] == PetscInt(row))
          diagonal = values[k];
        else
          is_diagonal = is_diagonal && values[k] == 0;
      petsc_check(MatRestoreRow(matrix, row, &n_columns, &columns, &values), "MatRestoreRow");
      added.push_back(diagonal > 0 ? 1e-10 * diagonal : 1.);
    }
    if (dealii::Utilities::MPI::min(static_cast<unsigned int>(is_diagonal), system.communicator) == 1)
      return;
    unsigned int k = 0;
    for (const auto row : system.locally_owned)
      shifted.add(row, row, added[k++]);
    shifted.compress(dealii::VectorOperation::add);
    SymmetricFactorization::Options options;
    options.name = system.body + ": " + what + ", negative roots";
    options.definite = false;
    options.keep_factors = false;
    const unsigned int n = SymmetricFactorization(shifted, nullptr, 0., options).n_negative();
    if (n > 0)
      throw InputError(file + " holds a " + what + " with " + std::to_string(n) +
                       (n == 1 ? " negative root" : " negative roots") +
                       ", but that of a body at rest is positive semi-definite: mend the matrix.");
  }
} // namespace vibrocontact
