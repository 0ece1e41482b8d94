#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/reduction/flexibility.h>

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

    std::vector<double> gather_on_host(const Vector &v)
    {
      const MPI_Comm communicator = v.get_mpi_communicator();
      const int local = v.locally_owned_size();
      const auto sizes = dealii::Utilities::MPI::all_gather(communicator, local);
      std::vector<int> offsets(1, 0);
      for (const int size : sizes)
        offsets.push_back(offsets.back() + size);
      const bool is_host = dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
      std::vector<double> all(is_host ? v.size() : 0);
      const PetscScalar *values = nullptr;
      VecGetArrayRead(v, &values);
      MPI_Gatherv(values, local, MPI_DOUBLE, all.data(), sizes.data(), offsets.data(), MPI_DOUBLE, 0,
                  communicator);
      VecRestoreArrayRead(v, &values);
      return all;
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

  Flexibility::Flexibility(const SecondOrderSystem &system_) : system(system_)
  {
    for (const auto &row : system.trace.rows)
      for (const auto &[dof, weight] : row)
        trace_dofs.push_back(dof);
    std::sort(trace_dofs.begin(), trace_dofs.end());
    trace_dofs.erase(std::unique(trace_dofs.begin(), trace_dofs.end()), trace_dofs.end());

    if (system.n_rigid_modes > 0)
    {
      make_rigid_modes();
      fixed_dofs = support_dofs();
    }
    SymmetricFactorization::Options options;
    options.name = system.body + ": stiffness";
    options.schur_dofs = trace_dofs;
    options.fixed_dofs = fixed_dofs;
    factors = std::make_unique<SymmetricFactorization>(system.stiffness, nullptr, 0., options);

    const auto &cost = factors->statistics();
    std::ostringstream text;
    text.precision(3);
    text << system.body << ": stiffness factorised: ordering " << time_text(cost.seconds_ordering)
         << ", analysis " << time_text(cost.seconds_analysis) << ", factorisation "
         << time_text(cost.seconds_factorization) << ", " << cost.factor_entries / 1e6 << " million entries, "
         << cost.operations / 1e9 << " Gflop, " << cost.megabytes_rank << " MB on the fullest rank, "
         << cost.megabytes_total << " MB in all";
    run_log().line(text.str());
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
      const PetscScalar *values = nullptr;
      VecGetArrayRead(phi[k], &values);
      for (unsigned int i = 0; i < rows.size(); ++i)
        rows[i][k] = values[i];
      VecRestoreArrayRead(phi[k], &values);
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
    if (phi.empty())
    {
      factors->solve(f, u);
      return;
    }
    Vector balanced(f);
    for (unsigned int i = 0; i < phi.size(); ++i)
      balanced.add(-(phi[i] * f), inertia[i]);
    for (const auto dof : fixed_dofs)
      if (balanced.in_local_range(dof))
        balanced(dof) = 0;
    balanced.compress(dealii::VectorOperation::insert);
    factors->solve(balanced, u);
    for (unsigned int i = 0; i < phi.size(); ++i)
      u.add(-(inertia[i] * u), phi[i]);
  }

  void Flexibility::vmult(DenseMatrix &columns)
  {
    const unsigned int n_rigid = phi.size();
    std::vector<std::vector<double>> shapes, forces;
    for (unsigned int i = 0; i < n_rigid; ++i)
    {
      shapes.push_back(gather_on_host(phi[i]));
      forces.push_back(gather_on_host(inertia[i]));
    }
    // column -= sum_i b_i (a_i . column)
    const auto project =
        [&](const std::vector<std::vector<double>> &a, const std::vector<std::vector<double>> &b)
    {
      if (columns.m() == 0)
        return;
      for (unsigned int j = 0; j < columns.n(); ++j)
        for (unsigned int i = 0; i < n_rigid; ++i)
        {
          double *const column = &columns(0, j);
          const double factor = std::inner_product(a[i].begin(), a[i].end(), column, 0.);
          for (unsigned int k = 0; k < columns.m(); ++k)
            column[k] -= factor * b[i][k];
        }
    };
    project(shapes, forces);
    if (columns.m() > 0)
      for (const auto dof : fixed_dofs)
        for (unsigned int j = 0; j < columns.n(); ++j)
          columns(dof, j) = 0;
    factors->solve(columns);
    project(forces, shapes);
  }

  DenseMatrix Flexibility::contact_compliance()
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
      double largest = 0, asymmetry = 0;
      for (unsigned int c = 0; c < n; ++c)
        for (unsigned int r = 0; r <= c; ++r)
        {
          largest = std::max(largest, std::abs(result(r, c)));
          asymmetry = std::max(asymmetry, std::abs(result(r, c) - result(c, r)));
          result(r, c) = result(c, r) = (result(r, c) + result(c, r)) / 2;
        }
      is_good = is_good && asymmetry <= 1e-8 * largest;
    }
    if (!dealii::Utilities::MPI::broadcast(system.communicator, is_good))
      throw ConvergenceError(
          "The contact compliance of body '" + system.body +
          "' is not symmetric and positive definite: its mesh has badly shaped cells or its "
          "material numbers are out of range; mend those.");
    broadcast(result, system.communicator);
    return result;
  }

  DenseMatrix Flexibility::contact_compliance_columns(const std::vector<unsigned int> &rows,
                                                      const unsigned int block_size)
  {
    const bool is_host = dealii::Utilities::MPI::this_mpi_process(system.communicator) == 0;
    const unsigned int n = system.trace.rows.size();
    DenseMatrix result(n, rows.size());
    for (unsigned int first = 0; first < rows.size(); first += block_size)
    {
      const unsigned int m = std::min<unsigned int>(block_size, rows.size() - first);
      DenseMatrix columns;
      if (is_host)
      {
        columns.reinit(system.stiffness.m(), m);
        for (unsigned int j = 0; j < m; ++j)
          for (const auto &[dof, weight] : system.trace.rows[rows[first + j]])
            columns(dof, j) = weight;
      }
      vmult(columns);
      if (is_host)
        for (unsigned int j = 0; j < m; ++j)
          for (unsigned int r = 0; r < n; ++r)
            for (const auto &[dof, weight] : system.trace.rows[r])
              result(r, first + j) += weight * columns(dof, j);
    }
    broadcast(result, system.communicator);
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
