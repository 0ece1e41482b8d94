#include <vibrocontact/analyses/stability/sparse_roots.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/petsc_check.h>

#include <deal.II/base/mpi.h>

#include <slepcpep.h>

#include <algorithm>
#include <map>
#include <numeric>

namespace vibrocontact
{
  namespace
  {
    /// The dofs of the bodies and the forces dN as one vector: each rank has its rows of body 1, then those of
    /// body 2 and so on, and the last one the forces.
    class Layout
    {
    public:
      Layout(const FiniteElementPair &bodies, const unsigned int n_forces, const MPI_Comm communicator)
          : first(bodies.size()), offset(bodies.size())
      {
        const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(communicator),
                           rank = dealii::Utilities::MPI::this_mpi_process(communicator);
        PetscInt next = 0;
        std::vector<std::vector<PetscInt>> sizes(bodies.size());
        for (unsigned int b = 0; b < bodies.size(); ++b)
          if (bodies[b].system)
            sizes[b] = dealii::Utilities::MPI::all_gather(
                communicator, static_cast<PetscInt>(bodies[b].system->locally_owned.n_elements()));
        for (unsigned int r = 0; r < n_ranks; ++r)
        {
          if (r == rank)
            begin = next;
          for (unsigned int b = 0; b < bodies.size(); ++b)
            if (bodies[b].system)
            {
              first[b].push_back(r == 0 ? 0 : first[b].back() + sizes[b][r - 1]);
              offset[b].push_back(next);
              next += sizes[b][r];
            }
          if (r == rank)
            n_owned = next - begin + (r + 1 == n_ranks ? n_forces : 0);
        }
        forces = next;
      }

      PetscInt row(const unsigned int body, const PetscInt dof) const
      {
        const unsigned int r =
            std::upper_bound(first[body].begin(), first[body].end(), dof) - first[body].begin() - 1;
        return offset[body][r] + dof - first[body][r];
      }

      /// of this rank; row of the first force
      PetscInt begin = 0, n_owned = 0, forces = 0;

    private:
      /// by body and rank: first dof, and its row
      std::vector<std::vector<PetscInt>> first, offset;
    };

    struct SparseMatrix
    {
      SparseMatrix(const Layout &layout, const PetscInt entries_per_row, const MPI_Comm communicator)
      {
        petsc_check(MatCreateAIJ(communicator, layout.n_owned, layout.n_owned, PETSC_DETERMINE,
                                 PETSC_DETERMINE, entries_per_row, nullptr, entries_per_row, nullptr,
                                 &matrix),
                    "MatCreateAIJ");
        petsc_check(MatSetOption(matrix, MAT_NEW_NONZERO_ALLOCATION_ERR, PETSC_FALSE), "MatSetOption");
        // a factorisation wants the whole diagonal
        for (PetscInt i = 0; i < layout.n_owned; ++i)
          add(layout.begin + i, layout.begin + i, 0);
      }
      ~SparseMatrix() { MatDestroy(&matrix); }
      SparseMatrix(const SparseMatrix &) = delete;
      SparseMatrix &operator=(const SparseMatrix &) = delete;

      void add(const PetscInt row, const PetscInt column, const double value)
      {
        petsc_check(MatSetValue(matrix, row, column, value, ADD_VALUES), "MatSetValue");
      }
      void add(const FiniteElementPair &bodies, const Layout &layout,
               const dealii::PETScWrappers::MPI::SparseMatrix SecondOrderSystem::*part)
      {
        for (unsigned int b = 0; b < bodies.size(); ++b)
        {
          if (!bodies[b].system)
            continue;
          const Mat source = bodies[b].system->*part;
          for (const auto dof : bodies[b].system->locally_owned)
          {
            PetscInt n;
            const PetscInt *columns;
            const PetscScalar *values;
            petsc_check(MatGetRow(source, dof, &n, &columns, &values), "MatGetRow");
            for (PetscInt k = 0; k < n; ++k)
              add(layout.row(b, dof), layout.row(b, columns[k]), values[k]);
            petsc_check(MatRestoreRow(source, dof, &n, &columns, &values), "MatRestoreRow");
          }
        }
      }
      void finish()
      {
        petsc_check(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY), "MatAssemblyBegin");
        petsc_check(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY), "MatAssemblyEnd");
      }

      Mat matrix = nullptr;
    };

    struct Solver
    {
      explicit Solver(const MPI_Comm communicator)
      {
        petsc_check(PEPCreate(communicator, &pep), "PEPCreate");
      }
      ~Solver() { PEPDestroy(&pep); }
      Solver(const Solver &) = delete;
      Solver &operator=(const Solver &) = delete;

      PEP pep = nullptr;
    };

    void solve(const PEP pep, const std::vector<Mat> &matrices, const unsigned int n_roots)
    {
      std::vector<Mat> operators = matrices;
      petsc_check(PEPSetOperators(pep, operators.size(), operators.data()), "PEPSetOperators");
      petsc_check(PEPSetProblemType(pep, PEP_GENERAL), "PEPSetProblemType");
      petsc_check(PEPSetType(pep, PEPTOAR), "PEPSetType");
      petsc_check(PEPSetScale(pep, PEP_SCALE_SCALAR, PETSC_DECIDE, nullptr, nullptr, 1, 1), "PEPSetScale");
      petsc_check(PEPSetDimensions(pep, 2 * n_roots, PETSC_DEFAULT, PETSC_DEFAULT), "PEPSetDimensions");
      petsc_check(PEPSetTarget(pep, 0), "PEPSetTarget");
      petsc_check(PEPSetWhichEigenpairs(pep, PEP_TARGET_MAGNITUDE), "PEPSetWhichEigenpairs");
      petsc_check(PEPSetTolerances(pep, 1e-10, 500), "PEPSetTolerances");
      ST transformation;
      KSP ksp;
      PC preconditioner;
      petsc_check(PEPGetST(pep, &transformation), "PEPGetST");
      petsc_check(STSetType(transformation, STSINVERT), "STSetType");
      petsc_check(STSetTransform(transformation, PETSC_TRUE), "STSetTransform");
      petsc_check(STGetKSP(transformation, &ksp), "STGetKSP");
      petsc_check(KSPSetType(ksp, KSPPREONLY), "KSPSetType");
      petsc_check(KSPGetPC(ksp, &preconditioner), "KSPGetPC");
      petsc_check(PCSetType(preconditioner, PCLU), "PCSetType");
      petsc_check(PCFactorSetMatSolverType(preconditioner, MATSOLVERMUMPS), "PCFactorSetMatSolverType");
      petsc_check(PEPSolve(pep), "PEPSolve");
      PetscInt n_converged;
      petsc_check(PEPGetConverged(pep, &n_converged), "PEPGetConverged");
      if (n_converged < static_cast<PetscInt>(2 * n_roots))
        throw ConvergenceError("SLEPc found " + std::to_string(n_converged) + " of " +
                               std::to_string(2 * n_roots) +
                               " eigenvalues of the finite elements: lower Stability/Number of roots.");
    }
  } // namespace

  std::vector<StabilityRoot> sparse_roots(const FiniteElementPair &bodies, const ContactPair &pair,
                                          const CreepScheme &scheme, const RollingEquilibrium &equilibrium,
                                          const LinearisationOptions &options, const unsigned int n_roots)
  {
    if (std::any_of(pair.damping_ratio.begin(), pair.damping_ratio.end(),
                    [](const double z) { return z > 0; }))
      throw InputError(
          "Stability/Model is finite elements with more than " + std::to_string(most_dense_dofs) +
          " dofs, which takes no damping of the modes: set loss factors and damping ratios to 0, or "
          "Model to attachment inertia.");
    MPI_Comm communicator = MPI_COMM_SELF;
    const PlacedContacts &contacts = pair.interface.contacts;
    // the dofs that the contact touches
    std::map<std::pair<unsigned int, unsigned int>, unsigned int> touched;
    for (unsigned int b = 0; b < bodies.size(); ++b)
      if (bodies[b].system)
      {
        communicator = bodies[b].system->communicator;
        for (const auto &row : bodies[b].system->trace.rows)
          for (const auto &[dof, weight] : row)
            touched.emplace(std::make_pair(b, dof), touched.size());
      }
    DenseMatrix trace(3 * pair.n_points(), touched.size());
    for (unsigned int b = 0; b < bodies.size(); ++b)
      if (bodies[b].system)
      {
        const PlacedContacts::Rows own = contacts.rows_of(b);
        for (unsigned int i = 0; i < own.rows.size(); ++i)
          for (const auto &[dof, weight] : bodies[b].system->trace.rows[i])
            trace(own.rows[i], touched.at({b, dof})) += own.sign[i] * weight;
      }
    const ContactCoupling coupling = contact_coupling(trace, contacts, scheme, equilibrium, options);
    const unsigned int n_forces = coupling.gaps.n();

    const Layout layout(bodies, n_forces, communicator);
    SparseMatrix K(layout, 250, communicator), C(layout, 50, communicator), M(layout, 100, communicator);
    K.add(bodies, layout, &SecondOrderSystem::stiffness);
    M.add(bodies, layout, &SecondOrderSystem::mass);
    std::vector<PetscInt> rows(touched.size());
    for (const auto &[dof, k] : touched)
      rows[k] = layout.row(dof.first, dof.second);
    // rows and columns of the constraints as large as those of K
    double scale = 0;
    for (const FiniteElementBody &body : bodies)
      if (body.system)
        scale = std::max(scale, body.system->stiffness.linfty_norm());
    if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
      for (unsigned int i = 0; i < rows.size(); ++i)
      {
        for (unsigned int k = 0; k < n_forces; ++k)
        {
          if (coupling.forces(i, k) != 0)
            K.add(rows[i], layout.forces + k, -scale * coupling.forces(i, k));
          if (coupling.gaps(i, k) != 0)
            K.add(layout.forces + k, rows[i], scale * coupling.gaps(i, k));
        }
        for (unsigned int j = 0; j < rows.size(); ++j)
        {
          if (coupling.stiffness(i, j) != 0)
            K.add(rows[i], rows[j], coupling.stiffness(i, j));
          if (coupling.damping(i, j) != 0)
            C.add(rows[i], rows[j], coupling.damping(i, j));
        }
      }
    for (SparseMatrix *const matrix : {&K, &C, &M})
      matrix->finish();

    const Solver solver(communicator);
    solve(solver.pep, {K.matrix, C.matrix, M.matrix}, n_roots);

    // M phi of this rank, for the modal amplitudes
    std::vector<std::vector<double>> inertia;
    std::vector<PetscInt> first_row;
    for (unsigned int b = 0; b < bodies.size(); ++b)
    {
      if (!bodies[b].system)
        continue;
      const SecondOrderSystem &system = *bodies[b].system;
      dealii::PETScWrappers::MPI::Vector product(system.locally_owned, communicator);
      for (const auto &shape : bodies[b].modes->shapes)
      {
        system.mass.vmult(product, shape);
        inertia.emplace_back();
        for (const auto dof : system.locally_owned)
          inertia.back().push_back(product(dof));
        first_row.push_back(system.locally_owned.n_elements() > 0
                                ? layout.row(b, *system.locally_owned.begin()) - layout.begin
                                : 0);
      }
    }
    PetscInt n_found;
    petsc_check(PEPGetConverged(solver.pep, &n_found), "PEPGetConverged");
    Vec parts[2];
    petsc_check(MatCreateVecs(K.matrix, &parts[0], &parts[1]), "MatCreateVecs");
    std::vector<StabilityRoot> roots;
    for (PetscInt k = 0; k < n_found; ++k)
    {
      double real, imaginary;
      petsc_check(PEPGetEigenpair(solver.pep, k, &real, &imaginary, parts[0], parts[1]), "PEPGetEigenpair");
      const std::complex<double> lambda(real, imaginary);
      if (!is_listed(lambda))
        continue;
      std::vector<double> sums(2 * inertia.size());
      for (unsigned int part = 0; part < 2; ++part)
      {
        const PetscScalar *values;
        petsc_check(VecGetArrayRead(parts[part], &values), "VecGetArrayRead");
        for (unsigned int m = 0; m < inertia.size(); ++m)
          sums[2 * m + part] =
              std::inner_product(inertia[m].begin(), inertia[m].end(), values + first_row[m], 0.);
        petsc_check(VecRestoreArrayRead(parts[part], &values), "VecRestoreArrayRead");
      }
      dealii::Utilities::MPI::sum(sums, communicator, sums);
      std::vector<std::complex<double>> amplitudes;
      for (unsigned int m = 0; m < inertia.size(); ++m)
        amplitudes.emplace_back(sums[2 * m], sums[2 * m + 1]);
      roots.push_back(named_root(lambda, std::move(amplitudes), pair.omega, pair.labels));
    }
    for (Vec &part : parts)
      VecDestroy(&part);
    sort_roots(roots);
    if (roots.size() > n_roots)
      roots.resize(n_roots);
    return roots;
  }
} // namespace vibrocontact
