// A rail on periodic supports: its section's smooth shapes against all of its dofs, a short rail against hexahedra, sleepers,
// and what is known of the shipped rail on the supports of the squeal paper.

#include "span_about.h"

#include <vibrocontact/fe/assemble_body.h>
#include <vibrocontact/fe/trace_assembly.h>
#include <vibrocontact/reduction/harmonic_solver.h>
#include <vibrocontact/scene/rail_supports.h>
#include <vibrocontact/scene/section_parameters.h>
#include <vibrocontact/waveguide/periodic_track.h>
#include <vibrocontact/waveguide/plane_section.h>
#include <vibrocontact/waveguide/section_basis.h>
#include <vibrocontact/waveguide/track_loads.h>

#include <deal.II/base/numbers.h>
#include <deal.II/grid/grid_generator.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>

using namespace vibrocontact;
using dealii::numbers::PI;
using Complex = std::complex<double>;

namespace
{
  struct Rail
  {
    explicit Rail(const unsigned int degree, const double tolerance = SmoothShapesSettings().tolerance)
        : outline(parameters.read_outline()),
          mesh(plane_section(parameters.read_mesh(outline, true, {"rail", {}}), outline)),
          elements(*mesh, {steel()}, degree)
    {
      SmoothShapesSettings settings;
      settings.tolerance = tolerance;
      shapes = track_shapes(elements, track.support, {0.}, 0.02, {}, settings);
      track.section = track_section(elements, shapes);
    }
    static ElasticMaterial steel()
    {
      ElasticMaterial material;
      material.young_modulus = 205e9;
      material.poisson_ratio = 0.3;
      material.loss_factor = 0.02;
      return material;
    }
    const SectionParameters parameters{"rail_60e1", {"foot", "crown"}};
    const SectionOutline outline;
    const std::unique_ptr<dealii::Triangulation<2>> mesh;
    const SectionElements elements;
    SectionShapes shapes;
    PeriodicTrack track;
  };

  /// 80 by 60 mm of eight quadratic cells, on its foot b = 0.
  struct BlockSection
  {
    BlockSection() : elements(cells(mesh), {Rail::steel()}, 2) {}
    static const dealii::Triangulation<2> &cells(dealii::Triangulation<2> &mesh)
    {
      dealii::GridGenerator::subdivided_hyper_rectangle(
          mesh, std::vector<unsigned int>{4, 2}, dealii::Point<2>(-0.04, 0), dealii::Point<2>(0.04, 0.06));
      for (const auto &face : mesh.active_face_iterators())
        if (face->at_boundary())
          face->set_boundary_id(face->center()[1] < 1e-9    ? section_boundary::foot
                                : face->center()[1] > 0.059 ? section_boundary::crown
                                                            : section_boundary::surface);
      return mesh;
    }
    dealii::Triangulation<2> mesh;
    const SectionElements elements;
  };

  AxialLoad patch(const SectionElements &elements, const SectionShapes &shapes, const double x,
                  const double y, const double length, const double width, const unsigned int direction)
  {
    return patch_motions(elements, shapes, x, y, length, width)[direction];
  }
} // namespace

// Two spans of a block of 80 by 60 mm with free ends, all dofs of its section, against hexahedra, quadratic along the axis.
TEST(PeriodicTrack, short_block_against_hexahedra)
{
  const double layer = 0.01875, length = 0.075, width = 0.04;
  const BlockSection section;
  PeriodicTrack track;
  const SectionShapes shapes = all_shapes(section.elements);
  track.section = track_section(section.elements, shapes);

  BodyMesh<3> mesh;
  mesh.name = "block";
  mesh.triangulation = std::make_unique<dealii::parallel::distributed::Triangulation<3>>(MPI_COMM_SELF);
  dealii::GridGenerator::subdivided_hyper_rectangle(
      *mesh.triangulation, std::vector<unsigned int>{static_cast<unsigned int>(1.2 / layer + 0.5), 4, 2},
      dealii::Point<3>(-0.6, -0.04, -0.06), dealii::Point<3>(0.6, 0.04, 0));
  for (const auto &cell : mesh.triangulation->active_cell_iterators())
    for (const unsigned int f : cell->face_indices())
      if (cell->face(f)->at_boundary())
        cell->face(f)->set_boundary_id(f == 4 ? 1 : f == 5 ? 2 : 0);
  mesh.boundaries = {{"foot", 1}, {"contact", 2}};
  mesh.contact_boundaries = {2};
  ElasticModel<3> model;
  model.material = Rail::steel();
  SpringBed<3> bed;
  bed.boundary = 1;
  bed.loss_factor = track.support.pad_loss;
  for (unsigned int d = 0; d < 3; ++d)
    bed.stiffness_per_area[d] = track.support.pad_stiffness[d] / (0.08 * track.support.pad_length);
  for (const double x : {-0.3, 0.3})
    bed.segments.emplace_back(x - track.support.pad_length / 2, x + track.support.pad_length / 2);
  model.springs.push_back(bed);
  const ElasticBody<3> body(std::move(mesh), model, 2);
  const auto system = assemble_body<3>(body);

  ContactGrid grid;
  grid.n_x = grid.n_y = 1;
  grid.spacing_x = length;
  grid.spacing_y = width;
  std::vector<TraceRow> rows;
  std::vector<AxialLoad> loads;
  for (const double x : {0., 2 * length})
    for (const unsigned int direction : {2, 1, 0})
    {
      grid.x_first = x;
      // rows of a trace: normal, x, y
      rows.push_back(make_contact_trace(body, grid).rows[(direction + 1) % 3]);
      loads.push_back(patch(section.elements, shapes, x, 0, length, width, direction));
    }
  HarmonicSolver solver(*system);
  for (const double f : {334., 1670.})
  {
    const double omega = 2 * PI * f;
    const std::vector<Complex> solid = solver.receptance(omega, rows);
    const ComplexMatrix H =
        receptance(join(span_about(track, omega, -0.3, loads), span_about(track, omega, 0.3, loads)),
                   ComplexMatrix(), ComplexMatrix());
    const unsigned int n = rows.size();
    double worst = 0;
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        worst = std::max(worst, std::abs(H(i, j) - solid[i * n + j]) /
                                    std::sqrt(std::abs(solid[i * n + i] * solid[j * n + j])));
    std::cout << f << " Hz: off by " << worst << " at most" << std::endl;
    EXPECT_LT(worst, 2e-3);
  }
}

TEST(PeriodicTrack, smooth_shapes_stand_for_all_dofs)
{
  const BlockSection section;
  TrackSupport support;
  support.sleeper.mass = 20;
  support.sleeper.ballast_stiffness = {{20e6, 30e6, 60e6}};
  support.sleeper.ballast_loss = 0.5;
  const std::vector<SectionShapes> bases = {all_shapes(section.elements),
                                            track_shapes(section.elements, support, {0.}, 0.02, {}, {})};
  EXPECT_LT(bases[1].n(), bases[0].n());
  std::cout << bases[1].n() << " shapes of " << section.elements.n_dofs() << std::endl;
  for (const double f : {100., 4000.})
  {
    std::vector<ComplexMatrix> H;
    for (const SectionShapes &shapes : bases)
    {
      PeriodicTrack track;
      track.section = track_section(section.elements, shapes);
      track.support = support;
      H.push_back(
          track.receptance(track.at(2 * PI * f), {patch(section.elements, shapes, 0.01, 0, 0.08, 0.02, 2),
                                                  patch(section.elements, shapes, 0.3, 0, 0.08, 0.02, 1)}));
    }
    for (unsigned int j = 0; j < 2; ++j)
      EXPECT_LT(std::abs(H[1](j, j) / H[0](j, j) - 1.), 1e-3) << f << " Hz, load " << j;
    EXPECT_LT(std::abs(H[0](0, 1) - H[0](1, 0)), 1e-9 * std::abs(H[0](0, 0)));
  }
}

// Whether the load stands 0.13 m further or the supports 0.13 m before.
TEST(PeriodicTrack, supports_before_the_load)
{
  const Rail rail(2, 0.1);
  const double omega = 2 * PI * 600;
  PeriodicTrack before = rail.track;
  before.first_support -= 0.13;
  const auto receptance = [&](const PeriodicTrack &track, const double x)
  {
    return track.receptance(track.at(omega), {patch(rail.elements, rail.shapes, x, 0, 0.08, 0.02, 2),
                                              patch(rail.elements, rail.shapes, x + 0.3, 0, 0.08, 0.02, 1)});
  };
  const ComplexMatrix there = receptance(rail.track, 0.13), here = receptance(before, 0),
                      elsewhere = receptance(rail.track, 0);
  for (unsigned int j = 0; j < 2; ++j)
  {
    EXPECT_LT(std::abs(here(j, j) / there(j, j) - 1.), 1e-9);
    EXPECT_GT(std::abs(elsewhere(j, j) / there(j, j) - 1.), 1e-3);
  }
}

// Ballast that does not give way is rigid ground, whatever the sleeper's mass; a sleeper in flight is carried by its mass alone.
TEST(PeriodicTrack, sleepers_at_their_limits)
{
  const Rail rail(2, 0.1);
  const double omega = 2 * PI * 200;
  const std::vector<AxialLoad> loads = {patch(rail.elements, rail.shapes, 0.1, 0, 0.08, 0.02, 2),
                                        patch(rail.elements, rail.shapes, 0.28, 0, 0.08, 0.02, 1)};
  PeriodicTrack sleepers = rail.track;
  sleepers.support.sleeper.mass = 150;
  sleepers.support.sleeper.ballast_stiffness = {{1e18, 1e18, 1e18}};
  const ComplexMatrix ground = rail.track.receptance(rail.track.at(omega), loads),
                      stiff = sleepers.receptance(sleepers.at(omega), loads);
  sleepers.support.sleeper.ballast_stiffness = {{0, 0, 0}};
  const ComplexMatrix free = sleepers.receptance(sleepers.at(omega), loads);
  sleepers.support.sleeper.mass = 300;
  sleepers.support.sleeper.ballast_stiffness.fill(150 * omega * omega);
  const ComplexMatrix same = sleepers.receptance(sleepers.at(omega), loads);
  for (unsigned int j = 0; j < 2; ++j)
  {
    EXPECT_LT(std::abs(stiff(j, j) / ground(j, j) - 1.), 1e-6);
    EXPECT_LT(std::abs(same(j, j) / free(j, j) - 1.), 1e-10);
    EXPECT_GT(std::abs(free(j, j) / ground(j, j) - 1.), 1e-2);
  }
}

// The table of issue 15 in the scene of the squeal paper: pads of 180 and 36 MN/m with loss factor 1 on rigid ground.
TEST(PeriodicTrack, known_numbers_of_the_shipped_rail)
{
  const Rail rail(2, 0.1);
  const auto mobility = [&](const double f, const double x, const unsigned int direction)
  {
    const double omega = 2 * PI * f;
    return omega *
           std::abs(rail.track.receptance(
               rail.track.at(omega), {patch(rail.elements, rail.shapes, x, 0, 0.08, 0.02, direction)})(0, 0));
  };
  double peak = 0, level = 0, dip = 0, lowest = 1e300;
  for (const double f : {1020., 1044., 1053., 1062., 1071., 1100.})
    if (const double value = mobility(f, 0, 2); value > level)
    {
      peak = f;
      level = value;
    }
  for (const double f : {1060., 1075., 1085., 1095., 1110.})
    if (const double value = mobility(f, 0.3, 2); value < lowest)
    {
      dip = f;
      lowest = value;
    }
  std::cout << "mid-span peak " << level << " m/(N s) at " << peak << " Hz, dip over a support at " << dip
            << " Hz" << std::endl;
  EXPECT_GT(peak, 1050);
  EXPECT_LT(peak, 1068);
  EXPECT_GT(level, 1.2e-5);
  EXPECT_LT(level, 1.9e-5);
  EXPECT_NEAR(dip, 1085, 10);
}

// 48 m with the anechoic ends of the squeal paper (6 m, loss factors from 0.1 to 1 in geometric steps) is nearly infinite.
TEST(PeriodicTrack, infinite_against_48_m_with_anechoic_ends)
{
  const Rail rail(2, 0.1);
  RailSupports ends;
  ends.length = 48;
  ends.anechoic_lengths = {0.6, 0.6, 0.6, 1.2, 3.0};
  const double omega = 2 * PI * 918;
  const std::vector<AxialLoad> loads = {patch(rail.elements, rail.shapes, 0, 0, 0.08, 0.02, 2),
                                        patch(rail.elements, rail.shapes, 0, 0, 0.08, 0.02, 1)};
  // pieces end at mid-span: spans are of one piece each
  std::map<unsigned int, Slice> end_spans;
  for (unsigned int piece = 1; piece <= ends.anechoic_lengths.size(); ++piece)
  {
    PeriodicTrack lossy = rail.track;
    for (unsigned int j = 0; j < 3; ++j)
    {
      lossy.section.matrices.loss_stiffness[j] = lossy.section.matrices.stiffness[j];
      lossy.section.matrices.loss_stiffness[j] *= ends.anechoic_loss(piece);
    }
    end_spans.emplace(piece, span_about(lossy, omega, 0.3, {}));
  }
  const auto span = [&](const double x)
  {
    const unsigned int piece = ends.anechoic_piece(x);
    if (piece == 0)
      return span_about(rail.track, omega, x, loads);
    Slice result = end_spans.at(piece);
    result.forces.reinit(2 * result.n_shapes(), loads.size());
    result.compliance.reinit(loads.size(), loads.size());
    return result;
  };
  Slice track = span(-23.7);
  for (double x = -23.1; x < 24; x += 0.6)
    track = join(track, span(x));
  const ComplexMatrix H = receptance(track, ComplexMatrix(), ComplexMatrix()),
                      infinite = rail.track.receptance(rail.track.at(omega), loads);
  for (unsigned int j = 0; j < 2; ++j)
  {
    std::cout << "load " << j << ": " << std::abs(H(j, j) / infinite(j, j) - 1.) << std::endl;
    EXPECT_LT(std::abs(H(j, j) / infinite(j, j) - 1.), 0.02);
  }
}

// Spans of an irregular track that are far from loads move in the smooth shapes of greatest share alone: what that costs, for a
// load across a border and for one beside it.
TEST(PeriodicTrack, irregular_track_in_fewer_shapes)
{
  const Rail rail(2, 0.3);
  PeriodicTrack exact = rail.track;
  exact.own = irregular_supports({40, 0.2, 0.03, 3}, 0.6, false);
  PeriodicTrack fewer = exact;
  keep_far_shapes(fewer, rail.shapes);
  std::cout << fewer.far_shapes.size() << " of " << rail.shapes.n() << " shapes" << std::endl;
  EXPECT_LT(fewer.far_shapes.size(), rail.shapes.n());
  constexpr double omega = 2 * PI * 3417, length = 0.08;
  const PeriodicTrack::AtFrequency at_exact = exact.at(omega), at_fewer = fewer.at(omega),
                                   at_even = rail.track.at(omega);
  for (const double x : {0., length / 2 + 1e-3})
  {
    const std::vector<AxialLoad> loads = {patch(rail.elements, rail.shapes, x, 0, length, 0.02, 2),
                                          patch(rail.elements, rail.shapes, x, 0, length, 0.02, 1)};
    const ComplexMatrix right = exact.receptance(at_exact, loads), got = fewer.receptance(at_fewer, loads),
                        even = rail.track.receptance(at_even, loads);
    for (unsigned int j = 0; j < 2; ++j)
    {
      const double off = std::abs(got(j, j) / right(j, j) - 1.);
      std::cout << "x = " << x << " m, load " << j << ": off by " << off << ", scatter does "
                << std::abs(even(j, j) / right(j, j) - 1.) << std::endl;
      EXPECT_LT(off, 3e-3);
    }
  }
}

// A slab moves vertically alone, and one that is heavy enough hardly: its stiffness says nothing of the waves in the rail on it.
TEST(PeriodicTrack, a_heavy_slab_is_rigid_ground)
{
  const Rail rail(1, 0.3);
  const std::vector<AxialLoad> loads = {patch(rail.elements, rail.shapes, 0, 0, 0.08, 0.02, 2),
                                        patch(rail.elements, rail.shapes, 0, 0, 0.08, 0.02, 1)};
  PeriodicTrack heavy = rail.track;
  heavy.slab = TrackSlab();
  heavy.slab->mass = 1e9;
  for (const double f : {300., 900.})
  {
    const ComplexMatrix on_ground = rail.track.receptance(rail.track.at(2 * PI * f), loads),
                        on_slab = heavy.receptance(heavy.at(2 * PI * f), loads);
    EXPECT_LT(std::abs(on_slab(0, 0) / on_ground(0, 0) - 1.), 1e-6) << f;
    EXPECT_LT(std::abs(on_slab(1, 1) / on_ground(1, 1) - 1.), 1e-9) << f;
  }
}
