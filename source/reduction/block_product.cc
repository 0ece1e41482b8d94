#include <vibrocontact/base/petsc_check.h>
#include <vibrocontact/reduction/block_product.h>

#include <algorithm>

namespace vibrocontact
{
  std::vector<double> block_product(Mat matrix, const std::vector<double> &columns, const PetscInt n_columns)
  {
    PetscInt n_rows = 0, n = 0, stride = 0;
    MatGetLocalSize(matrix, &n_rows, nullptr);
    MatGetSize(matrix, &n, nullptr);
    Mat in, out;
    petsc_check(MatCreateDense(PetscObjectComm(reinterpret_cast<PetscObject>(matrix)), n_rows, PETSC_DECIDE,
                               n, n_columns, const_cast<double *>(columns.data()), &in),
                "MatCreateDense");
    petsc_check(MatMatMult(matrix, in, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &out), "MatMatMult");
    const PetscScalar *values = nullptr;
    MatDenseGetLDA(out, &stride);
    petsc_check(MatDenseGetArrayRead(out, &values), "MatDenseGetArrayRead");
    std::vector<double> result(std::size_t(n_rows) * n_columns);
    for (PetscInt j = 0; j < n_columns; ++j)
      std::copy_n(values + std::size_t(j) * stride, n_rows, result.data() + std::size_t(j) * n_rows);
    MatDenseRestoreArrayRead(out, &values);
    MatDestroy(&in);
    MatDestroy(&out);
    return result;
  }
} // namespace vibrocontact
