#include <vibrocontact/base/blas.h>
#include <vibrocontact/base/singleton_start.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

int main(int argc, char **argv)
{
  testing::InitGoogleTest(&argc, argv);
  // Listing the tests (ctest does it) needs no MPI.
  if (testing::GTEST_FLAG(list_tests))
    return RUN_ALL_TESTS();

  const vibrocontact::SingletonStart start;
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  // as the program does
  vibrocontact::prepare_blas();
  const unsigned int rank = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
  if (rank != 0)
    delete testing::UnitTest::GetInstance()->listeners().Release(
        testing::UnitTest::GetInstance()->listeners().default_result_printer());
  const int result = RUN_ALL_TESTS();
  // A failure on any rank is a failure of the run.
  return dealii::Utilities::MPI::max(result, MPI_COMM_WORLD);
}
