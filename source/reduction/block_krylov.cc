#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/reduction/block_product.h>
#include <vibrocontact/reduction/mode_solver.h>

#include <deal.II/base/mpi.h>

#include <petscblaslapack.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace vibrocontact
{
  using Vector = dealii::PETScWrappers::MPI::Vector;

  namespace
  {
    constexpr double tolerance = 1e-10;
    constexpr unsigned int block_size = 16;

    // Columns of distributed vectors, each rank with its rows, one after the other.
    struct Columns
    {
      PetscInt n_rows = 0;
      std::vector<double> values;

      PetscInt n() const { return n_rows == 0 ? 0 : values.size() / n_rows; }
      double *column(const std::size_t j) { return values.data() + j * n_rows; }
      const double *column(const std::size_t j) const { return values.data() + j * n_rows; }
    };

    // c = alpha a^(T) b + beta c, column-major with leading dimensions.
    void gemm(const char transpose, const PetscInt m, const PetscInt n, const PetscInt k, const double alpha,
              const double *a, const PetscInt lda, const double *b, const PetscInt ldb, const double beta,
              double *c, const PetscInt ldc)
    {
      const PetscBLASInt m_ = m, n_ = n, k_ = k, lda_ = std::max<PetscInt>(1, lda),
                         ldb_ = std::max<PetscInt>(1, ldb), ldc_ = std::max<PetscInt>(1, ldc);
      if (m_ > 0 && n_ > 0)
        BLASgemm_(&transpose, "N", &m_, &n_, &k_, &alpha, a, &lda_, b, &ldb_, &beta, c, &ldc_);
    }

    class BlockKrylov
    {
    public:
      BlockKrylov(const SecondOrderSystem &system, Flexibility &flexibility, Mat mass, Modes &modes)
          : system(system), flexibility(flexibility), mass(mass), modes(modes),
            communicator(system.communicator), n_rows(system.locally_owned.n_elements()),
            n_dofs(system.stiffness.m()),
            row_sizes(dealii::Utilities::MPI::all_gather(communicator, static_cast<int>(n_rows))),
            row_offsets(1, 0), is_host(dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
      {
        std::partial_sum(row_sizes.begin(), row_sizes.end(), std::back_inserter(row_offsets));
        basis.n_rows = basis_inertia.n_rows = n_rows;
      }

      void run(unsigned int n_wanted);

    private:
      Columns times_mass(const Columns &x) const;
      Columns times_flexibility(const Columns &x);
      // w <- w - Q (Q^T M w), inertia = M w follows; the coefficients are set (n_basis x n), if that is given
      void remove_basis(Columns &w, Columns &inertia, DenseMatrix *coefficients) const;
      // w <- x with x^T M x = 1 and w = x r, inertia = M w follows; directions below `drop` (relative) are
      // left out
      DenseMatrix normalise(Columns &w, Columns &inertia, double drop) const;
      // Orthonormalises `w` against the basis and in itself, twice; returns r and the coefficients as above.
      DenseMatrix orthonormalise(Columns &w, Columns &inertia, DenseMatrix *coefficients) const;
      void append(const Columns &w, const Columns &inertia);
      // Ritz values, descending, and vectors of the new part of the basis
      void ritz(std::vector<double> &theta, DenseMatrix &vectors) const;

      const SecondOrderSystem &system;
      Flexibility &flexibility;
      Mat mass;
      Modes &modes;
      MPI_Comm communicator;
      PetscInt n_rows, n_dofs;
      std::vector<int> row_sizes, row_offsets;
      bool is_host;
      // Q and M Q
      Columns basis, basis_inertia;
      // H on the columns of the basis that are not known modes, and where these begin
      unsigned int n_known = 0;
      std::vector<std::vector<double>> projected; // by columns
    };

    Columns BlockKrylov::times_mass(const Columns &x) const
    {
      return {n_rows, block_product(mass, x.values, x.n())};
    }

    Columns BlockKrylov::times_flexibility(const Columns &x)
    {
      const unsigned int n = x.n();
      DenseMatrix whole;
      if (is_host)
        whole.reinit(n_dofs, n);
      for (unsigned int j = 0; j < n; ++j)
        MPI_Gatherv(x.column(j), n_rows, MPI_DOUBLE, is_host ? &whole(0, j) : nullptr, row_sizes.data(),
                    row_offsets.data(), MPI_DOUBLE, 0, communicator);
      flexibility.vmult(whole);
      Columns result{n_rows, std::vector<double>(x.values.size())};
      for (unsigned int j = 0; j < n; ++j)
        MPI_Scatterv(is_host ? &whole(0, j) : nullptr, row_sizes.data(), row_offsets.data(), MPI_DOUBLE,
                     result.column(j), n_rows, MPI_DOUBLE, 0, communicator);
      modes.n_solves += n;
      return result;
    }

    void BlockKrylov::remove_basis(Columns &w, Columns &inertia, DenseMatrix *const coefficients) const
    {
      const PetscInt m = basis.n(), n = w.n();
      if (m == 0)
        return;
      std::vector<double> c(m * n);
      gemm('T', m, n, n_rows, 1, basis.values.data(), n_rows, inertia.values.data(), n_rows, 0, c.data(), m);
      MPI_Allreduce(MPI_IN_PLACE, c.data(), c.size(), MPI_DOUBLE, MPI_SUM, communicator);
      gemm('N', n_rows, n, m, -1, basis.values.data(), n_rows, c.data(), m, 1, w.values.data(), n_rows);
      gemm('N', n_rows, n, m, -1, basis_inertia.values.data(), n_rows, c.data(), m, 1, inertia.values.data(),
           n_rows);
      if (coefficients)
        std::copy(c.begin(), c.end(), &(*coefficients)(0, 0));
    }

    DenseMatrix BlockKrylov::normalise(Columns &w, Columns &inertia, const double drop) const
    {
      const PetscInt n = w.n();
      std::vector<double> gram(n * n);
      gemm('T', n, n, n_rows, 1, w.values.data(), n_rows, inertia.values.data(), n_rows, 0, gram.data(), n);
      MPI_Allreduce(MPI_IN_PLACE, gram.data(), gram.size(), MPI_DOUBLE, MPI_SUM, communicator);
      // Symmetric eigenproblem of the Gram matrix, the same on all ranks; columns of unit length first.
      std::vector<double> scale(n), values(n), work(std::max<PetscInt>(64 * n, 128));
      for (PetscInt j = 0; j < n; ++j)
        scale[j] = std::sqrt(std::max(gram[j * n + j], 1e-300));
      for (PetscInt j = 0; j < n; ++j)
        for (PetscInt i = 0; i < n; ++i)
          gram[j * n + i] /= scale[i] * scale[j];
      PetscBLASInt size = n, work_size = work.size(), info = 0;
      LAPACKsyev_("V", "U", &size, gram.data(), &size, values.data(), work.data(), &work_size, &info);
      AssertThrow(info == 0, dealii::ExcMessage("syev failed"));
      MPI_Bcast(gram.data(), gram.size(), MPI_DOUBLE, 0, communicator);
      MPI_Bcast(values.data(), n, MPI_DOUBLE, 0, communicator);
      unsigned int first = 0;
      while (first < values.size() && values[first] < drop * values.back())
        ++first;
      // x = w D^-1 V s^-1/2, r = s^1/2 V^T D
      const PetscInt kept = n - first;
      std::vector<double> transform(n * kept);
      DenseMatrix r(kept, n);
      for (PetscInt k = 0; k < kept; ++k)
        for (PetscInt i = 0; i < n; ++i)
        {
          const double v = gram[(first + k) * n + i], root = std::sqrt(values[first + k]);
          transform[k * n + i] = v / (scale[i] * root);
          r(k, i) = root * v * scale[i];
        }
      for (Columns *const columns : {&w, &inertia})
      {
        Columns x{n_rows, std::vector<double>(n_rows * kept)};
        gemm('N', n_rows, kept, n, 1, columns->values.data(), n_rows, transform.data(), n, 0, x.values.data(),
             n_rows);
        *columns = std::move(x);
      }
      return r;
    }

    DenseMatrix BlockKrylov::orthonormalise(Columns &w, Columns &inertia,
                                            DenseMatrix *const coefficients) const
    {
      inertia = times_mass(w);
      remove_basis(w, inertia, coefficients);
      const DenseMatrix r = normalise(w, inertia, 1e-14);
      // Once more: what round-off left of the basis; the coefficients do not change by more.
      inertia = times_mass(w);
      remove_basis(w, inertia, nullptr);
      const DenseMatrix correction = normalise(w, inertia, 0);
      DenseMatrix product(correction.m(), r.n());
      correction.mmult(product, r);
      return product;
    }

    void BlockKrylov::append(const Columns &w, const Columns &inertia)
    {
      basis.values.insert(basis.values.end(), w.values.begin(), w.values.end());
      basis_inertia.values.insert(basis_inertia.values.end(), inertia.values.begin(), inertia.values.end());
    }

    void BlockKrylov::ritz(std::vector<double> &theta, DenseMatrix &vectors) const
    {
      const unsigned int m = projected.size();
      std::vector<double> a(m * m), values(m), work(std::max(64u * m, 128u));
      for (unsigned int j = 0; j < m; ++j)
        for (unsigned int i = 0; i < m; ++i)
          a[j * m + i] = (i < projected[j].size() ? projected[j][i] : 0.);
      // A column knows the rows up to its own block; the upper triangle is all that is read.
      PetscBLASInt size = m, work_size = work.size(), info = 0;
      LAPACKsyev_("V", "U", &size, a.data(), &size, values.data(), work.data(), &work_size, &info);
      AssertThrow(info == 0, dealii::ExcMessage("syev failed"));
      MPI_Bcast(a.data(), a.size(), MPI_DOUBLE, 0, communicator);
      MPI_Bcast(values.data(), m, MPI_DOUBLE, 0, communicator);
      theta.assign(values.rbegin(), values.rend());
      vectors.reinit(m, m);
      for (unsigned int j = 0; j < m; ++j)
        std::copy_n(a.data() + (m - 1 - j) * m, m, &vectors(0, j));
    }

    void BlockKrylov::run(const unsigned int n_wanted)
    {
      // Known modes are deflated: they head the basis and take no part in H.
      for (unsigned int k = modes.n_rigid_modes; k < modes.shapes.size(); ++k)
      {
        const PetscScalar *values = nullptr;
        VecGetArrayRead(modes.shapes[k], &values);
        basis.values.insert(basis.values.end(), values, values + n_rows);
        VecRestoreArrayRead(modes.shapes[k], &values);
      }
      n_known = basis.n();
      if (n_known > 0)
        basis_inertia = times_mass(basis);

      Columns block{n_rows, std::vector<double>(n_rows * std::min<PetscInt>(block_size, n_dofs))};
      for (PetscInt j = 0; j < block.n(); ++j)
        for (PetscInt i = 0; i < n_rows; ++i)
        {
          const double dof = system.locally_owned.nth_index_in_set(i);
          block.column(j)[i] =
              std::sin(1. + n_known + dof * (0.7390851 + 0.1234567 * j) + 0.01 * std::fmod(dof * dof, 97.));
        }
      Columns inertia;
      block = times_flexibility(times_mass(block));
      orthonormalise(block, inertia, nullptr);
      append(block, inertia);

      Progress progress(system.body + ": modes", n_wanted);
      unsigned int n_reported = 0;
      std::vector<double> theta;
      DenseMatrix vectors;
      while (true)
      {
        const unsigned int n_before = basis.n() - block.n(), n_now = basis.n(), n_block = block.n();
        Columns next = times_flexibility(inertia), next_inertia;
        DenseMatrix coefficients(n_now, n_block);
        const DenseMatrix coupling = orthonormalise(next, next_inertia, &coefficients);
        for (unsigned int j = 0; j < n_block; ++j)
        {
          projected.emplace_back(n_before - n_known + n_block);
          for (unsigned int i = n_known; i < n_now; ++i)
            projected.back()[i - n_known] = coefficients(i, j);
        }

        const unsigned int m = projected.size();
        if (m >= n_wanted || next.n() == 0)
        {
          ritz(theta, vectors);
          // |R s_last| for the wanted ones
          unsigned int n_converged = 0;
          for (unsigned int k = 0; k < std::min(n_wanted, m); ++k)
          {
            double square = 0;
            for (unsigned int i = 0; i < coupling.m(); ++i)
            {
              double sum = 0;
              for (unsigned int j = 0; j < n_block; ++j)
                sum += coupling(i, j) * vectors(m - n_block + j, k);
              square += sum * sum;
            }
            if (std::sqrt(square) <= tolerance * theta[k])
              ++n_converged;
          }
          if (n_converged > n_reported)
            progress.advance(n_converged - n_reported);
          n_reported = std::max(n_reported, n_converged);
          if (n_converged == n_wanted)
            break;
          if (next.n() == 0 || basis.n() + next.n() > n_dofs)
          {
            AssertThrow(m >= n_wanted,
                        dealii::ExcMessage("The Krylov space of body '" + system.body + "' is exhausted."));
            break;
          }
          if (m > 10 * n_wanted + 500)
            throw ConvergenceError("Body '" + system.body + "': only " + std::to_string(n_converged) +
                                   " of " + std::to_string(n_wanted) + " modes converged with " +
                                   std::to_string(m) + " solves.");
        }
        block = std::move(next);
        inertia = std::move(next_inertia);
        append(block, inertia);
      }

      const unsigned int m = projected.size();
      std::vector<double> shape(n_rows);
      for (unsigned int k = 0; k < n_wanted; ++k)
      {
        gemm('N', n_rows, 1, m, 1, basis.column(n_known), n_rows, &vectors(0, k), m, 0, shape.data(), n_rows);
        Vector v(system.locally_owned, communicator);
        PetscScalar *values = nullptr;
        VecGetArray(v, &values);
        std::copy(shape.begin(), shape.end(), values);
        VecRestoreArray(v, &values);
        modes.shapes.push_back(v);
        modes.omega.push_back(1 / std::sqrt(theta[k]));
      }
      sort_modes(modes);
    }
  } // namespace

  void block_krylov(const SecondOrderSystem &system, Flexibility &flexibility, Mat mass,
                    const unsigned int n_wanted, Modes &modes)
  {
    BlockKrylov(system, flexibility, mass, modes).run(n_wanted);
  }
} // namespace vibrocontact
