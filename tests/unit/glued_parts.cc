// Parts of one body whose meshes do not match, glued: constant stress, rigid motions, held and hanging nodes on the glued faces,
// edges where several meet, curved surfaces, a beam cut in the middle against the whole one; what is refused.

#include "box_of_cells.h"
#include "scratch_folder.h"

#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/fe/assemble_body.h>
#include <vibrocontact/fe/face_overlap.h>
#include <vibrocontact/fe/make_elastic_body.h>
#include <vibrocontact/reduction/compute_modes.h>
#include <vibrocontact/scene/mesh_file.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace vibrocontact;
using namespace dealii;

namespace
{
  /// A box of a body of several, in the units of the whole: sets are `a left`, `a right` and so on.
  struct GluedBox
  {
    std::string name;
    std::array<unsigned int, 3> divisions;
    Point<3> from, to;
    /// of its nodes
    double distortion = 1;
    /// of its cells, and of those beyond its middle; empty: as all
    std::string type = "", other_type = "";
  };

  using Place = std::function<Point<3>(const Point<3> &)>;

  /// Faces of the boxes stay plane, their nodes move in them, more of one box than of another.
  Point<3> distorted(const GluedBox &box, const Point<3> &p)
  {
    const double factor = box.distortion * (0.5 + 0.1 * (box.name[0] - 'a'));
    Tensor<1, 3> wave;
    for (unsigned int d = 0; d < 3; ++d)
      wave[d] = std::sin(numbers::PI * p[d]);
    const Point<3> moved(p[0] + 0.2 * factor * wave[0] * p[1] * (1 - p[2]),
                         p[1] - 0.15 * factor * wave[1] * p[0],
                         p[2] + 0.14 * factor * wave[2] * (0.5 + p[0] - p[1]));
    Point<3> x;
    for (unsigned int d = 0; d < 3; ++d)
      x[d] = box.from[d] + moved[d] * (box.to[d] - box.from[d]);
    return x;
  }

  /// No axis is along the faces.
  Tensor<2, 3> turn()
  {
    const double a = 0.4, b = 0.7;
    return Tensor<2, 3>({{std::cos(a), -std::sin(a), 0}, {std::sin(a), std::cos(a), 0}, {0, 0, 1}}) *
           Tensor<2, 3>({{1, 0, 0}, {0, std::cos(b), -std::sin(b)}, {0, std::sin(b), std::cos(b)}});
  }

  MeshFileParameters glued_boxes(
      const std::string &type, const std::vector<GluedBox> &boxes, const std::string &glued,
      const unsigned int degree, const Place &place = [](const Point<3> &x) { return x; })
  {
    MeshFileParameters parameters;
    parameters.file = scratch_folder() + "/" + type + ".inp";
    parameters.element_degree = degree;
    parameters.glued_groups = glued;
    std::ofstream out(parameters.file);
    for (unsigned int k = 0; k < boxes.size(); ++k)
    {
      BoxOfCells box;
      box.type = boxes[k].type.empty() ? type : boxes[k].type;
      box.other_type = boxes[k].other_type;
      box.divisions = boxes[k].divisions;
      box.prefix = boxes[k].name + "_";
      box.offset = 100000 * k;
      box.place = [&](const Point<3> &p) { return place(distorted(boxes[k], p)); };
      out << box.text();
    }
    return parameters;
  }

  std::unique_ptr<ElasticBody<3>> glued_body(const MeshFileParameters &parameters,
                                             const ElasticModel<3> &given, const MPI_Comm communicator,
                                             const unsigned int n_refined = 0)
  {
    ElasticModel<3> model = given;
    BodyMesh<3> mesh = make_mesh_from_file(parameters, 0, nullptr, "body", communicator);
    add_supports(model, parameters, mesh);
    for (unsigned int k = 0; k < n_refined; ++k)
    {
      // hanging nodes on both sides of x = 0.15 m
      for (const auto &cell : mesh.triangulation->active_cell_iterators())
        if (cell->is_locally_owned() && cell->center()[1] + cell->center()[2] < 0.2 - 0.07 * k)
          cell->set_refine_flag();
      mesh.triangulation->execute_coarsening_and_refinement();
    }
    auto body = std::make_unique<ElasticBody<3>>(std::move(mesh), model, parameters.element_degree);
    glue_parts(*body, parameters.glued(body->mesh.name));
    return body;
  }

  Tensor<2, 3> stress_of(const Tensor<2, 3> &gradient)
  {
    const ElasticMaterial material;
    return material.lambda() * trace(gradient) * unit_symmetric_tensor<3>() +
           material.mu() * (gradient + transpose(gradient));
  }

  /// Tractions of a constant stress on all faces that are not glued.
  void load_by_stress(ElasticModel<3> &model, const MeshFileParameters &parameters,
                      const std::vector<GluedBox> &boxes, const Tensor<2, 3> &stress,
                      const Tensor<2, 3> &turned)
  {
    const BodyMesh<3> mesh = make_mesh_from_file(parameters, 0, nullptr, "body", MPI_COMM_WORLD);
    const std::array<std::string, 6> sides = {{"left", "right", "front", "back", "bottom", "top"}};
    for (const GluedBox &box : boxes)
      for (unsigned int f = 0; f < 6; ++f)
      {
        const std::string name = box.name + "_" + sides[f];
        if (parameters.glued_groups.find(name) != std::string::npos)
          continue;
        Tensor<1, 3> normal;
        normal[f / 2] = f % 2 == 1 ? 1 : -1;
        model.tractions.push_back({mesh.boundary_id(name), stress * (turned * normal)});
      }
  }

  /// Largest force that a linear displacement leaves on any node, over the largest load on a node.
  double residual_of(const ElasticBody<3> &body, const Tensor<2, 3> &gradient)
  {
    const auto system = assemble_body(body);
    PETScWrappers::MPI::Vector u(body.locally_owned, body.communicator()), force(u);
    for (unsigned int i = 0; i < system->dof_position.size(); ++i)
      u(body.locally_owned.nth_index_in_set(i)) =
          (gradient * Tensor<1, 3>(system->dof_position[i]))[system->dof_direction[i]];
    u.compress(VectorOperation::insert);
    for (const auto dof : body.locally_owned)
      if (body.constraints.is_constrained(dof))
        u(dof) = 0;
    u.compress(VectorOperation::insert);
    system->stiffness.vmult(force, u);
    force -= system->load;
    for (const auto dof : body.locally_owned)
      if (body.constraints.is_constrained(dof))
        force(dof) = 0;
    force.compress(VectorOperation::insert);
    return force.linfty_norm() / system->load.linfty_norm();
  }

  const Tensor<2, 3> some_gradient({{1e-3, -3e-4, 7e-4}, {2e-4, -4e-4, 5e-4}, {-6e-4, 1e-4, 8e-4}});

  const std::vector<std::pair<std::string, unsigned int>> glued_cells = {
      {"C3D8", 1},  {"C3D8", 2},  {"C3D8", 3}, {"C3D20", 1}, {"C3D20", 2}, {"C3D4", 1}, {"C3D4", 2},
      {"C3D10", 1}, {"C3D10", 2}, {"C3D6", 1}, {"C3D6", 2},  {"C3D15", 1}, {"C3D15", 2}};

  std::vector<GluedBox> two_boxes(const std::array<unsigned int, 3> &first,
                                  const std::array<unsigned int, 3> &second)
  {
    return {{"a", first, {0, 0, 0}, {0.15, 0.2, 0.1}}, {"b", second, {0.15, 0, 0}, {0.3, 0.2, 0.1}}};
  }
} // namespace

TEST(FaceOverlap, areas_and_nodes)
{
  for (const bool triangle : {false, true})
    for (const unsigned int degree : {1u, 2u})
    {
      SurfaceFace face;
      face.triangle = triangle;
      face.degree = degree;
      for (const Point<2> &s : SurfaceFace::unit_nodes(triangle, degree))
        face.nodes.emplace_back(2 * s[0] + 0.3 * s[1], 3 * s[1], 1.);
      EXPECT_TRUE(face.is_affine());
      EXPECT_NEAR(face.area(), triangle ? 3 : 6, 1e-13);
      std::vector<double> values;
      for (unsigned int k = 0; k < face.nodes.size(); ++k)
      {
        face.shapes(SurfaceFace::unit_nodes(triangle, degree)[k], values);
        for (unsigned int l = 0; l < values.size(); ++l)
          EXPECT_NEAR(values[l], k == l, 1e-13);
      }
      // a square of side 0.5 within it, and one that it does not meet
      SurfaceFace square;
      for (const Point<2> &s : SurfaceFace::unit_nodes(false, 1))
        square.nodes.emplace_back(0.4 + 0.5 * s[0], 0.3 + 0.5 * s[1], 1.25);
      const FaceOverlap within = overlap_of(face, square);
      double area = 0;
      Point<3> moment;
      for (const SharedPoint &point : within.points)
      {
        area += point.weight;
        moment += point.weight * face.place(point.on_first);
        EXPECT_NEAR(face.place(point.on_first).distance(square.place(point.on_second)), 0.25, 1e-13);
      }
      EXPECT_NEAR(area, 0.25, 1e-14);
      EXPECT_NEAR(moment[0] / area, 0.65, 1e-13);
      EXPECT_NEAR(moment[1] / area, 0.55, 1e-13);
      EXPECT_NEAR(within.gap, 0.25, 1e-13);
      for (Point<3> &node : square.nodes)
        node[0] += 10;
      EXPECT_TRUE(overlap_of(face, square).points.empty());
    }
}

TEST(GluedPartsMpi, constant_stress_is_exact)
{
  double worst = 0;
  const Tensor<2, 3> turned = turn();
  for (const auto &[type, degree] : glued_cells)
    for (const bool finer : {true, false})
    {
      const auto boxes = finer ? two_boxes({{2, 3, 3}}, {{2, 2, 2}}) : two_boxes({{1, 2, 1}}, {{2, 3, 3}});
      const MeshFileParameters parameters = glued_boxes(
          type, boxes, "a_right: b_left", degree, [&](const Point<3> &x) { return Point<3>(turned * x); });
      ElasticModel<3> model;
      load_by_stress(model, parameters, boxes, stress_of(some_gradient), turned);
      const auto owner = glued_body(parameters, model, MPI_COMM_WORLD);
      const ElasticBody<3> &body = *owner;
      const double residual = residual_of(body, some_gradient);
      worst = std::max(worst, residual);
      const std::string what =
          type + ", degree " + std::to_string(degree) + (finer ? ", finer" : ", coarser");
      EXPECT_LT(residual, 1e-10) << what;
      const auto system = assemble_body(body);
      EXPECT_EQ(system->n_rigid_modes, 6u) << what;
      PETScWrappers::MPI::Vector force(system->load);
      for (const auto &motion : system->rigid_motions)
      {
        system->stiffness.vmult(force, motion);
        EXPECT_LT(force.linfty_norm(), 1e-12 * system->stiffness.linfty_norm()) << what;
      }
    }
  std::cout << "forces left over the largest load on a node: " << worst << std::endl;
}

TEST(GluedPartsMpi, held_hanging_and_doubly_glued_nodes_pass_it_as_well)
{
  const auto pair = two_boxes({{2, 3, 3}}, {{2, 2, 2}});
  Tensor<2, 3> gradient = some_gradient;
  gradient[2][0] = gradient[2][1] = 0;
  for (const auto &[type, degree] : glued_cells)
  {
    // held along z below, across the glued faces
    MeshFileParameters parameters = glued_boxes(type, pair, "a_right: b_left", degree);
    parameters.held_groups = {"a_bottom: z", "b_bottom: z"};
    ElasticModel<3> model;
    load_by_stress(model, parameters, pair, stress_of(gradient), unit_symmetric_tensor<3>());
    EXPECT_LT(residual_of(*glued_body(parameters, model, MPI_COMM_WORLD), gradient), 1e-10)
        << "held, " << type << ", degree " << degree;

    // four around an edge
    const std::vector<GluedBox> four = {{"a", {{2, 2, 2}}, {0, 0, 0}, {0.15, 0.1, 0.1}},
                                        {"b", {{2, 1, 3}}, {0.15, 0, 0}, {0.3, 0.1, 0.1}},
                                        {"c", {{3, 2, 1}}, {0, 0.1, 0}, {0.15, 0.2, 0.1}},
                                        {"d", {{1, 2, 2}}, {0.15, 0.1, 0}, {0.3, 0.2, 0.1}}};
    const MeshFileParameters around =
        glued_boxes(type, four, "a_right: b_left; c_right: d_left; a_back: c_front; d_front: b_back", degree);
    ElasticModel<3> free;
    load_by_stress(free, around, four, stress_of(some_gradient), unit_symmetric_tensor<3>());
    EXPECT_LT(residual_of(*glued_body(around, free, MPI_COMM_WORLD), some_gradient), 1e-10)
        << "four, " << type << ", degree " << degree;

    if (type[3] != '8' && type != "C3D20")
      continue;
    MeshFileParameters hanging = glued_boxes(type, pair, "a_right: b_left", degree);
    ElasticModel<3> refined;
    load_by_stress(refined, hanging, pair, stress_of(some_gradient), unit_symmetric_tensor<3>());
    EXPECT_LT(residual_of(*glued_body(hanging, refined, MPI_COMM_WORLD, degree == 3 ? 1 : 2), some_gradient),
              1e-10)
        << "hanging, " << type << ", degree " << degree;
  }
}

TEST(GluedPartsMpi, parts_of_different_cells_pass_it)
{
  struct Pair
  {
    std::string first, beyond, second;
    unsigned int degree;
  };
  double worst = 0;
  const Tensor<2, 3> turned = turn();
  for (const auto &[first, beyond, second, degree] : std::vector<Pair>{{"C3D8", "", "C3D4", 1},
                                                                       {"C3D8", "", "C3D4", 2},
                                                                       {"C3D4", "", "C3D6", 2},
                                                                       {"C3D6", "C3D8", "C3D4", 1},
                                                                       {"C3D8", "C3D6", "C3D4", 2},
                                                                       {"C3D20", "", "C3D10", 1},
                                                                       {"C3D20", "", "C3D10", 2},
                                                                       {"C3D10", "", "C3D15", 2},
                                                                       {"C3D15", "C3D20", "C3D10", 2}})
    for (const bool finer : {true, false})
    {
      auto boxes = finer ? two_boxes({{2, 3, 3}}, {{2, 2, 2}}) : two_boxes({{2, 2, 1}}, {{2, 3, 3}});
      boxes[0].other_type = beyond;
      boxes[1].type = second;
      MeshFileParameters parameters = glued_boxes(first, boxes, "a_right: b_left", degree,
                                                  [&](const Point<3> &x) { return Point<3>(turned * x); });
      parameters.split = true;
      ElasticModel<3> model;
      load_by_stress(model, parameters, boxes, stress_of(some_gradient), turned);
      const auto body = glued_body(parameters, model, MPI_COMM_WORLD);
      const double residual = residual_of(*body, some_gradient);
      worst = std::max(worst, residual);
      EXPECT_LT(residual, 1e-10) << first << " and " << second << ", degree " << degree;
      EXPECT_EQ(assemble_body(*body)->n_rigid_modes, 6u);
    }
  std::cout << "forces left over the largest load on a node: " << worst << std::endl;
}

TEST(GluedPartsMpi, facets_of_a_curved_surface_turn_without_stress)
{
  for (const auto &[type, degree] : glued_cells)
  {
    const auto boxes = two_boxes({{2, 5, 4}}, {{2, 3, 3}});
    const MeshFileParameters parameters =
        glued_boxes(type, boxes, "a_right: b_left", degree,
                    [](const Point<3> &x)
                    { return Point<3>(x[0] + 2 * x[1] * (0.2 - x[1]) - 3 * x[2] * x[2], x[1], x[2]); });
    ElasticModel<3> model;
    model.gravity[2] = -1;
    const auto owner = glued_body(parameters, model, MPI_COMM_WORLD);
    const ElasticBody<3> &body = *owner;
    const auto system = assemble_body(body);
    PETScWrappers::MPI::Vector force(system->load);
    for (const auto &motion : system->rigid_motions)
    {
      system->stiffness.vmult(force, motion);
      EXPECT_LT(force.linfty_norm(), 1e-12 * system->stiffness.linfty_norm())
          << type << ", degree " << degree;
    }
  }
}

TEST(GluedPartsMpi, frequencies_are_those_of_the_whole_beam)
{
  const auto frequencies = [](const std::string &type, const std::vector<GluedBox> &boxes,
                              const std::string &glued, const MPI_Comm communicator)
  {
    const auto owner = glued_body(glued_boxes(type, boxes, glued, 2), {}, communicator);
    const ElasticBody<3> &body = *owner;
    const auto system = assemble_body(body);
    Flexibility flexibility(*system);
    ModeParameters wanted;
    wanted.count = 12;
    return compute_modes(*system, flexibility, wanted).omega;
  };
  const auto halves = [](const unsigned int n) -> std::vector<GluedBox>
  {
    return {{"a", {{2 * n, 3 * n / 2, 3 * n / 2}}, {0, 0, 0}, {0.45, 0.12, 0.1}, 0},
            {"b", {{2 * n, n, n}}, {0.45, 0, 0}, {1, 0.12, 0.1}, 0}};
  };
  const std::string glue = "a_right: b_left";
  const auto whole = [](const std::array<unsigned int, 3> &cells) -> std::vector<GluedBox> {
    return {{"a", cells, {0, 0, 0}, {1, 0.12, 0.1}, 0}};
  };
  for (const std::string type : {"C3D8", "C3D10"})
  {
    const std::vector<double> truth = frequencies(type, whole({{12, 6, 6}}), "", MPI_COMM_WORLD);
    // of the six lowest elastic ones
    const auto error = [&](const std::vector<double> &omega)
    {
      double worst = 0;
      for (unsigned int k = 6; k < 12; ++k)
        worst = std::max(worst, std::abs(omega.at(k) / truth.at(k) - 1));
      return worst;
    };
    std::vector<double> glued;
    for (const unsigned int n : {2, 4})
    {
      const std::vector<double> omega = frequencies(type, halves(n), glue, MPI_COMM_WORLD);
      glued.push_back(error(omega));
      const double coarse = error(frequencies(type, whole({{4 * n, n, n}}), "", MPI_COMM_WORLD));
      std::cout << type << ": frequencies of the glued beam are off by " << glued.back()
                << ", of the whole one with the cells of its coarser half by " << coarse << std::endl;
      EXPECT_LT(glued.back(), 1.1 * coarse) << type;
      if (n > 2)
        continue;
      const std::vector<double> alone = frequencies(type, halves(n), glue, MPI_COMM_SELF);
      for (unsigned int k = 6; k < 12; ++k)
        EXPECT_NEAR(omega[k] / alone[k], 1, 1e-9) << type;
    }
    EXPECT_GT(glued[0] / glued[1], 4) << type;
  }
}

namespace
{
  /// What is said to boxes of hexahedra with this entry.
  std::string said_of_glue(const std::vector<GluedBox> &boxes, const std::string &glued,
                           const std::vector<std::string> &held = {}, const std::string &type = "C3D8")
  {
    try
    {
      MeshFileParameters parameters = glued_boxes(type, boxes, glued, 1);
      parameters.held_groups = held;
      parameters.check("body/Mesh");
      glued_body(parameters, {}, MPI_COMM_SELF);
    }
    catch (const InputError &error)
    {
      return error.what();
    }
    return "nothing";
  }

  void expect_said(const std::string &said, const std::vector<std::string> &parts)
  {
    for (const std::string &part : parts)
      EXPECT_NE(said.find(part), std::string::npos) << "wanted: " << part << "\ngot: " << said;
    EXPECT_LT(said.size(), 700u) << said;
  }
} // namespace

TEST(GluedParts, refused_with_numbers_and_places)
{
  auto boxes = two_boxes({{1, 2, 2}}, {{1, 1, 1}});
  EXPECT_EQ(said_of_glue(boxes, "a_right: b_left"), "nothing");
  expect_said(said_of_glue(boxes, ""), {"double nodes", "Mesh/Glued"});
  expect_said(said_of_glue(boxes, "a_right"), {"body/Mesh/Glued has \"a_right\"", "with a colon"});
  expect_said(said_of_glue(boxes, "a_right: a_right"), {"glues a_right to itself"});
  expect_said(said_of_glue(boxes, "a_right: b_left; a_right: b_top"), {"a_right before the colon twice"});
  expect_said(said_of_glue(boxes, "a_right: b_lift"),
              {"no faces in a group named 'b_lift'", "body/Mesh/Glued", "b_left (1 faces)"});
  expect_said(said_of_glue(boxes, "a_right: b_left", {"b_left"}),
              {"body/Mesh/Glued and Held groups", "'b_left'", "held, in contact, glued or on springs"});
  expect_said(said_of_glue(boxes, "a_right: contact"), {"both name 'contact'"});

  boxes[1].from[0] += 0.03;
  expect_said(said_of_glue(boxes, ""), {"falls into 2 pieces", "body/Mesh/Glued"});
  expect_said(said_of_glue(boxes, "a_right: b_left"),
              {"4 of the 4 faces of \"a_right\" are off \"b_left\"", "by 0.03 m", "touch"});
  expect_said(said_of_glue(boxes, "a_top: b_left"), {"2 of the 2 faces", "less than half", "exchange"});
  boxes[1].from[0] -= 0.03;
  boxes[1].from[2] += 0.06;
  boxes[1].to[2] += 0.06;
  expect_said(said_of_glue(boxes, "a_right: b_left"),
              {"2 of the 4 faces of \"a_right\" lie on \"b_left\" with less than half", "(0.15 0.0", "%"});
  boxes = two_boxes({{1, 1, 1}}, {{1, 1, 1}});
  boxes.push_back({"c", {{1, 1, 1}}, {0.15, 0.5, 0}, {0.3, 0.7, 0.1}});
  expect_said(said_of_glue(boxes, "a_right: b_left"), {"falls into 2 pieces"});
  // in the group that leads, but away from what follows
  boxes[2].name = "b";
  expect_said(said_of_glue(boxes, "a_right: b_left"),
              {"no face of \"a_right\" lies on the part of \"b_left\" at (0.15 0.6", "loose"});
}
