// Jobs of MUMPS whose workspace its analysis has counted too small.

#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/reduction/mumps_job.h>

#include <dmumps_c.h>
#include <gtest/gtest.h>
#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace vibrocontact;

namespace
{
  // Multipliers first, none of which is a pivot before what it couples: every one is delayed, which the analysis of a
  // symmetric matrix without its values does not foresee. Lower triangle, counted from 1, and A x for x = 1.
  struct DelayedPivots
  {
    static constexpr MUMPS_INT n_multipliers = 200, n = 2 * n_multipliers;
    std::vector<MUMPS_INT> rows, columns;
    std::vector<double> values, row_sums = std::vector<double>(n, 0.);

    DelayedPivots()
    {
      for (MUMPS_INT k = 1; k <= n_multipliers; ++k)
        for (MUMPS_INT j = std::max(1, k - 1); j <= std::min(n_multipliers, k + 1); ++j)
          add(n_multipliers + j, k, j == k ? 2. : 0.5);
      for (MUMPS_INT j = 1; j < n_multipliers; ++j)
        for (MUMPS_INT i = j + 1; i <= std::min(n_multipliers, j + 6); ++i)
          add(n_multipliers + i, n_multipliers + j, 1e-3);
    }
    void add(const MUMPS_INT row, const MUMPS_INT column, const double value)
    {
      rows.push_back(row);
      columns.push_back(column);
      values.push_back(value);
      row_sums[row - 1] += value;
      row_sums[column - 1] += value;
    }
  };

  struct Outcome
  {
    int first_info, margin;
    double error;
  };

  // INFOG(1) of the factorisation as MUMPS makes it, then the margin that run_mumps() ends with, and the error.
  Outcome solve(DelayedPivots matrix)
  {
    DMUMPS_STRUC_C mumps{};
    mumps.comm_fortran = MPI_Comm_c2f(MPI_COMM_SELF);
    mumps.par = 1;
    mumps.sym = 2;
    run_mumps(mumps, dmumps_c, -1, "start");
    for (const int k : {1, 2, 3, 4})
      mumps.icntl[k - 1] = k == 4 ? 0 : -1;
    std::vector<MUMPS_INT> order(matrix.n);
    for (MUMPS_INT k = 0; k < matrix.n; ++k)
      order[k] = k + 1;
    mumps.icntl[6 - 1] = 0;
    mumps.icntl[7 - 1] = 1;
    mumps.icntl[8 - 1] = 0;
    mumps.icntl[12 - 1] = 1;
    mumps.icntl[14 - 1] = 0;
    mumps.perm_in = order.data();
    mumps.n = matrix.n;
    mumps.nnz = matrix.rows.size();
    mumps.irn = matrix.rows.data();
    mumps.jcn = matrix.columns.data();
    mumps.a = matrix.values.data();
    run_mumps(mumps, dmumps_c, 1, "analysis");
    mumps.job = 2;
    dmumps_c(&mumps);
    const int first_info = mumps.infog[1 - 1];
    run_mumps(mumps, dmumps_c, 2, "factorisation");
    std::vector<double> x = matrix.row_sums;
    mumps.rhs = x.data();
    mumps.nrhs = 1;
    mumps.lrhs = matrix.n;
    run_mumps(mumps, dmumps_c, 3, "solution");
    double error = 0;
    for (const double value : x)
      error = std::max(error, std::abs(value - 1));
    const int margin = mumps.icntl[14 - 1];
    run_mumps(mumps, dmumps_c, -2, "end");
    return {first_info, margin, error};
  }
} // namespace

TEST(MumpsJob, FactorisationIsRepeatedWithTheWorkspaceThatItAsksFor)
{
  const Outcome outcome = solve(DelayedPivots());
  EXPECT_EQ(outcome.first_info, -9) << "the analysis has foreseen all: this tests nothing";
  EXPECT_GT(outcome.margin, 0);
  EXPECT_LT(outcome.error, 1e-12);
}
