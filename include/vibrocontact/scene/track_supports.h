#pragma once

#include <vibrocontact/base/entries_read.h>

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace vibrocontact
{
  struct RailSupports;

  /// What a periodic rail lies on beyond equal pads (RailSupports): sleepers on ballast, and supports that are laid one by one
  /// about the contact, with scatter or between ends (waveguide/periodic_track.h).
  struct TrackSupports
  {
    /// mass of a sleeper under one rail, 0: pads on rigid ground [kg]; its ballast in x, y, z [N/m]
    double sleeper_mass = 0, ballast_stiffness_x = 0, ballast_stiffness_y = 0, ballast_stiffness_z = 0;
    double ballast_loss_factor = 0;

    /// mass, rigid beam or beam; see waveguide/sleeper.h
    std::string sleeper_model = "mass";
    /// one loaded, symmetric or antisymmetric
    std::string rails = "one loaded";
    double sleeper_length = 2.6, rail_distance = 1.5;                  ///< [m]
    double sleeper_bending_stiffness = 6e6;                            ///< [N m^2]
    double sleeper_shear_stiffness = 4e8;                              ///< [N]
    double sleeper_gyration_radius = 0.06, sleeper_loss_factor = 0.02; ///< [m], [-]

    /// a slab under one rail in place of sleepers, 0: none [kg/m]; see TrackSlab of waveguide/track_span.h
    double slab_mass = 0;
    double slab_bending_stiffness = 120e6, slab_shear_stiffness = 5e9; ///< [N m^2], [N]
    double slab_gyration_radius = 0.087, slab_loss_factor = 0.02;      ///< [m], [-]
    double slab_bed_stiffness = 150e6, slab_bed_loss_factor = 0.1;     ///< [N/m^2], [-]

    /// supports about the contact that are laid one by one; 0: equal ones without end
    unsigned int n_supports = 0;
    /// equal supports, free end or bare rail
    std::string beyond = "equal supports";
    /// standard deviation over mean
    double pad_scatter = 0, spacing_scatter = 0;
    unsigned int scatter_seed = 1;

    void declare_parameters(dealii::ParameterHandler &prm);
    /// @throws InputError
    void check(const std::string &path, const RailSupports &pads) const;
    void add_entries(EntriesRead &entries, const std::string &section) const;
    bool scatters() const { return pad_scatter > 0 || spacing_scatter > 0; }
    /// whether it is not one of equal supports without end
    bool is_irregular() const { return n_supports > 0; }
    /// whether sleepers are longer than a point, and whether they are more than rigid
    bool has_sleeper_beams() const { return sleeper_mass > 0 && sleeper_model != "mass"; }
    bool sleepers_bend() const { return has_sleeper_beams() && sleeper_model == "beam"; }
  };
} // namespace vibrocontact
