#include <vibrocontact/base/petsc_check.h>
#include <vibrocontact/reduction/block_product.h>

#include <algorithm>
#include <array>

namespace vibrocontact
{
  namespace
  {
    /// columns of a panel, whose entries of a row lie side by side: each entry of the matrix is read once for all
    constexpr PetscInt panel = 8;

    /// y += A x of one panel. @param matrix sequential
    void add_product(Mat matrix, const std::vector<double> &x, std::vector<double> &y)
    {
      PetscInt n = 0;
      const PetscInt *start = nullptr, *column = nullptr;
      const PetscScalar *value = nullptr;
      PetscBool done = PETSC_FALSE;
      petsc_check(MatGetRowIJ(matrix, 0, PETSC_FALSE, PETSC_FALSE, &n, &start, &column, &done),
                  "MatGetRowIJ");
      petsc_check(MatSeqAIJGetArrayRead(matrix, &value), "MatSeqAIJGetArrayRead");
      for (PetscInt row = 0; row < n; ++row)
      {
        std::array<double, panel> sum{};
        for (PetscInt k = start[row]; k < start[row + 1]; ++k)
        {
          const double *const of_column = x.data() + std::size_t(column[k]) * panel;
          for (PetscInt j = 0; j < panel; ++j)
            sum[j] += value[k] * of_column[j];
        }
        for (PetscInt j = 0; j < panel; ++j)
          y[std::size_t(row) * panel + j] += sum[j];
      }
      petsc_check(MatSeqAIJRestoreArrayRead(matrix, &value), "MatSeqAIJRestoreArrayRead");
      petsc_check(MatRestoreRowIJ(matrix, 0, PETSC_FALSE, PETSC_FALSE, &n, &start, &column, &done),
                  "MatRestoreRowIJ");
    }

    /// Brings the rows of a panel that a rank's part of the matrix needs of other ranks.
    class Exchange
    {
    public:
      Exchange(const MPI_Comm communicator, const PetscInt n_rows, const PetscInt n_others,
               const PetscInt *const others)
          : from_others(std::size_t(n_others) * panel)
      {
        IS rows, places;
        petsc_check(VecCreateMPIWithArray(communicator, panel, n_rows * panel, PETSC_DECIDE, nullptr, &own),
                    "VecCreateMPIWithArray");
        petsc_check(
            VecCreateSeqWithArray(PETSC_COMM_SELF, panel, n_others * panel, from_others.data(), &other),
            "VecCreateSeqWithArray");
        petsc_check(ISCreateBlock(PETSC_COMM_SELF, panel, n_others, others, PETSC_COPY_VALUES, &rows),
                    "ISCreateBlock");
        petsc_check(ISCreateStride(PETSC_COMM_SELF, n_others * panel, 0, 1, &places), "ISCreateStride");
        petsc_check(VecScatterCreate(own, rows, other, places, &scatter), "VecScatterCreate");
        ISDestroy(&rows);
        ISDestroy(&places);
      }
      ~Exchange()
      {
        VecScatterDestroy(&scatter);
        VecDestroy(&own);
        VecDestroy(&other);
      }
      Exchange(const Exchange &) = delete;
      Exchange &operator=(const Exchange &) = delete;

      const std::vector<double> &operator()(const std::vector<double> &x)
      {
        petsc_check(VecPlaceArray(own, x.data()), "VecPlaceArray");
        petsc_check(VecScatterBegin(scatter, own, other, INSERT_VALUES, SCATTER_FORWARD), "VecScatterBegin");
        petsc_check(VecScatterEnd(scatter, own, other, INSERT_VALUES, SCATTER_FORWARD), "VecScatterEnd");
        petsc_check(VecResetArray(own), "VecResetArray");
        return from_others;
      }

    private:
      std::vector<double> from_others;
      Vec own = nullptr, other = nullptr;
      VecScatter scatter = nullptr;
    };
  } // namespace

  std::vector<double> block_product(Mat matrix, const std::vector<double> &columns, const PetscInt n_columns)
  {
    PetscInt n_rows = 0, n_others = 0;
    petsc_check(MatGetLocalSize(matrix, &n_rows, nullptr), "MatGetLocalSize");
    const std::size_t n = n_rows;
    Mat own = matrix, other = nullptr;
    const PetscInt *others = nullptr;
    PetscBool is_parallel = PETSC_FALSE;
    PetscObjectTypeCompare(reinterpret_cast<PetscObject>(matrix), MATMPIAIJ, &is_parallel);
    if (is_parallel)
    {
      petsc_check(MatMPIAIJGetSeqAIJ(matrix, &own, &other, &others), "MatMPIAIJGetSeqAIJ");
      petsc_check(MatGetSize(other, nullptr, &n_others), "MatGetSize");
    }
    Exchange exchange(PetscObjectComm(reinterpret_cast<PetscObject>(matrix)), n_rows, n_others, others);
    std::vector<double> result(n * n_columns), x(n * panel), y(n * panel);
    for (PetscInt first = 0; first < n_columns; first += panel)
    {
      const PetscInt width = std::min(panel, n_columns - first);
      std::fill(x.begin(), x.end(), 0.);
      std::fill(y.begin(), y.end(), 0.);
      for (PetscInt j = 0; j < width; ++j)
        for (std::size_t i = 0; i < n; ++i)
          x[i * panel + j] = columns[(first + j) * n + i];
      add_product(own, x, y);
      if (is_parallel)
        add_product(other, exchange(x), y);
      for (PetscInt j = 0; j < width; ++j)
        for (std::size_t i = 0; i < n; ++i)
          result[(first + j) * n + i] = y[i * panel + j];
    }
    return result;
  }
} // namespace vibrocontact
