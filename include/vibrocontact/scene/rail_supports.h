#pragma once

#include <vibrocontact/base/entries_read.h>
#include <vibrocontact/scene/body_use.h>

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <utility>
#include <vector>

namespace vibrocontact
{
  /// What a rail lies on, whether it is made of solid elements or a beam: pads to rigid ground at equal
  /// distances, symmetric to the contact at x = 0, and ends whose loss rises outwards.
  struct RailSupports
  {
    /// length of the rail [m]; the contact is at its middle
    double length = 12;
    /// where the contact stands: mid-span or support
    std::string contact_at = "mid-span";
    bool is_over_support() const { return contact_at == "support"; }
    /// distance of the supports and length of a pad [m]
    double sleeper_spacing = 0.6, pad_length = 0.15;
    /// stiffness of one pad in x, y, z [N/m]; all zero: a free rail
    double pad_stiffness_x = 36e6, pad_stiffness_y = 36e6, pad_stiffness_z = 180e6;
    double pad_loss_factor = 1;
    /// lengths of the anechoic pieces from inside to outside [m]; empty: plain free ends
    std::vector<double> anechoic_lengths;
    /// loss factors of the innermost and the outermost piece, geometric steps between
    double anechoic_loss_first = 0.1, anechoic_loss_last = 1;

    /// Everything but the length.
    void declare_parameters(dealii::ParameterHandler &prm);
    void check(const std::string &path) const;
    /// anechoic ends or pads do
    bool supports_lose_energy() const
    {
      return !anechoic_lengths.empty() || (has_pads() && pad_loss_factor > 0);
    }
    bool has_pads() const { return pad_stiffness_x > 0 || pad_stiffness_y > 0 || pad_stiffness_z > 0; }
    /// What of these entries matters to a body. @param pieces_divide anechoic pieces are divisions of the mesh too
    void add_support_entries(EntriesRead &entries, const std::string &section, const BodyUse &use,
                             bool pieces_divide) const;
    /// BodyDescription::missing_support(). @param path of the section
    std::pair<std::string, std::string> support_wanted(const std::string &path) const;
    /// x of the supports' centres on the rail [m]
    std::vector<double> supports() const;
    /// Anechoic piece at x: 0 inside, then 1, 2, ... outwards.
    unsigned int anechoic_piece(double x) const;
    /// Loss factor of an anechoic piece, from 1.
    double anechoic_loss(unsigned int piece) const;
  };
} // namespace vibrocontact
