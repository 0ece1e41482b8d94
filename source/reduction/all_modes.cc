#include <vibrocontact/base/dense_operations.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/fe/dense_system.h>
#include <vibrocontact/numerics/null_space.h>
#include <vibrocontact/reduction/all_modes.h>
#include <vibrocontact/reduction/reduction_parts.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
    DenseMatrix projected(const DenseMatrix &matrix, const DenseMatrix &Z)
    {
      DenseMatrix result(Z.n());
      Z.Tmmult(result, product(matrix, Z));
      return result;
    }

    // the modes that are M-orthogonal to those kept
    Modes remaining_modes(const SecondOrderSystem &system, const Modes &kept)
    {
      const DenseSystem dense = dense_system(system);
      const unsigned int n = dense.n_dofs(), m = kept.shapes.size();
      Modes rest;
      if (n <= m)
        return rest;
      const std::optional<DenseMatrix> Z =
          null_space(product(dense.mass, dense_vectors(system, dense, kept.shapes)), n);
      AssertThrow(Z, dealii::ExcMessage("the modes of body '" + system.body + "' depend on each other"));
      DenseMatrix K = projected(dense.stiffness, *Z), M = projected(dense.mass, *Z);
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
      DenseMatrix shapes(n, n - m);
      std::vector<double> squares;
      for (unsigned int k = 0; k < n - m; ++k)
      {
        squares.push_back(K.eigenvalue(k).real());
        DenseVector shape(n);
        Z->vmult(shape, vectors[k]);
        std::copy(shape.begin(), shape.end(), &shapes(0, k));
      }
      // each rank writes its part of a shape: all have to mean the same sign and the same of a pair
      MPI_Bcast(squares.data(), n - m, MPI_DOUBLE, 0, system.communicator);
      MPI_Bcast(&shapes(0, 0), n * (n - m), MPI_DOUBLE, 0, system.communicator);
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
    return all;
  }

  ReducedBody with_all_modes(ReducedBody body, const SecondOrderSystem &system, const Modes &all)
  {
    const unsigned int n_kept = body.omega.size(), n = all.omega.size();
    const ModalReduction modal = modal_reduction(system, all);
    body.modal_trace = modal.trace;
    body.modal_load = modal.load;
    body.participation = modal.participation;
    for (unsigned int k = n_kept; k < n; ++k)
    {
      body.omega.push_back(all.omega[k]);
      body.damping_ratio.push_back(0);
      body.labels.push_back("mode " + std::to_string(k + 1 - body.n_rigid_modes));
    }
    body.residual_flexibility = 0;
    std::fill(body.residual_load_response.begin(), body.residual_load_response.end(), 0.);
    return body;
  }
} // namespace vibrocontact
