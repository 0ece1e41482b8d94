#pragma once

#include <vibrocontact/scene/contact_refinement.h>
#include <vibrocontact/scene/elastic_model.h>
#include <vibrocontact/scene/section_parameters.h>

namespace vibrocontact
{
  /// A rail: its section extruded along x, on pads, with free ends that may be anechoic.
  ///
  ///      anechoic                contact                anechoic       x = 0 at the contact,
  ///   |=====|=====|-----------------*-----------------|=====|=====|    z = 0 on the crown
  ///      []    []    []    []    []    []    []    []    []    []      pads: spread springs to rigid ground
  ///
  /// Boundaries: foot (underside), contact (the crown), end left, end right, surface (all else).
  struct RailParameters
  {
    SectionParameters section{"rail_60e1"};
    /// length of the rail [m]; the contact is at its middle
    double length = 12;
    /// position of the contact on the crown, from the symmetry plane [m]
    double lateral_position = 0;
    /// where the contact stands: mid-span or support
    std::string contact_at = "mid-span";
    /// distance of the supports and length of a pad [m]
    double sleeper_spacing = 0.6, pad_length = 0.15;
    /// stiffness of one pad in x, y, z [N/m]; all zero: a free rail
    double pad_stiffness_x = 36e6, pad_stiffness_y = 36e6, pad_stiffness_z = 180e6;
    double pad_loss_factor = 1;
    /// lengths of the anechoic pieces from inside to outside [m]; empty: plain free ends
    std::vector<double> anechoic_lengths;
    /// loss factors of the innermost and the outermost piece, geometric steps between
    double anechoic_loss_first = 0.1, anechoic_loss_last = 1;
    /// lengths of cells along the rail: at the contact and far from it [m]; growth
    double contact_division = 0.008, coarse_division = 0.12, growth = 1.6;
    /// the fine divisions reach this far to either side of the contact [m]
    double fine_length = 0.016;
    ContactRefinement refinement;

    void declare_parameters(dealii::ParameterHandler &prm);
    void check(const std::string &path) const;
    bool has_pads() const { return pad_stiffness_x > 0 || pad_stiffness_y > 0 || pad_stiffness_z > 0; }
    /// x of the supports' centres on the rail [m]
    std::vector<double> supports() const;
  };

  BodyMesh<3> make_rail(const RailParameters &parameters, const ContactGrid *grid, const std::string &name,
                        const MPI_Comm communicator);

  /// Pads and anechoic zones of the rail, to be added to the model of @p mesh (a mesh of make_rail).
  void add_supports(ElasticModel<3> &model, const RailParameters &parameters, const BodyMesh<3> &mesh);
} // namespace vibrocontact
