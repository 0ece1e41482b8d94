#include <vibrocontact/base/collective.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/scene/cad_meshing.h>
#include <vibrocontact/scene/element_type.h>
#include <vibrocontact/scene/mesh_quality.h>

#include <boost/serialization/map.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  using namespace dealii;

  void CadMeshing::declare_parameters(ParameterHandler &prm)
  {
    using Patterns::Double;
    prm.enter_subsection("CAD");
    prm.add_parameter("Faces", faces,
                      "Groups of faces, separated by semicolons: contact: plane z = 0.01; held: cylinder z "
                      "0.005 at 0 0.1; side: number 5 6; back: box x0 y0 z0 x1 y1 z1; pad: name text in the "
                      "file. Units: unit of the file; m for STEP.",
                      Patterns::Anything());
    prm.add_parameter("Cell size", cell_size,
                      "Edge of the tetrahedra that a STEP or BREP file is meshed with. Units: unit of the "
                      "file; m for STEP.",
                      Double(0, 1e5));
    prm.add_parameter("Contact cell size", contact_cell_size,
                      "The same at the faces of Contact group; 0: as elsewhere. Units: unit of the file; m "
                      "for STEP.",
                      Double(0, 1e5));
    prm.add_parameter("Growth distance", growth_distance,
                      "Distance from these faces over which Contact cell size becomes Cell size; 0: five "
                      "times Cell size. Units: unit of the file; m for STEP.",
                      Double(0, 1e5));
    prm.add_parameter("Cells around a circle", cells_around_circle,
                      "On a curved face at least so many cells around a whole circle, smaller than Cell size "
                      "where need be; 0: not looked at. Units: none.",
                      Patterns::Integer(0, 1000));
    prm.add_parameter("Write mesh", copy, "Writes the mesh to this file (.msh); empty: none. Units: none.",
                      Patterns::FileName(Patterns::FileName::output));
    prm.leave_subsection();
  }

  void CadMeshing::add_entries(EntriesRead &entries, const std::string &section, const bool is_cad) const
  {
    const std::string own = section + "/CAD", condition = "File is a STEP or BREP file";
    entries.add_if(is_cad, condition, own,
                   "Faces, Cell size, Contact cell size, Cells around a circle, Write mesh");
    entries.add_if(is_cad && contact_cell_size > 0, condition + " and there is a Contact cell size", own,
                   "Growth distance");
  }

  std::map<std::string, std::vector<int>>
  CadMeshing::face_groups(const CadPart &part, const std::string &file, const std::string &entry) const
  {
    return chosen_faces(face_rules(faces, entry), part, entry, file);
  }

  void CadMeshing::check(const std::string &section, const std::string &file, const double unit,
                         const unsigned int degree, const std::vector<std::string> &groups) const
  {
    const std::string own = section + "/CAD/";
    if (has_own_unit(file) && unit != 1)
      throw InputError(section + "/Unit is " + number_text(unit) + ", but the CAD file " + file +
                       " says its unit itself and is read in m: leave it out.");
    const CadPart part = read_cad_part(file);
    const double size = unit * part.size();
    if (size > 100 || size < 1e-3)
      throw InputError("The CAD file " + file + " describes a part of " + number_text(size) +
                       " m: save it with the right unit in the program that made it" +
                       (has_own_unit(file) ? "." : ", or set " + section + "/Unit."));
    if (!(cell_size > 0))
      throw InputError(own + "Cell size is not set: give the edge of a cell for " + file +
                       ", whose size is " + number_text(part.size()) + " and whose volume is " +
                       number_text(part.volume) + ".");
    if (contact_cell_size > cell_size)
      throw InputError(own + "Contact cell size is " + number_text(contact_cell_size) +
                       ", above the Cell size of " + number_text(cell_size) + ": make it smaller, or 0.");
    const auto chosen = face_groups(part, file, own + "Faces");
    for (const std::string &group : groups)
      if (chosen.count(group) == 0)
      {
        std::string list;
        for (const auto &one : chosen)
          list += (list.empty() ? "" : ", ") + one.first;
        throw InputError(section + " names the group '" + group + "', but " + own + "Faces has " +
                         (list.empty() ? "none" : "only " + list) + ": add an item such as " + group +
                         ": plane z = 0.");
      }
    // a tetrahedron of edge h has the volume h^3 / (6 sqrt 2)
    const double n_cells = 6 * std::sqrt(2.) * part.volume / std::pow(cell_size, 3);
    check_number_of_cells<3>(n_cells * element_type(4)->cubes(), degree, section,
                             "make " + own + "Cell size larger");
  }

  FileMesh CadMeshing::mesh(const std::string &section, const std::string &file, const unsigned int degree,
                            const std::string &fine_group, const std::string &folder,
                            const MPI_Comm communicator) const
  {
    FileMesh result;
    on_first_rank(
        [&]
        {
          const auto groups = face_groups(read_cad_part(file), file, section + "/CAD/Faces");
          CadSizes sizes;
          sizes.cell_size = cell_size;
          sizes.fine_size = contact_cell_size;
          sizes.growth = contact_cell_size == 0 ? 0 : growth_distance > 0 ? growth_distance : 5 * cell_size;
          sizes.cells_around_circle = cells_around_circle;
          sizes.order = std::min(degree, 2u);
          const auto fine = groups.find(fine_group);
          result = mesh_cad_part(file, sizes, groups,
                                 fine == groups.end() || contact_cell_size == 0 ? std::vector<int>()
                                                                                : fine->second,
                                 copy, folder, keeps);
        },
        communicator);
    return Utilities::MPI::broadcast(communicator, result);
  }

  std::optional<FlatFace> CadMeshing::flat_face(const std::string &file, const std::string &group,
                                                const std::vector<double> &place, const double unit) const
  {
    const CadPart part = read_cad_part(file);
    const auto groups = face_groups(part, file, "CAD/Faces");
    const auto own = groups.find(group);
    if (own == groups.end())
      return {};
    FlatFace result{1e300, -1e300, 1e300, -1e300};
    double area = 0;
    for (const CadFace &face : part.faces)
    {
      if (std::count(own->second.begin(), own->second.end(), int(face.number)) == 0)
        continue;
      if (!face.is_plane() || std::abs(face.place[2] - place.at(2)) > 1e-5 * part.size() ||
          std::abs(std::abs(face.direction[2]) - 1) > 1e-8)
        return {};
      area += unit * unit * face.area;
      result.x_low = std::min(result.x_low, unit * (face.low[0] - place.at(0)));
      result.x_high = std::max(result.x_high, unit * (face.high[0] - place.at(0)));
      result.y_low = std::min(result.y_low, unit * (face.low[1] - place.at(1)));
      result.y_high = std::max(result.y_high, unit * (face.high[1] - place.at(1)));
    }
    const double whole = (result.x_high - result.x_low) * (result.y_high - result.y_low);
    if (!(area > 0) || std::abs(area / whole - 1) > 1e-6)
      return {};
    return result;
  }
} // namespace vibrocontact
