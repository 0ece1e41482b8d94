#pragma once

#include <vibrocontact/base/entries_read.h>
#include <vibrocontact/scene/section.h>

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// The cross-section of a wheel or a rail and its elements: the entries that both have in common.
  struct SectionParameters
  {
    /// @param built_in name of the section that comes with the program (meshes/<name>_section.msh and
    /// <name>_outline.txt): wheel, rail_60e1
    /// @param parts of the outline that mean something to the body
    SectionParameters(const std::string &built_in, const std::vector<std::string> &parts)
        : built_in(built_in), parts(parts)
    {
    }

    /// files; both empty: the section that comes with the program; an outline alone is meshed by gmsh (scene/drawn_section.h)
    std::string mesh, outline;
    /// of the cells of an outline that is given alone [m]
    double cell_size = 0.015;
    /// halvings of the section's cells
    unsigned int refinements = 0;
    /// polynomial degree of the displacements
    unsigned int element_degree = 2;

    /// Entries `Section mesh`, `Section outline`, `Section cell size`, `Section refinements`, `Element degree`.
    /// @param coordinates what the two coordinates of the section are, for the reader of the file
    void declare_parameters(dealii::ParameterHandler &prm, const std::string &coordinates);
    void check(const std::string &section) const;
    void add_entries(EntriesRead &entries, const std::string &section) const;
    bool is_drawn() const { return mesh.empty() && !outline.empty(); }
    bool is_built_in() const { return mesh.empty() && outline.empty(); }

    /// @param scale factor on all lengths
    /// @throws InputError if it is no outline of a section, see check_outline()
    SectionOutline read_outline(double scale = 1) const;
    /// @param mirrored the outline is one half of the section
    SectionMesh read_mesh(const SectionOutline &outline, bool mirrored, const GroupMaterials &materials,
                          double scale = 1) const;

  private:
    std::string built_in;
    std::vector<std::string> parts;
  };
} // namespace vibrocontact
