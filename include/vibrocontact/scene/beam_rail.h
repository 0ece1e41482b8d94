#pragma once

#include <vibrocontact/scene/body_description.h>
#include <vibrocontact/scene/rail_supports.h>

namespace vibrocontact
{
  /// A rail as a Timoshenko beam on discrete pads: bends in both planes, stretches, twists and warps; its
  /// section keeps its shape (fe/beam_elements.h). Good to about 2 kHz, thousands of times cheaper than the
  /// rail of finite elements; the local compliance of the contact is that of a half-space.
  ///
  ///        _____
  ///       (__ __)  * contact on the crown      heights above the underside:
  ///          |       + centroid 80.9 mm         the lateral shear force of a section without twist acts
  ///          |       x shear centre 46.3 mm     in its shear centre, so that a lateral contact force twists
  ///     _____|_____                             the rail by its lever of 126 mm
  ///       pads: points on x, or spread over Pad length; spread over Foot width
  ///
  /// Defaults: 60E1. A, Iy, Iz, centroid as in EN 13674-1; shear coefficient 0.4 as in Hamet (1999). Torsion
  /// constant, warping constant, shear centre and lateral shear coefficient by Saint-Venant's problems of the
  /// section, solved by finite elements on meshes/rail_60e1_section.msh (which give 0.393 vertically).
  struct BeamRailParameters : ElementBody, RailSupports
  {
    /// A [m^2]; second moments for vertical (about y) and lateral bending (about z) [m^4]
    double area = 76.71e-4, moment_y = 3038.8e-8, moment_z = 512.4e-8;
    /// Saint-Venant's torsion constant [m^4] and the warping constant about the shear centre [m^6]
    double torsion_constant = 220.6e-8, warping_constant = 1.599e-8;
    /// share of A that carries vertical and lateral shear [-]
    double shear_coefficient_z = 0.4, shear_coefficient_y = 0.55;
    /// heights above the underside of crown, centroid, shear centre [m]
    double height = 0.172, centroid_height = 0.08091, shear_centre_height = 0.0463;
    /// width of the foot, over which pads are spread; 0: pads hold the middle only [m]
    double foot_width = 0.15;
    /// radius of the crown [m]; 0: flat
    double crown_radius = 0.3;
    /// position of the contact on the crown, from the symmetry plane [m]
    double lateral_position = 0;
    /// longest element [m]; polynomial degree of the elements
    double element_length = 0.15;
    unsigned int degree = 4;

    void declare_parameters(dealii::ParameterHandler &prm) override;
    void check(const std::string &path) const override;
    bool add_entries(EntriesRead &entries, const std::string &section, const BodyUse &use) const override;
    void print(Log &log) const override;
    nlohmann::ordered_json sizes() const override;
    std::pair<std::string, std::string> missing_support(const std::string &name) const override;
    std::unique_ptr<SecondOrderSystem> assemble(const BodyParameters &body, bool above,
                                                const ContactGrid *grid,
                                                MPI_Comm communicator) const override;
    bool has_loss() const override { return supports_lose_energy(); }
    bool lies_below() const override { return true; }
    bool lies_on_half_space() const override { return true; }
    std::vector<std::vector<std::pair<dealii::types::global_dof_index, double>>>
    surface_rows(const std::string &name, double x, double y, double length) const override;
    /// height of the crown above the underside, y from the symmetry plane [m]
    double crown_height(double y) const;
  };
} // namespace vibrocontact
