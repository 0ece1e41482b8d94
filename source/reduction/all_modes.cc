#include <vibrocontact/base/dense_operations.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/fe/dense_system.h>
#include <vibrocontact/numerics/null_space.h>
#include <vibrocontact/reduction/all_modes.h>
#include <vibrocontact/reduction/dense_modes.h>
#include <vibrocontact/reduction/orient_modes.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
    /// Motion of all dofs for unit motions of those with mass, the others following statically: T, n x n_massive.
    DenseMatrix static_following(const DenseSystem &dense, const std::string &body)
    {
      const unsigned int n = dense.n_dofs();
      std::vector<unsigned int> massive, massless;
      for (unsigned int i = 0; i < n; ++i)
        (dense.mass(i, i) > 0 ? massive : massless).push_back(i);
      DenseMatrix T(n, massive.size());
      for (unsigned int j = 0; j < massive.size(); ++j)
        T(massive[j], j) = 1;
      if (massless.empty())
        return T;
      DenseMatrix K(massless.size());
      for (unsigned int i = 0; i < massless.size(); ++i)
        for (unsigned int j = 0; j < massless.size(); ++j)
          K(i, j) = dense.stiffness(massless[i], massless[j]);
      if (!factorise_cholesky(K))
        throw ConvergenceError("Dofs of body '" + body +
                               "' have neither mass nor stiffness; check its mesh.");
      DenseVector follow(massless.size());
      for (unsigned int j = 0; j < massive.size(); ++j)
      {
        for (unsigned int i = 0; i < massless.size(); ++i)
          follow(i) = -dense.stiffness(massless[i], massive[j]);
        K.solve(follow);
        for (unsigned int i = 0; i < massless.size(); ++i)
          T(massless[i], j) = follow(i);
      }
      return T;
    }

    // the modes that are M-orthogonal to those kept
    Modes remaining_modes(const SecondOrderSystem &system, const Modes &kept)
    {
      const DenseSystem dense = dense_system(system);
      const DenseMatrix T = static_following(dense, system.body);
      const unsigned int n = T.n(), m = kept.shapes.size();
      Modes rest;
      if (n <= m)
        return rest;
      DenseMatrix inertia(n, m);
      if (m > 0)
        T.Tmmult(inertia, product(dense.mass, dense_vectors(system, dense, kept.shapes)));
      const std::optional<DenseMatrix> Z = null_space(inertia, n);
      AssertThrow(Z, dealii::ExcMessage("the modes of body '" + system.body + "' depend on each other"));
      const DenseMatrix motions = product(T, *Z);
      DenseMatrix K = projected(dense.stiffness, motions), M = projected(dense.mass, motions);
      std::vector<DenseVector> vectors(n - m, DenseVector(n - m));
      try
      {
        K.compute_generalized_eigenvalues_symmetric(M, vectors);
      }
      catch (const dealii::ExceptionBase &)
      {
        throw ConvergenceError("LAPACK found no eigenvalues of the finite elements of body '" + system.body +
                               "'; check its mesh and its material.");
      }
      DenseMatrix shapes(dense.n_dofs(), n - m);
      std::vector<double> squares;
      for (unsigned int k = 0; k < n - m; ++k)
      {
        squares.push_back(K.eigenvalue(k).real());
        DenseVector shape(dense.n_dofs());
        motions.vmult(shape, vectors[k]);
        std::copy(shape.begin(), shape.end(), &shapes(0, k));
      }
      // each rank writes its part of a shape: all have to mean the same sign and the same of a pair
      MPI_Bcast(squares.data(), n - m, MPI_DOUBLE, 0, system.communicator);
      MPI_Bcast(&shapes(0, 0), dense.n_dofs() * (n - m), MPI_DOUBLE, 0, system.communicator);
      for (unsigned int k = 0; k < n - m; ++k)
      {
        if (!(squares[k] > 1e-14 * squares.back()))
          throw ConvergenceError("Mode " + std::to_string(m + k + 1) + " of body '" + system.body +
                                 "', rigid motions counted, has a frequency of zero, though it is no rigid "
                                 "motion; check its mesh and its material.");
        rest.omega.push_back(std::sqrt(squares[k]));
        rest.shapes.emplace_back(system.locally_owned, system.communicator);
        for (const auto dof : system.locally_owned)
          if (dense.place[dof] != dealii::numbers::invalid_unsigned_int)
            rest.shapes.back()(dof) = shapes(dense.place[dof], k);
        rest.shapes.back().compress(dealii::VectorOperation::insert);
      }
      orient_modes(system, rest);
      return rest;
    }
  } // namespace

  Modes all_modes(const SecondOrderSystem &system, const Modes &kept)
  {
    Modes all = kept;
    Modes rest = remaining_modes(system, kept);
    all.omega.insert(all.omega.end(), rest.omega.begin(), rest.omega.end());
    for (auto &shape : rest.shapes)
      all.shapes.push_back(std::move(shape));
    sort(all);
    return all;
  }
} // namespace vibrocontact
