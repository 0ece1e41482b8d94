// Rigid masses coupled to groups of a mesh, rigidly or by their mean motion: energy of rigid motions, weight, a body on springs, a
// beam with a mass on its tip, finite rotations under the forces of a rotation; what is refused.

#include "box_of_cells.h"
#include "scratch_folder.h"

#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/fe/assemble_body.h>
#include <vibrocontact/fe/attached_points.h>
#include <vibrocontact/reduction/compute_modes.h>
#include <vibrocontact/scene/mesh_file.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace vibrocontact;
using namespace dealii;

namespace
{
  struct MassOnBox
  {
    std::string type = "C3D20";
    std::array<unsigned int, 3> divisions = {{3, 2, 2}};
    Point<3> size{0.3, 0.2, 0.1};
    unsigned int degree = 2;
    MeshFileParameters parameters;
    ElasticModel<3> model;

    MassOnBox()
    {
      PointMassParameters mass;
      mass.name = "motor";
      mass.groups = {"right", "top"};
      mass.mass = 20;
      mass.place = {0.5, 0.15, 0.3};
      mass.inertia = {0.4, 0.5, 0.6};
      mass.products = {0.05, -0.03, 0.02};
      parameters.masses = {mass};
    }

    std::unique_ptr<ElasticBody<3>> make(const MPI_Comm communicator) const
    {
      BoxOfCells box;
      box.type = type;
      box.divisions = divisions;
      box.place = [this](const Point<3> &p)
      { return Point<3>(size[0] * p[0], size[1] * p[1], size[2] * p[2]); };
      MeshFileParameters own = parameters;
      own.file = scratch_folder() + "/mass_on_box.inp";
      own.element_degree = degree;
      box.write(own.file);
      BodyMesh<3> mesh = make_mesh_from_file(own, 0, nullptr, "box", communicator);
      ElasticModel<3> all = model;
      add_supports(all, own, mesh);
      auto body = std::make_unique<ElasticBody<3>>(std::move(mesh), all, degree);
      attach_masses(*body);
      return body;
    }
  };

  /// Unconstrained dofs of t + theta x x.
  PETScWrappers::MPI::Vector rigid(const ElasticBody<3> &body, const SecondOrderSystem &system,
                                   const Tensor<1, 3> &t, const Tensor<1, 3> &theta)
  {
    PETScWrappers::MPI::Vector u(body.locally_owned, body.communicator());
    for (unsigned int i = 0; i < system.dof_position.size(); ++i)
    {
      const auto dof = body.locally_owned.nth_index_in_set(i);
      if (!body.constraints.is_constrained(dof))
        u(dof) = (t + cross_product_3d(theta, system.dof_position[i]))[system.dof_direction[i]];
    }
    u.compress(VectorOperation::insert);
    return u;
  }

  std::vector<double> lowest(const ElasticBody<3> &body, const unsigned int count)
  {
    const auto system = assemble_body(body);
    Flexibility flexibility(*system);
    ModeParameters wanted;
    wanted.count = count;
    return compute_modes(*system, flexibility, wanted).omega;
  }
} // namespace

TEST(PointMassesMpi, rigid_motions_have_the_energy_of_both)
{
  for (const std::string type : {"C3D8", "C3D20", "C3D4", "C3D10", "C3D6", "C3D15"})
    for (const bool is_rigid : {false, true})
    {
      MassOnBox box;
      box.type = type;
      box.parameters.masses[0].rigid = is_rigid;
      box.model.gravity = Tensor<1, 3>({1, -2, -9.81});
      const auto body = box.make(MPI_COMM_WORLD);
      const auto system = assemble_body(*body);
      EXPECT_EQ(system->n_rigid_modes, 6u);
      const double rho = box.model.material.density, volume = 0.3 * 0.2 * 0.1;
      EXPECT_NEAR(system->total_mass / (rho * volume + 20), 1, 1e-12);
      double worst = 0;
      for (const auto &[t, theta] : std::vector<std::pair<Tensor<1, 3>, Tensor<1, 3>>>{
               {Tensor<1, 3>({1, 0, 0}), Tensor<1, 3>()},
               {Tensor<1, 3>({0.3, -1, 0.5}), Tensor<1, 3>()},
               {Tensor<1, 3>(), Tensor<1, 3>({1, 0, 0})},
               {Tensor<1, 3>({0.2, 0.1, -0.3}), Tensor<1, 3>({2, -1, 1.5})}})
      {
        const auto u = rigid(*body, *system, t, theta);
        PETScWrappers::MPI::Vector inertia(u);
        system->mass.vmult(inertia, u);
        // both about their centres of mass
        const Point<3> centre(0.15, 0.1, 0.05), place(0.5, 0.15, 0.3);
        const Tensor<1, 3> v = t + cross_product_3d(theta, centre), w = t + cross_product_3d(theta, place);
        double exact = rho * volume * v.norm_square() + 20 * w.norm_square() +
                       theta * (box.parameters.masses[0].inertia_tensor() * theta);
        const double sizes[] = {0.3, 0.2, 0.1};
        for (unsigned int d = 0; d < 3; ++d)
          exact += theta[d] * theta[d] * rho * volume / 12 *
                   (std::pow(sizes[(d + 1) % 3], 2) + std::pow(sizes[(d + 2) % 3], 2));
        EXPECT_NEAR(u * inertia / exact, 1, 1e-11) << type << is_rigid;
        worst = std::max(worst, std::abs(u * inertia / exact - 1));
        const double power = box.model.gravity * (rho * volume * v + 20 * w);
        EXPECT_NEAR((u * system->load) / power, 1, 1e-10) << type << is_rigid;
        PETScWrappers::MPI::Vector force(u);
        system->stiffness.vmult(force, u);
        EXPECT_LT(force.linfty_norm(), 1e-12 * system->stiffness.linfty_norm() * u.linfty_norm());
      }
      std::cout << type << (is_rigid ? " rigid: " : " mean: ") << worst << std::endl;
    }
}

TEST(PointMassesMpi, body_on_springs)
{
  for (const bool is_rigid : {false, true})
  {
    MassOnBox box;
    PointMassParameters &mass = box.parameters.masses[0];
    mass.groups = {"top"};
    mass.rigid = is_rigid;
    mass.place = {0.15, 0.1, 0.05};
    box.parameters.foundation_groups = {"bottom"};
    // the least along z
    box.parameters.foundation_stiffness = {1e6, 1e6, 1e5};
    const auto body = box.make(MPI_COMM_WORLD);
    const double m = assemble_body(*body)->total_mass, exact = std::sqrt(1e5 * 0.3 * 0.2 / m);
    double nearest = 1e300;
    for (const double omega : lowest(*body, 6))
      nearest = std::min(nearest, std::abs(omega / exact - 1));
    std::printf("sqrt(k / (m + M)), %s: %.2g off\n", is_rigid ? "rigid" : "mean", nearest);
    EXPECT_LT(nearest, 1e-6);
  }
}

TEST(PointMassesMpi, ranks_and_cells_agree)
{
  for (const bool is_rigid : {false, true})
  {
    MassOnBox box;
    box.parameters.masses[0].rigid = is_rigid;
    PointMassParameters second = box.parameters.masses[0];
    second.name = "sensor";
    second.groups = {"front"};
    second.rigid = false;
    second.mass = 1;
    second.place.clear();
    box.parameters.masses.push_back(second);
    box.parameters.held_groups = {"left"};
    if (is_rigid)
      box.parameters.masses[0].groups = {"right"};
    else
      box.parameters.masses[0].groups = {"right", "top"};
    for (const std::string type : {"C3D20", "C3D10"})
    {
      box.type = type;
      const auto together = lowest(*box.make(MPI_COMM_WORLD), 4), alone = lowest(*box.make(MPI_COMM_SELF), 4);
      ASSERT_EQ(together.size(), alone.size());
      for (unsigned int k = 0; k < alone.size(); ++k)
        EXPECT_NEAR(together[k] / alone[k], 1, 1e-10) << type << is_rigid;
    }
  }
}

// 1 + cos b cosh b = mu b (sin b cosh b - cos b sinh b), mu the tip's mass over that of the beam (Karnovsky & Lebed, 6.4).
TEST(PointMassesMpi, mass_on_the_tip_of_a_beam)
{
  for (const double mu : {0.5, 2.})
  {
    const auto residual = [&](const double b)
    {
      return 1 + std::cos(b) * std::cosh(b) -
             mu * b * (std::sin(b) * std::cosh(b) - std::cos(b) * std::sinh(b));
    };
    double low = 0.1, high = 1.875;
    for (unsigned int k = 0; k < 100; ++k)
      (residual((low + high) / 2) > 0 ? low : high) = (low + high) / 2;
    for (const bool is_rigid : {false, true})
    {
      MassOnBox beam;
      beam.divisions = {{16, 1, 1}};
      beam.size = {1, 0.02, 0.01};
      beam.degree = 3;
      beam.model.material.poisson_ratio = 0;
      beam.parameters.held_groups = {"left"};
      PointMassParameters &mass = beam.parameters.masses[0];
      const ElasticMaterial &steel = beam.model.material;
      mass.groups = {"right"};
      mass.rigid = is_rigid;
      mass.mass = mu * steel.density * 0.02 * 0.01;
      mass.place.clear();
      mass.inertia = mass.products = {0, 0, 0};
      const double exact = low * low * 0.01 / std::sqrt(12.) * std::sqrt(steel.young_modulus / steel.density),
                   found = lowest(*beam.make(MPI_COMM_WORLD), 1)[0];
      std::printf("tip of %g beams, %s: %.2g off\n", mu, is_rigid ? "rigid" : "mean", found / exact - 1);
      EXPECT_NEAR(found / exact, 1, 5e-4);
    }
  }
}

// The potential of all points of a mass, gravity and centrifugal, under a finite rotation and translation of its group: load and
// stiffening are its first and second derivatives, the rest is of third order.
TEST(PointMasses, forces_turn_with_a_finite_rotation)
{
  MassOnBox box;
  box.parameters.masses[0].groups = {"right", "top"};
  box.model.gravity = Tensor<1, 3>({1, -2, -9.81});
  box.model.rotation.speed = 7;
  box.model.rotation.axis = Tensor<1, 3>({2, 1, -2}) / 3.;
  box.model.rotation.point = Point<3>(0.1, -0.3, 0.2);
  const auto body = box.make(MPI_COMM_SELF);
  const auto system = assemble_body(*body);
  const AttachedPoint point = attached_points(*body).at(0);
  const SymmetricTensor<2, 3> I = box.parameters.masses[0].inertia_tensor();
  const Tensor<2, 3> second = trace(I) / 2 * Tensor<2, 3>(unit_symmetric_tensor<3>()) - Tensor<2, 3>(I);
  const Tensor<1, 3> e = box.model.rotation.axis, g = box.model.gravity;
  const Point<3> place(0.5, 0.15, 0.3);
  std::vector<double> left;
  for (const double size : {2e-2, 1e-2})
  {
    const Tensor<1, 3> t = size * Tensor<1, 3>({0.03, -0.02, 0.05}),
                       theta = size * Tensor<1, 3>({0.8, -0.5, 0.6});
    const double angle = theta.norm();
    Tensor<2, 3> R;
    for (unsigned int j = 0; j < 3; ++j)
    {
      Tensor<1, 3> unit;
      unit[j] = 1;
      const Tensor<1, 3> n = theta / angle, turned = std::cos(angle) * unit +
                                                     std::sin(angle) * cross_product_3d(n, unit) +
                                                     (1 - std::cos(angle)) * (n * unit) * n;
      for (unsigned int i = 0; i < 3; ++i)
        R[i][j] = turned[i];
    }
    // of the group about its centroid
    const Point<3> c = point.centroid;
    Vector<double> u(point.dofs.size()), q(6), Sq(6);
    for (unsigned int k = 0; k < point.dofs.size(); ++k)
    {
      const auto i = body->locally_owned.index_within_set(point.dofs[k]);
      const Tensor<1, 3> r = system->dof_position[i] - c;
      u(k) = (t + R * r - r)[system->dof_direction[i]];
    }
    point.motion.vmult(q, u);
    point.stiffening.vmult(Sq, q);
    double by_matrices = 0.5 * (q * Sq);
    for (unsigned int p = 0; p < 6; ++p)
      by_matrices -= point.load[p] * q(p);
    const auto potential = [&](const Tensor<1, 3> &x, const Tensor<2, 3> &moments)
    {
      const Tensor<1, 3> way = x - box.model.rotation.point;
      return -20 * (g * x) -
             49. / 2 * (20 * (way * way - std::pow(way * e, 2)) + trace(moments) - e * (moments * e));
    };
    const Tensor<1, 3> a = place - c;
    const double exact = potential(Tensor<1, 3>(c) + t + R * a, R * second * transpose(R)) -
                         potential(Tensor<1, 3>(place), second);
    left.push_back(std::abs(by_matrices - exact));
    std::printf("size %g: %g of %g\n", size, left.back(), exact);
    EXPECT_LT(left.back(), 20 * size * std::abs(0.5 * (q * Sq)));
  }
  EXPECT_NEAR(left[0] / left[1], 8, 0.8);
}

TEST(PointMasses, what_cannot_be_coupled_is_refused)
{
  const auto message = [](const MassOnBox &box)
  {
    try
    {
      box.parameters.masses[0].check("box/Mesh/Mass/motor");
      box.make(MPI_COMM_SELF);
    }
    catch (const InputError &error)
    {
      return std::string(error.what());
    }
    return std::string();
  };
  MassOnBox box;
  EXPECT_EQ(message(box), "");
  box.parameters.masses[0].rigid = true;
  box.parameters.held_groups = {"left"};
  // the edge of the top belongs to the held face
  EXPECT_NE(message(box).find("nodes of what is to be rigid are held"), std::string::npos) << message(box);
  box.parameters.masses[0].inertia = {3, 1, 1};
  EXPECT_NE(message(box).find("belongs to no body"), std::string::npos) << message(box);
  MassOnBox fine;
  fine.divisions = {{24, 24, 2}};
  fine.type = "C3D8";
  EXPECT_NE(message(fine).find("degrees of freedom, which would couple all with all"), std::string::npos)
      << message(fine);
}
