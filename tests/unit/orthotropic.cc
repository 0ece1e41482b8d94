// Orthotropic materials: constant strain in every cell against the compliance in the material's axes, axes turned with the body,
// frequencies of a rod, stress under a traction; what is no material.

#include "box_of_cells.h"
#include "constant_strain.h"
#include "scratch_folder.h"

#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/fe/assemble_body.h>
#include <vibrocontact/fe/prestress.h>
#include <vibrocontact/reduction/compute_modes.h>
#include <vibrocontact/scene/mesh_file.h>

#include <deal.II/lac/full_matrix.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace vibrocontact;
using namespace dealii;

namespace
{
  ElasticMaterial ply()
  {
    ElasticMaterial material;
    material.density = 1600;
    OrthotropicElasticity &own = material.orthotropic;
    own.E1 = 140e9;
    own.E2 = 10e9;
    own.E3 = 8e9;
    own.nu12 = 0.3;
    own.nu13 = 0.25;
    own.nu23 = 0.4;
    own.G12 = 5e9;
    own.G13 = 4e9;
    own.G23 = 3e9;
    own.axis_1 = {1, 2, 0.5};
    own.axis_2 = {0.3, 1, -1};
    return material;
  }

  /// Columns are the axes 1, 2, 3 of a material.
  Tensor<2, 3> columns_of_axes(const OrthotropicElasticity &material)
  {
    const Tensor<1, 3> one({material.axis_1[0], material.axis_1[1], material.axis_1[2]}),
        other({material.axis_2[0], material.axis_2[1], material.axis_2[2]});
    const Tensor<1, 3> first = one / one.norm();
    Tensor<1, 3> second = other - (other * first) * first;
    second /= second.norm();
    const Tensor<1, 3> third = cross_product_3d(first, second);
    Tensor<2, 3> result;
    for (unsigned int d = 0; d < 3; ++d)
    {
      result[d][0] = first[d];
      result[d][1] = second[d];
      result[d][2] = third[d];
    }
    return result;
  }

  /// eps : C : eps by the compliance of Voigt's six strains in the material's axes.
  double energy_density(const OrthotropicElasticity &m, const Tensor<2, 3> &strain)
  {
    FullMatrix<double> compliance(6, 6), stiffness(6, 6);
    compliance(0, 0) = 1 / m.E1;
    compliance(1, 1) = 1 / m.E2;
    compliance(2, 2) = 1 / m.E3;
    compliance(0, 1) = compliance(1, 0) = -m.nu12 / m.E1;
    compliance(0, 2) = compliance(2, 0) = -m.nu13 / m.E1;
    compliance(1, 2) = compliance(2, 1) = -m.nu23 / m.E2;
    compliance(3, 3) = 1 / m.G23;
    compliance(4, 4) = 1 / m.G13;
    compliance(5, 5) = 1 / m.G12;
    stiffness.invert(compliance);
    const Tensor<2, 3> axes = columns_of_axes(m), own = transpose(axes) * strain * axes;
    const Vector<double> voigt(
        {own[0][0], own[1][1], own[2][2], 2 * own[1][2], 2 * own[0][2], 2 * own[0][1]});
    return stiffness.matrix_norm_square(voigt);
  }

  Tensor<2, 3> turn_of_box()
  {
    const double a = 0.4, b = 0.7;
    return Tensor<2, 3>({{std::cos(a), -std::sin(a), 0}, {std::sin(a), std::cos(a), 0}, {0, 0, 1}}) *
           Tensor<2, 3>({{1, 0, 0}, {0, std::cos(b), -std::sin(b)}, {0, std::sin(b), std::cos(b)}});
  }

  struct OrthotropicBox
  {
    std::string type = "C3D20";
    bool curved = false;
    unsigned int degree = 2;
    ElasticModel<3> model;
    std::function<Point<3>(const Point<3> &)> place = distorted_in_box;
    std::array<unsigned int, 3> divisions = {{3, 3, 3}};
    std::vector<std::string> held;
    std::string pulled;

    std::unique_ptr<ElasticBody<3>> make(const MPI_Comm communicator) const
    {
      BoxOfCells box;
      box.type = type;
      box.divisions = divisions;
      box.place = place;
      box.curved = curved;
      MeshFileParameters parameters;
      parameters.file = scratch_folder() + "/orthotropic.inp";
      box.write(parameters.file);
      parameters.element_degree = degree;
      parameters.held_groups = held;
      BodyMesh<3> mesh = make_mesh_from_file(parameters, 0, nullptr, "box", communicator);
      ElasticModel<3> own = model;
      add_supports(own, parameters, mesh);
      if (!pulled.empty())
        own.tractions.push_back({mesh.boundary_id(pulled), Tensor<1, 3>({3e6, 0, 0})});
      return std::make_unique<ElasticBody<3>>(std::move(mesh), own, degree);
    }
  };

  std::vector<double> frequencies_of(const OrthotropicBox &box, const unsigned int count,
                                     const MPI_Comm communicator)
  {
    const auto body = box.make(communicator);
    const auto system = assemble_body(*body);
    Flexibility flexibility(*system);
    ModeParameters wanted;
    wanted.count = count;
    const Modes modes = compute_modes(*system, flexibility, wanted);
    return {modes.omega.begin() + modes.n_rigid_modes, modes.omega.end()};
  }
} // namespace

TEST(OrthotropicMpi, constant_strain_is_exact)
{
  struct Case
  {
    std::string type;
    bool curved;
    unsigned int degree;
  };
  double worst = 0, worst_energy = 0;
  for (const Case &one : std::vector<Case>{{"C3D8", false, 1},
                                           {"C3D8", false, 2},
                                           {"C3D8", false, 3},
                                           {"C3D20", false, 2},
                                           {"C3D20", true, 2},
                                           {"C3D20", true, 3},
                                           {"C3D4", false, 1},
                                           {"C3D4", false, 2},
                                           {"C3D10", false, 2},
                                           {"C3D10", true, 2},
                                           {"C3D6", false, 1},
                                           {"C3D6", false, 2},
                                           {"C3D15", false, 2},
                                           {"C3D15", true, 2}})
  {
    const std::string name = one.type + (one.curved ? " curved " : " ") + std::to_string(one.degree);
    OrthotropicBox box;
    box.type = one.type;
    box.curved = one.curved;
    box.degree = one.degree;
    box.model.material = ply();
    const auto body = box.make(MPI_COMM_WORLD);
    const auto system = assemble_body(*body);
    const Tensor<2, 3> gradient({{1, -2, 0.3}, {2, -1.5, 0.7}, {-0.4, 1.1, 0.6}});
    const ConstantStrain strain = constant_strain(*body, *system, gradient);
    EXPECT_LT(strain.residual, 1e-12) << name;
    const double exact =
                     0.3 * 0.2 * 0.1 *
                     energy_density(box.model.material.orthotropic, 0.5 * (gradient + transpose(gradient))),
                 error = std::abs(strain.displacement * strain.force / exact - 1);
    EXPECT_LT(error, 1e-12) << name;
    worst = std::max(worst, strain.residual);
    worst_energy = std::max(worst_energy, error);
  }
  std::cout << "forces on inner nodes over those on the boundary: " << worst << ", energy: " << worst_energy
            << std::endl;
}

TEST(OrthotropicMpi, axes_turn_with_the_body)
{
  OrthotropicBox box;
  box.divisions = {{4, 3, 2}};
  box.model.material = ply();
  const std::vector<double> straight = frequencies_of(box, 6, MPI_COMM_WORLD);
  const Tensor<2, 3> turn = turn_of_box();
  box.place = [&](const Point<3> &p) { return Point<3>(turn * Tensor<1, 3>(distorted_in_box(p))); };
  const std::vector<double> axes_left = frequencies_of(box, 6, MPI_COMM_WORLD);
  EXPECT_GT(std::abs(axes_left[0] / straight[0] - 1), 0.01);
  for (auto *const axis : {&box.model.material.orthotropic.axis_1, &box.model.material.orthotropic.axis_2})
  {
    const Tensor<1, 3> turned = turn * Tensor<1, 3>({(*axis)[0], (*axis)[1], (*axis)[2]});
    *axis = {turned[0], turned[1], turned[2]};
  }
  const std::vector<double> both = frequencies_of(box, 6, MPI_COMM_WORLD);
  ASSERT_GE(both.size(), 6u);
  double worst = 0;
  for (unsigned int k = 0; k < 6; ++k)
  {
    EXPECT_NEAR(both[k] / straight[k], 1, 1e-9);
    worst = std::max(worst, std::abs(both[k] / straight[k] - 1));
  }
  const std::vector<double> alone = frequencies_of(box, 6, MPI_COMM_SELF);
  for (unsigned int k = 0; k < 6; ++k)
    EXPECT_NEAR(both[k] / alone[k], 1, 1e-10);
  std::cout << "frequencies of the body turned with its axes: " << worst << std::endl;
}

TEST(Orthotropic, equal_constants_are_an_isotropic_material)
{
  ElasticMaterial isotropic, same;
  const double E = isotropic.young_modulus, nu = isotropic.poisson_ratio, G = isotropic.mu();
  OrthotropicElasticity &own = same.orthotropic;
  own.E1 = own.E2 = own.E3 = E;
  own.nu12 = own.nu13 = own.nu23 = nu;
  own.G12 = own.G13 = own.G23 = G;
  own.axis_1 = {1, 1, 0.2};
  EXPECT_LT((same.stiffness() - isotropic.stiffness()).norm() / isotropic.stiffness().norm(), 1e-14);
}

// u = sin(pi x / 2 L), f = sqrt(E / rho) / (4 L) of a rod whose sides slide: without contraction it stretches along x alone.
TEST(OrthotropicMpi, axial_frequency_of_a_rod)
{
  for (const unsigned int along : {1, 2, 3})
  {
    OrthotropicBox rod;
    rod.divisions = {{16, 1, 1}};
    rod.place = [](const Point<3> &p) { return Point<3>(p[0], 0.02 * p[1], 0.02 * p[2]); };
    rod.held = {"left", "front: y", "back: y", "bottom: z", "top: z"};
    rod.model.material = ply();
    OrthotropicElasticity &own = rod.model.material.orthotropic;
    own.nu12 = own.nu13 = own.nu23 = 0;
    own.axis_1 = along == 1 ? std::vector<double>{1, 0, 0} : std::vector<double>{0, along == 2 ? 1. : 0., 1};
    own.axis_2 = along == 2   ? std::vector<double>{1, 0, 0}
                 : along == 1 ? std::vector<double>{0, 1, 1}
                              : std::vector<double>{0, 1, 0};
    const double E = along == 1   ? own.E1
                     : along == 2 ? own.E2
                                  : own.E3,
                 exact = numbers::PI / 2 * std::sqrt(E / rod.model.material.density);
    const double found = frequencies_of(rod, 1, MPI_COMM_WORLD)[0];
    std::printf("rod along axis %u: %.3g off\n", along, found / exact - 1);
    EXPECT_NEAR(found / exact, 1, 1e-6);
  }
}

// A free bar contracts: its first frequency is the closed form less Rayleigh's inertia of the sides.
TEST(Orthotropic, contraction_goes_by_the_ratios_of_the_rods_axis)
{
  OrthotropicBox rod;
  rod.divisions = {{8, 1, 1}};
  rod.place = [](const Point<3> &p) { return Point<3>(p[0], 0.06 * p[1], 0.1 * p[2]); };
  rod.held = {"left: x", "front: y", "bottom: z"};
  rod.model.material = ply();
  OrthotropicElasticity &own = rod.model.material.orthotropic;
  own.axis_1 = {0, 0, 1};
  own.axis_2 = {1, 0, 0};
  // along x axis 2; sides: y is axis 3 (across z and x), z axis 1. The sides with y = 0 and z = 0 are planes of symmetry.
  const double b = 0.06, h = 0.1, nu_y = own.nu23, nu_z = own.nu12 * own.E2 / own.E1,
               inertia = (nu_y * nu_y * b * b + nu_z * nu_z * h * h) / 3, wave = numbers::PI / 2,
               exact = wave * std::sqrt(own.E2 / rod.model.material.density) /
                       std::sqrt(1 + wave * wave * inertia);
  const double found = frequencies_of(rod, 1, MPI_COMM_SELF)[0];
  std::printf("free rod: %.3g off Rayleigh-Love, which is %.3g off the thin rod\n", found / exact - 1,
              1 - 1 / std::sqrt(1 + wave * wave * inertia));
  EXPECT_NEAR(found / exact, 1, 5e-5);
}

TEST(Orthotropic, stress_under_a_traction_is_the_traction)
{
  OrthotropicBox box;
  box.held = {"left: x", "front: y", "bottom: z"};
  box.pulled = "right";
  box.model.material = ply();
  box.model.material.orthotropic.axis_1 = {0, 0, 1};
  box.model.material.orthotropic.axis_2 = {1, 0, 0};
  const auto body = box.make(MPI_COMM_SELF);
  const auto system = assemble_body(*body);
  PETScWrappers::MPI::Vector u(system->load);
  Flexibility(*system).vmult(u, system->load);
  EXPECT_NEAR(add_prestress(*body, u, *system).largest_stress / 3e6, 1, 1e-9);
  EXPECT_NEAR(u.linfty_norm() / (3e6 / box.model.material.orthotropic.E2 * 0.3), 1, 1e-9);
}

TEST(Orthotropic, what_is_no_material_is_refused)
{
  const auto message = [](const ElasticMaterial &material)
  {
    try
    {
      material.check("plate/Material");
    }
    catch (const InputError &error)
    {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(message(ply()), "");
  ElasticMaterial wrong = ply();
  wrong.orthotropic.G13 = 0;
  EXPECT_NE(message(wrong).find("plate/Material/Orthotropic/G13 is 0"), std::string::npos) << message(wrong);
  wrong = ply();
  wrong.orthotropic.nu12 = 4;
  EXPECT_NE(message(wrong).find("its square has to be below E1 / E2"), std::string::npos) << message(wrong);
  wrong = ply();
  wrong.orthotropic.nu23 = 0.9;
  wrong.orthotropic.nu12 = 2.5;
  wrong.orthotropic.nu13 = 2.5;
  EXPECT_NE(message(wrong).find("not positive definite"), std::string::npos) << message(wrong);
  wrong = ply();
  wrong.orthotropic.axis_2 = {-2, -4, -1};
  EXPECT_NE(message(wrong).find("Axis 2 is along Axis 1"), std::string::npos) << message(wrong);
  wrong = ply();
  wrong.orthotropic.E1 = 140;
  EXPECT_NE(message(wrong).find("no solid has both"), std::string::npos) << message(wrong);
}
