#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/memory.h>
#include <vibrocontact/base/petsc_check.h>
#include <vibrocontact/reduction/fill_reducing_order.h>
#include <vibrocontact/reduction/mumps_job.h>
#include <vibrocontact/reduction/symmetric_factorization.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/timer.h>

#include <dmumps_c.h>
#include <smumps_c.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <type_traits>

#include <exception>

namespace vibrocontact
{
  namespace
  {
    /// What an idle core does in a factorisation [flop/s], for its expected time.
    constexpr double flops_per_second = 1e10;

    /// of an approximate factorisation: entries that blocks of low rank leave out, relative to those of the scaled
    /// matrix. 1e-4 saves a tenth of the memory, but takes 7 steps of conjugate gradients in place of 4 (doc/scale.md).
    constexpr double dropping = 1e-5;

    // Entry k of an array of MUMPS's manual, which counts from 1.
    template <typename Array>
    auto &entry(Array &array, const int k)
    {
      return array[k - 1];
    }

    /// MUMPS in the precision of a number.
    template <typename Number>
    struct Arithmetic;

    template <>
    struct Arithmetic<double>
    {
      using Mumps = DMUMPS_STRUC_C;
      static void run(Mumps *mumps) { dmumps_c(mumps); }
      static MPI_Datatype mpi_type() { return MPI_DOUBLE; }
    };

    template <>
    struct Arithmetic<float>
    {
      using Mumps = SMUMPS_STRUC_C;
      static void run(Mumps *mumps) { smumps_c(mumps); }
      static MPI_Datatype mpi_type() { return MPI_FLOAT; }
    };
  } // namespace

  struct SymmetricFactorization::Implementation
  {
    virtual ~Implementation() = default;
    virtual void factorise(Mat matrix, Mat mass, double shift, const Options &options) = 0;
    /// Own rows, column by column; `in` and `out` may be the same.
    virtual void solve(const double *in, double *out, int n_columns) = 0;
    virtual unsigned int n_negative() const = 0;

    MPI_Comm communicator;
    bool is_host = false;
    PetscInt n = 0, begin = 0, end = 0;
    std::vector<int> local_sizes, offsets;
    DenseMatrix schur, schur_factor;
    Statistics statistics;
  };

  namespace
  {
    template <typename Number>
    class Factors : public SymmetricFactorization::Implementation
    {
    public:
      ~Factors() override;
      void factorise(Mat matrix, Mat mass, double shift,
                     const SymmetricFactorization::Options &options) override;
      void solve(const double *in, double *out, int n_columns) override;
      unsigned int n_negative() const override { return mumps.infog[11]; }

    private:
      void run(int job, const char *what);
      void collect_entries(Mat matrix, Mat mass, double shift, const std::vector<char> &is_fixed);
      // Solves for `n_columns` columns in place, on the host.
      void solve_on_host(Number *columns, int n_columns);

      typename Arithmetic<Number>::Mumps mumps{};
      std::vector<MUMPS_INT> rows, columns, position, schur_list;
      std::vector<Number> values, reduced;
    };
  } // namespace

  template <typename Number>
  void Factors<Number>::run(const int job, const char *what)
  {
    run_mumps(mumps, Arithmetic<Number>::run, job, what + (" of a matrix of " + std::to_string(n)) + " dofs");
  }

  template <typename Number>
  void Factors<Number>::collect_entries(Mat matrix, Mat mass, const double shift,
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

  template <typename Number>
  void Factors<Number>::factorise(Mat a, Mat mass, const double shift,
                                  const SymmetricFactorization::Options &options)
  {
    const std::vector<unsigned int> schur_dofs(options.schur_dofs.begin(), options.schur_dofs.end());
    dealii::Timer timer;
    // 12 us per dof for METIS and the analysis
    std::optional<Progress> progress;
    progress.emplace(options.name + ": ordering of " + std::to_string(n) + " dofs", 1, 12e-6 * n);
    position = fill_reducing_order(a, schur_dofs);
    statistics.seconds_ordering = timer.wall_time();

    mumps.comm_fortran = MPI_Comm_c2f(communicator);
    mumps.par = 1;
    mumps.sym = options.definite ? 1 : 2;
    run(-1, "start");
    for (const int k : {1, 2, 3, 4})
      entry(mumps.icntl, k) = k == 4 ? 0 : -1; // no output
    entry(mumps.icntl, 5) = 0;                 // assembled
    entry(mumps.icntl, 18) = 3;                // distributed
    entry(mumps.icntl, 28) = 1;                // sequential analysis
    entry(mumps.icntl, 6) = 0;                 // no permutation to the diagonal
    entry(mumps.icntl, 7) = 1;                 // our ordering
    entry(mumps.icntl, 12) = 1;                // no compression of the graph
    entry(mumps.icntl, 14) = 30;               // workspace margin [%]
    if (options.approximate)
    {
      entry(mumps.icntl, 35) = 2; // blocks of low rank, in the factors too
      entry(mumps.icntl, 37) = 1; // and in the contribution blocks
      entry(mumps.icntl, 14) = 5; // what they save is margin enough
      entry(mumps.cntl, 7) = dropping;
    }
    if (!options.definite)
    {
      entry(mumps.icntl, 13) = 1; // no ScaLAPACK at the root: it does not count negative pivots
      entry(mumps.icntl, 24) = 1; // null pivots are noticed
    }
    if (!options.keep_factors)
      entry(mumps.icntl, 31) = 1;

    mumps.n = n;
    mumps.perm_in = position.data();
    for (const unsigned int dof : schur_dofs)
      schur_list.push_back(dof + 1);
    if (!schur_dofs.empty())
    {
      entry(mumps.icntl, 19) = 1; // complement on the host, lower triangle by rows
      mumps.size_schur = schur_dofs.size();
      mumps.listvar_schur = schur_list.data();
      if (is_host)
      {
        schur.reinit(schur_dofs.size(), schur_dofs.size());
        if constexpr (std::is_same_v<Number, double>)
          mumps.schur = &schur(0, 0);
      }
    }

    std::vector<char> is_fixed(n, 0);
    for (const auto dof : options.fixed_dofs)
      is_fixed[dof] = 1;
    collect_entries(a, mass, shift, is_fixed);
    return_free_memory();

    timer.restart();
    run(1, "analysis");
    statistics.seconds_analysis = timer.wall_time();
    // INFO(15), with blocks of low rank INFO(30): of this rank, in MB
    const std::string shortage =
        memory_shortage("The factorisation of " + options.name + " (" + std::to_string(n) + " dofs)",
                        1e6 * entry(mumps.info, options.approximate ? 30 : 15), communicator);
    if (!shortage.empty())
      throw ConvergenceError(shortage + ": " + ways_to_less_memory + ".");
    const double n_ranks = dealii::Utilities::MPI::n_mpi_processes(communicator),
                 operations = entry(mumps.rinfog, 1);
    progress.emplace(options.name + ": factorisation of " + std::to_string(n) + " dofs", 1,
                     (options.approximate ? 0.2 : 1.) * operations /
                         (flops_per_second * std::pow(n_ranks, 0.8)));
    timer.restart();
    run(2, "factorisation");
    statistics.seconds_factorization = timer.wall_time();
    progress.reset();
    statistics.megabytes_rank = entry(mumps.infog, 21);
    statistics.megabytes_total = entry(mumps.infog, 22);
    const double entries = entry(mumps.infog, options.approximate ? 35 : 29);
    statistics.factor_entries = entries < 0 ? -1e6 * entries : entries;
    statistics.operations = entry(mumps.rinfog, options.approximate ? 14 : 3);
    for (auto *triplets : {&rows, &columns, &position})
    {
      triplets->clear();
      triplets->shrink_to_fit();
    }
    values.clear();
    values.shrink_to_fit();

    bool is_definite = true;
    if (!schur_dofs.empty() && is_host)
    {
      // What MUMPS writes by rows is the transposed of our storage by columns.
      const unsigned int m = schur_dofs.size();
      for (unsigned int i = 0; i < m; ++i)
        for (unsigned int j = 0; j < i; ++j)
          schur(i, j) = schur(j, i);
      if (options.keep_factors && options.definite)
      {
        schur_factor = schur;
        is_definite = factorise_cholesky(schur_factor);
      }
    }
    if (!dealii::Utilities::MPI::broadcast(communicator, is_definite))
      throw ConvergenceError(
          "The stiffness condensed on the contact is not positive definite in a matrix of " +
          std::to_string(n) + " dofs: is the body held, and does its mesh have cells of reasonable shape?");
  }

  template <typename Number>
  Factors<Number>::~Factors()
  {
    // Ending MUMPS is collective: after an exception, which may be this rank's alone, it would wait for ever.
    if (std::uncaught_exceptions() > 0)
      return;
    mumps.job = -2;
    Arithmetic<Number>::run(&mumps);
  }

  template <typename Number>
  void Factors<Number>::solve_on_host(Number *const right_sides, const int n_columns)
  {
    const int m = mumps.size_schur;
    mumps.nrhs = n_columns;
    mumps.lrhs = n;
    mumps.rhs = right_sides;
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
  }

  template <typename Number>
  void Factors<Number>::solve(const double *const in, double *const out, const int n_columns)
  {
    dealii::Timer timer;
    const std::size_t n_own = end - begin, n_all = n;
    const MPI_Datatype type = Arithmetic<Number>::mpi_type();
    std::vector<Number> own(in, in + n_own * n_columns), work(is_host ? n_all * n_columns : 0);
    for (int j = 0; j < n_columns; ++j)
      MPI_Gatherv(own.data() + j * n_own, n_own, type, work.data() + (is_host ? j * n_all : 0),
                  local_sizes.data(), offsets.data(), type, 0, communicator);
    solve_on_host(work.data(), n_columns);
    for (int j = 0; j < n_columns; ++j)
      MPI_Scatterv(work.data() + (is_host ? j * n_all : 0), local_sizes.data(), offsets.data(), type,
                   own.data() + j * n_own, n_own, type, 0, communicator);
    std::copy(own.begin(), own.end(), out);
    statistics.n_solves += n_columns;
    statistics.seconds_solves += timer.wall_time();
  }

  SymmetricFactorization::SymmetricFactorization(const dealii::PETScWrappers::MatrixBase &matrix,
                                                 const dealii::PETScWrappers::MatrixBase *mass,
                                                 const double shift, const Options &options)
  {
    AssertThrow(shift == 0 || mass != nullptr, dealii::ExcInternalError());
    AssertThrow(!options.approximate || options.schur_dofs.empty(), dealii::ExcInternalError());
    if (options.approximate)
      implementation = std::make_unique<Factors<float>>();
    else
      implementation = std::make_unique<Factors<double>>();
    Implementation &my = *implementation;
    Mat a = matrix;
    my.communicator = PetscObjectComm(reinterpret_cast<PetscObject>(a));
    my.is_host = dealii::Utilities::MPI::this_mpi_process(my.communicator) == 0;
    petsc_check(MatGetSize(a, &my.n, nullptr), "MatGetSize");
    petsc_check(MatGetOwnershipRange(a, &my.begin, &my.end), "MatGetOwnershipRange");
    my.local_sizes = dealii::Utilities::MPI::all_gather(my.communicator, static_cast<int>(my.end - my.begin));
    my.offsets.assign(1, 0);
    std::partial_sum(my.local_sizes.begin(), my.local_sizes.end(), std::back_inserter(my.offsets));
    my.factorise(a, mass != nullptr ? static_cast<Mat>(*mass) : nullptr, shift, options);
  }

  SymmetricFactorization::~SymmetricFactorization() = default;

  void SymmetricFactorization::solve(Vec b, Vec x)
  {
    const PetscScalar *in = nullptr;
    PetscScalar *out = nullptr;
    petsc_check(VecGetArrayRead(b, &in), "VecGetArrayRead");
    petsc_check(VecGetArray(x, &out), "VecGetArray");
    implementation->solve(in, out, 1);
    VecRestoreArray(x, &out);
    VecRestoreArrayRead(b, &in);
  }

  void SymmetricFactorization::solve(std::vector<double> &columns, const unsigned int n_columns)
  {
    if (n_columns > 0)
      implementation->solve(columns.data(), columns.data(), n_columns);
  }

  const DenseMatrix &SymmetricFactorization::schur_complement() const
  {
    return implementation->schur;
  }

  unsigned int SymmetricFactorization::n_negative() const
  {
    return implementation->n_negative();
  }

  const SymmetricFactorization::Statistics &SymmetricFactorization::statistics() const
  {
    return implementation->statistics;
  }
} // namespace vibrocontact
