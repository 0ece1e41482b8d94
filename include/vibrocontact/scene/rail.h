#pragma once

#include <vibrocontact/scene/body_description.h>
#include <vibrocontact/scene/contact_refinement.h>
#include <vibrocontact/scene/elastic_model.h>
#include <vibrocontact/scene/rail_supports.h>
#include <vibrocontact/scene/section_parameters.h>
#include <vibrocontact/scene/track_supports.h>

namespace vibrocontact
{
  /// A rail: its section extruded along x, on pads, with free ends that may be anechoic.
  ///
  ///      anechoic                contact                anechoic       x = 0 at the contact,
  ///   |=====|=====|-----------------*-----------------|=====|=====|    z = 0 on the crown
  ///      []    []    []    []    []    []    []    []    []    []      pads: spread springs to rigid ground
  ///
  /// Boundaries: foot (underside), contact (the crown), end left, end right, surface (all else).
  ///
  /// Or, Model = periodic: its section on supports, infinitely many equal ones or some laid one by one
  /// (waveguide/periodic_track.h), in contact by its receptance, roots being sought from poles near that. It is then no solid,
  /// and sleepers on ballast may carry the pads.
  struct RailParameters : SolidBody, RailSupports
  {
    /// solid or periodic
    std::string model = "solid";
    SectionParameters section{"rail_60e1", {"foot", "crown"}};
    /// position of the contact on the crown, from the symmetry plane [m]
    double lateral_position = 0;
    /// lengths of cells along the rail: at the contact and far from it [m]; growth
    double contact_division = 0.008, coarse_division = 0.12, growth = 1.6;
    /// the fine divisions reach this far to either side of the contact [m]
    double fine_length = 0.016;
    ContactRefinement refinement;
    /// periodic: how far the contact stands beyond where RailSupports::contact_at says, along x [m]
    double contact_offset = 0;
    /// periodic: sleepers, and supports that are laid one by one
    TrackSupports track;
    /// periodic, in contact: pairs of poles near its receptance, up to a frequency, from which roots are sought [Hz]
    unsigned int n_pole_pairs = 24;
    double fitted_up_to = 6000;

    bool is_periodic() const { return model == "periodic"; }
    void read_ahead(const ParameterFile &file, const std::string &section) override;
    const SolidBody *solid() const override { return is_periodic() ? nullptr : this; }
    void declare_parameters(dealii::ParameterHandler &prm) override;
    void check(const std::string &path) const override;
    bool add_entries(EntriesRead &entries, const std::string &section, const BodyUse &use) const override;
    std::pair<std::string, std::string> missing_support(const std::string &name) const override;
    BodyMesh<3> make_mesh(const MeshRequest &request) const override;
    void hold(ElasticModel<3> &model, const BodyMesh<3> &mesh) const override;
    unsigned int mesh_degree() const override { return section.element_degree; }
    bool has_groups() const override { return true; }
    const RailParameters *periodic_rail() const override { return is_periodic() ? this : nullptr; }
    ContactPlaces contact_places() const override
    {
      return is_periodic() ? ContactPlaces::own : SolidBody::contact_places();
    }
    bool lies_below() const override { return is_periodic(); }
    bool may_stand_for_half_space() const override { return !is_periodic(); }
    bool has_loss() const override { return supports_lose_energy(); }
  };

  /// @param materials groups of the section with a material each; empty: one material. Material ids of the
  ///   cells: group + number of groups * anechoic piece, 0 being the rail between them.
  BodyMesh<3> make_rail(const RailParameters &parameters, const ContactGrid *grid, const std::string &name,
                        const MPI_Comm communicator, const std::vector<std::string> &materials = {});

  /// Pads and anechoic zones of the rail, to be added to the model of @p mesh (a mesh of make_rail), which has
  /// the materials of its groups.
  void add_supports(ElasticModel<3> &model, const RailParameters &parameters, const BodyMesh<3> &mesh);
} // namespace vibrocontact
