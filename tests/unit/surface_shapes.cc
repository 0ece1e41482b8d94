// Modes on the surface of a body: rigid mobilities in closed form, the cache, ranks.

#include "reduction_bodies.h"

#include <vibrocontact/base/log.h>
#include <vibrocontact/output/surface_fields.h>
#include <vibrocontact/reduction/body_reduction.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

using namespace vibrocontact;

namespace
{
  /// A free block of 40 x 30 x 20 mm, its modes kept in `folder`.
  BodyReduction free_block(const std::string &folder, reduction_test::Body &kept)
  {
    ReductionRequest request;
    request.body = "block";
    request.key = "surface shapes test";
    request.modes.count = 4;
    request.cache_directory = folder;
    const auto assemble = [&kept]
    {
      BlockParameters parameters;
      parameters.length = 0.04;
      parameters.width = 0.03;
      parameters.height = 0.02;
      parameters.divisions_x = 4;
      parameters.divisions_y = 3;
      parameters.divisions_z = 2;
      parameters.held.clear();
      kept = reduction_test::make_body(parameters, ElasticModel<3>(), MPI_COMM_WORLD, 1);
      return std::move(kept.system);
    };
    return BodyReduction(request, {assemble}, MPI_COMM_WORLD);
  }
} // namespace

TEST(SurfaceShapesMpi, RigidMobilityAndCache)
{
  run_log().set_screen(false);
  const std::string folder = "surface_shapes_cache";
  if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    std::filesystem::remove_all(folder);
  MPI_Barrier(MPI_COMM_WORLD);
  reduction_test::Body kept;
  BodyReduction reduction = free_block(folder, kept);
  const SurfaceShapes &shapes = reduction.surface_shapes();
  ASSERT_EQ(shapes.n_points(), 5u * 4 * 3 - 3 * 2 * 1);
  ASSERT_EQ(shapes.quads.size(), 4 * 2 * (4 * 3 + 4 * 2 + 3 * 2u));
  EXPECT_EQ(shapes.n_modes(), reduction.modal().omega.size());

  // outer area of the quads
  double area = 0;
  for (unsigned int k = 0; k < shapes.quads.size(); k += 4)
  {
    const auto p = [&](const unsigned int c) { return shapes.point(shapes.quads[k + c]); };
    area += dealii::cross_product_3d(p(2) - p(0), p(3) - p(1)).norm() / 2;
  }
  EXPECT_NEAR(area, 2 * (0.04 * 0.03 + 0.04 * 0.02 + 0.03 * 0.02), 1e-12);

  // sum over the rigid modes of phi_d^2 = 1/m + (r x e_d)^T I^-1 (r x e_d), r from the centre of mass
  const double m = 7800 * 0.04 * 0.03 * 0.02;
  const double inertia[] = {m / 12 * (9e-4 + 4e-4), m / 12 * (16e-4 + 4e-4), m / 12 * (16e-4 + 9e-4)};
  dealii::Point<3> centre;
  for (unsigned int i = 0; i < shapes.n_points(); ++i)
    centre += shapes.point(i) / shapes.n_points();
  ASSERT_EQ(reduction.modal().n_rigid_modes, 6u);
  for (unsigned int i = 0; i < shapes.n_points(); ++i)
    for (unsigned int d = 0; d < 3; ++d)
    {
      dealii::Tensor<1, 3> e;
      e[d] = 1;
      const auto arm = dealii::cross_product_3d(shapes.point(i) - centre, e);
      double exact = 1 / m, found = 0;
      for (unsigned int c = 0; c < 3; ++c)
        exact += arm[c] * arm[c] / inertia[c];
      for (unsigned int k = 0; k < 6; ++k)
        found += std::pow(shapes.value(i, d, k), 2);
      EXPECT_NEAR(found, exact, 1e-5 * exact);
    }

  // one mode alone, and what a later run finds
  std::vector<double> amplitudes(shapes.n_modes(), 0.);
  amplitudes[7] = 2;
  const auto displacement = surface_displacement(shapes, amplitudes);
  EXPECT_EQ(displacement[3 * 5 + 1], 2 * shapes.value(5, 1, 7));
  BodyReduction later = free_block(folder, kept);
  EXPECT_EQ(later.surface_shapes().shapes, shapes.shapes);
  EXPECT_EQ(later.surface_shapes().quads, shapes.quads);
  EXPECT_TRUE(later.stages().empty());

  // modes of an earlier version, without shapes: computed again
  MPI_Barrier(MPI_COMM_WORLD);
  if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    for (const auto &file : std::filesystem::directory_iterator(folder))
      if (file.path().filename().string().find("shapes") != std::string::npos)
        std::filesystem::remove(file);
  MPI_Barrier(MPI_COMM_WORLD);
  BodyReduction anew = free_block(folder, kept);
  EXPECT_TRUE(anew.is_cached(false, true));
  for (unsigned int k = 0; k < shapes.shapes.size(); ++k)
    EXPECT_NEAR(anew.surface_shapes().shapes[k], shapes.shapes[k], 1e-3);
}

TEST(SurfaceShapes, WrittenAsVtu)
{
  write_surface({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, {0, 1, 2, 3},
                {{"real_m", std::vector<double>(12, 0.5)}, {"imaginary_m", std::vector<double>(12, 0.25)}},
                "surface.vtu");
  std::ifstream file("surface.vtu");
  const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  EXPECT_NE(text.find("NumberOfPoints=\"4\" NumberOfCells=\"1\""), std::string::npos);
  // one offset and one type: some letters of coded zip
  for (const std::string name : {"offsets", "types"})
  {
    const std::size_t begin = text.find('\n', text.find("Name=\"" + name + "\"")) + 1;
    EXPECT_GT(text.find('\n', begin) - begin, 10u);
  }
  EXPECT_NE(text.find("Name=\"imaginary_m\" NumberOfComponents=\"3\""), std::string::npos);
}
