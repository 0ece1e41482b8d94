#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/petsc_check.h>
#include <vibrocontact/fe/dense_system.h>
#include <vibrocontact/matrices/matrix_motions.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  using Vector = dealii::PETScWrappers::MPI::Vector;

  namespace
  {
    constexpr double least_resistance = 1e-10;
    /// Gram-Schmidt of the columns in place; those of which nothing is left are dropped. @return R of A = Q R
    DenseMatrix orthonormalise(std::vector<Vector> &columns, const double left)
    {
      const unsigned int n = columns.size();
      DenseMatrix R(n, n);
      std::vector<Vector> kept;
      for (unsigned int j = 0; j < n; ++j)
      {
        Vector v(columns[j]);
        const double whole = v.l2_norm();
        for (unsigned int pass = 0; pass < 2; ++pass)
          for (unsigned int i = 0; i < kept.size(); ++i)
          {
            const double share = v * kept[i];
            R(i, j) += share;
            v.add(-share, kept[i]);
          }
        const double norm = v.l2_norm();
        if (!(norm > left * whole))
          continue;
        R(kept.size(), j) = norm;
        v /= norm;
        kept.push_back(v);
      }
      columns = kept;
      return R;
    }

    /// 1 / sum over a row of |K|; 0 of an empty row
    Vector row_scales(const SecondOrderSystem &system)
    {
      Vector scales(system.locally_owned, system.communicator);
      for (const auto row : system.locally_owned)
      {
        PetscInt n_columns;
        const PetscInt *columns;
        const PetscScalar *values;
        petsc_check(MatGetRow(system.stiffness, row, &n_columns, &columns, &values), "MatGetRow");
        double sum = 0;
        for (PetscInt k = 0; k < n_columns; ++k)
          sum += std::abs(values[k]);
        petsc_check(MatRestoreRow(system.stiffness, row, &n_columns, &columns, &values), "MatRestoreRow");
        scales(row) = sum > 0 ? 1 / sum : 0.;
      }
      scales.compress(dealii::VectorOperation::insert);
      return scales;
    }
  } // namespace

  std::vector<Vector> rigid_motions_by_places(const SecondOrderSystem &system, const std::vector<bool> &held,
                                              const double size)
  {
    std::vector<Vector> motions;
    for (unsigned int c = 0; c < 6; ++c)
    {
      motions.emplace_back(system.locally_owned, system.communicator);
      unsigned int k = 0;
      for (const auto dof : system.locally_owned)
      {
        const auto &p = system.dof_position[k];
        const unsigned int direction = system.dof_direction[k++];
        if (held[dof])
          continue;
        double value = c == direction ? 1 : 0;
        if (c >= 3)
        {
          // rotation about an axis a: e_a x p
          const unsigned int a = c - 3, b = (a + 1) % 3, e = (a + 2) % 3;
          value = direction == b   ? -p[e] / size
                  : direction == e ? p[b] / size
                  : direction == c ? 1 / size
                                   : 0;
        }
        motions.back()(dof) = value;
      }
      motions.back().compress(dealii::VectorOperation::insert);
    }
    orthonormalise(motions, 1e-6);
    const unsigned int n = motions.size();
    const Vector scales = row_scales(system);
    std::vector<Vector> forces;
    for (const Vector &motion : motions)
    {
      Vector force(motion);
      system.stiffness.vmult(force, motion);
      force.scale(scales);
      forces.push_back(force);
    }
    // singular values of the forces by those of their triangle
    if (n == 0)
      return {};
    const DenseMatrix R = orthonormalise(forces, 0.);
    DenseMatrix triangle(n, n);
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int i = 0; i < n; ++i)
        triangle(i, j) = R(i, j);
    triangle.compute_svd();
    std::vector<Vector> result;
    for (unsigned int s = 0; s < n; ++s)
      if (triangle.singular_value(s) < least_resistance)
      {
        result.emplace_back(system.locally_owned, system.communicator);
        for (unsigned int j = 0; j < n; ++j)
          result.back().add(triangle.get_svd_vt()(s, j), motions[j]);
      }
    return result;
  }

  std::vector<Vector> null_motions(const SecondOrderSystem &system)
  {
    constexpr unsigned int most = 3000;
    const unsigned int n = system.stiffness.m();
    if (n > most)
      throw InputError("Body " + system.body + " has " + std::to_string(n) +
                       " coordinates, some of them without a place, more than the " + std::to_string(most) +
                       " whose rigid motions go to LAPACK: reduce it further or give all places.");
    DenseMatrix K(n, n);
    for (const auto row : system.locally_owned)
    {
      PetscInt n_columns;
      const PetscInt *columns;
      const PetscScalar *values;
      petsc_check(MatGetRow(system.stiffness, row, &n_columns, &columns, &values), "MatGetRow");
      for (PetscInt k = 0; k < n_columns; ++k)
        K(row, columns[k]) = values[k];
      petsc_check(MatRestoreRow(system.stiffness, row, &n_columns, &columns, &values), "MatRestoreRow");
    }
    MPI_Allreduce(MPI_IN_PLACE, &K(0, 0), n * n, MPI_DOUBLE, MPI_SUM, system.communicator);
    std::vector<double> unit(n);
    for (unsigned int i = 0; i < n; ++i)
      unit[i] = K(i, i) > 0 ? 1 / std::sqrt(K(i, i)) : 1.;
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int i = 0; i < n; ++i)
        K(i, j) *= unit[i] * unit[j];
    dealii::FullMatrix<double> vectors;
    DenseVector roots;
    K.set_property(dealii::LAPACKSupport::symmetric);
    K.compute_eigenvalues_symmetric(-1., least_resistance, 0., roots, vectors);
    if (roots.size() > 6)
      throw InputError(
          "Body " + system.body + ": its stiffness leaves " + std::to_string(roots.size()) +
          " motions without energy, but a rigid body has six: hold its loose parts or mend the matrix.");
    std::vector<Vector> result;
    for (unsigned int k = 0; k < roots.size(); ++k)
    {
      result.emplace_back(system.locally_owned, system.communicator);
      for (const auto dof : system.locally_owned)
        result.back()(dof) = unit[dof] * vectors(dof, k);
      result.back().compress(dealii::VectorOperation::insert);
    }
    orthonormalise(result, 1e-12);
    return result;
  }

  double mass_along_axes(const SecondOrderSystem &system)
  {
    double largest = 0;
    for (unsigned int d = 0; d < 3; ++d)
    {
      Vector motion(system.locally_owned, system.communicator), inertia(motion);
      if (system.translations.empty())
        for (unsigned int i = 0; i < system.dof_direction.size(); ++i)
          motion(system.locally_owned.nth_index_in_set(i)) = system.dof_direction[i] == d;
      else
        motion = system.translations[d];
      motion.compress(dealii::VectorOperation::insert);
      system.mass.vmult(inertia, motion);
      largest = std::max(largest, motion * inertia);
    }
    return largest;
  }
} // namespace vibrocontact
