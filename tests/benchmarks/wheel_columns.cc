/// Ten columns of the wheel's contact compliance P_c K^-1 P_c^T (231,738 dofs, 1,071 rows, by Schur
/// complement) against independent solves: PETSc's own MUMPS Cholesky factorisation of K, without Schur
/// complement, with MUMPS' own ordering. Some minutes, 6 GB; any number of ranks.

#include <vibrocontact/contact/interface.h>
#include <vibrocontact/fe/assemble_body.h>
#include <vibrocontact/fe/elastic_body.h>
#include <vibrocontact/reduction/flexibility.h>
#include <vibrocontact/scene/wheel.h>

#include <deal.II/base/mpi.h>

#include <petscksp.h>

#include <cmath>
#include <iostream>

using namespace vibrocontact;

int main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const ContactGrid grid = ContactParameters().grid();
  BodyMesh<3> mesh = make_wheel(WheelParameters(), 0., &grid, "wheel", MPI_COMM_WORLD);
  ElasticModel<3> model;
  model.held = {mesh.boundary_id("bore")};
  const ElasticBody<3> body(std::move(mesh), model, 2);
  const auto system = assemble_body(body, &grid);
  DenseMatrix compliance;
  {
    Flexibility flexibility(*system);
    compliance = flexibility.contact_compliance();
  }

  KSP ksp;
  PC pc;
  KSPCreate(MPI_COMM_WORLD, &ksp);
  KSPSetOperators(ksp, system->stiffness, system->stiffness);
  KSPSetType(ksp, KSPPREONLY);
  KSPGetPC(ksp, &pc);
  MatSetOption(system->stiffness, MAT_SPD, PETSC_TRUE);
  PCSetType(pc, PCCHOLESKY);
  PCFactorSetMatSolverType(pc, MATSOLVERMUMPS);
  KSPSetUp(ksp);

  const unsigned int n_rows = compliance.m(), n_columns = 10;
  double largest = 0;
  for (unsigned int i = 0; i < n_rows; ++i)
    largest = std::max(largest, compliance(i, i));
  double worst = 0;
  for (unsigned int k = 0; k < n_columns; ++k)
  {
    const unsigned int column = (k * n_rows) / n_columns + 5 * k;
    dealii::PETScWrappers::MPI::Vector force(system->locally_owned, MPI_COMM_WORLD), u(force);
    for (const auto &[dof, weight] : system->trace.rows[column])
      if (system->locally_owned.is_element(dof))
        force(dof) = weight;
    force.compress(dealii::VectorOperation::insert);
    KSPSolve(ksp, force, u);
    const std::vector<double> response = contact_trace(system->trace, u);
    double difference = 0;
    for (unsigned int i = 0; i < n_rows; ++i)
      difference = std::max(difference, std::abs(response[i] - compliance(i, column)));
    worst = std::max(worst, difference / largest);
    if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cout << "column " << column << ": largest difference " << difference / largest
                << " of the largest diagonal entry" << std::endl;
  }
  KSPDestroy(&ksp);
  return worst < 1e-8 ? 0 : 1;
}
