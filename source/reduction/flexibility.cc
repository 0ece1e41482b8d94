#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/reduction/block_product.h>
#include <vibrocontact/reduction/conjugate_gradients.h>
#include <vibrocontact/reduction/flexibility.h>
#include <vibrocontact/reduction/locally_owned_values.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

namespace vibrocontact
{
  using dealii::types::global_dof_index;
  using Vector = dealii::PETScWrappers::MPI::Vector;

  std::vector<double> contact_trace(const ContactTrace &trace, const Vector &displacement)
  {
    const auto [begin, end] = displacement.local_range();
    const PetscScalar *values = nullptr;
    VecGetArrayRead(displacement, &values);
    std::vector<double> result(trace.rows.size(), 0.);
    for (unsigned int r = 0; r < trace.rows.size(); ++r)
      for (const auto &[dof, weight] : trace.rows[r])
        if (dof >= begin && dof < end)
          result[r] += weight * values[dof - begin];
    VecRestoreArrayRead(displacement, &values);
    const MPI_Comm communicator = displacement.get_mpi_communicator();
    MPI_Allreduce(MPI_IN_PLACE, result.data(), result.size(), MPI_DOUBLE, MPI_SUM, communicator);
    return result;
  }

  namespace
  {
    /// of the contact compliance, between two reports
    constexpr unsigned int columns_at_once = 128;

    /// of the conjugate gradients: far more than approximate factors that are worth anything need
    constexpr unsigned int most_iterations = 40;
    constexpr double solve_tolerance = 1e-12;

    std::string compliance_error(const std::string &body)
    {
      return "The contact compliance of body '" + body +
             "' is not symmetric and positive definite: its mesh has badly shaped cells or its "
             "material numbers are out of range; mend those.";
    }

    void broadcast(DenseMatrix &matrix, MPI_Comm communicator)
    {
      const auto size = dealii::Utilities::MPI::broadcast(
          communicator, std::pair<unsigned int, unsigned int>(matrix.m(), matrix.n()));
      if (dealii::Utilities::MPI::this_mpi_process(communicator) != 0)
        matrix.reinit(size.first, size.second);
      for (unsigned int j = 0; j < size.second; ++j)
        MPI_Bcast(&matrix(0, j), size.first, MPI_DOUBLE, 0, communicator);
    }
  } // namespace

  Flexibility::Flexibility(const SecondOrderSystem &system_, const StiffnessSolver solver_)
      : system(system_), solver(solver_)
  {
    for (const auto &row : system.trace.rows)
      for (const auto &[dof, weight] : row)
        trace_dofs.push_back(dof);
    std::sort(trace_dofs.begin(), trace_dofs.end());
    trace_dofs.erase(std::unique(trace_dofs.begin(), trace_dofs.end()), trace_dofs.end());

    // A body reduced before moves its contact by all of its coordinates: nothing is left to condense.
    by_columns = is_iterative() || 2 * trace_dofs.size() > system.stiffness.m();
    if (by_columns)
      trace_dofs.clear();

    if (system.n_rigid_modes > 0)
    {
      make_rigid_modes();
      fixed_dofs = support_dofs();
    }
    SymmetricFactorization::Options options;
    options.name = system.body + ": stiffness";
    options.approximate = is_iterative();
    options.schur_dofs = trace_dofs;
    options.fixed_dofs = fixed_dofs;
    factors = std::make_unique<SymmetricFactorization>(system.stiffness, nullptr, 0., options);

    const auto &cost = factors->statistics();
    std::ostringstream text;
    text.precision(3);
    text << system.body << ": stiffness factorised" << (is_iterative() ? " approximately" : "")
         << ": ordering " << time_text(cost.seconds_ordering) << ", analysis "
         << time_text(cost.seconds_analysis) << ", factorisation " << time_text(cost.seconds_factorization)
         << ", " << cost.factor_entries / 1e6 << " million entries, " << cost.operations / 1e9 << " Gflop, "
         << cost.megabytes_rank << " MB on the fullest rank, " << cost.megabytes_total << " MB in all";
    run_log().line(text.str());
    if (is_iterative())
      MatNorm(system.stiffness, NORM_INFINITY, &stiffness_norm);
    if (phi.empty())
      check_digits();
  }

  // What a second solution finds in the residual of the first is the error that rounding makes of a static answer.
  void Flexibility::check_digits()
  {
    Vector motion(system.locally_owned, system.communicator), force(motion), u(motion), left(motion),
        more(motion);
    motion = 1.;
    system.mass.vmult(force, motion);
    vmult(u, force);
    system.stiffness.vmult(left, u);
    left.sadd(-1., force);
    vmult(more, left);
    const double error = force.l2_norm() > 0 ? more.l2_norm() / u.l2_norm() : 0;
    if (!(error < 1e-3))
      throw InputError("Body '" + system.body +
                       "': its stiffness has no digits left for its weakest motion, as " +
                       number_text(100 * error) +
                       " % of a static answer are rounding; nothing holds one of its motions, it or its "
                       "cells are too slender, or its materials too "
                       "unlike: make it shorter or thicker, or take a rail of Type = beam rail.");
  }

  void Flexibility::make_rigid_modes()
  {
    Vector diagonal(system.rigid_motions.at(0)), product(diagonal), k_diagonal(diagonal);
    MatGetDiagonal(system.stiffness, k_diagonal);
    MatGetDiagonal(system.mass, diagonal);
    const double k_scale = k_diagonal.linfty_norm();
    for (const Vector &motion : system.rigid_motions)
    {
      Vector v(motion);
      for (unsigned int pass = 0; pass < 2; ++pass)
        for (unsigned int i = 0; i < phi.size(); ++i)
          v.add(-(v * inertia[i]), phi[i]);
      system.mass.vmult(product, v);
      const double norm = std::sqrt(v * product);
      v /= norm;
      product /= norm;
      system.stiffness.vmult(k_diagonal, v);
      if (k_diagonal.linfty_norm() > 1e-6 * k_scale * v.linfty_norm())
        throw InputError("Body '" + system.body + "': a motion that should be rigid deforms it (force " +
                         number_text(k_diagonal.linfty_norm() / (k_scale * v.linfty_norm())) +
                         " of its stiffness); say correctly whether the body is held.");
      phi.push_back(v);
      inertia.push_back(product);
    }
  }

  std::vector<global_dof_index> Flexibility::support_dofs() const
  {
    // Greedy choice of the rows of Phi_R that span most: Gram-Schmidt with pivoting. No trace dof is taken.
    const unsigned int n = phi.size();
    const auto [begin, end] = phi[0].local_range();
    std::vector<std::vector<double>> rows(end - begin, std::vector<double>(n));
    for (unsigned int k = 0; k < n; ++k)
    {
      const std::vector<double> values = locally_owned_values(phi[k]);
      for (unsigned int i = 0; i < rows.size(); ++i)
        rows[i][k] = values[i];
    }
    for (const auto dof : trace_dofs)
      if (dof >= begin && dof < end)
        std::fill(rows[dof - begin].begin(), rows[dof - begin].end(), 0.);

    std::vector<global_dof_index> result;
    const MPI_Comm communicator = system.communicator;
    for (unsigned int step = 0; step < n; ++step)
    {
      double best = 0;
      unsigned int best_row = 0;
      for (unsigned int i = 0; i < rows.size(); ++i)
      {
        double square = 0;
        for (const double x : rows[i])
          square += x * x;
        if (square > best * (1 + 1e-9))
        {
          best = square;
          best_row = i;
        }
      }
      const auto all = dealii::Utilities::MPI::all_gather(communicator, best);
      const unsigned int owner = std::max_element(all.begin(), all.end()) - all.begin();
      std::vector<double> pivot;
      global_dof_index dof = begin + best_row;
      if (owner == dealii::Utilities::MPI::this_mpi_process(communicator))
        pivot = rows[best_row];
      pivot = dealii::Utilities::MPI::broadcast(communicator, pivot, owner);
      result.push_back(dealii::Utilities::MPI::broadcast(communicator, dof, owner));
      const double square = all[owner];
      for (auto &row : rows)
      {
        double projection = 0;
        for (unsigned int k = 0; k < n; ++k)
          projection += row[k] * pivot[k] / square;
        for (unsigned int k = 0; k < n; ++k)
          row[k] -= projection * pivot[k];
      }
    }
    std::sort(result.begin(), result.end());
    return result;
  }

  void Flexibility::vmult(Vector &u, const Vector &f)
  {
    std::vector<double> values = locally_owned_values(f);
    vmult(values, 1);
    set_locally_owned_values(values.data(), u);
  }

  void Flexibility::vmult(std::vector<double> &columns, const unsigned int n_columns)
  {
    const std::size_t n = system.locally_owned.n_elements(), n_rigid = phi.size();
    std::vector<std::vector<double>> shapes, forces;
    for (unsigned int i = 0; i < n_rigid; ++i)
    {
      shapes.push_back(locally_owned_values(phi[i]));
      forces.push_back(locally_owned_values(inertia[i]));
    }
    // column -= sum_i b_i (a_i . column)
    const auto project =
        [&](const std::vector<std::vector<double>> &a, const std::vector<std::vector<double>> &b)
    {
      std::vector<double> factors(n_rigid * n_columns);
      for (unsigned int j = 0; j < n_columns; ++j)
        for (unsigned int i = 0; i < n_rigid; ++i)
          factors[j * n_rigid + i] =
              std::inner_product(a[i].begin(), a[i].end(), columns.begin() + j * n, 0.);
      MPI_Allreduce(MPI_IN_PLACE, factors.data(), factors.size(), MPI_DOUBLE, MPI_SUM, system.communicator);
      for (unsigned int j = 0; j < n_columns; ++j)
        for (unsigned int i = 0; i < n_rigid; ++i)
          for (std::size_t k = 0; k < n; ++k)
            columns[j * n + k] -= factors[j * n_rigid + i] * b[i][k];
    };
    if (n_rigid > 0)
      project(shapes, forces);
    free_fixed_dofs(columns, n_columns);
    solve(columns, n_columns);
    if (n_rigid > 0)
      project(forces, shapes);
  }

  void Flexibility::free_fixed_dofs(std::vector<double> &columns, const unsigned int n_columns) const
  {
    const std::size_t n = system.locally_owned.n_elements();
    for (const auto dof : fixed_dofs)
      if (system.locally_owned.is_element(dof))
        for (unsigned int j = 0; j < n_columns; ++j)
          columns[j * n + system.locally_owned.index_within_set(dof)] = 0;
  }

  void Flexibility::solve(std::vector<double> &columns, const unsigned int n_columns)
  {
    if (!is_iterative())
    {
      factors->solve(columns, n_columns);
      return;
    }
    // K_c: the fixed dofs have no part in it
    const ColumnOperator stiffness = [&](const std::vector<double> &in, const unsigned int n)
    {
      std::vector<double> out = block_product(system.stiffness, in, n);
      free_fixed_dofs(out, n);
      return out;
    };
    const ColumnOperator preconditioner = [&](const std::vector<double> &in, const unsigned int n)
    {
      std::vector<double> out = in;
      factors->solve(out, n);
      free_fixed_dofs(out, n);
      return out;
    };
    const ConjugateGradientsResult result =
        conjugate_gradients(system.communicator, stiffness, preconditioner, columns, n_columns,
                            stiffness_norm, solve_tolerance, most_iterations);
    n_iterations += result.n_iterations;
    ++n_blocks;
    residual = std::max(residual, result.measured);
    if (!result.converged)
      throw ConvergenceError(
          "Body '" + system.body + "': conjugate gradients leave a residual of " +
          number_text(std::max(result.residual, result.measured)) + " after " +
          std::to_string(result.n_iterations) + " steps, more than " + number_text(solve_tolerance) +
          ": single precision has no digits left for its weakest motion; set " + system.body +
          "/Solver/Method to direct, or make it or its cells less slender and its materials less unlike.");
  }

  std::string Flexibility::iterations_text() const
  {
    if (!is_iterative())
      return "";
    return number_text(double(n_iterations) / std::max(1u, n_blocks)) +
           " steps of conjugate gradients in the mean, residual " + number_text(residual);
  }

  DenseMatrix Flexibility::contact_compliance()
  {
    const unsigned int n = system.trace.rows.size();
    DenseMatrix result;
    if (by_columns)
    {
      std::vector<unsigned int> all(n);
      std::iota(all.begin(), all.end(), 0u);
      result = contact_compliance_columns(all);
    }
    else
      result = compliance_by_complement();
    double largest = 0, asymmetry = 0;
    for (unsigned int c = 0; c < n; ++c)
      for (unsigned int r = 0; r <= c; ++r)
      {
        largest = std::max(largest, std::abs(result(r, c)));
        asymmetry = std::max(asymmetry, std::abs(result(r, c) - result(c, r)));
        result(r, c) = result(c, r) = (result(r, c) + result(c, r)) / 2;
      }
    if (!(asymmetry <= 1e-8 * largest))
      throw ConvergenceError(compliance_error(system.body));
    return result;
  }

  DenseMatrix Flexibility::compliance_by_complement()
  {
    const unsigned int n = system.trace.rows.size(), m = trace_dofs.size(), n_rigid = phi.size();
    // K_c^+ M Phi_R at the contact, and Phi_R there
    std::vector<std::vector<double>> response(n_rigid), shape(n_rigid);
    DenseMatrix energy(n_rigid, n_rigid);
    for (unsigned int i = 0; i < n_rigid; ++i)
    {
      Vector load(inertia[i]), u(load);
      for (const auto dof : fixed_dofs)
        if (load.in_local_range(dof))
          load(dof) = 0;
      load.compress(dealii::VectorOperation::insert);
      factors->solve(load, u);
      response[i] = contact_trace(system.trace, u);
      shape[i] = contact_trace(system.trace, phi[i]);
      for (unsigned int j = 0; j < n_rigid; ++j)
        energy(j, i) = inertia[j] * u;
    }

    DenseMatrix result;
    bool is_good = true;
    if (dealii::Utilities::MPI::this_mpi_process(system.communicator) == 0)
    {
      std::vector<std::vector<std::pair<unsigned int, double>>> rows(n);
      for (unsigned int r = 0; r < n; ++r)
        for (const auto &[dof, weight] : system.trace.rows[r])
          rows[r].emplace_back(
              std::lower_bound(trace_dofs.begin(), trace_dofs.end(), dof) - trace_dofs.begin(), weight);
      // S^-1 P^T, then P S^-1 P^T
      DenseMatrix factor = factors->schur_complement(), columns(m, n);
      for (unsigned int r = 0; r < n; ++r)
        for (const auto &[k, weight] : rows[r])
          columns(k, r) += weight;
      // m^3 / 3 for the factor, 2 m^2 per column
      const double own_factor = m / 6.;
      Progress progress(system.body + ": contact compliance, " + std::to_string(n) + " columns",
                        n + own_factor, 2. * m * m * (n + own_factor) / 6e9);
      is_good = factorise_cholesky(factor);
      progress.advance(own_factor);
      for (unsigned int first = 0; is_good && first < n; first += columns_at_once)
      {
        const unsigned int n_now = std::min(columns_at_once, n - first);
        DenseMatrix block(m, n_now);
        std::copy_n(&columns(0, first), std::size_t(m) * n_now, &block(0, 0));
        factor.solve(block);
        std::copy_n(&block(0, 0), std::size_t(m) * n_now, &columns(0, first));
        progress.advance(n_now);
      }
      result.reinit(n, n);
      for (unsigned int c = 0; c < n; ++c)
        for (unsigned int r = 0; r < n; ++r)
        {
          double sum = 0;
          for (const auto &[k, weight] : rows[r])
            sum += weight * columns(k, c);
          result(r, c) = sum;
        }
      for (unsigned int i = 0; i < n_rigid; ++i)
        for (unsigned int c = 0; c < n; ++c)
          for (unsigned int r = 0; r < n; ++r)
          {
            result(r, c) -= shape[i][r] * response[i][c] + response[i][r] * shape[i][c];
            for (unsigned int j = 0; j < n_rigid; ++j)
              result(r, c) += shape[i][r] * energy(i, j) * shape[j][c];
          }
    }
    if (!dealii::Utilities::MPI::broadcast(system.communicator, is_good))
      throw ConvergenceError(compliance_error(system.body));
    broadcast(result, system.communicator);
    return result;
  }

  DenseMatrix Flexibility::contact_compliance_columns(const std::vector<unsigned int> &rows,
                                                      const unsigned int block_size)
  {
    const unsigned int n = system.trace.rows.size(), n_columns = rows.size();
    const std::size_t n_own = system.locally_owned.n_elements();
    std::vector<std::vector<std::pair<std::size_t, double>>> own_rows(n);
    for (unsigned int r = 0; r < n; ++r)
      for (const auto &[dof, weight] : system.trace.rows[r])
        if (system.locally_owned.is_element(dof))
          own_rows[r].emplace_back(system.locally_owned.index_within_set(dof), weight);
    DenseMatrix result(n, n_columns);
    Progress progress(system.body + ": contact compliance, " + std::to_string(n_columns) + " columns",
                      n_columns);
    for (unsigned int first = 0; first < n_columns; first += block_size)
    {
      const unsigned int m = std::min<unsigned int>(block_size, n_columns - first);
      std::vector<double> columns(n_own * m, 0.);
      for (unsigned int j = 0; j < m; ++j)
        for (const auto &[i, weight] : own_rows[rows[first + j]])
          columns[j * n_own + i] += weight;
      vmult(columns, m);
      for (unsigned int j = 0; j < m; ++j)
        for (unsigned int r = 0; r < n; ++r)
          for (const auto &[i, weight] : own_rows[r])
            result(r, first + j) += weight * columns[j * n_own + i];
      progress.advance(m);
    }
    for (unsigned int j = 0; j < n_columns; ++j)
      MPI_Allreduce(MPI_IN_PLACE, &result(0, j), n, MPI_DOUBLE, MPI_SUM, system.communicator);
    return result;
  }

  void Flexibility::static_displacement(dealii::PETScWrappers::MPI::Vector &u, const DenseVector &R)
  {
    dealii::PETScWrappers::MPI::Vector force(system.locally_owned, system.communicator);
    for (unsigned int row = 0; row < R.size(); ++row)
      if (R[row] != 0)
        for (const auto &[dof, weight] : system.trace.rows[row])
          if (system.locally_owned.is_element(dof))
            force(dof) += weight * R[row];
    force.compress(dealii::VectorOperation::add);
    if (system.has_load)
      force += system.load;
    u.reinit(system.locally_owned, system.communicator);
    vmult(u, force);
  }
} // namespace vibrocontact
