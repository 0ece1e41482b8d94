#pragma once

#include <vibrocontact/scene/cell_groups.h>

#include <deal.II/base/point.h>

#include <array>
#include <string>
#include <vector>

namespace vibrocontact
{
  struct GmshFile;

  /// Points of a section nearer to each other are one [m].
  constexpr double section_resolution = 2e-7;

  /// Outline of a cross-section: lines and circular arcs in coordinates (a, b), each belonging to a named
  /// part.
  ///
  /// Wheel: a axial, b radius. Rail: a lateral (right half, mirrored), b height above the underside.
  /// The files in meshes/ hold one row per curve, in mm; here everything is in metres. A file whose name ends in .csv holds
  /// one row per corner instead, `a, b, rounding radius, part[, region]`, each polygon closed: the part is that of the edge
  /// to the next corner, a rounding is an arc tangent to both edges.
  class SectionOutline
  {
  public:
    struct Row
    {
      bool is_arc = false;
      /// ends, and for arcs the centre; radius [m]
      dealii::Point<2> start, end, centre;
      double radius = 0;
      std::string part;
      /// of the file
      unsigned int line = 0;
      /// that this curve bounds: of several materials, each is drawn by itself
      std::string region;
    };

    /// @throws InputError if the file is missing or a row is not a curve.
    static SectionOutline read(const std::string &file, const double scale = 1);

    /// The row on which all points lie, or rows.size() if there is none.
    unsigned int find(const std::vector<dealii::Point<2>> &points) const;

    std::vector<Row> rows;

  private:
    bool contains(const Row &row, const dealii::Point<2> &p) const;
    double tolerance = 1e-7;
  };

  /// Quadrilaterals of a cross-section, all positively oriented in (a, b), deal.II's vertex order.
  struct SectionMesh
  {
    std::vector<dealii::Point<2>> vertices;
    std::vector<std::array<unsigned int, 4>> cells;
    /// position of each cell's material in the body's list, see material_numbers()
    std::vector<unsigned int> materials;

    /// Read a gmsh file of quadrilaterals (coordinates in metres, times @p scale).
    /// Each of @p refinements halves the cells, new nodes of the outline going onto its arcs; @p mirrored
    /// tells that the outline is one half of the section.
    /// @throws InputError for other elements, inverted cells, slivers, pieces that are not joined, cells
    ///   without a material, and a mesh of another size than its outline
    static SectionMesh read(const std::string &file, const double scale, const unsigned int refinements,
                            const SectionOutline &outline, const bool mirrored,
                            const GroupMaterials &materials);
    /// The same of cells that are there already. @param file where they come from, for messages
    static SectionMesh make(const GmshFile &gmsh, const std::string &file, const double scale,
                            const unsigned int refinements, const SectionOutline &outline,
                            const bool mirrored, const GroupMaterials &materials);
  };

  /// Folder of the meshes that come with the program.
  std::string mesh_directory();
} // namespace vibrocontact
