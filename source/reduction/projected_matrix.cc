#include <vibrocontact/base/petsc_check.h>
#include <vibrocontact/reduction/projected_matrix.h>

namespace vibrocontact
{
  using Vector = dealii::PETScWrappers::MPI::Vector;

  namespace
  {
    /// V^T A V with its symmetric (sign 1) or antisymmetric part (-1) alone
    DenseMatrix projected(const dealii::PETScWrappers::MPI::SparseMatrix &A, const std::vector<Vector> &V,
                          const double sign)
    {
      const unsigned int n = V.size();
      DenseMatrix result(n);
      std::vector<Vec> all(V.begin(), V.end());
      for (unsigned int j = 0; j < n; ++j)
      {
        Vector product(V[j]);
        A.vmult(product, V[j]);
        petsc_check(VecMDot(product, n, all.data(), &result(0, j)), "VecMDot");
      }
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = 0; i <= j; ++i)
        {
          result(i, j) = (result(i, j) + sign * result(j, i)) / 2;
          result(j, i) = sign * result(i, j);
        }
      return result;
    }
  } // namespace

  DenseMatrix projected_matrix(const dealii::PETScWrappers::MPI::SparseMatrix &A,
                               const std::vector<Vector> &V)
  {
    return projected(A, V, 1);
  }

  DenseMatrix projected_antisymmetric_matrix(const dealii::PETScWrappers::MPI::SparseMatrix &A,
                                             const std::vector<Vector> &V)
  {
    return projected(A, V, -1);
  }
} // namespace vibrocontact
