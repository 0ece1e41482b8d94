#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/read_ahead.h>
#include <vibrocontact/scene/mesh_quality.h>
#include <vibrocontact/scene/rail.h>
#include <vibrocontact/scene/section_manifolds.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace vibrocontact
{
  using namespace dealii;

  namespace
  {
    const dealii::Patterns::Selection rail_models("solid|periodic");

    constexpr types::boundary_id surface_id = 0, foot_id = 1, contact_id = 2, left_id = 3, right_id = 4;

    /// Manifold and boundary ids of the extruded outline, mirrored about the section's axis a = 0.
    void attach_rail_geometry(Triangulation<3> &triangulation, const SectionOutline &outline,
                              const double shift_y, const double shift_z, const double half_length)
    {
      const unsigned int n = outline.rows.size(), crown_manifold = 1 + 2 * n;
      std::vector<SectionOutline::Row> crown;
      for (unsigned int k = 0; k < n; ++k)
      {
        const auto &row = outline.rows[k];
        if (row.is_arc)
          for (const unsigned int side : {0, 1})
            triangulation.set_manifold(1 + k + side * n, ExtrudedArcManifold(Point<2>(
                                                             (side == 0 ? 1. : -1.) * row.centre[0] - shift_y,
                                                             row.centre[1] - shift_z)));
        if (row.part == "crown")
          crown.push_back(row);
      }
      triangulation.set_manifold(crown_manifold, CrownManifold(crown, shift_y, shift_z));
      double crown_reach = 0, foot_reach = 0;
      for (const auto &row : outline.rows)
        if (row.part == "crown")
          crown_reach = std::max({crown_reach, row.start[0], row.end[0]});
        else if (row.part == "foot")
          foot_reach = std::max({foot_reach, row.start[0], row.end[0]});

      for (const auto &cell : triangulation.cell_iterators_on_level(0))
        for (const unsigned int f : cell->face_indices())
        {
          const auto face = cell->face(f);
          if (!face->at_boundary())
            continue;
          face->set_all_boundary_ids(surface_id);
          bool on_crown = true, on_foot = true, is_left = true, is_right = true;
          std::vector<Point<2>> right, left;
          for (const unsigned int v : face->vertex_indices())
          {
            const Point<3> p = face->vertex(v);
            const double a = p[1] + shift_y, b = p[2] + shift_z;
            on_crown = on_crown && std::abs(a) < crown_reach + 1e-7 &&
                       std::abs(b - CrownManifold::height(crown, a)) < 1e-6;
            on_foot = on_foot && std::abs(b) < 1e-7;
            is_left = is_left && std::abs(p[0] + half_length) < 1e-7;
            is_right = is_right && std::abs(p[0] - half_length) < 1e-7;
            right.emplace_back(a, b);
            left.emplace_back(-a, b);
          }
          if (is_left || is_right)
          {
            face->set_boundary_id(is_left ? left_id : right_id);
            continue;
          }
          if (on_foot)
            face->set_all_boundary_ids(foot_id);
          else if (on_crown)
          {
            face->set_all_boundary_ids(contact_id);
            face->set_all_manifold_ids(crown_manifold);
          }
          else
          {
            const unsigned int k = outline.find(right), m = outline.find(left);
            if (k < n && outline.rows[k].is_arc)
              face->set_all_manifold_ids(1 + k);
            else if (m < n && outline.rows[m].is_arc)
              face->set_all_manifold_ids(1 + m + n);
          }
        }
    }
  } // namespace

  void RailParameters::declare_parameters(ParameterHandler &prm)
  {
    using Patterns::Double;
    prm.add_parameter("Model", model,
                      "solid: the section extruded over a length; periodic: infinite on equal supports, by "
                      "finite elements of the section alone. Units: none.",
                      rail_models);
    section.declare_parameters(prm, "lateral, height; outline of the right half");
    prm.add_parameter("Length", length, "Length of the rail; the contact is at its middle. Units: m.",
                      Double(0));
    prm.add_parameter("Lateral position", lateral_position,
                      "Position of the contact on the crown, from the symmetry plane. Units: m.", Double());
    RailSupports::declare_parameters(prm);
    prm.add_parameter("Contact division", contact_division,
                      "Length of the coarse cells at the contact. Units: m.", Double(0));
    prm.add_parameter("Coarse division", coarse_division,
                      "Length of the cells far from the contact. Units: m.", Double(0));
    prm.add_parameter("Growth", growth, "Largest ratio of neighbouring lengths. Units: none.", Double(1, 4));
    prm.add_parameter("Fine length", fine_length,
                      "Length of rail on either side of the contact with the contact division. Units: m.",
                      Double(0));
    refinement.declare_parameters(prm);
    track.declare_parameters(prm);
    prm.add_parameter("Contact offset", contact_offset,
                      "Model periodic: how far the contact stands beyond the place that Contact at names, "
                      "along x, for a sweep over a span. Units: m.",
                      Double());
    prm.add_parameter(
        "Pole pairs", n_pole_pairs,
        "Model periodic in contact: number of pairs of poles near its receptance, from which its "
        "roots are sought. Units: none.",
        Patterns::Integer(4, 60));
    prm.add_parameter("Fitted up to", fitted_up_to,
                      "Model periodic in contact: highest frequency at which these poles follow its "
                      "receptance. Units: Hz.",
                      Double(200, 20000));
  }

  void RailParameters::read_ahead(const ParameterFile &file, const std::string &section)
  {
    // whether it has modes and a mesh
    model = read_ahead_choice(file, section, "Model", model, rail_models);
  }

  void RailParameters::check(const std::string &path) const
  {
    section.check(path);
    refinement.check(path);
    std::ostringstream text;
    // about the contact
    const double reach =
        track.is_irregular() ? (track.n_supports - 1) / 2. * sleeper_spacing : sleeper_spacing;
    if (!(contact_division >= 1e-4) || !(coarse_division >= contact_division))
      text << path << "/Contact division (" << contact_division
           << " m) must be 1e-4 m or more and not above Coarse division (" << coarse_division << " m).";
    else if (has_pads() && !(pad_length > 0))
      text << path << "/Pad length is 0: a rail of finite elements needs pads of some length; give 0.15 m.";
    else if (is_periodic() && has_pads() && !(pad_length < sleeper_spacing))
      text << path << "/Pad length (" << pad_length << " m) must be below Sleeper spacing ("
           << sleeper_spacing << " m).";
    else if (is_periodic() && has_pads() && std::abs(contact_offset) > (1 + 1e-9) * reach)
      text << path << "/Contact offset is " << contact_offset << " m, more than "
           << (track.is_irregular() ? "half of what the Supports carry" : "a span") << ": give one between "
           << -reach << " and " << reach << " m.";
    else if (is_periodic() && !has_pads())
      text << path << "/Model is periodic, but there are no supports: give Pad stiffness x, y and z.";
    if (!text.str().empty())
      throw InputError(text.str());
    RailSupports::check(path);
    if (is_periodic())
      track.check(path, *this);
  }

  BodyMesh<3> make_rail(const RailParameters &parameters, const ContactGrid *grid, const std::string &name,
                        const MPI_Comm communicator, const std::vector<std::string> &materials)
  {
    const SectionOutline outline = parameters.section.read_outline();
    const SectionMesh section = parameters.section.read_mesh(outline, true, {name, materials});
    std::vector<SectionOutline::Row> crown;
    double reach = 0;
    for (const auto &row : outline.rows)
      if (row.part == "crown")
      {
        crown.push_back(row);
        reach = std::max({reach, row.start[0], row.end[0]});
      }
    if (crown.empty() || std::abs(parameters.lateral_position) > reach)
    {
      std::ostringstream text;
      text << "Rail/Lateral position " << parameters.lateral_position << " m of body " << name
           << " is not on the crown; give one between " << -reach << " and " << reach << " m.";
      throw InputError(text.str());
    }
    const double shift_y = parameters.lateral_position, shift_z = CrownManifold::height(crown, shift_y);

    const auto half = graded_divisions(parameters.length / 2, parameters.contact_division,
                                       parameters.fine_length, parameters.coarse_division, parameters.growth);
    check_number_of_cells<3>(2. * half.size() * section.cells.size(), parameters.section.element_degree, name,
                             "make " + name + "/Rail/Contact division or Coarse division larger");
    std::vector<double> x = {0.};
    for (const double length : half)
      x.push_back(x.back() + length);
    for (unsigned int k = 1; k <= half.size(); ++k)
      x.insert(x.begin(), -x[2 * k - 1]);

    const unsigned int n_vertices = section.vertices.size();
    std::vector<Point<3>> vertices;
    for (const double position : x)
      for (const Point<2> &p : section.vertices)
        vertices.emplace_back(position, p[0] - shift_y, p[1] - shift_z);

    std::vector<CellData<3>> cells;
    for (unsigned int layer = 0; layer + 1 < x.size(); ++layer)
      for (unsigned int q = 0; q < section.cells.size(); ++q)
      {
        CellData<3> cell;
        for (unsigned int v = 0; v < 4; ++v)
        {
          cell.vertices[v] = section.cells[q][v] + layer * n_vertices;
          cell.vertices[4 + v] = section.cells[q][v] + (layer + 1) * n_vertices;
        }
        const unsigned int n_groups = std::max<std::size_t>(1, materials.size());
        cell.material_id =
            section.materials[q] + n_groups * parameters.anechoic_piece((x[layer] + x[layer + 1]) / 2);
        cells.push_back(cell);
      }

    BodyMesh<3> mesh;
    mesh.name = name;
    mesh.cell_groups = materials;
    mesh.geometry_degree = std::max(2u, parameters.section.element_degree);
    mesh.triangulation = std::make_unique<parallel::distributed::Triangulation<3>>(
        communicator, Triangulation<3>::limit_level_difference_at_vertices);
    mesh.triangulation->create_triangulation(vertices, cells, SubCellData());
    attach_rail_geometry(*mesh.triangulation, outline, shift_y, shift_z, parameters.length / 2);
    mesh.boundaries = {{"surface", surface_id},
                       {"foot", foot_id},
                       {"contact", contact_id},
                       {"end left", left_id},
                       {"end right", right_id}};
    mesh.contact_boundaries = {contact_id};

    if (grid)
      refine_at_contact(mesh, *grid, parameters.refinement, parameters.section.element_degree);
    return mesh;
  }

  void add_supports(ElasticModel<3> &model, const RailParameters &parameters, const BodyMesh<3> &mesh)
  {
    const unsigned int n_groups = std::max<std::size_t>(1, mesh.cell_groups.size());
    for (unsigned int piece = 1; piece <= parameters.anechoic_lengths.size(); ++piece)
      for (unsigned int group = 0; group < n_groups; ++group)
      {
        ElasticMaterial material = model.material_of(group);
        material.loss_factor = parameters.anechoic_loss(piece);
        model.zones[group + n_groups * piece] = material;
      }
    if (!parameters.has_pads())
      return;

    // Width of the foot, from its faces of the coarse mesh.
    SpringBed<3> bed;
    bed.boundary = mesh.boundary_id("foot");
    double low = 1e300, high = -1e300;
    for (const auto &cell : mesh.triangulation->cell_iterators_on_level(0))
      for (const unsigned int f : cell->face_indices())
        if (cell->face(f)->at_boundary() && cell->face(f)->boundary_id() == bed.boundary)
          for (const unsigned int v : cell->face(f)->vertex_indices())
          {
            low = std::min(low, cell->face(f)->vertex(v)[1]);
            high = std::max(high, cell->face(f)->vertex(v)[1]);
          }
    const double area = (high - low) * parameters.pad_length;
    bed.stiffness_per_area[0] = parameters.pad_stiffness_x / area;
    bed.stiffness_per_area[1] = parameters.pad_stiffness_y / area;
    bed.stiffness_per_area[2] = parameters.pad_stiffness_z / area;
    bed.loss_factor = parameters.pad_loss_factor;
    for (const double x : parameters.supports())
      bed.segments.emplace_back(x - parameters.pad_length / 2, x + parameters.pad_length / 2);
    model.springs.push_back(bed);
  }

  bool RailParameters::add_entries(EntriesRead &entries, const std::string &section, const BodyUse &use) const
  {
    this->section.add_entries(entries, section);
    entries.add(section, "Model, Lateral position");
    if (is_periodic())
    {
      entries.add(section, "Pad stiffness x, Pad stiffness y, Pad stiffness z, Contact at, Contact offset, "
                           "Sleeper spacing, Pad length, Pad loss factor");
      track.add_entries(entries, section);
      entries.add_if(use.contact && use.motion, "the rail moves in a contact", section,
                     "Pole pairs, Fitted up to");
      return true;
    }
    entries.add(section, "Length, Contact division, Coarse division, Growth, Fine length");
    add_support_entries(entries, section, use, false);
    refinement.add_entries(entries, section, use);
    return true;
  }

  std::pair<std::string, std::string> RailParameters::missing_support(const std::string &name) const
  {
    return support_wanted(name + "/Rail");
  }

  BodyMesh<3> RailParameters::make_mesh(const MeshRequest &request) const
  {
    return make_rail(*this, request.grid, request.name, request.communicator, request.materials);
  }

  void RailParameters::hold(ElasticModel<3> &model, const BodyMesh<3> &mesh) const
  {
    add_supports(model, *this, mesh);
  }
} // namespace vibrocontact
