#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/read_ahead.h>
#include <vibrocontact/scene/file_boundaries.h>
#include <vibrocontact/scene/held_part.h>
#include <vibrocontact/scene/mesh_file.h>
#include <vibrocontact/scene/wheel.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

namespace vibrocontact
{
  using namespace dealii;

  void MeshFileParameters::read_ahead(const ParameterFile &file, const std::string &section)
  {
    const ListedNames names = read_ahead_names(file, section, "Masses");
    masses = groups_of<PointMassParameters>(names.listed);
    unlisted_masses = groups_of<PointMassParameters>(names.unlisted);
  }

  void MeshFileParameters::declare_parameters(ParameterHandler &prm)
  {
    using Patterns::Double;
    prm.add_parameter(
        "File", file,
        "Mesh of hexahedra, tetrahedra or prisms, by the ending of its name: .msh (gmsh), "
        ".unv, .bdf, .vtk, .inp "
        "(Abaqus, CalculiX); or a part that is meshed as section CAD says: .step, .stp, .brep. Units: none.",
        Patterns::FileName());
    prm.add_parameter("Unit", unit,
                      "Length of the file's unit; 0.001 for a file in mm. STEP files say it themselves and "
                      "are in m. Units: m.",
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
        "Foundation damping", foundation_damping,
        "Viscous damping per area of dashpots beside these springs, along x, y, z. Units: N s/m^3.",
        Patterns::List(Double(0, 1e18), 3, 3, ","));
    masses_entry = names_of_groups(masses);
    prm.add_parameter("Masses", masses_entry,
                      "Names of rigid masses that are coupled to groups, separated by commas: a motor, a "
                      "sensor. Section Mass then holds a subsection of each name. Units: none.",
                      Patterns::Anything());
    declare_groups(prm, "Mass", masses, unlisted_masses);
    prm.add_parameter(
        "Split into tetrahedra", split,
        "Hexahedra, prisms and pyramids of the file are split into tetrahedra, so that parts of "
        "different cells can be glued and mixed cells are one mesh. Units: none.");
    prm.add_parameter(
        "Glued", glued_groups,
        "Pairs of boundaries of parts whose meshes do not match, glued where the first lies on the "
        "second: pad back: plate front; rib: plate back. The first, better the finer mesh, follows "
        "the second. Empty: one mesh. Units: none.",
        Patterns::Anything());
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
                      "Polynomial degree of the displacements; tetrahedra and prisms: 1 or 2. Units: none.",
                      Patterns::Integer(1, 4));
    refinement.declare_parameters(prm);
    cad.declare_parameters(prm);
  }

  namespace
  {
    bool any_of(const std::vector<double> &values)
    {
      return std::any_of(values.begin(), values.end(), [](const double value) { return value > 0; });
    }
  } // namespace

  std::vector<NamedGroup> MeshFileParameters::supporting_groups(const std::string &section) const
  {
    std::vector<NamedGroup> groups;
    for (const HeldPart &part : held_parts(held_groups, section + "/Held groups"))
      groups.push_back({part.boundary, "Held groups"});
    for (const std::string &group : foundation_groups)
      groups.push_back({group, "Foundation groups"});
    std::set<std::string> glued_names;
    for (const GluedPair &pair : glued_pairs(glued_groups, section + "/Glued"))
      glued_names.insert({pair.follower, pair.leader});
    for (const std::string &group : glued_names)
      groups.push_back({group, "Glued"});
    for (const PointMassParameters &mass : masses)
      for (const std::string &group : mass.groups)
        groups.push_back({group, "Mass/" + mass.name + "/Groups"});
    return groups;
  }

  bool MeshFileParameters::has_dashpots() const
  {
    return !foundation_groups.empty() && any_of(foundation_damping);
  }

  std::string MeshFileParameters::in_the_way_of_prestress(const std::string &body) const
  {
    for (const PointMassParameters &mass : masses)
      if (mass.rigid)
        return body + "/Mesh/Mass/" + mass.name +
               "/Rigid is true, which has no stiffness of second order in the rotations of its groups: set "
               "it "
               "to false, or leave out the stress of the loads";
    return "";
  }

  void MeshFileParameters::check_masses(const std::string &section) const
  {
    if (!masses.empty() && is_wheel())
      throw InputError(section +
                       "/Masses is given, but Geometry is wheel, whose modes are named by their waves "
                       "around the axle, which a mass mixes: set Geometry to flat.");
    for (const PointMassParameters &mass : masses)
    {
      const std::string own = section + "/Mass/" + mass.name;
      mass.check(own);
      for (const std::string &group : mass.groups)
      {
        for (const HeldPart &part : held_parts(held_groups, section + "/Held groups"))
          if (part.boundary == group && (mass.rigid || part.holds_all()))
            throw InputError(
                own + "/Groups and Held groups both name '" + group + "': a mass on what is held " +
                (mass.rigid ? "is not rigid with it" : "does not move") + "; take it out of one of them.");
        if (mass.rigid && group == contact_group)
          throw InputError(own + "/Groups contains the contact group '" + group +
                           "', which Rigid would keep from deforming in contact: set Rigid to false or name "
                           "another group.");
      }
    }
  }

  void MeshFileParameters::check(const std::string &section) const
  {
    refinement.check(section);
    const std::vector<HeldPart> held = held_parts(held_groups, section + "/Held groups");
    for (const GluedPair &pair : glued_pairs(glued_groups, section + "/Glued"))
      for (const std::string &group : {pair.follower, pair.leader})
      {
        const auto refuse = [&](const std::string &entry)
        {
          throw InputError(section + "/Glued and " + entry + " both name '" + group +
                           "': a face is held, in contact, glued or on springs; take it out of one of them.");
        };
        if (group == contact_group)
          refuse("Contact group");
        for (const HeldPart &part : held)
          if (part.boundary == group)
            refuse("Held groups");
        if (std::count(foundation_groups.begin(), foundation_groups.end(), group) > 0)
          refuse("Foundation groups");
      }
    if (file.empty())
      throw InputError(section + "/File is empty: give the path of a mesh file.");
    if (!std::ifstream(file) || std::filesystem::is_directory(file))
      throw InputError(section + "/File: cannot read " + file + "; give the path of an existing file.");
    for (const HeldPart &part : held)
      if (part.boundary == contact_group)
        throw InputError(section + "/Held groups contains the contact group '" + contact_group +
                         "': a held face cannot deform in contact; take it out of the list.");
    const bool some = any_of(foundation_stiffness);
    const bool all = std::all_of(foundation_stiffness.begin(), foundation_stiffness.end(),
                                 [](const double k) { return k > 0; });
    if (some && foundation_groups.empty())
      throw InputError(section + "/Foundation stiffness is given without Foundation groups: name the groups "
                                 "that stand on springs.");
    if (any_of(foundation_damping) && foundation_groups.empty())
      throw InputError(section +
                       "/Foundation damping is given without Foundation groups: name the groups that "
                       "stand on dashpots, which are beside springs.");
    check_masses(section);
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
    if (is_cad_file(file))
      cad.check(section, file, unit, element_degree, group_names_of(supporting_groups(section)));
  }

  namespace
  {
    /// Between a milligram and a thousand tonnes: a mesh of millimetres taken for metres has 1e9 times its mass.
    void check_mass(const ElasticModel<3> &model, const MeshFileParameters &parameters,
                    const BodyMesh<3> &mesh)
    {
      double mass = 0;
      for (const auto &cell : mesh.triangulation->active_cell_iterators())
        if (cell->is_locally_owned())
          mass += cell->measure() * model.material_of(cell->material_id()).density;
      mass = Utilities::MPI::sum(mass, mesh.triangulation->get_communicator());
      if (mass >= 1e-6 && mass <= 1e6)
        return;
      std::ostringstream text;
      text << "Body " << mesh.name << " of the mesh file " << parameters.file << " would have a mass of "
           << mass << " kg with Unit = " << parameters.unit << " m and the density of " << mesh.name
           << "/Material: set Unit (0.001 for a file in mm), or the density in kg/m^3.";
      throw InputError(text.str());
    }
  } // namespace

  void add_supports(ElasticModel<3> &model, const MeshFileParameters &parameters, const BodyMesh<3> &mesh)
  {
    check_mass(model, parameters, mesh);
    for (const HeldPart &part : held_parts(parameters.held_groups, "Held groups"))
      model.held.emplace_back(mesh.boundary_id(part.boundary), part.directions);
    for (const std::string &group : parameters.foundation_groups)
    {
      SpringBed<3> bed;
      bed.boundary = mesh.boundary_id(group);
      for (unsigned int d = 0; d < 3; ++d)
      {
        bed.stiffness_per_area[d] = parameters.foundation_stiffness.at(d);
        bed.damping_per_area[d] = parameters.foundation_damping.at(d);
      }
      bed.loss_factor = parameters.foundation_loss_factor;
      model.springs.push_back(bed);
    }
    for (const PointMassParameters &given : parameters.masses)
    {
      PointMass mass;
      mass.name = given.name;
      for (const std::string &group : given.groups)
        mass.boundaries.push_back(mesh.boundary_id(group));
      mass.rigid = given.rigid;
      mass.mass = given.mass;
      mass.inertia = given.inertia_tensor();
      if (!given.place.empty())
      {
        mass.place.emplace();
        for (unsigned int d = 0; d < 3; ++d)
          (*mass.place)[d] = parameters.unit * (given.place[d] - parameters.contact_point.at(d));
      }
      model.masses.push_back(mass);
    }
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
    entries.add(section, "File, Unit, Contact point, Held groups, Foundation groups, Glued, "
                         "Geometry, Element degree");
    entries.add_if(use.contact, "the body is in contact", section, "Contact group");
    const bool springs = !foundation_groups.empty();
    entries.add_if(springs, "there are Foundation groups", section, "Foundation stiffness");
    entries.add_if(springs && use.loss, "there are Foundation groups and the body moves", section,
                   "Foundation loss factor, Foundation damping");
    const bool weighs = use.motion || use.heavy;
    entries.add_if(weighs || std::any_of(masses.begin(), masses.end(),
                                         [](const PointMassParameters &mass) { return mass.rigid; }),
                   "the body moves or has a Gravity, or a mass is Rigid", section, "Masses");
    for (const PointMassParameters &mass : masses)
      entries.add_if(weighs || mass.rigid, "the body moves or has a Gravity, or the mass is Rigid",
                     section + "/Mass/" + mass.name,
                     "Groups, Rigid, Mass, Place, Inertia, Products of inertia");
    entries.add_if(is_wheel(), "Geometry is wheel", section, "Wheel outline, Wheel scale");
    const bool is_cad = is_cad_file(file);
    entries.add_if(!is_cad, "File is a mesh", section, "Split into tetrahedra");
    if (!is_cad)
      refinement.add_entries(entries, section, use);
    cad.add_entries(entries, section, is_cad);
    return true;
  }

  std::pair<std::string, std::string> MeshFileParameters::missing_support(const std::string &name) const
  {
    if (!is_supported())
      return {name + "/Mesh/Held groups and Foundation groups are empty",
              "hold at least one of the file's groups or put it on springs"};
    std::array<bool, 3> carried = {};
    for (const HeldPart &part : held_parts(held_groups, name + "/Mesh/Held groups"))
      for (unsigned int d = 0; d < 3; ++d)
        carried[d] = carried[d] || part.directions[d];
    for (unsigned int d = 0; d < 3; ++d)
      if (!carried[d] && (foundation_groups.empty() || !(foundation_stiffness[d] > 0)))
        return {name + "/Mesh/Held groups and Foundation groups leave " + std::string(1, "xyz"[d]) + " free",
                "hold a group along it too or put one on springs"};
    return {};
  }

  BodyMesh<3> MeshFileParameters::make_mesh(const MeshRequest &request) const
  {
    return make_mesh_from_file(*this, request.lateral_position, request.grid, request.name,
                               request.communicator, request.materials, request.mesh_folder);
  }

  void MeshFileParameters::hold(ElasticModel<3> &model, const BodyMesh<3> &mesh) const
  {
    add_supports(model, *this, mesh);
  }

  std::vector<GluedPair> MeshFileParameters::glued(const std::string &body) const
  {
    return glued_pairs(glued_groups, body + "/Mesh/Glued");
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
