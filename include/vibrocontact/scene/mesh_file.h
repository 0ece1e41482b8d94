#pragma once

#include <vibrocontact/scene/body_description.h>
#include <vibrocontact/scene/cad_meshing.h>
#include <vibrocontact/scene/contact_refinement.h>
#include <vibrocontact/scene/elastic_model.h>
#include <vibrocontact/scene/flat_face.h>
#include <vibrocontact/scene/point_mass.h>

#include <vibrocontact/scene/section.h>

#include <optional>
#include <string>
#include <vector>

namespace vibrocontact
{
  struct NamedGroup;

  /// A body from a mesh file of another program, or from a CAD file that is meshed here: cells of one type, whose boundary groups are found by their names.
  ///
  /// The file's axes are those of the contact (z up, x the rolling line); its nominal contact point is moved
  /// to the origin. Faces of no group belong to `surface`.
  struct MeshFileParameters : SolidBody
  {
    /// mesh file, see read_file_mesh()
    std::string file;
    /// length of the file's unit [m]
    double unit = 1;
    /// nominal contact point in the file [unit of the file]
    std::vector<double> contact_point = {0, 0, 0};
    /// names of the groups
    std::string contact_group = "contact";
    std::vector<std::string> held_groups;
    /// groups that stand on springs to rigid ground (the pads of a rail), stiffness per area in x, y, z
    /// [N/m^3], hysteretic loss factor [-]
    std::vector<std::string> foundation_groups;
    std::vector<double> foundation_stiffness = {0, 0, 0};
    double foundation_loss_factor = 0;
    /// of dashpots beside these springs, per area in x, y, z [N s/m^3]
    std::vector<double> foundation_damping = {0, 0, 0};
    /// rigid masses coupled to groups; those that the file has sections of and an option leaves out
    std::vector<PointMassParameters> masses, unlisted_masses;
    /// hexahedra, prisms and pyramids become tetrahedra, split_into_tetrahedra()
    bool split = false;
    /// groups of parts whose meshes do not match, glued_pairs()
    std::string glued_groups;
    /// flat: cells as they are; wheel: arcs of a wheel's outline are attached as to the built-in one
    std::string geometry = "flat";
    /// for geometry = wheel: outline, empty the built-in one, and similarity factor
    std::string wheel_outline;
    double wheel_scale = 1;
    unsigned int element_degree = 2;
    ContactRefinement refinement;
    /// of a STEP or BREP file, whose mesh is taken as it is
    CadMeshing cad;

    void read_ahead(const ParameterFile &file, const std::string &section) override;
    void declare_parameters(dealii::ParameterHandler &prm) override;
    void check(const std::string &section) const override;
    bool add_entries(EntriesRead &entries, const std::string &section, const BodyUse &use) const override;
    std::pair<std::string, std::string> missing_support(const std::string &name) const override;
    BodyMesh<3> make_mesh(const MeshRequest &request) const override;
    void hold(ElasticModel<3> &model, const BodyMesh<3> &mesh) const override;
    std::vector<GluedPair> glued(const std::string &body) const override;
    std::string in_the_way_of_prestress(const std::string &body) const override;
    unsigned int mesh_degree() const override { return element_degree; }
    bool has_groups() const override { return true; }
    bool may_turn() const override { return true; }
    bool has_loss() const override { return foundation_loss_factor > 0 || has_dashpots(); }
    bool has_dashpots() const;
    std::optional<FlatFace> flat_face(double lateral_position) const override;
    std::optional<SectionOutline> wheel_section() const override;
    std::string way_to_turn(const std::string &name, bool above) const override;
    void write_no_mesh() override { cad.write_nothing(); }
    bool is_wheel() const override { return geometry == "wheel"; }
    /// held, or on springs that resist every direction: no motion without force
    bool is_supported() const { return !held_groups.empty() || !foundation_groups.empty(); }
    /// The groups that the section names but for that in contact, each once per entry.
    std::vector<NamedGroup> supporting_groups(const std::string &section) const;

  private:
    void check_masses(const std::string &section) const;
    std::string masses_entry;
  };

  /// @param lateral_position used with geometry = wheel: y of the contact in the wheel's section [m]
  /// @param grid contact grid to refine for; null: the body has no contact, no contact group is needed
  /// @param materials groups of cells with a material each; empty: one material
  /// @param mesh_folder where meshes of CAD parts are kept; empty: nowhere
  /// @throws InputError for a missing group (with the names there and their face counts), what check_cells()
  ///   finds, or a size that looks like another unit.
  BodyMesh<3> make_mesh_from_file(const MeshFileParameters &parameters, const double lateral_position,
                                  const ContactGrid *grid, const std::string &name,
                                  const MPI_Comm communicator, const std::vector<std::string> &materials = {},
                                  const std::string &mesh_folder = "");

  /// Held groups and foundation of the body, to be added to the model of @p mesh (a mesh of
  /// make_mesh_from_file).
  void add_supports(ElasticModel<3> &model, const MeshFileParameters &parameters, const BodyMesh<3> &mesh);

  /// The rectangle along x and y that the contact group fills, if it is flat at the nominal contact point's
  /// height and fills one; nothing otherwise. Reads the file.
  std::optional<FlatFace> flat_contact_group(const MeshFileParameters &parameters);

  /// The outline of a mesh with geometry = wheel.
  SectionOutline wheel_outline(const MeshFileParameters &parameters);
} // namespace vibrocontact
