#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/scene/body_mesh.h>

namespace vibrocontact
{
  template <int dim>
  dealii::types::boundary_id BodyMesh<dim>::boundary_id(const std::string &boundary) const
  {
    const auto found = boundaries.find(boundary);
    if (found != boundaries.end())
      return found->second;

    // Faces of the coarse mesh are known on every rank.
    std::map<dealii::types::boundary_id, unsigned int> n_faces;
    for (const auto &cell : triangulation->cell_iterators_on_level(0))
      for (const unsigned int f : cell->face_indices())
        if (cell->face(f)->at_boundary())
          ++n_faces[cell->face(f)->boundary_id()];
    std::string list;
    for (const auto &entry : boundaries)
      list +=
          (list.empty() ? "" : ", ") + entry.first + " (" + std::to_string(n_faces[entry.second]) + " faces)";
    throw InputError("Body " + name + " has no boundary named '" + boundary + "'; " +
                     (list.empty() ? "its mesh has no named boundary: name one in the mesh."
                                   : "use one of those that its mesh has: " + list + "."));
  }

  template struct BodyMesh<2>;
  template struct BodyMesh<3>;
} // namespace vibrocontact
