#pragma once

#include <vibrocontact/scene/body_description.h>
#include <vibrocontact/scene/contact_refinement.h>
#include <vibrocontact/scene/section_parameters.h>
#include <vibrocontact/scene/web_thickness.h>
#include <vibrocontact/scene/wheel_damper.h>

#include <functional>
#include <utility>

namespace vibrocontact
{
  /// A wheel: its half section revolved about the axle.
  ///
  ///      z ^
  ///        |   - - - - - axle - - - - -     the axle lies at z = tread radius above the contact point,
  ///        |        ___________             which is the origin; y = axial position in the section less
  ///        |       |___________|  bore      the lateral position of the contact
  ///        |           | |     hub
  ///        |           | |     web          boundaries: bore, contact (the tread), surface (all else)
  ///        |     |\____| |____
  ///        |     |____________|  rim
  ///      --+-----------*-----------> y      tread, z = 0
  ///           flange
  struct WheelParameters : SolidBody, RevolvedBody
  {
    SectionParameters section{"wheel", {"bore", "tread"}};
    /// beside the drawing, by harmonics
    WebThickness web;
    /// solid: hexahedra all around; harmonics: elements of the section, one problem for each number of waves
    std::string model = "solid";
    /// waves around the axle that the contact compliance is summed over; a half-space has the shorter ones
    unsigned int n_harmonics = 40;
    /// turns past the contact with the speed of rolling: its modes become waves around the axle
    bool rotation = false;
    /// what damps it besides its materials, by harmonics
    std::vector<WheelDamper> dampers;
    /// those of the file that an option has put out of use
    std::vector<WheelDamper> unlisted_dampers;
    /// gmsh file to write the coarse mesh to; empty: none
    std::string write_mesh;
    /// similar wheels: all lengths times this factor
    double scale = 1;
    /// circumferential lengths of cells on the tread: at the contact, and largest far from it [m]; growth
    double contact_division = 0.008, coarse_division = 0.055, growth = 1.6;
    /// the fine divisions reach this far to either side of the contact [m]
    double fine_length = 0.016;
    ContactRefinement refinement;
    /// names of the dampers as written
    std::string dampers_entry;
    /// how the section's points move from where they are drawn (web) @param path of the wheel's section in the file
    std::function<dealii::Point<2>(const dealii::Point<2> &)> web_motion(const SectionOutline &outline,
                                                                         const std::string &path) const;

    void declare_parameters(dealii::ParameterHandler &prm) override;
    void check(const std::string &path) const override;
    bool add_entries(EntriesRead &entries, const std::string &section, const BodyUse &use) const override;
    void read_ahead(const ParameterFile &file, const std::string &section) override;
    bool is_by_harmonics() const { return model == "harmonics"; }
    const SolidBody *solid() const override { return is_by_harmonics() ? nullptr : this; }
    const RevolvedBody *revolved() const override { return is_by_harmonics() ? this : nullptr; }
    ContactPlaces contact_places() const override
    {
      return is_by_harmonics() ? ContactPlaces::own : ContactPlaces::anywhere;
    }
    bool takes_gravity() const override { return is_by_harmonics(); }
    bool rolls() const override { return is_by_harmonics() && rotation; }
    RevolvedMesh make_section(const MeshRequest &request) const override;
    BodyMesh<3> make_mesh(const MeshRequest &request) const override;
    void hold(ElasticModel<3> &model, const BodyMesh<3> &mesh) const override;
    const std::vector<WheelDamper> *wheel_dampers() const override { return &dampers; }
    unsigned int mesh_degree() const override { return section.element_degree; }
    bool has_groups() const override { return true; }
    bool is_wheel() const override { return true; }
    std::optional<SectionOutline> wheel_section() const override { return section.read_outline(scale); }
    double size_over_section() const override { return scale; }
    bool writes_mesh() const override { return !write_mesh.empty(); }
    void write_no_mesh() override { write_mesh.clear(); }
  };

  /// @param lateral_position y of the contact in the section [m]
  /// @param grid contact grid to refine for; null: none
  /// @param materials groups of the section with a material each; empty: one material
  /// @throws InputError if the contact does not lie on the tread.
  BodyMesh<3> make_wheel(const WheelParameters &parameters, const double lateral_position,
                         const ContactGrid *grid, const std::string &name, const MPI_Comm communicator,
                         const std::vector<std::string> &materials = {});

  /// Attach the manifolds of a body of revolution to a coarse mesh by geometry: also used for a wheel that
  /// was read from a mesh file. Returns the outline's row of every boundary face, by cell and face number in
  /// mesh order.
  std::vector<unsigned int> attach_wheel_manifolds(dealii::Triangulation<3> &triangulation,
                                                   const SectionOutline &outline, const double axis_height,
                                                   const double shift);

  /// Axial positions between which the tread lies, fillets left out [m].
  std::pair<double, double> tread_limits(const SectionOutline &outline);

  /// Radius of the tread at an axial position [m].
  double tread_radius(const SectionOutline &outline, const double lateral_position);
} // namespace vibrocontact
