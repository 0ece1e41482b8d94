#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/petsc_check.h>
#include <vibrocontact/fe/material_flow.h>
#include <vibrocontact/reduction/fill_reducing_order.h>
#include <vibrocontact/reduction/harmonic_solver.h>
#include <vibrocontact/reduction/mumps_job.h>

#include <deal.II/base/mpi.h>

#include <zmumps_c.h>

#include <exception>
#include <type_traits>
#include <utility>

namespace vibrocontact
{
  struct HarmonicSolver::Implementation
  {
    MPI_Comm communicator;
    bool is_host = false;
    PetscInt n = 0;
    ZMUMPS_STRUC_C mumps{};
    /// own entries of the lower triangle, with Coriolis forces of both: place, K, K'', M, B, C and 2 Omega G together
    std::vector<MUMPS_INT> rows, columns, position;
    std::vector<double> stiffness, loss, mass, of_frequency, damping;
    bool is_symmetric = true;
    std::vector<ZMUMPS_COMPLEX> values, work;

    void run(const int job, const char *what)
    {
      run_mumps(mumps, zmumps_c, job, what + (" of a complex matrix of " + std::to_string(n)) + " dofs");
    }

    void add_row(const SecondOrderSystem &system,
                 const dealii::PETScWrappers::MPI::SparseMatrix *const linear, const double rotation,
                 const PetscInt row)
    {
      const auto read = [&](Mat matrix, const auto &take)
      {
        PetscInt m = 0;
        const PetscInt *c = nullptr;
        const PetscScalar *v = nullptr;
        petsc_check(MatGetRow(matrix, row, &m, &c, &v), "MatGetRow");
        for (PetscInt k = 0; k < m && (c[k] <= row || !is_symmetric); ++k)
          take(c[k] + 1, v[k]);
        MatRestoreRow(matrix, row, &m, &c, &v);
      };
      const std::size_t first = stiffness.size();
      read(system.stiffness,
           [&](const MUMPS_INT column, const double value)
           {
             rows.push_back(row + 1);
             columns.push_back(column);
             stiffness.push_back(value);
           });
      // the others have no place that the stiffness does not have
      for (auto *const values : {&loss, &mass, &of_frequency, &damping})
        values->resize(stiffness.size(), 0.);
      const auto read_beside = [&](Mat matrix, std::vector<double> &into, const double factor = 1)
      {
        std::size_t place = first;
        read(matrix,
             [&](const MUMPS_INT column, const double value)
             {
               while (place < columns.size() && columns[place] < column)
                 ++place;
               AssertThrow(
                   place < columns.size() && columns[place] == column,
                   dealii::ExcMessage("The matrices of body " + system.body + " differ in their patterns."));
               into[place] += factor * value;
             });
      };
      read_beside(system.mass, mass);
      if (system.has_loss)
        read_beside(system.loss_stiffness, loss);
      if (system.has_damping)
        read_beside(system.damping, damping);
      if (!is_symmetric)
        read_beside(system.flow->fixed, damping, 2 * rotation);
      if (linear)
        read_beside(*linear, of_frequency);
    }

    /// The entries and the order of all ranks on each of them.
    void gather(const MPI_Comm all)
    {
      const auto join = [&](auto &values)
      {
        std::remove_reference_t<decltype(values)> joined;
        for (const auto &part : dealii::Utilities::MPI::all_gather(all, values))
          joined.insert(joined.end(), part.begin(), part.end());
        values = std::move(joined);
      };
      join(rows);
      join(columns);
      join(stiffness);
      join(loss);
      join(mass);
      join(of_frequency);
      join(damping);
      position = dealii::Utilities::MPI::broadcast(all, position);
    }
  };

  HarmonicSolver::HarmonicSolver(const SecondOrderSystem &system, const Ranks ranks,
                                 const dealii::PETScWrappers::MPI::SparseMatrix *const of_frequency,
                                 const double rotation)
      : implementation(std::make_unique<Implementation>())
  {
    Implementation &my = *implementation;
    my.communicator = ranks == Ranks::alone ? MPI_COMM_SELF : system.communicator;
    my.is_host = dealii::Utilities::MPI::this_mpi_process(my.communicator) == 0;
    my.n = system.stiffness.m();
    my.is_symmetric = rotation == 0;
    my.position = fill_reducing_order(system.stiffness, {});
    const auto [begin, end] = system.stiffness.local_range();
    for (PetscInt row = begin; row < static_cast<PetscInt>(end); ++row)
      my.add_row(system, of_frequency, rotation, row);
    if (ranks == Ranks::alone)
      my.gather(system.communicator);

    ZMUMPS_STRUC_C &mumps = my.mumps;
    mumps.comm_fortran = MPI_Comm_c2f(my.communicator);
    mumps.par = 1;
    mumps.sym = my.is_symmetric ? 2 : 0;
    my.run(-1, "start");
    const auto control = [&mumps](const int k, const int value) { mumps.icntl[k - 1] = value; };
    for (const int k : {1, 2, 3})
      control(k, -1); // no output
    control(4, 0);
    control(5, 0);   // assembled
    control(18, 3);  // distributed
    control(28, 1);  // sequential analysis
    control(6, 0);   // no permutation to the diagonal
    control(7, 1);   // our ordering
    control(12, 1);  // no compression of the graph
    control(14, 40); // workspace margin [%]
    mumps.n = my.n;
    mumps.perm_in = my.position.data();
    my.values.resize(my.stiffness.size());
    mumps.nnz_loc = my.values.size();
    mumps.irn_loc = my.rows.data();
    mumps.jcn_loc = my.columns.data();
    mumps.a_loc = my.values.data();
    my.run(1, "analysis");
  }

  HarmonicSolver::~HarmonicSolver()
  {
    // Ending MUMPS is collective: after an exception, which may be this rank's alone, it would wait for ever.
    if (std::uncaught_exceptions() > 0)
      return;
    implementation->mumps.job = -2;
    zmumps_c(&implementation->mumps);
  }

  double HarmonicSolver::factorisation_bytes() const
  {
    return 1e6 * implementation->mumps.infog[15];
  }

  std::vector<std::complex<double>> HarmonicSolver::receptance(const double omega,
                                                               const std::vector<TraceRow> &rows,
                                                               const double factor, const double sign)
  {
    Implementation &my = *implementation;
    for (std::size_t k = 0; k < my.values.size(); ++k)
    {
      my.values[k].r = my.stiffness[k] + factor * omega * my.of_frequency[k] - omega * omega * my.mass[k];
      my.values[k].i = sign * my.loss[k] + omega * my.damping[k];
    }
    my.run(2, "factorisation");

    const unsigned int m = rows.size();
    if (my.is_host)
    {
      my.work.assign(std::size_t(my.n) * m, ZMUMPS_COMPLEX{0., 0.});
      for (unsigned int j = 0; j < m; ++j)
        for (const auto &[dof, weight] : rows[j])
          my.work[std::size_t(my.n) * j + dof].r += weight;
    }
    my.mumps.nrhs = m;
    my.mumps.lrhs = my.n;
    my.mumps.rhs = my.work.data();
    my.run(3, "solution");
    std::vector<std::complex<double>> result(m * m);
    if (my.is_host)
      for (unsigned int i = 0; i < m; ++i)
        for (unsigned int j = 0; j < m; ++j)
          for (const auto &[dof, weight] : rows[i])
          {
            const ZMUMPS_COMPLEX &u = my.work[std::size_t(my.n) * j + dof];
            result[i * m + j] += weight * std::complex<double>(u.r, u.i);
          }
    MPI_Bcast(result.data(), 2 * m * m, MPI_DOUBLE, 0, my.communicator);
    return result;
  }
} // namespace vibrocontact
