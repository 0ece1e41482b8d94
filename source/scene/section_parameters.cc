#include <vibrocontact/base/exceptions.h>
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
        "Outline of the section, lines and arcs (see meshes/README.md); empty: the one that comes "
        "with the program. Units: none.",
        FileName());
    prm.add_parameter("Section refinements", refinements, "Halvings of the section's cells. Units: none.",
                      Integer(0, 3));
    prm.add_parameter("Element degree", element_degree,
                      "Polynomial degree of the displacements. Units: none.", Integer(1, 4));
  }

  void SectionParameters::check(const std::string &section) const
  {
    if (mesh.empty() != outline.empty())
      throw InputError(section +
                       (mesh.empty() ? "/Section outline is given without Section mesh"
                                     : "/Section mesh is given without Section outline") +
                       ": give both or none.");
  }

  SectionOutline SectionParameters::read_outline(const double scale) const
  {
    return SectionOutline::read(
        outline.empty() ? mesh_directory() + "/" + built_in + "_outline.txt" : outline, scale);
  }

  SectionMesh SectionParameters::read_mesh(const SectionOutline &outline_read, const bool mirrored,
                                           const GroupMaterials &materials, const double scale) const
  {
    return SectionMesh::read(mesh.empty() ? mesh_directory() + "/" + built_in + "_section.msh" : mesh, scale,
                             refinements, outline_read, mirrored, materials);
  }
} // namespace vibrocontact
