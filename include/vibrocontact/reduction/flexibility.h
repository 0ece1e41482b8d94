#pragma once

#include <vibrocontact/base/dense.h>
#include <vibrocontact/fe/second_order_system.h>
#include <vibrocontact/reduction/stiffness_solver.h>
#include <vibrocontact/reduction/symmetric_factorization.h>

#include <memory>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// P_c U of a distributed vector, replicated; rows as contact_row() [m].
  std::vector<double> contact_trace(const ContactTrace &trace,
                                    const dealii::PETScWrappers::MPI::Vector &displacement);

  /// The static flexibility G of a body, from one factorisation: static response, contact compliance, and the
  /// operator of the modes' inverse iteration.
  ///
  /// Held body:  G = K^-1.
  /// Free body, Phi_R its rigid modes (Phi_R^T M Phi_R = I):  inertia relief,
  ///     G = A^T K_c^+ A,   A = I - M Phi_R Phi_R^T,
  /// A balances a load by the inertia of the rigid motion it causes; K_c^+ solves with just as many dofs
  /// fixed as there are rigid motions, where then no reaction acts; A^T takes the rigid part out of the
  /// answer. G does not depend on the dofs chosen, G M Phi_R = 0, and G = sum over elastic modes of phi phi^T
  /// / w^2: no shifted K is passed off as K^-1.
  ///
  /// Direct: the Schur complement on the trace dofs comes with the factorisation, so that P_c G P_c^T needs no
  /// solves but those for Phi_R. Iterative: an approximate factorisation of K preconditions conjugate gradients, several
  /// columns at once, to a residual of 1e-12; P_c G P_c^T is solved column by column. All members are collective, and
  /// those that solve throw a ConvergenceError if the conjugate gradients do not get there.
  class Flexibility
  {
  public:
    /// @throws InputError if a motion said to be rigid costs energy, a body said to be held is not, or rounding leaves less than
    /// three digits of how a held one bends under its own weight in all directions
    explicit Flexibility(const SecondOrderSystem &system, StiffnessSolver solver = StiffnessSolver::direct);

    /// u = G f
    void vmult(dealii::PETScWrappers::MPI::Vector &u, const dealii::PETScWrappers::MPI::Vector &f);
    /// columns <- G columns: own rows, column by column
    void vmult(std::vector<double> &columns, unsigned int n_columns);

    /// P_c G P_c^T, 3 n square [m/N], symmetric; replicated. By the Schur complement, or by solves if iterative.
    DenseMatrix contact_compliance();
    /// The columns `rows` of P_c G P_c^T by blocked solves: the only way if iterative, otherwise for checks; replicated.
    DenseMatrix contact_compliance_columns(const std::vector<unsigned int> &rows,
                                           unsigned int block_size = 32);

    /// u = G (P_c^T R + F): static displacement under contact forces on the body (3 n, [N]) and its loads [m]
    void static_displacement(dealii::PETScWrappers::MPI::Vector &u, const DenseVector &R);

    /// Phi_R, mass-orthonormal [1/sqrt(kg)]
    const std::vector<dealii::PETScWrappers::MPI::Vector> &rigid_modes() const { return phi; }
    const SymmetricFactorization &factorization() const { return *factors; }
    bool is_iterative() const { return solver == StiffnessSolver::iterative; }
    /// What the solves were like so far, as text; empty if direct.
    std::string iterations_text() const;

  private:
    void make_rigid_modes();
    void check_digits();
    std::vector<dealii::types::global_dof_index> support_dofs() const;
    DenseMatrix compliance_by_complement();
    /// columns <- K_c^+ columns; balanced and without force on the fixed dofs
    void solve(std::vector<double> &columns, unsigned int n_columns);
    void free_fixed_dofs(std::vector<double> &columns, unsigned int n_columns) const;

    const SecondOrderSystem &system;
    const StiffnessSolver solver;
    /// the contact compliance is solved column by column: iteratively, or since the trace takes most dofs
    bool by_columns = false;
    /// dofs of the trace, sorted; empty if solved by columns
    std::vector<dealii::types::global_dof_index> trace_dofs;
    std::vector<dealii::types::global_dof_index> fixed_dofs;
    /// Phi_R and M Phi_R
    std::vector<dealii::PETScWrappers::MPI::Vector> phi, inertia;
    std::unique_ptr<SymmetricFactorization> factors;
    /// largest sum of a row of |K|: no eigenvalue is larger [N/m]
    double stiffness_norm = 0;
    /// of the conjugate gradients: steps of all blocks, blocks, largest residual measured
    unsigned int n_iterations = 0, n_blocks = 0;
    double residual = 0;
  };
} // namespace vibrocontact
