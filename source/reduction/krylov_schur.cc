#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/reduction/block_product.h>
#include <vibrocontact/reduction/krylov_schur.h>
#include <vibrocontact/reduction/locally_owned_values.h>

#include <deal.II/base/mpi.h>

#include <AnasaziBasicEigenproblem.hpp>
#include <AnasaziBlockKrylovSchurSolMgr.hpp>
#include <AnasaziEpetraAdapter.hpp>
#include <Epetra_Map.h>
#include <Epetra_MpiComm.h>
#include <Epetra_MultiVector.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace vibrocontact
{
  using Vector = dealii::PETScWrappers::MPI::Vector;
  /// out = A in, several columns at once
  using BlockOperator = std::function<void(const Epetra_MultiVector &in, Epetra_MultiVector &out)>;
} // namespace vibrocontact

namespace Anasazi
{
  template <>
  class OperatorTraits<double, Epetra_MultiVector, vibrocontact::BlockOperator>
  {
  public:
    static void Apply(const vibrocontact::BlockOperator &A, const Epetra_MultiVector &x,
                      Epetra_MultiVector &y)
    {
      A(x, y);
    }
  };
} // namespace Anasazi

namespace vibrocontact
{
  namespace
  {
    /// columns of a block: a solve reads all factors from memory, and for 8 columns that takes little longer
    /// than for one
    constexpr unsigned int block_size = 8;

    /// of the basis that a body of many dofs has room for beside: the lowest 20 modes of a cube take 168 solves with them, 312
    /// without
    constexpr unsigned int spare_blocks = 11;

    /// of the basis; convergence mostly comes before it is full
    unsigned int krylov_blocks(const unsigned int n_wanted)
    {
      return std::max(4u, 3 + (22 * n_wanted / 10 + block_size - 1) / block_size);
    }

    /// own rows, column by column
    std::vector<double> values_of(const Epetra_MultiVector &columns)
    {
      std::vector<double> values(std::size_t(columns.MyLength()) * columns.NumVectors());
      columns.ExtractCopy(values.data(), columns.MyLength());
      return values;
    }

    void set_values(const std::vector<double> &values, Epetra_MultiVector &columns)
    {
      const std::size_t n = columns.MyLength();
      for (int j = 0; j < columns.NumVectors(); ++j)
        std::copy_n(values.data() + j * n, n, columns[j]);
    }
  } // namespace

  unsigned int krylov_dimension(const unsigned int n_wanted)
  {
    return (krylov_blocks(n_wanted) + 1) * block_size;
  }

  void krylov_schur(const SecondOrderSystem &system, Flexibility &flexibility, const unsigned int n_wanted,
                    Modes &modes, const double tolerance)
  {
    const int block = block_size;
    const unsigned int n_first = modes.omega.size(),
                       n_blocks =
                           krylov_blocks(n_wanted) +
                           (system.stiffness.m() > 100 * krylov_dimension(n_wanted) ? spare_blocks : 0);
    const Epetra_MpiComm communicator(system.communicator);
    const Epetra_Map map(static_cast<int>(system.stiffness.m()),
                         static_cast<int>(system.locally_owned.n_elements()), 0, communicator);
    // Modes converge at about two and a half solves each.
    Progress progress(system.body + ": " + std::to_string(n_wanted) + " modes", 2.5 * n_wanted + 3 * block);
    const BlockOperator inertia = [&](const Epetra_MultiVector &in, Epetra_MultiVector &out)
    { set_values(block_product(system.mass, values_of(in), in.NumVectors()), out); };
    const BlockOperator inverse = [&](const Epetra_MultiVector &in, Epetra_MultiVector &out)
    {
      std::vector<double> values = block_product(system.mass, values_of(in), in.NumVectors());
      flexibility.vmult(values, in.NumVectors());
      set_values(values, out);
      modes.n_solves += in.NumVectors();
      progress.advance(in.NumVectors());
    };

    Epetra_MultiVector random(map, block);
    for (int j = 0; j < block; ++j)
      for (int i = 0; i < map.NumMyElements(); ++i)
      {
        const int dof = map.GID(i);
        random[j][i] = std::sin(1. + n_first + 1.6180340 * j +
                                (0.7390851 + 0.0314159 * j) * dof * (1. + 1e-3 * (dof % 97)));
      }
    const auto start = Teuchos::rcp(new Epetra_MultiVector(map, block));
    inverse(random, *start);

    using Problem = Anasazi::BasicEigenproblem<double, Epetra_MultiVector, BlockOperator>;
    const auto problem = Teuchos::rcp(new Problem(Teuchos::rcpFromRef(inverse), start));
    problem->setM(Teuchos::rcpFromRef(inertia));
    problem->setHermitian(true);
    problem->setNEV(n_wanted);
    const unsigned int n_known = n_first - modes.n_rigid_modes;
    if (n_known > 0)
    {
      const auto known = Teuchos::rcp(new Epetra_MultiVector(map, n_known));
      set_values(locally_owned_values(modes.shapes, modes.n_rigid_modes, n_known), *known);
      problem->setAuxVecs(known);
    }
    problem->setProblem();

    Teuchos::ParameterList options;
    options.set("Which", "LM");
    options.set("Block Size", block);
    options.set("Num Blocks", static_cast<int>(n_blocks));
    options.set("Step Size", 2);
    options.set("Maximum Restarts", 200);
    options.set("Convergence Tolerance", tolerance);
    options.set("In Situ Restarting", true);
    options.set("Verbosity", static_cast<int>(Anasazi::Errors));
    Anasazi::BlockKrylovSchurSolMgr<double, Epetra_MultiVector, BlockOperator> solver(problem, options);
    try
    {
      solver.solve();
    }
    catch (const Anasazi::AnasaziError &error)
    {
      run_log().line(error.what());
      throw ConvergenceError(
          "Body '" + system.body +
          "': the block Krylov sequence of its modes broke down, as it does where its stiffness "
          "has no digits left; check the shape of its cells and the ratio of its materials, or "
          "ask for fewer modes.");
    }
    const auto &solution = problem->getSolution();
    if (solution.numVecs < static_cast<int>(n_wanted))
      throw ConvergenceError("Body '" + system.body + "': only " + std::to_string(solution.numVecs) + " of " +
                             std::to_string(n_wanted) + " modes converged to " + number_text(tolerance) +
                             ".");
    for (int i = 0; i < solution.numVecs; ++i)
    {
      modes.shapes.emplace_back(system.locally_owned, system.communicator);
      set_locally_owned_values((*solution.Evecs)[i], modes.shapes.back());
    }
    // Not by the values that were found: of two equal ones rounding may make a complex pair in the projected problem, and
    // then Anasazi puts its vectors into another order than its values.
    take_frequencies_of_shapes(system, n_first, modes);
  }
} // namespace vibrocontact
