#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/scene/drawn_section.h>
#include <vibrocontact/scene/outline_check.h>
#include <vibrocontact/scene/section_parameters.h>

namespace vibrocontact
{
  void SectionParameters::declare_parameters(dealii::ParameterHandler &prm, const std::string &coordinates)
  {
    using namespace dealii::Patterns;
    prm.add_parameter("Section mesh", mesh,
                      "gmsh file of the section's quadrilaterals (" + coordinates +
                          "; m); empty: the one that comes with the program. Units: none.",
                      FileName());
    prm.add_parameter(
        "Section outline", outline,
        "Outline of the section, lines and arcs or corners (see meshes/README.md); empty: the one that comes "
        "with the program. Given without Section mesh it is meshed by gmsh. Units: none.",
        FileName());
    prm.add_parameter("Section cell size", cell_size,
                      "Size of the cells of an outline that is given without Section mesh. Units: m.",
                      Double(1e-4));
    prm.add_parameter("Section refinements", refinements, "Halvings of the section's cells. Units: none.",
                      Integer(0, 3));
    prm.add_parameter("Element degree", element_degree,
                      "Polynomial degree of the displacements. Units: none.", Integer(1, 4));
  }

  void SectionParameters::check(const std::string &section) const
  {
    if (!mesh.empty() && outline.empty())
      throw InputError(section +
                       "/Section mesh is given without Section outline: give both, or the outline alone.");
  }

  void SectionParameters::add_entries(EntriesRead &entries, const std::string &section) const
  {
    entries.add(section, "Section mesh, Section outline, Section refinements, Element degree");
    entries.add_if(is_drawn(), "Section outline is given without Section mesh", section, "Section cell size");
  }

  SectionOutline SectionParameters::read_outline(const double scale) const
  {
    if (outline.empty())
      return SectionOutline::read(mesh_directory() + "/" + built_in + "_outline.txt", scale);
    const SectionOutline result = SectionOutline::read(outline, scale);
    check_outline(result, parts, outline, scale);
    return result;
  }

  SectionMesh SectionParameters::read_mesh(const SectionOutline &outline_read, const bool mirrored,
                                           const GroupMaterials &materials, const double scale) const
  {
    if (is_drawn())
      return SectionMesh::make(mesh_outline(outline_read, cell_size, mirrored, outline), outline, 1.,
                               refinements, outline_read, mirrored, materials);
    return SectionMesh::read(mesh.empty() ? mesh_directory() + "/" + built_in + "_section.msh" : mesh, scale,
                             refinements, outline_read, mirrored, materials);
  }
} // namespace vibrocontact
