#include <vibrocontact/base/collective.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/parameter_text.h>
#include <vibrocontact/base/read_ahead.h>
#include <vibrocontact/scene/gmsh_file.h>
#include <vibrocontact/scene/mesh_quality.h>
#include <vibrocontact/scene/revolved_mesh.h>
#include <vibrocontact/scene/section_manifolds.h>
#include <vibrocontact/scene/wheel.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace vibrocontact
{
  using namespace dealii;

  namespace
  {
    const dealii::Patterns::Selection wheel_models("solid|harmonics");

    constexpr types::boundary_id wheel_surface_id = 0, wheel_bore_id = 1, wheel_contact_id = 2;

    InputError no_bore(const std::string &name)
    {
      return InputError("The section mesh of body " + name +
                        " has no edge on a row of its outline that is called bore, so that nothing holds the "
                        "wheel: give mesh and outline of one section, the outline with a bore.");
    }

    /// Mean over each cell of the height of the tread, a radius r(a) over the plane of contact.
    std::vector<double> revolved_heights(const SectionOutline &outline, const ContactGrid &grid,
                                         const double axle_height, const double lateral_position)
    {
      const auto [first, last] = tread_limits(outline);
      const double low = lateral_position + grid.y_first - grid.spacing_y / 2,
                   high = low + grid.n_y * grid.spacing_y;
      if (low < first || high > last)
      {
        std::ostringstream text;
        text << "The contact grid reaches from " << low << " to " << high
             << " m of the wheel's section, but its tread from " << first << " to " << last
             << " m: make the grid smaller or move the contact (Contact/Lateral position).";
        throw InputError(text.str());
      }
      const QGauss<1> gauss(4);
      std::vector<double> heights(grid.n_points(), 0.);
      for (unsigned int i = 0; i < grid.n_points(); ++i)
        for (unsigned int p = 0; p < gauss.size(); ++p)
          for (unsigned int q = 0; q < gauss.size(); ++q)
          {
            const double x = grid.x(i) + (gauss.point(p)[0] - 0.5) * grid.spacing_x,
                         a = lateral_position + grid.y(i) + (gauss.point(q)[0] - 0.5) * grid.spacing_y,
                         r = tread_radius(outline, a);
            heights[i] += gauss.weight(p) * gauss.weight(q) * (axle_height - std::sqrt(r * r - x * x));
          }
      return heights;
    }
  } // namespace

  void WheelParameters::declare_parameters(ParameterHandler &prm)
  {
    using Patterns::Double;
    section.declare_parameters(prm, "half of it: axial, radius");
    web.declare_parameters(prm);
    prm.add_parameter(
        "Model", model,
        "Elements: solid, hexahedra all around; harmonics, quadrilaterals of the section and one "
        "problem for each number of waves around the axle, a hundredth of the cost. Units: none.",
        wheel_models);
    prm.add_parameter(
        "Harmonics", n_harmonics,
        "Waves around the axle that the contact compliance is summed over; a half-space answers "
        "to the shorter ones. Units: none.",
        Patterns::Integer(4, 400));
    prm.add_parameter("Rotation", rotation,
                      "The wheel turns past its contact, and past the points of frequency responses, with "
                      "the speed of rolling: a pair of modes becomes "
                      "two waves, one with the "
                      "rotation and one against it (Model = harmonics). false: it stands still there, as in "
                      "the paper. Units: none.",
                      Patterns::Bool());
    dampers_entry = names_of_groups(dampers);
    prm.add_parameter("Dampers", dampers_entry,
                      "Names of what damps the wheel besides its materials, separated by commas (Model = "
                      "harmonics). Section Damper then holds a subsection of each name. Units: none.",
                      Patterns::Anything());
    declare_groups(prm, "Damper", dampers, unlisted_dampers);
    prm.add_parameter(
        "Write mesh", write_mesh,
        "gmsh file to write the coarse hexahedra and named boundaries to, y as in the section; empty: "
        "none. Units: none.",
        Patterns::Anything());
    prm.add_parameter("Scale", scale, "All lengths of the section times this factor. Units: none.",
                      Double(0.01, 100));
    prm.add_parameter("Contact division", contact_division,
                      "Circumferential length of the coarse cells at the contact. Units: m.", Double(0));
    prm.add_parameter("Coarse division", coarse_division,
                      "Circumferential length of the cells on the tread far from the contact. Units: m.",
                      Double(0));
    prm.add_parameter("Growth", growth, "Largest ratio of neighbouring circumferential lengths. Units: none.",
                      Double(1, 4));
    prm.add_parameter("Fine length", fine_length,
                      "Length of tread on either side of the contact with the contact division. Units: m.",
                      Double(0));
    refinement.declare_parameters(prm);
  }

  void WheelParameters::check(const std::string &path) const
  {
    section.check(path);
    refinement.check(path);
    if (is_by_harmonics() && (web.change != 0 || !web.radii.empty()))
      web_motion(section.read_outline(scale), path);
    for (const WheelDamper &damper : dampers)
    {
      damper.check(path + "/Damper/" + damper.name);
      if (!is_by_harmonics())
        throw InputError(path + "/Dampers lists " + damper.name +
                         ", which a wheel of solid elements does not take: set Model to harmonics.");
      if (rotation && !damper.is_layer())
        throw InputError(path + "/Dampers lists " + damper.name + " (" + damper.kind + ")" +
                         ", which would pass the contact with the turning wheel: set Rotation to false, or "
                         "leave it out.");
    }
    std::ostringstream text;
    if (!(contact_division >= 1e-4 * scale) || !(coarse_division >= contact_division))
      text << path << "/Contact division (" << contact_division << " m) must be " << 1e-4 * scale
           << " m or more and not above Coarse division (" << coarse_division << " m).";
    else if (coarse_division > 0.5 * scale)
      text << path << "/Coarse division is " << coarse_division
           << " m, fewer than six cells around the wheel; give it in metres.";
    if (!text.str().empty())
      throw InputError(text.str());
  }

  std::pair<double, double> tread_limits(const SectionOutline &outline)
  {
    double low = 1e300, high = -1e300;
    for (const auto &row : outline.rows)
      if (row.part == "tread" && !row.is_arc)
      {
        low = std::min({low, row.start[0], row.end[0]});
        high = std::max({high, row.start[0], row.end[0]});
      }
    return {low, high};
  }

  double tread_radius(const SectionOutline &outline, const double lateral_position)
  {
    for (const auto &row : outline.rows)
      if (row.part == "tread" && !row.is_arc)
      {
        const double t = (lateral_position - row.start[0]) / (row.end[0] - row.start[0]);
        if (t >= 0 && t <= 1)
          return row.start[1] + t * (row.end[1] - row.start[1]);
      }
    const auto [low, high] = tread_limits(outline);
    if (low > high)
      throw InputError(
          "The outline of the wheel's section has no straight line that is called tread, so that nothing "
          "can touch the wheel: give one this part.");
    std::ostringstream text;
    text << "Contact/Lateral position " << lateral_position
         << " m is not on the wheel's tread; give one between " << low << " and " << high << " m.";
    throw InputError(text.str());
  }

  std::vector<unsigned int> attach_wheel_manifolds(Triangulation<3> &triangulation,
                                                   const SectionOutline &outline, const double axis_height,
                                                   const double shift)
  {
    const RevolvedManifold revolved(axis_height, shift);
    triangulation.set_all_manifold_ids(0);
    triangulation.set_manifold(0, revolved);
    for (unsigned int k = 0; k < outline.rows.size(); ++k)
      if (outline.rows[k].is_arc)
        triangulation.set_manifold(1 + k, RevolvedArcManifold(axis_height, shift, outline.rows[k].centre));

    std::vector<unsigned int> rows;
    for (const auto &cell : triangulation.cell_iterators_on_level(0))
      for (const unsigned int f : cell->face_indices())
      {
        const auto face = cell->face(f);
        if (!face->at_boundary())
          continue;
        std::vector<Point<2>> points;
        for (const unsigned int v : face->vertex_indices())
        {
          const Point<3> chart = revolved.pull_back(face->vertex(v));
          points.emplace_back(chart[0], chart[1]);
        }
        rows.push_back(outline.find(points));
        if (rows.back() < outline.rows.size() && outline.rows[rows.back()].is_arc)
          face->set_all_manifold_ids(1 + rows.back());
      }
    return rows;
  }

  BodyMesh<3> make_wheel(const WheelParameters &parameters, const double lateral_position,
                         const ContactGrid *grid, const std::string &name, const MPI_Comm communicator,
                         const std::vector<std::string> &materials)
  {
    const SectionOutline outline = parameters.section.read_outline(parameters.scale);
    const double radius = tread_radius(outline, lateral_position);
    const SectionMesh section =
        parameters.section.read_mesh(outline, false, {name, materials}, parameters.scale);

    // Angles of the sections, symmetric about the contact at phi = 0.
    const auto half = graded_divisions(numbers::PI * radius, parameters.contact_division,
                                       parameters.fine_length, parameters.coarse_division, parameters.growth);
    std::vector<double> angles = {0.};
    for (const double length : half)
      angles.push_back(angles.back() + length / radius);
    for (unsigned int k = half.size(); k-- > 1;)
      angles.push_back(2 * numbers::PI - angles[k]);

    check_number_of_cells<3>(double(angles.size()) * section.cells.size(), parameters.section.element_degree,
                             name, "make " + name + "/Wheel/Contact division or Coarse division larger");

    const RevolvedManifold revolved(radius, lateral_position);
    const unsigned int n_angles = angles.size(), n_vertices = section.vertices.size();
    std::vector<Point<3>> vertices;
    for (const double angle : angles)
      for (const Point<2> &p : section.vertices)
        vertices.push_back(revolved.push_forward(Point<3>(p[0], p[1], angle)));
    // The section's (a, b) and the angle are right-handed as (b, a, angle): swap two vertices of each layer.
    std::vector<CellData<3>> cells;
    for (unsigned int layer = 0; layer < n_angles; ++layer)
      for (unsigned int q = 0; q < section.cells.size(); ++q)
      {
        CellData<3> cell;
        const unsigned int order[4] = {0, 2, 1, 3};
        for (unsigned int v = 0; v < 4; ++v)
        {
          cell.vertices[v] = section.cells[q][order[v]] + layer * n_vertices;
          cell.vertices[4 + v] = section.cells[q][order[v]] + ((layer + 1) % n_angles) * n_vertices;
        }
        cell.material_id = section.materials[q];
        cells.push_back(cell);
      }

    BodyMesh<3> mesh;
    mesh.name = name;
    mesh.cell_groups = materials;
    mesh.geometry_degree = std::max(2u, parameters.section.element_degree);
    mesh.triangulation = std::make_unique<parallel::distributed::Triangulation<3>>(
        communicator, Triangulation<3>::limit_level_difference_at_vertices);
    mesh.triangulation->create_triangulation(vertices, cells, SubCellData());
    const auto rows = attach_wheel_manifolds(*mesh.triangulation, outline, radius, lateral_position);
    unsigned int k = 0, n_bore = 0;
    for (const auto &cell : mesh.triangulation->cell_iterators_on_level(0))
      for (const unsigned int f : cell->face_indices())
        if (cell->face(f)->at_boundary())
        {
          const unsigned int row = rows[k++];
          const std::string part = row < outline.rows.size() ? outline.rows[row].part : "surface";
          n_bore += part == "bore";
          cell->face(f)->set_all_boundary_ids(part == "bore"    ? wheel_bore_id
                                              : part == "tread" ? wheel_contact_id
                                                                : wheel_surface_id);
        }
    if (n_bore == 0)
      throw no_bore(name);
    mesh.boundaries = {{"surface", wheel_surface_id}, {"bore", wheel_bore_id}, {"contact", wheel_contact_id}};
    mesh.contact_boundaries = {wheel_contact_id};

    if (!parameters.write_mesh.empty())
      on_first_rank([&] { write_gmsh(mesh, parameters.write_mesh, lateral_position); }, communicator);
    if (grid)
      refine_at_contact(mesh, *grid, parameters.refinement, parameters.section.element_degree);
    return mesh;
  }

  void WheelParameters::read_ahead(const ParameterFile &file, const std::string &section)
  {
    // whether it has tractions
    model = read_ahead_choice(file, section, "Model", model, wheel_models);
    // a wheel's section costs little; 0.05 % of its frequencies to 8 kHz with the shipped one
    if (is_by_harmonics())
      this->section.element_degree = 3;
    const ListedNames names = read_ahead_names(file, section, "Dampers");
    dampers = groups_of<WheelDamper>(names.listed);
    unlisted_dampers = groups_of<WheelDamper>(names.unlisted);
  }

  bool WheelParameters::add_entries(EntriesRead &entries, const std::string &section,
                                    const BodyUse &use) const
  {
    this->section.add_entries(entries, section);
    entries.add(section, "Scale, Model");
    entries.add_if(is_by_harmonics(), "Model is harmonics", section, "Web thickness change, Web radii");
    entries.add_if(!is_by_harmonics(), "Model is solid", section,
                   "Write mesh, Contact division, Coarse division, Growth, Fine length");
    entries.add_if(is_by_harmonics() && (use.contact || use.points),
                   "Model is harmonics and the body is in contact or responds to forces", section,
                   "Harmonics, Rotation");
    entries.add_if(is_by_harmonics() && use.contact, "Model is harmonics and the body is in contact", section,
                   "Contact cell size");
    const std::string damped = "Model is harmonics and the body moves";
    entries.add_if(is_by_harmonics() && use.motion, damped, section, "Dampers");
    for (const WheelDamper &damper : dampers)
      entries.add_if(is_by_harmonics() && use.motion, damped, section + "/Damper/" + damper.name,
                     damper.entries());
    if (!is_by_harmonics())
      refinement.add_entries(entries, section, use);
    return true;
  }

  std::function<Point<2>(const Point<2> &)> WheelParameters::web_motion(const SectionOutline &outline,
                                                                        const std::string &path) const
  {
    std::vector<double> usual;
    if (section.is_built_in())
      usual = {0.175 * scale, 0.37 * scale};
    return web.motion(outline, usual, path);
  }

  RevolvedMesh WheelParameters::make_section(const MeshRequest &request) const
  {
    const SectionOutline outline = section.read_outline(scale);
    const SectionMesh cells = section.read_mesh(outline, false, {request.name, request.materials}, scale);
    RevolvedMesh mesh;
    mesh.held = wheel_bore_id;
    mesh.tread = wheel_contact_id;
    mesh.radius = tread_radius(outline, request.lateral_position);
    mesh.lateral_position = request.lateral_position;
    mesh.degree = section.element_degree;
    mesh.displacement = web_motion(outline, request.name + "/Wheel");
    mesh.n_harmonics = n_harmonics;
    auto triangulation =
        section_triangulation(cells, outline, {{"bore", wheel_bore_id}, {"tread", wheel_contact_id}});
    const auto ids = triangulation->get_boundary_ids();
    if (std::count(ids.begin(), ids.end(), wheel_bore_id) == 0)
      throw no_bore(request.name);
    if (request.grid)
    {
      const ContactGrid &grid = *request.grid;
      // all of the tread, so that the elements are the same wherever on it the contact lies
      const auto [first, last] = tread_limits(outline);
      if (refinement.cell_size > 0)
        refine_section(*triangulation, wheel_contact_id, first, last, refinement.cell_size);
      for (const auto &face : triangulation->active_cell_iterators())
        for (const unsigned int f : face->face_indices())
          if (face->face(f)->at_boundary() && face->face(f)->boundary_id() == wheel_contact_id &&
              (face->face(f)->vertex(0)[0] - request.lateral_position) *
                      (face->face(f)->vertex(1)[0] - request.lateral_position) <=
                  0)
            mesh.contact_material = face->material_id();
      mesh.surface_height = revolved_heights(outline, grid, mesh.radius, request.lateral_position);
    }
    mesh.triangulation = std::move(triangulation);
    return mesh;
  }

  BodyMesh<3> WheelParameters::make_mesh(const MeshRequest &request) const
  {
    return make_wheel(*this, request.lateral_position, request.grid, request.name, request.communicator,
                      request.materials);
  }

  void WheelParameters::hold(ElasticModel<3> &model, const BodyMesh<3> &mesh) const
  {
    model.held = {mesh.boundary_id("bore")};
  }
} // namespace vibrocontact
