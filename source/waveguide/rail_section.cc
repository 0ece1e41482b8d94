#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/scene/section_manifolds.h>
#include <vibrocontact/waveguide/plane_section.h>
#include <vibrocontact/waveguide/rail_section.h>

namespace vibrocontact
{
  namespace
  {
    std::vector<SectionOutline::Row> crown_of(const BodyParameters &body, const RailParameters &rail)
    {
      std::vector<SectionOutline::Row> crown;
      for (const auto &row : rail.section.read_outline().rows)
        if (row.part == "crown")
          crown.push_back(row);
      if (crown.empty())
        throw InputError("The section outline of " + body.name +
                         " has no part crown: name the curves of the running surface so.");
      return crown;
    }

    std::vector<ElasticMaterial> materials_of(const BodyParameters &body)
    {
      std::vector<ElasticMaterial> result;
      for (const auto &group : body.materials)
        result.push_back(group.second);
      if (result.empty())
        result.push_back(body.material);
      return result;
    }

    std::unique_ptr<dealii::Triangulation<2>> mesh_of(const BodyParameters &body, const RailParameters &rail)
    {
      const SectionOutline outline = rail.section.read_outline();
      std::vector<std::string> groups;
      for (const auto &group : body.materials)
        groups.push_back(group.first);
      return plane_section(rail.section.read_mesh(outline, true, {body.name, groups}), outline);
    }
  } // namespace

  RailSection::RailSection(const BodyParameters &body, const RailParameters &rail)
      : crown(crown_of(body, rail)), lateral_position(rail.lateral_position),
        crown_height(height(rail.lateral_position)), mesh(mesh_of(body, rail)),
        elements(*mesh, materials_of(body), rail.section.element_degree)
  {
  }

  double RailSection::height(const double lateral) const
  {
    return CrownManifold::height(crown, lateral);
  }

  PeriodicTrack supports_of_track(const RailParameters &rail)
  {
    PeriodicTrack track;
    track.spacing = rail.sleeper_spacing;
    track.first_support = (rail.is_over_support() ? 0 : rail.sleeper_spacing / 2) - rail.contact_offset;
    track.support.pad_stiffness = {{rail.pad_stiffness_x, rail.pad_stiffness_y, rail.pad_stiffness_z}};
    track.support.pad_loss = rail.pad_loss_factor;
    track.support.pad_length = rail.pad_length;
    const TrackSupports &supports = rail.track;
    Sleeper &sleeper = track.support.sleeper;
    sleeper.mass = supports.sleeper_mass;
    sleeper.ballast_stiffness = {
        {supports.ballast_stiffness_x, supports.ballast_stiffness_y, supports.ballast_stiffness_z}};
    sleeper.ballast_loss = supports.ballast_loss_factor;
    if (supports.has_sleeper_beams())
      sleeper.beam = {supports.sleepers_bend(),         supports.sleeper_length,
                      supports.rail_distance,           supports.sleeper_bending_stiffness,
                      supports.sleeper_shear_stiffness, supports.sleeper_gyration_radius,
                      supports.sleeper_loss_factor};
    if (supports.slab_mass > 0)
      track.slab = {supports.slab_mass,
                    supports.slab_bending_stiffness,
                    supports.slab_shear_stiffness,
                    supports.slab_gyration_radius,
                    supports.slab_loss_factor,
                    supports.slab_bed_stiffness,
                    supports.slab_bed_loss_factor};
    if (supports.rails != "one loaded")
      track.pairs = {supports.rails == "symmetric" ? RailPair::symmetric : RailPair::antisymmetric};
    if (supports.is_irregular())
    {
      track.own = irregular_supports(
          {supports.n_supports, supports.pad_scatter, supports.spacing_scatter, supports.scatter_seed},
          rail.sleeper_spacing, rail.is_over_support());
      for (OwnSupport &support : track.own)
        support.place -= rail.contact_offset;
      track.beyond = supports.beyond == "free end"    ? TrackEnds::free
                     : supports.beyond == "bare rail" ? TrackEnds::rail
                                                      : TrackEnds::track;
    }
    return track;
  }
} // namespace vibrocontact
