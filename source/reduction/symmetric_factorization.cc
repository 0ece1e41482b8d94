#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/memory.h>
#include <vibrocontact/base/petsc_check.h>
#include <vibrocontact/reduction/fill_reducing_order.h>
#include <vibrocontact/reduction/symmetric_factorization.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/timer.h>

#include <dmumps_c.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include <exception>

namespace vibrocontact
{
  namespace
  {
    /// What an idle core does in a factorisation [flop/s], for its expected time.
    constexpr double flops_per_second = 1e10;

    // Entry k of an array of MUMPS's manual, which counts from 1.
    template <typename Array>
    auto &entry(Array &array, const int k)
    {
      return array[k - 1];
    }
  } // namespace

  struct SymmetricFactorization::Implementation
  {
    MPI_Comm communicator;
    bool is_host = false;
    PetscInt n = 0, begin = 0, end = 0;
    std::vector<int> local_sizes, offsets;
    DMUMPS_STRUC_C mumps{};
    std::vector<MUMPS_INT> rows, columns, position, schur_list;
    std::vector<double> values, reduced;
    DenseMatrix schur, schur_factor;
    // workspace of single solves, on the host
    std::vector<double> work;
    Statistics statistics;

    void run(const int job, const char *what)
    {
      mumps.job = job;
      dmumps_c(&mumps);
      const int info = entry(mumps.infog, 1);
      if (info < 0)
        throw ConvergenceError("MUMPS failed in the " + std::string(what) + " of a matrix of " +
                               std::to_string(n) + " dofs: INFOG(1) = " + std::to_string(info) +
                               ", INFOG(2) = " + std::to_string(entry(mumps.infog, 2)) +
                               (info == -10 ? " (the matrix is singular: is the body held?)."
                                : info == -9 || info == -13 || info == -19 ? " (not enough memory)."
                                                                           : "."));
    }

    void collect_entries(Mat matrix, Mat mass, double shift, const std::vector<char> &is_fixed);
    // Solves for `n_columns` columns in place, on the host.
    void solve_on_host(double *columns, int n_columns);
  };

  void SymmetricFactorization::Implementation::collect_entries(Mat matrix, Mat mass, const double shift,
                                                               const std::vector<char> &is_fixed)
  {
    // MUMPS adds entries given twice: no need for equal patterns. Lower triangle only.
    const auto add = [&](Mat source, const double factor)
    {
      for (PetscInt row = begin; row < end; ++row)
      {
        PetscInt m = 0;
        const PetscInt *c = nullptr;
        const PetscScalar *v = nullptr;
        petsc_check(MatGetRow(source, row, &m, &c, &v), "MatGetRow");
        for (PetscInt k = 0; k < m; ++k)
          if (c[k] == row || (c[k] < row && v[k] != 0 && !is_fixed[row] && !is_fixed[c[k]]))
          {
            rows.push_back(row + 1);
            columns.push_back(c[k] + 1);
            values.push_back(factor * v[k]);
          }
        MatRestoreRow(source, row, &m, &c, &v);
      }
    };
    add(matrix, 1);
    if (shift != 0)
      add(mass, -shift);
    mumps.nnz_loc = values.size();
    mumps.irn_loc = rows.data();
    mumps.jcn_loc = columns.data();
    mumps.a_loc = values.data();
  }

  SymmetricFactorization::SymmetricFactorization(const dealii::PETScWrappers::MatrixBase &matrix,
                                                 const dealii::PETScWrappers::MatrixBase *mass,
                                                 const double shift, const Options &options)
      : implementation(std::make_unique<Implementation>())
  {
    AssertThrow(shift == 0 || mass != nullptr, dealii::ExcInternalError());
    Implementation &my = *implementation;
    Mat a = matrix;
    my.communicator = PetscObjectComm(reinterpret_cast<PetscObject>(a));
    my.is_host = dealii::Utilities::MPI::this_mpi_process(my.communicator) == 0;
    petsc_check(MatGetSize(a, &my.n, nullptr), "MatGetSize");
    petsc_check(MatGetOwnershipRange(a, &my.begin, &my.end), "MatGetOwnershipRange");
    my.local_sizes = dealii::Utilities::MPI::all_gather(my.communicator, static_cast<int>(my.end - my.begin));
    my.offsets.assign(1, 0);
    std::partial_sum(my.local_sizes.begin(), my.local_sizes.end(), std::back_inserter(my.offsets));

    dealii::Timer timer;
    // 12 us per dof for METIS and the analysis
    std::optional<Progress> progress;
    progress.emplace(options.name + ": ordering of " + std::to_string(my.n) + " dofs", 1, 12e-6 * my.n);
    const std::vector<unsigned int> schur_dofs(options.schur_dofs.begin(), options.schur_dofs.end());
    my.position = fill_reducing_order(a, schur_dofs);
    my.statistics.seconds_ordering = timer.wall_time();

    DMUMPS_STRUC_C &mumps = my.mumps;
    mumps.comm_fortran = MPI_Comm_c2f(my.communicator);
    mumps.par = 1;
    mumps.sym = options.definite ? 1 : 2;
    my.run(-1, "start");
    for (const int k : {1, 2, 3, 4})
      entry(mumps.icntl, k) = k == 4 ? 0 : -1; // no output
    entry(mumps.icntl, 5) = 0;                 // assembled
    entry(mumps.icntl, 18) = 3;                // distributed
    entry(mumps.icntl, 28) = 1;                // sequential analysis
    entry(mumps.icntl, 6) = 0;                 // no permutation to the diagonal
    entry(mumps.icntl, 7) = 1;                 // our ordering
    entry(mumps.icntl, 12) = 1;                // no compression of the graph
    entry(mumps.icntl, 14) = 30;               // workspace margin [%]
    if (!options.definite)
    {
      entry(mumps.icntl, 13) = 1; // no ScaLAPACK at the root: it does not count negative pivots
      entry(mumps.icntl, 24) = 1; // null pivots are noticed
    }
    if (!options.keep_factors)
      entry(mumps.icntl, 31) = 1;

    mumps.n = my.n;
    mumps.perm_in = my.position.data();
    for (const unsigned int dof : schur_dofs)
      my.schur_list.push_back(dof + 1);
    if (!schur_dofs.empty())
    {
      entry(mumps.icntl, 19) = 1; // complement on the host, lower triangle by rows
      mumps.size_schur = schur_dofs.size();
      mumps.listvar_schur = my.schur_list.data();
      if (my.is_host)
      {
        my.schur.reinit(schur_dofs.size(), schur_dofs.size());
        mumps.schur = &my.schur(0, 0);
      }
    }

    std::vector<char> is_fixed(my.n, 0);
    for (const auto dof : options.fixed_dofs)
      is_fixed[dof] = 1;
    my.collect_entries(a, mass != nullptr ? static_cast<Mat>(*mass) : nullptr, shift, is_fixed);

    timer.restart();
    my.run(1, "analysis");
    my.statistics.seconds_analysis = timer.wall_time();
    // INFO(15): of this rank, in MB
    const std::string shortage =
        memory_shortage("The factorisation of " + options.name + " (" + std::to_string(my.n) + " dofs)",
                        1e6 * entry(mumps.info, 15), my.communicator);
    if (!shortage.empty())
      throw ConvergenceError(shortage + ": " + ways_to_less_memory + ".");
    const double n_ranks = dealii::Utilities::MPI::n_mpi_processes(my.communicator),
                 operations = entry(mumps.rinfog, 1);
    progress.emplace(options.name + ": factorisation of " + std::to_string(my.n) + " dofs", 1,
                     operations / (flops_per_second * std::pow(n_ranks, 0.8)));
    timer.restart();
    my.run(2, "factorisation");
    my.statistics.seconds_factorization = timer.wall_time();
    progress.reset();
    my.statistics.megabytes_rank = entry(mumps.infog, 21);
    my.statistics.megabytes_total = entry(mumps.infog, 22);
    const double entries = entry(mumps.infog, 29);
    my.statistics.factor_entries = entries < 0 ? -1e6 * entries : entries;
    my.statistics.operations = entry(mumps.rinfog, 3);
    for (auto *triplets : {&my.rows, &my.columns, &my.position})
    {
      triplets->clear();
      triplets->shrink_to_fit();
    }
    my.values.clear();
    my.values.shrink_to_fit();

    bool is_definite = true;
    if (!schur_dofs.empty() && my.is_host)
    {
      // What MUMPS writes by rows is the transposed of our storage by columns.
      const unsigned int m = schur_dofs.size();
      for (unsigned int i = 0; i < m; ++i)
        for (unsigned int j = 0; j < i; ++j)
          my.schur(i, j) = my.schur(j, i);
      if (options.keep_factors && options.definite)
      {
        my.schur_factor = my.schur;
        is_definite = factorise_cholesky(my.schur_factor);
      }
    }
    if (!dealii::Utilities::MPI::broadcast(my.communicator, is_definite))
      throw ConvergenceError(
          "The stiffness condensed on the contact is not positive definite in a matrix of " +
          std::to_string(my.n) +
          " dofs: is the body held, and does its mesh have cells of reasonable shape?");
  }

  SymmetricFactorization::~SymmetricFactorization()
  {
    // Ending MUMPS is collective: after an exception, which may be this rank's alone, it would wait for ever.
    if (std::uncaught_exceptions() > 0)
      return;
    implementation->mumps.job = -2;
    dmumps_c(&implementation->mumps);
  }

  void SymmetricFactorization::Implementation::solve_on_host(double *const columns_, const int n_columns)
  {
    dealii::Timer timer;
    const int m = mumps.size_schur;
    mumps.nrhs = n_columns;
    mumps.lrhs = n;
    mumps.rhs = columns_;
    entry(mumps.icntl, 27) = std::max(1, std::min(n_columns, 128));
    if (m == 0)
      run(3, "solution");
    else
    {
      mumps.lredrhs = m;
      if (is_host)
        reduced.resize(static_cast<std::size_t>(m) * n_columns);
      mumps.redrhs = reduced.data();
      entry(mumps.icntl, 26) = 1;
      run(3, "condensation");
      if (is_host)
      {
        DenseMatrix x(m, n_columns);
        std::copy(reduced.begin(), reduced.end(), &x(0, 0));
        schur_factor.solve(x);
        std::copy_n(&x(0, 0), reduced.size(), reduced.begin());
      }
      entry(mumps.icntl, 26) = 2;
      run(3, "expansion");
      entry(mumps.icntl, 26) = 0;
    }
    statistics.n_solves += n_columns;
    statistics.seconds_solves += timer.wall_time();
  }

  void SymmetricFactorization::solve(Vec b, Vec x)
  {
    Implementation &my = *implementation;
    if (my.is_host)
      my.work.resize(my.n);
    const PetscScalar *in = nullptr;
    petsc_check(VecGetArrayRead(b, &in), "VecGetArrayRead");
    MPI_Gatherv(in, my.end - my.begin, MPI_DOUBLE, my.work.data(), my.local_sizes.data(), my.offsets.data(),
                MPI_DOUBLE, 0, my.communicator);
    VecRestoreArrayRead(b, &in);
    my.solve_on_host(my.work.data(), 1);
    PetscScalar *out = nullptr;
    petsc_check(VecGetArray(x, &out), "VecGetArray");
    MPI_Scatterv(my.work.data(), my.local_sizes.data(), my.offsets.data(), MPI_DOUBLE, out, my.end - my.begin,
                 MPI_DOUBLE, 0, my.communicator);
    VecRestoreArray(x, &out);
  }

  void SymmetricFactorization::solve(DenseMatrix &columns)
  {
    Implementation &my = *implementation;
    const int n_columns = dealii::Utilities::MPI::broadcast(my.communicator, static_cast<int>(columns.n()));
    if (n_columns > 0)
      my.solve_on_host(my.is_host ? &columns(0, 0) : nullptr, n_columns);
  }

  const DenseMatrix &SymmetricFactorization::schur_complement() const
  {
    return implementation->schur;
  }

  unsigned int SymmetricFactorization::n_negative() const
  {
    return entry(implementation->mumps.infog, 12);
  }

  const SymmetricFactorization::Statistics &SymmetricFactorization::statistics() const
  {
    return implementation->statistics;
  }
} // namespace vibrocontact
