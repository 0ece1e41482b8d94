/// Makes the finite-element problems of this folder: `make_finite_element_problems blocks` (half a minute) or
/// `make_finite_element_problems wheel_on_rail` (some minutes, 3 GB), written to the working directory.

#include <vibrocontact/contact/contact_solvers.h>
#include <vibrocontact/contact/interface.h>
#include <vibrocontact/contact/problem_file.h>
#include <vibrocontact/fe/assemble_body.h>
#include <vibrocontact/fe/elastic_body.h>
#include <vibrocontact/reduction/flexibility.h>
#include <vibrocontact/scene/block.h>
#include <vibrocontact/scene/rail.h>
#include <vibrocontact/scene/wheel.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <iostream>

using namespace vibrocontact;

namespace
{
  /// 2 mm cells under a contact grid of 1 mm
  void refine(BodyMesh<3> &mesh)
  {
    for (const auto &cell : mesh.triangulation->active_cell_iterators())
      if (cell->is_locally_owned() && std::abs(cell->center()[0]) < 0.015 &&
          std::abs(cell->center()[1]) < 0.012 && std::abs(cell->center()[2]) < 0.0045)
        cell->set_refine_flag();
    mesh.triangulation->execute_coarsening_and_refinement();
  }

  ElasticBody<3> make_body(const bool blocks, const bool second, const ContactGrid &grid)
  {
    ElasticModel<3> model;
    if (blocks)
    {
      BlockParameters block;
      block.length = 0.056;
      block.width = 0.048;
      block.height = 0.032;
      block.divisions_x = 14;
      block.divisions_y = 12;
      block.divisions_z = 8;
      block.contact_face = second ? "top" : "bottom";
      block.held = {second ? "bottom" : "top"};
      BodyMesh<3> mesh = make_block<3>(block, second ? "lower" : "upper", MPI_COMM_WORLD);
      refine(mesh);
      if (second)
      {
        model.material.young_modulus = 70e9;
        model.material.poisson_ratio = 0.15;
      }
      model.held = {mesh.boundary_id(block.held.front())};
      return ElasticBody<3>(std::move(mesh), model, 2);
    }
    if (!second)
    {
      BodyMesh<3> mesh = make_wheel(WheelParameters(), 0., &grid, "wheel", MPI_COMM_WORLD);
      model.held = {mesh.boundary_id("bore")};
      return ElasticBody<3>(std::move(mesh), model, 2);
    }
    RailParameters rail;
    rail.length = 6;
    BodyMesh<3> mesh = make_rail(rail, &grid, "rail", MPI_COMM_WORLD);
    model.material.young_modulus = 205e9;
    model.material.poisson_ratio = 0.3;
    add_supports(model, rail, mesh);
    return ElasticBody<3>(std::move(mesh), model, 2);
  }

  /// Keeps the points in contact and their neighbours and writes the problem.
  void store(const ContactProblem &problem, const ContactGrid &grid, const std::string &description)
  {
    const ContactSolution s = create_contact_solver({})->solved(problem);
    const auto touches = [&](const int i, const int j)
    {
      return i >= 0 && j >= 0 && i < int(grid.n_x) && j < int(grid.n_y) &&
             s.status[grid.index(i, j)] != ContactStatus::open;
    };
    std::vector<unsigned int> points;
    for (int j = 0; j < int(grid.n_y); ++j)
      for (int i = 0; i < int(grid.n_x); ++i)
      {
        bool near = false;
        for (int k = 0; k < 9; ++k)
          near = near || touches(i + k % 3 - 1, j + k / 3 - 1);
        if (near)
          points.push_back(grid.index(i, j));
      }
    ContactFileOptions options;
    options.single_precision = true;
    options.description = description;
    write_contact_problem(problem.title + ".h5", restrict_to_points(problem, points), {}, options);
    std::cout << problem.title << ": " << points.size() << " points, " << s.iterations << " iterations\n";
  }
} // namespace

int main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const std::string which = argc > 1 ? argv[1] : "";
  const bool blocks = which == "blocks";
  if (!blocks && which != "wheel_on_rail")
  {
    std::cerr << "say which: blocks or wheel_on_rail\n";
    return 1;
  }
  ContactParameters contact;
  ContactInterface interface;
  interface.contacts.only() = contact.grid();
  const ContactGrid &grid = interface.contacts.only();
  interface.gap.assign(grid.n_points(), 0.);
  DenseMatrix compliance(3 * grid.n_points());
  for (const bool second : {false, true})
  {
    const ElasticBody<3> body = make_body(blocks, second, grid);
    const auto system = assemble_body(body, &grid);
    for (unsigned int i = 0; i < grid.n_points(); ++i)
      interface.gap[i] +=
          (second ? -1 : 1) * system->trace.surface_height[i] +
          (blocks && second ? std::pow(grid.x(i), 2) / 0.92 + std::pow(grid.y(i), 2) / 0.6 : 0);
    compliance.add(1., Flexibility(*system).contact_compliance());
  }
  const double lowest = *std::min_element(interface.gap.begin(), interface.gap.end());
  for (double &gap : interface.gap)
    gap -= lowest;

  const double force = blocks ? 35e3 : 66e3;
  const std::string description =
      blocks
          ? "Finite-element blocks 56 x 48 x 32 mm, E 206.9 GPa and 70 GPa, far faces held, gap of a wheel "
            "on a crown, 1 mm grid"
          : "Finite-element wheel, bore held, on 6 m of finite-element rail on pads, mid-span, 1 mm grid";
  for (const bool spin : {false, true})
  {
    Creepage creepage;
    creepage.longitudinal = spin ? -0.001 : 0;
    creepage.lateral = spin ? 0.001 : 0.002;
    creepage.spin = spin ? 0.5 : 0;
    contact.friction = spin ? 0.6 : 0.3;
    const CreepScheme &scheme = find_creep_scheme(spin ? "first-order upwind" : "second-order upwind");
    DenseMatrix copy = compliance;
    ContactProblem problem = rolling_problem(rolling_operator(grid, std::move(copy), scheme, creepage.speed),
                                             interface, scheme, creepage, contact);
    problem.title = which + (spin ? "_spin" : "_lateral");
    problem.normal_force = force;
    if (spin)
    {
      problem.approach = create_contact_solver({})->solved(problem).approach;
      problem.normal_force = 0;
    }
    store(problem, grid, description);
  }
}
