#pragma once

#include <vibrocontact/base/dense.h>

#include <deal.II/base/types.h>
#include <deal.II/lac/petsc_sparse_matrix.h>
#include <deal.II/lac/petsc_vector.h>

#include <memory>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// Sparse symmetric factorisation A = L D L^T by MUMPS, made once and used for everything that needs A^-1:
  /// single solves, solves with many columns, the Schur complement on a few dofs, the number of negative
  /// eigenvalues.
  ///
  /// MUMPS is called directly, not through PETSc: PETSc 3.18 refuses solves beside a Schur complement on more
  /// than one rank, and Debian's MUMPS has no nested-dissection ordering; here METIS orders the nodes (dofs
  /// of equal pattern are one vertex of its graph).
  ///
  /// With Schur dofs s and the others i:  S = A_ss - A_si A_ii^-1 A_is,  (A^-1)_ss = S^-1.  Solves use S too,
  /// so that the complement costs nothing beside the factorisation. Right-hand sides and solutions pass
  /// through rank 0 (2 MB per column of 258,000 dofs). All members are collective.
  ///
  /// An approximate factorisation is made in single precision, and blocks of its fronts far from the diagonal are
  /// kept as products of low rank (Amestoy, Buttari, L'Excellent, Mary 2019, doi 10.1145/3242094): less than half the
  /// memory. Its solves precondition conjugate_gradients().
  class SymmetricFactorization
  {
  public:
    struct Options
    {
      /// for messages and progress, e.g. "wheel: stiffness"
      std::string name = "matrix";
      /// A is positive definite: no pivoting
      bool definite = true;
      /// single precision and blocks of low rank; without Schur complement
      bool approximate = false;
      /// keep the factors for solves; otherwise only Schur complement and inertia are wanted
      bool keep_factors = true;
      /// dofs of the Schur complement, sorted; the same on all ranks
      std::vector<dealii::types::global_dof_index> schur_dofs;
      /// dofs whose row and column are replaced by the diagonal entry alone, sorted; the same on all ranks
      std::vector<dealii::types::global_dof_index> fixed_dofs;
    };

    /// What it cost.
    struct Statistics
    {
      /// wall times: METIS, analysis of MUMPS, numerical factorisation, all solves so far [s]
      double seconds_ordering = 0, seconds_analysis = 0, seconds_factorization = 0, seconds_solves = 0;
      /// memory that MUMPS used on the rank that used most, and on all ranks [MB]
      double megabytes_rank = 0, megabytes_total = 0;
      /// entries of the factors as they are kept [-], operations of the factorisation [flop]
      double factor_entries = 0, operations = 0;
      /// columns solved so far
      unsigned int n_solves = 0;
    };

    /// Factorises A = matrix - shift * mass; `mass` may be null if shift = 0.
    /// @throws ConvergenceError if MUMPS fails (singular matrix, memory), with its codes; before the numerical
    /// factorisation if the machine does not leave what the analysis says it needs.
    SymmetricFactorization(const dealii::PETScWrappers::MatrixBase &matrix,
                           const dealii::PETScWrappers::MatrixBase *mass, double shift,
                           const Options &options);
    ~SymmetricFactorization();
    SymmetricFactorization(const SymmetricFactorization &) = delete;
    SymmetricFactorization &operator=(const SymmetricFactorization &) = delete;

    /// x = A^-1 b, vectors distributed by rows as the matrix.
    void solve(Vec b, Vec x);
    /// The same for several columns at once, in place: own rows, column by column.
    void solve(std::vector<double> &columns, unsigned int n_columns);

    /// S on rank 0 (symmetric, order of schur_dofs), empty on the others.
    const DenseMatrix &schur_complement() const;
    /// Number of negative eigenvalues of A (Sylvester): the modes below `shift`.
    unsigned int n_negative() const;
    const Statistics &statistics() const;

    /// in double or single precision
    struct Implementation;

  private:
    std::unique_ptr<Implementation> implementation;
  };
} // namespace vibrocontact
