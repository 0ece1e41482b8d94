#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/scene/gmsh_file.h>
#include <vibrocontact/scene/held_part.h>
#include <vibrocontact/scene/mesh_file.h>
#include <vibrocontact/scene/mesh_quality.h>
#include <vibrocontact/scene/wheel.h>

#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/manifold_lib.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>

namespace vibrocontact
{
  using namespace dealii;

  void MeshFileParameters::declare_parameters(ParameterHandler &prm)
  {
    using Patterns::Double;
    prm.add_parameter("File", file, "gmsh file of hexahedra, text format 4.1 or 2.2. Units: none.",
                      Patterns::FileName());
    prm.add_parameter("Unit", unit, "Length of the file's unit; 0.001 for a file in mm. Units: m.",
                      Double(1e-9, 1e3));
    prm.add_parameter(
        "Contact point", contact_point,
        "Nominal contact point in the file's coordinates; it becomes the origin. Units: unit of the file.",
        Patterns::List(Double(), 3, 3, ","));
    prm.add_parameter("Contact group", contact_group,
                      "Physical name of the boundary that can come into contact. Units: none.",
                      Patterns::Anything());
    prm.add_parameter("Held groups", held_groups,
                      "Physical names of the boundaries that are held; name: yz holds those directions "
                      "alone; empty: a free body. Units: none.",
                      Patterns::List(Patterns::Anything(), 0, 100, ","));
    prm.add_parameter("Foundation groups", foundation_groups,
                      "Physical names of the boundaries that stand on springs to rigid ground, such as the "
                      "pads' areas under a rail's foot; empty: none. Units: none.",
                      Patterns::List(Patterns::Anything(), 0, 100, ","));
    prm.add_parameter("Foundation stiffness", foundation_stiffness,
                      "Stiffness per area of these springs along x, y, z. Units: N/m^3.",
                      Patterns::List(Double(0, 1e18), 3, 3, ","));
    prm.add_parameter("Foundation loss factor", foundation_loss_factor,
                      "Hysteretic loss factor of these springs. Units: none.", Double(0, 10));
    prm.add_parameter(
        "Geometry", geometry,
        "flat: cells as in the file; wheel: the arcs of a wheel's outline are attached again. Units: none.",
        Patterns::Selection("flat|wheel"));
    prm.add_parameter(
        "Wheel outline", wheel_outline,
        "Outline for the wheel geometry; empty: the one that comes with the program. Units: none.",
        Patterns::FileName());
    prm.add_parameter("Wheel scale", wheel_scale, "Factor on the outline's lengths. Units: none.",
                      Double(0.01, 100));
    prm.add_parameter("Element degree", element_degree,
                      "Polynomial degree of the displacements. Units: none.", Patterns::Integer(1, 4));
    refinement.declare_parameters(prm);
  }

  void MeshFileParameters::check(const std::string &section) const
  {
    refinement.check(section);
    if (file.empty())
      throw InputError(section + "/File is empty: give the path of a gmsh file.");
    if (!std::ifstream(file) || std::filesystem::is_directory(file))
      throw InputError(section + "/File: cannot read " + file + "; give the path of an existing gmsh file.");
    const std::vector<HeldPart> held = held_parts(held_groups, section + "/Held groups");
    for (const HeldPart &part : held)
      if (part.boundary == contact_group)
        throw InputError(section + "/Held groups contains the contact group '" + contact_group +
                         "': a held face cannot deform in contact; take it out of the list.");
    const bool some = std::any_of(foundation_stiffness.begin(), foundation_stiffness.end(),
                                  [](const double k) { return k > 0; });
    const bool all = std::all_of(foundation_stiffness.begin(), foundation_stiffness.end(),
                                 [](const double k) { return k > 0; });
    if (some && foundation_groups.empty())
      throw InputError(section + "/Foundation stiffness is given without Foundation groups: name the groups "
                                 "that stand on springs.");
    if (!foundation_groups.empty() && !(held_groups.empty() ? all : some))
      throw InputError(section + "/Foundation stiffness must be positive " +
                       (held_groups.empty()
                            ? "along x, y and z: a body that can slide in one direction has no "
                              "static response."
                            : "in one direction at least, or leave Foundation groups empty."));
    for (const auto &group : foundation_groups)
    {
      if (group == contact_group)
        throw InputError(section + "/Foundation groups contains the contact group '" + group +
                         "': one surface cannot do both; take it out of the list.");
      if (std::any_of(held.begin(), held.end(),
                      [&](const HeldPart &part) { return part.boundary == group && part.holds_all(); }))
        throw InputError(section + "/Foundation groups contains '" + group +
                         "', which Held groups holds rigidly; take it out of one of the lists.");
    }
  }

  namespace
  {
    void check_size(const std::vector<Point<3>> &vertices, const MeshFileParameters &parameters)
    {
      const BoundingBox<3> box(vertices);
      const double size = (box.get_boundary_points().second - box.get_boundary_points().first).norm();
      if (size <= 100 && size >= 1e-3)
        return;
      std::ostringstream text;
      text << "The mesh file " << parameters.file << " describes a body of " << size
           << " m with Unit = " << parameters.unit
           << " m; is it in other units? Set Unit (0.001 for a file in mm).";
      throw InputError(text.str());
    }
  } // namespace

  BodyMesh<3> make_mesh_from_file(const MeshFileParameters &parameters, const double lateral_position,
                                  const ContactGrid *grid, const std::string &name,
                                  const MPI_Comm communicator, const std::vector<std::string> &materials)
  {
    const GmshFile gmsh = GmshFile::read(parameters.file);
    const std::vector<unsigned int> numbers =
        material_numbers(gmsh.cells, {name, materials}, parameters.file);
    check_number_of_cells<3>(gmsh.hexahedra.size(), parameters.element_degree, name,
                             "give a coarser file or lower " + name + "/Mesh/Element degree");

    Point<3> origin;
    for (unsigned int d = 0; d < 3; ++d)
      origin[d] = parameters.contact_point.at(d) * parameters.unit;
    if (parameters.is_wheel())
      origin[1] += lateral_position;
    std::vector<Point<3>> vertices;
    for (const Point<3> &node : gmsh.nodes)
      vertices.push_back(Point<3>(parameters.unit * node - origin));

    std::vector<CellData<3>> cells;
    for (const auto &hexahedron : gmsh.hexahedra)
    {
      CellData<3> cell;
      const unsigned int order[8] = {0, 1, 3, 2, 4, 5, 7, 6};
      for (unsigned int v = 0; v < 8; ++v)
        cell.vertices[v] = hexahedron[order[v]];
      cell.material_id = numbers[cells.size()];
      cells.push_back(cell);
    }
    check_cells(vertices, cells, parameters.file);

    BodyMesh<3> mesh;
    mesh.name = name;
    mesh.cell_groups = materials;
    mesh.boundaries["surface"] = 0;
    for (const auto &[tag, group] : gmsh.names)
      if (group != "surface")
        mesh.boundaries[group] = tag;
    const auto counts = gmsh.face_counts();
    const auto require = [&](const std::string &group, const std::string &entry)
    {
      const auto found = counts.find(group);
      if (found != counts.end() && found->second > 0)
        return;
      std::string list;
      for (const auto &[present, n] : counts)
        list += (list.empty() ? "" : ", ") + present + " (" + std::to_string(n) + " faces)";
      throw InputError("The mesh file " + parameters.file + " has no faces in a physical surface named '" +
                       group + "', asked for by " + name + "/Mesh/" + entry + "; " +
                       (list.empty() ? "it has no named surface: name one in gmsh."
                                     : "name one of those it has: " + list + "."));
    };
    for (const HeldPart &part : held_parts(parameters.held_groups, name + "/Mesh/Held groups"))
      require(part.boundary, "Held groups");
    for (const auto &group : parameters.foundation_groups)
      require(group, "Foundation groups");
    if (grid)
    {
      require(parameters.contact_group, "Contact group");
      mesh.contact_boundaries = {mesh.boundaries.at(parameters.contact_group)};
    }

    SubCellData boundary;
    for (unsigned int k = 0; k < gmsh.quadrilaterals.size(); ++k)
    {
      const auto named = gmsh.names.find(gmsh.groups[k]);
      CellData<2> face;
      const auto &q = gmsh.quadrilaterals[k];
      face.vertices = {q[0], q[1], q[3], q[2]};
      face.boundary_id = named == gmsh.names.end() || named->second == "surface" ? 0 : named->first;
      boundary.boundary_quads.push_back(face);
    }
    GridTools::delete_unused_vertices(vertices, cells, boundary);
    check_size(vertices, parameters);
    GridTools::consistently_order_cells(cells);
    mesh.triangulation = std::make_unique<parallel::distributed::Triangulation<3>>(
        communicator, Triangulation<3>::limit_level_difference_at_vertices);
    try
    {
      mesh.triangulation->create_triangulation(vertices, cells, boundary);
    }
    catch (const ExceptionBase &)
    {
      throw InputError(
          "The mesh file " + parameters.file +
          " is no conforming mesh of hexahedra: cells overlap, or a named quadrilateral is not a face of a "
          "cell on the boundary; name boundary surfaces only.");
    }

    mesh.geometry_degree = 1;
    if (parameters.is_wheel())
    {
      const SectionOutline outline = wheel_outline(parameters);
      attach_wheel_manifolds(*mesh.triangulation, outline, tread_radius(outline, lateral_position),
                             lateral_position);
      mesh.geometry_degree = std::max(2u, parameters.element_degree);
    }
    if (grid)
      refine_at_contact(mesh, *grid, parameters.refinement, parameters.element_degree);
    return mesh;
  }

  void add_supports(ElasticModel<3> &model, const MeshFileParameters &parameters, const BodyMesh<3> &mesh)
  {
    for (const HeldPart &part : held_parts(parameters.held_groups, "Held groups"))
      model.held.emplace_back(mesh.boundary_id(part.boundary), part.directions);
    for (const std::string &group : parameters.foundation_groups)
    {
      SpringBed<3> bed;
      bed.boundary = mesh.boundary_id(group);
      for (unsigned int d = 0; d < 3; ++d)
        bed.stiffness_per_area[d] = parameters.foundation_stiffness.at(d);
      bed.loss_factor = parameters.foundation_loss_factor;
      model.springs.push_back(bed);
    }
  }

  std::optional<FlatFace> flat_contact_group(const MeshFileParameters &parameters)
  {
    const GmshFile gmsh = GmshFile::read(parameters.file);
    FlatFace face{1e300, -1e300, 1e300, -1e300};
    double area = 0, height = 0;
    for (unsigned int k = 0; k < gmsh.quadrilaterals.size(); ++k)
    {
      const auto named = gmsh.names.find(gmsh.groups[k]);
      if (named == gmsh.names.end() || named->second != parameters.contact_group)
        continue;
      std::array<Point<3>, 4> p;
      for (unsigned int v = 0; v < 4; ++v)
      {
        for (unsigned int d = 0; d < 3; ++d)
          p[v][d] =
              parameters.unit * (gmsh.nodes[gmsh.quadrilaterals[k][v]][d] - parameters.contact_point.at(d));
        face.x_low = std::min(face.x_low, p[v][0]);
        face.x_high = std::max(face.x_high, p[v][0]);
        face.y_low = std::min(face.y_low, p[v][1]);
        face.y_high = std::max(face.y_high, p[v][1]);
        height = std::max(height, std::abs(p[v][2]));
      }
      area += cross_product_3d(p[2] - p[0], p[3] - p[1]).norm() / 2;
    }
    const double whole = (face.x_high - face.x_low) * (face.y_high - face.y_low);
    if (!(area > 0) || std::abs(area / whole - 1) > 1e-6 || height > 1e-6 * std::sqrt(area))
      return {};
    return face;
  }

  SectionOutline wheel_outline(const MeshFileParameters &parameters)
  {
    SectionParameters section = WheelParameters().section;
    section.outline = parameters.wheel_outline;
    return section.read_outline(parameters.wheel_scale);
  }

  bool MeshFileParameters::add_entries(EntriesRead &entries, const std::string &section,
                                       const BodyUse &use) const
  {
    entries.add(section, "File, Unit, Contact point, Held groups, Foundation groups, Geometry, "
                         "Element degree");
    entries.add_if(use.contact, "the body is in contact", section, "Contact group");
    const bool springs = !foundation_groups.empty();
    entries.add_if(springs, "there are Foundation groups", section, "Foundation stiffness");
    entries.add_if(springs && use.loss, "there are Foundation groups and the body moves", section,
                   "Foundation loss factor");
    entries.add_if(is_wheel(), "Geometry is wheel", section, "Wheel outline, Wheel scale");
    refinement.add_entries(entries, section, use);
    return true;
  }

  std::pair<std::string, std::string> MeshFileParameters::missing_support(const std::string &name) const
  {
    if (is_supported())
      return {};
    return {name + "/Mesh/Held groups and Foundation groups are empty",
            "hold at least one of the file's groups or put it on springs"};
  }

  BodyMesh<3> MeshFileParameters::make_mesh(const MeshRequest &request) const
  {
    return make_mesh_from_file(*this, request.lateral_position, request.grid, request.name,
                               request.communicator, request.materials);
  }

  void MeshFileParameters::hold(ElasticModel<3> &model, const BodyMesh<3> &mesh) const
  {
    add_supports(model, *this, mesh);
  }

  std::optional<FlatFace> MeshFileParameters::flat_face(double) const
  {
    if (is_wheel())
      return {};
    return flat_contact_group(*this);
  }

  std::optional<SectionOutline> MeshFileParameters::wheel_section() const
  {
    if (!is_wheel())
      return {};
    return vibrocontact::wheel_outline(*this);
  }

  std::string MeshFileParameters::way_to_turn(const std::string &name, bool) const
  {
    return "turn its mesh, choose another " + name + "/Mesh/Contact group";
  }
} // namespace vibrocontact
