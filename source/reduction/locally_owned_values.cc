#include <vibrocontact/reduction/locally_owned_values.h>

#include <algorithm>

namespace vibrocontact
{
  using Vector = dealii::PETScWrappers::MPI::Vector;

  std::vector<double> locally_owned_values(const Vector &vector)
  {
    const PetscScalar *values = nullptr;
    VecGetArrayRead(vector, &values);
    const std::vector<double> result(values, values + vector.locally_owned_size());
    VecRestoreArrayRead(vector, &values);
    return result;
  }

  std::vector<double> locally_owned_values(const std::vector<Vector> &vectors, const unsigned int first,
                                           const unsigned int n)
  {
    std::vector<double> result;
    for (unsigned int k = first; k < first + n; ++k)
    {
      const std::vector<double> values = locally_owned_values(vectors[k]);
      result.insert(result.end(), values.begin(), values.end());
    }
    return result;
  }

  void set_locally_owned_values(const double *const values, Vector &vector)
  {
    PetscScalar *place = nullptr;
    VecGetArray(vector, &place);
    std::copy_n(values, vector.locally_owned_size(), place);
    VecRestoreArray(vector, &place);
  }
} // namespace vibrocontact
