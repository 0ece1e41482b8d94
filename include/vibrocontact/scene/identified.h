#pragma once

#include <vibrocontact/scene/body_description.h>
#include <vibrocontact/scene/contact_grid.h>

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// A body known by Green's functions: by poles that section Identification fits to data, or that a file has; or, for
  /// comparison, by the data themselves. Beside it what these do not say, where its points lie over the road.
  struct IdentifiedParameters : BodyDescription
  {
    /// table of poles and residues as the analysis identification writes it, in place of section Identification
    std::string poles_file;
    /// no fit: the data's inverse Fourier transform (bodies/band_limited.h), for the convolutions
    bool inverse_transform = false;
    /// of the data's points along the road, in their order; empty for one point at 0 [m]
    std::vector<double> positions;
    /// height of the points above the lowest one is radius (1 - cos(x / radius)), positions being measured along the
    /// circle; 0: all level [m]
    double radius = 0;
    /// under each point, 0: rigid [N/m]
    double tread_stiffness = 0;

    void declare_parameters(dealii::ParameterHandler &prm) override;
    /// @throws InputError
    void check(const std::string &section) const override;
    bool add_entries(EntriesRead &entries, const std::string &section, const BodyUse &use) const override;
    void print(Log &log) const override;
    std::optional<ContactGrid> contact_points(double cell) const override;
    const IdentifiedParameters *measured() const override { return this; }
    bool has_material() const override { return false; }
    bool has_rigid_points() const override { return tread_stiffness == 0; }
    bool takes_cell() const override { return true; }
    std::vector<double> places() const override;
    double tread_compliance(bool tangential) const override;
    bool touches_downwards_only() const override { return radius > 0; }
    std::string way_to_look_up() const override { return " or leave its Radius out"; }
    /// poles are fitted to the data of section Identification, or these are transformed
    bool takes_data() const { return poles_file.empty(); }
    /// of each point above the lowest one; as many as positions [m]
    std::vector<double> heights() const override;
    /// whether the positions are evenly spaced
    bool is_even() const;
    /// several positions as the points of a contact, whose x points backwards, with their mean distance.
    /// @param width of a cell [m]
    ContactGrid grid(double width) const;
  };
} // namespace vibrocontact
