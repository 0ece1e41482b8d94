#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/scene/cell_elements.h>
#include <vibrocontact/scene/file_boundaries.h>
#include <vibrocontact/scene/mesh_file.h>
#include <vibrocontact/scene/mesh_quality.h>
#include <vibrocontact/scene/wheel.h>

#include <deal.II/distributed/shared_tria.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/manifold_lib.h>

#include <algorithm>
#include <set>
#include <sstream>

namespace vibrocontact
{
  using namespace dealii;

  namespace
  {
    bool is_in_contact_group(const FileCells::Face &face, const FileCells &file,
                             const MeshFileParameters &parameters)
    {
      return std::any_of(face.groups.begin(), face.groups.end(),
                         [&](const unsigned int group)
                         { return file.names.at(group) == parameters.contact_group; });
    }

    double diagonal(const std::vector<Point<3>> &places)
    {
      const BoundingBox<3> box(places);
      return box.get_boundary_points().first.distance(box.get_boundary_points().second);
    }

    /// The contact point, which is the origin now, lies on the contact group or near it.
    void check_contact_point(const FileCells &file, const MeshFileParameters &parameters,
                             const std::string &name)
    {
      std::vector<Point<3>> corners;
      for (const FileCells::Face &face : file.faces)
        if (is_in_contact_group(face, file, parameters))
          for (const unsigned int v : face.corners)
            corners.push_back(file.vertices[v]);
      if (corners.empty())
        return;
      const auto nearest =
          std::min_element(corners.begin(), corners.end(),
                           [](const Point<3> &a, const Point<3> &b) { return a.norm() < b.norm(); });
      if (nearest->norm() > diagonal(corners))
        throw InputError(name + "/Mesh/Contact point lies " + number_text(nearest->norm()) +
                         " m away from the contact group '" + parameters.contact_group +
                         "', further than that is large: give a point on it, in the unit of the file.");
    }

    void check_size(const std::vector<Point<3>> &vertices, const MeshFileParameters &parameters)
    {
      const double size = diagonal(vertices);
      if (size <= 100 && size >= 1e-3)
        return;
      std::ostringstream text;
      text << "The mesh file " << parameters.file << " describes a body of " << size
           << " m with Unit = " << parameters.unit
           << " m; is it in other units? Set Unit (0.001 for a file in mm).";
      throw InputError(text.str());
    }
    /// What elements and geometry there are for the cells of a file.
    void check_element(const MeshFileParameters &parameters, const FileCells &file, const std::string &name)
    {
      if (file.kind().is_hexahedron())
      {
        if (parameters.is_wheel() && file.kind().order == 2)
          throw InputError(
              "The mesh file " + parameters.file + " is of second order, but " + name +
              "/Mesh/Geometry = wheel attaches the arcs itself: save it with Mesh.ElementOrder = 1.");
        return;
      }
      if (parameters.is_wheel())
        throw InputError(name + "/Mesh/Geometry is wheel, but the mesh file " + parameters.file + " holds " +
                         file.kind().name + ": this geometry is for hexahedra; write Geometry = flat.");
      if (parameters.element_degree > 2)
        throw InputError(name + "/Mesh/Element degree is " + std::to_string(parameters.element_degree) +
                         ", but the mesh file " + parameters.file + " holds " + file.kind().name +
                         ", whose elements are of degree 1 or 2: write Element degree = 2.");
    }

    std::set<std::string> names_of_glued(const MeshFileParameters &parameters)
    {
      std::set<std::string> result;
      for (const GluedPair &pair : glued_pairs(parameters.glued_groups, "Glued"))
      {
        result.insert(pair.follower);
        result.insert(pair.leader);
      }
      return result;
    }

    /// The faces of each glued pair, by their corners.
    std::vector<std::vector<std::vector<unsigned int>>> glued_faces(const MeshFileParameters &parameters,
                                                                    const FileCells &file)
    {
      std::vector<std::vector<std::vector<unsigned int>>> result;
      for (const GluedPair &pair : glued_pairs(parameters.glued_groups, "Glued"))
      {
        result.emplace_back();
        for (const FileCells::Face &face : file.faces)
          for (const unsigned int group : face.groups)
            if (file.names.at(group) == pair.follower || file.names.at(group) == pair.leader)
              result.back().push_back(face.corners);
      }
      return result;
    }

    FileCells meshed_cells(const MeshFileParameters &parameters, const std::vector<NamedGroup> &named,
                           const std::string &name, const std::string &folder, const MPI_Comm communicator)
    {
      const std::string section = name + "/Mesh";
      parameters.cad.check(section, parameters.file, parameters.unit, parameters.element_degree,
                           group_names_of(named));
      return solid_cells(parameters.cad.mesh(section, parameters.file, parameters.element_degree,
                                             parameters.contact_group, folder, communicator),
                         parameters.file);
    }

    /// ReferenceCell::contains_point() of deal.II 9.4 knows no prisms: its release library says of every point that it is outside.
    bool lies_in(const ReferenceCell &cell, const Point<3> &p)
    {
      constexpr double rounding = 1e-12;
      if (cell == ReferenceCells::Tetrahedron)
        return p[0] + p[1] + p[2] <= 1 + rounding;
      if (cell == ReferenceCells::Wedge)
        return p[0] + p[1] <= 1 + rounding;
      AssertThrow(cell == ReferenceCells::Hexahedron, ExcInternalError());
      return true;
    }

    /// Points of a reference cell a quarter apart, its nodes among them.
    std::vector<Point<3>> quarters(const ReferenceCell &cell)
    {
      std::vector<Point<3>> points;
      for (unsigned int i = 0; i < 125; ++i)
      {
        const Point<3> p(i % 5 / 4., i / 5 % 5 / 4., i / 25 / 4.);
        if (lies_in(cell, p))
          points.push_back(p);
      }
      return points;
    }

    /// Every curved cell has to be right-handed; its volume ratio is a polynomial, of degree three on tetrahedra.
    void check_curved_cells(const BodyMesh<3> &mesh, const std::string &file)
    {
      const auto mapping = make_mapping(mesh);
      const auto element = scalar_element<3>(mesh.reference_cell(), 2);
      FEValues<3> values(*mapping, *element, Quadrature<3>(quarters(mesh.reference_cell())),
                         update_jacobians);
      unsigned int n = 0;
      Point<3> first;
      for (const auto &cell : mesh.triangulation->active_cell_iterators())
        if (!cell->is_artificial())
        {
          values.reinit(cell);
          double smallest = 1e300, largest = 0;
          for (unsigned int q = 0; q < values.n_quadrature_points; ++q)
          {
            const double volume = values.jacobian(q).determinant();
            smallest = std::min(smallest, volume);
            largest = std::max(largest, std::abs(volume));
          }
          if (!(smallest > 1e-6 * largest) && cell->is_locally_owned() && n++ == 0)
            first = cell->center();
        }
      const auto all =
          Utilities::MPI::all_gather(mesh.triangulation->get_communicator(), std::make_pair(n, first));
      unsigned int sum = 0;
      for (const auto &[count, place] : all)
      {
        if (sum == 0 && count > 0)
          first = place;
        sum += count;
      }
      if (sum == 0)
        return;
      std::ostringstream text;
      text << "The mesh file " << file << " has " << sum
           << " curved cells that are inverted in places, the first at (" << first
           << ") m: mesh it finer there (gmsh: Mesh.HighOrderOptimize = 2), or save it with first-order "
              "cells.";
      throw InputError(text.str());
    }
  } // namespace

  BodyMesh<3> make_mesh_from_file(const MeshFileParameters &parameters, const double lateral_position,
                                  const ContactGrid *grid, const std::string &name,
                                  const MPI_Comm communicator, const std::vector<std::string> &materials,
                                  const std::string &mesh_folder)
  {
    const bool is_cad = is_cad_file(parameters.file);
    std::vector<NamedGroup> named = parameters.supporting_groups(name + "/Mesh");
    const NamedGroup contact = {parameters.contact_group, "Contact group"};
    // without contact its group need not be there
    if (grid)
      named.push_back(contact);
    FileCells file = is_cad ? meshed_cells(parameters, named, name, mesh_folder, communicator)
                            : FileCells::read(parameters.file, parameters.split);
    require_groups(named, file, name, parameters.file);
    if (!grid)
      named.push_back(contact);
    check_double_nodes(file, parameters.file, names_of_glued(parameters));
    const std::vector<unsigned int> numbers =
        material_numbers(file.groups, {name, materials}, parameters.file);
    const bool hexahedra = file.kind().is_hexahedron();
    check_element(parameters, file, name);
    check_number_of_cells<3>(file.cells.size() * file.kind().cubes(), parameters.element_degree, name,
                             "give a coarser file or lower " + name + "/Mesh/Element degree");

    Point<3> origin;
    for (unsigned int d = 0; d < 3; ++d)
      origin[d] = parameters.contact_point.at(d) * parameters.unit;
    if (parameters.is_wheel())
      origin[1] += lateral_position;
    for (Point<3> &vertex : file.vertices)
      vertex = Point<3>(parameters.unit * vertex - origin);
    for (auto &[key, place] : file.mid_nodes)
      place = Point<3>(parameters.unit * place - origin);
    if (grid)
      check_contact_point(file, parameters, name);
    for (unsigned int c = 0; c < file.cells.size(); ++c)
      file.cells[c].material_id = numbers[c];
    check_cells(file.vertices, file.cells, parameters.file, glued_faces(parameters, file),
                ", glue groups of their faces (" + name + "/Mesh/Glued)");
    check_size(file.vertices, parameters);

    BodyMesh<3> mesh;
    mesh.name = name;
    mesh.cell_groups = materials;
    const std::vector<types::boundary_id> ids = boundary_ids(named, file, mesh, parameters.file);
    if (grid)
      mesh.contact_boundaries = {mesh.boundaries.at(parameters.contact_group)};

    if (hexahedra)
    {
      GridTools::consistently_order_cells(file.cells);
      mesh.triangulation = std::make_unique<parallel::distributed::Triangulation<3>>(
          communicator, Triangulation<3>::limit_level_difference_at_vertices);
    }
    else
      mesh.triangulation = std::make_unique<parallel::shared::Triangulation<3>>(
          communicator, Triangulation<3>::none, true, parallel::shared::Triangulation<3>::partition_metis);
    try
    {
      mesh.triangulation->create_triangulation(file.vertices, file.cells, SubCellData());
    }
    catch (const ExceptionBase &)
    {
      throw InputError("The mesh file " + parameters.file + " is no conforming mesh of " + file.kind().name +
                       ": cells overlap; repair it in the program that made it.");
    }
    name_faces(*mesh.triangulation, file, ids, parameters.file);

    mesh.geometry_degree = 1;
    if (file.kind().order == 2 && parameters.element_degree == 1)
      run_log().line("The mesh file " + parameters.file + " is of second order, but " + name +
                     "/Mesh/Element degree is 1: its edges are taken as straight.");
    if (file.kind().order == 2 && parameters.element_degree > 1)
    {
      mesh.mid_nodes = std::move(file.mid_nodes);
      mesh.geometry_degree = 2;
      check_curved_cells(mesh, parameters.file);
    }
    if (parameters.is_wheel())
    {
      const SectionOutline outline = wheel_outline(parameters);
      attach_wheel_manifolds(*mesh.triangulation, outline, tread_radius(outline, lateral_position),
                             lateral_position);
      mesh.geometry_degree = std::max(2u, parameters.element_degree);
    }
    if (grid && !is_cad)
      refine_at_contact(mesh, *grid, parameters.refinement, parameters.element_degree);
    return mesh;
  }

  std::optional<FlatFace> flat_contact_group(const MeshFileParameters &parameters)
  {
    if (is_cad_file(parameters.file))
      return parameters.cad.flat_face(parameters.file, parameters.contact_group, parameters.contact_point,
                                      parameters.unit);
    const FileCells file = FileCells::read(parameters.file, parameters.split);
    FlatFace face{1e300, -1e300, 1e300, -1e300};
    double area = 0, height = 0;
    for (const FileCells::Face &named : file.faces)
    {
      if (!is_in_contact_group(named, file, parameters))
        continue;
      std::vector<Point<3>> p;
      for (const unsigned int v : named.corners)
      {
        Point<3> place;
        for (unsigned int d = 0; d < 3; ++d)
          place[d] = parameters.unit * (file.vertices[v][d] - parameters.contact_point.at(d));
        p.push_back(place);
        face.x_low = std::min(face.x_low, place[0]);
        face.x_high = std::max(face.x_high, place[0]);
        face.y_low = std::min(face.y_low, place[1]);
        face.y_high = std::max(face.y_high, place[1]);
        height = std::max(height, std::abs(place[2]));
      }
      // a triangle's last corner is its first
      area += cross_product_3d(p[2] - p[0], p[p.size() == 4 ? 3 : 0] - p[1]).norm() / 2;
    }
    const double whole = (face.x_high - face.x_low) * (face.y_high - face.y_low);
    if (!(area > 0) || std::abs(area / whole - 1) > 1e-6 || height > 1e-6 * std::sqrt(area))
      return {};
    return face;
  }
} // namespace vibrocontact
