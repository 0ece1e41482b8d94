#pragma once

#include <deal.II/base/point.h>

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// A face of a CAD part [unit of the part].
  struct CadFace
  {
    /// gmsh's number, from 1
    unsigned int number = 0;
    /// "Plane", "Cylinder", ... as gmsh calls its surface
    std::string surface;
    /// in the file; empty: none
    std::string name;
    /// names of the solids that it bounds: one, of solids that share it two
    std::vector<std::string> solids;
    double area = 0;
    dealii::Point<3> centre;
    /// corners of a box around it
    dealii::Point<3> low, high;
    /// of a plane a point and the normal, of a cylinder a point on the axis and the axis
    dealii::Point<3> place;
    dealii::Tensor<1, 3> direction;
    /// of a cylinder
    double radius = 0;

    bool is_plane() const { return surface == "Plane"; }
    bool is_cylinder() const { return surface == "Cylinder"; }
    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &number &surface &name &solids &area &centre &low &high &place &direction &radius;
    }
  };

  /// A solid of a CAD part [unit of the part].
  struct CadSolid
  {
    /// gmsh's number
    int number = 0;
    /// of its cells' group: "solid" if it is the only one, otherwise as in the file, without one solid1, solid2, ...
    std::string name;
    double volume = 0;
    dealii::Point<3> centre;
    /// numbers of its faces
    std::vector<int> faces;

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &number &name &volume &centre &faces;
    }
  };

  /// The solids of a CAD file and their faces.
  struct CadPart
  {
    std::vector<CadSolid> solids;
    std::vector<CadFace> faces;
    /// of all solids
    double volume = 0;

    /// diagonal of the box around all faces
    double size() const;
    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &solids &faces &volume;
    }
  };

  /// What an item of the entry Faces says: which faces belong to a group.
  struct FaceRule
  {
    std::string group;
    /// as written: "plane z = 0.01"
    std::string text;
    std::function<bool(const CadFace &, double tolerance)> holds;
  };

  /// Reads "contact: plane z = 0.01; held: cylinder z 0.005 at 0 0.1; side: number 5; rest: box 0 0 0 1 1 1; pad: name back".
  ///
  /// | number N ... | gmsh's numbers |
  /// | plane x = a | planes across an axis, there |
  /// | cylinder z r [at x y] | cylinders along an axis with a radius, about this place if one is given |
  /// | box x0 y0 z0 x1 y1 z1 | faces that lie in it |
  /// | name text | of the file |
  ///
  /// Behind number, plane, cylinder and box may stand "of NAME": of the faces of that solid alone.
  /// A group may have several items.
  /// @param entry where it stands, for messages @throws InputError
  std::vector<FaceRule> face_rules(const std::string &text, const std::string &entry);

  /// Numbers of the faces of each group.
  /// @throws InputError for an item that chooses none (with the faces there are), and for a face of two groups
  std::map<std::string, std::vector<int>> chosen_faces(const std::vector<FaceRule> &rules,
                                                       const CadPart &part, const std::string &entry,
                                                       const std::string &file);
} // namespace vibrocontact
