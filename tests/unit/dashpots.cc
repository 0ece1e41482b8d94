// Dashpots on groups of a mesh beside its springs: their matrix, the decay of a rigid motion, its frequency response.

#include "box_of_cells.h"
#include "scratch_folder.h"

#include <vibrocontact/fe/assemble_body.h>
#include <vibrocontact/fe/nearest_dof.h>
#include <vibrocontact/reduction/compute_modes.h>
#include <vibrocontact/reduction/response_reduction.h>
#include <vibrocontact/scene/mesh_file.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace vibrocontact;
using namespace dealii;

namespace
{
  /// A block of 0.3 x 0.2 x 0.1 m on springs far softer than itself.
  struct DampedBlock
  {
    explicit DampedBlock(const std::string &type, const MPI_Comm communicator)
    {
      BoxOfCells box;
      box.type = type;
      box.divisions = {{3, 2, 1}};
      box.place = [](const Point<3> &p) { return Point<3>(0.3 * p[0], 0.2 * p[1], 0.1 * p[2]); };
      parameters.file = scratch_folder() + "/damped_block.inp";
      box.write(parameters.file);
      parameters.foundation_groups = {"bottom", "top"};
      // no tilting motion has the frequency of the one along z, with which it would mix
      parameters.foundation_stiffness = {1.7e6, 2.3e6, 3e6};
      parameters.foundation_damping = {1e3, 3e3, 5e3};
      ElasticModel<3> model;
      BodyMesh<3> mesh = make_mesh_from_file(parameters, 0, nullptr, "block", communicator);
      add_supports(model, parameters, mesh);
      body = std::make_unique<ElasticBody<3>>(std::move(mesh), model, 2);
      system = assemble_body(*body);
    }

    const double area = 2 * 0.3 * 0.2;
    MeshFileParameters parameters;
    std::unique_ptr<ElasticBody<3>> body;
    std::unique_ptr<SecondOrderSystem> system;
  };
} // namespace

TEST(DashpotsMpi, rigid_motion_of_a_block)
{
  for (const std::string type : {"C3D8", "C3D10", "C3D15"})
  {
    DampedBlock block(type, MPI_COMM_WORLD);
    SecondOrderSystem &system = *block.system;
    ASSERT_TRUE(system.has_damping);
    const double m = system.total_mass;
    const auto motions = rigid_motions(*block.body);
    for (unsigned int d = 0; d < 3; ++d)
    {
      PETScWrappers::MPI::Vector force(motions[d]);
      const double one = motions[d].linfty_norm();
      system.damping.vmult(force, motions[d]);
      EXPECT_NEAR(motions[d] * force / (one * one * block.parameters.foundation_damping[d] * block.area), 1,
                  1e-12);
    }

    Flexibility flexibility(system);
    ModeParameters wanted;
    wanted.count = 6;
    const Modes modes = compute_modes(system, flexibility, wanted);
    const std::vector<double> ratio = damping_ratios(system, modes);
    // of the springs' own motions the one along z neither tilts nor slides: decay c / (2 m)
    const double k = block.parameters.foundation_stiffness[2] * block.area,
                 c = block.parameters.foundation_damping[2] * block.area, omega = std::sqrt(k / m);
    double nearest = 1e300, decay = 0;
    for (unsigned int i = 0; i < modes.omega.size(); ++i)
      if (std::abs(modes.omega[i] - omega) < nearest)
      {
        nearest = std::abs(modes.omega[i] - omega);
        decay = ratio[i] * modes.omega[i];
      }
    std::printf("%s: frequency %.2g off, decay rate %.2g off c / (2 m)\n", type.c_str(), nearest / omega,
                decay / (c / (2 * m)) - 1);
    EXPECT_LT(nearest / omega, 1e-4);
    EXPECT_NEAR(decay / (c / (2 * m)), 1, 1e-4);
  }
}

TEST(DashpotsMpi, frequency_response_of_a_block)
{
  DampedBlock block("C3D10", MPI_COMM_WORLD);
  SecondOrderSystem &system = *block.system;
  const double m = system.total_mass, k = block.parameters.foundation_stiffness[2] * block.area,
               c = block.parameters.foundation_damping[2] * block.area;
  // in its middle, so that it does not tilt
  const TraceRow middle = nearest_dof(system, Point<3>(0.15, 0.1, 0), 2, "block");
  const double f0 = std::sqrt(k / m) / (2 * numbers::PI);
  const std::vector<double> frequencies = {0.5 * f0, f0, 1.5 * f0};
  const DirectResponse response = solve_directly(system, {middle}, frequencies, [] {});
  for (unsigned int i = 0; i < frequencies.size(); ++i)
  {
    const double w = 2 * numbers::PI * frequencies[i];
    const std::complex<double> exact = 1. / std::complex<double>(k - m * w * w, w * c),
                               found(response.real(i, 0), response.imaginary(i, 0));
    std::printf("%g of the resonance: %.2g off\n", frequencies[i] / f0, std::abs(found / exact - 1.));
    EXPECT_LT(std::abs(found / exact - 1.), 2e-3);
  }
}
