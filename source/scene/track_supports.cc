#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/scene/rail_supports.h>
#include <vibrocontact/scene/track_supports.h>

#include <cmath>
#include <sstream>

namespace vibrocontact
{
  using namespace dealii;

  void TrackSupports::declare_parameters(ParameterHandler &prm)
  {
    using Patterns::Double;
    prm.add_parameter("Sleeper mass", sleeper_mass,
                      "Model periodic: mass of a sleeper under one rail; 0: the pads lie on rigid ground. "
                      "Units: kg.",
                      Double(0));
    prm.add_parameter("Ballast stiffness x", ballast_stiffness_x,
                      "Longitudinal stiffness of the ballast under one rail's part of a sleeper. Units: N/m.",
                      Double(0));
    prm.add_parameter("Ballast stiffness y", ballast_stiffness_y, "Lateral stiffness of it. Units: N/m.",
                      Double(0));
    prm.add_parameter("Ballast stiffness z", ballast_stiffness_z, "Vertical stiffness of it. Units: N/m.",
                      Double(0));
    prm.add_parameter("Ballast loss factor", ballast_loss_factor,
                      "Hysteretic loss factor of the ballast. Units: none.", Double(0, 10));
    prm.add_parameter("Sleeper model", sleeper_model,
                      "mass: a sleeper shifts under its rail, the other rail is not seen; rigid beam: it "
                      "carries both rails and rolls; beam: it bends too. Units: none.",
                      Patterns::Selection("mass|rigid beam|beam"));
    prm.add_parameter("Rails", rails,
                      "Sleepers that are beams: how the two rails move. one loaded: forces act on this rail "
                      "alone, the other one is its mirror image and carried along. Units: none.",
                      Patterns::Selection("one loaded|symmetric|antisymmetric"));
    prm.add_parameter("Sleeper length", sleeper_length, "Length of a sleeper across the track. Units: m.",
                      Double(0));
    prm.add_parameter("Rail distance", rail_distance, "Distance of the middles of the rails. Units: m.",
                      Double(0));
    prm.add_parameter("Sleeper bending stiffness", sleeper_bending_stiffness,
                      "E I of a sleeper in the vertical plane. Units: N m^2.", Double(0));
    prm.add_parameter("Sleeper shear stiffness", sleeper_shear_stiffness, "kappa G A of a sleeper. Units: N.",
                      Double(0));
    prm.add_parameter("Sleeper gyration radius", sleeper_gyration_radius,
                      "Radius of gyration of a sleeper's section about its horizontal axis. Units: m.",
                      Double(0, 1));
    prm.add_parameter("Sleeper loss factor", sleeper_loss_factor,
                      "Hysteretic loss factor of a sleeper that bends. Units: none.", Double(0, 10));
    prm.add_parameter("Slab mass", slab_mass,
                      "Model periodic: mass of a slab under one rail per length, on which the pads lie in "
                      "place of sleepers; 0: none. Units: kg/m.",
                      Double(0));
    prm.add_parameter("Slab bending stiffness", slab_bending_stiffness,
                      "E I of the slab under one rail. Units: N m^2.", Double(0));
    prm.add_parameter("Slab shear stiffness", slab_shear_stiffness,
                      "kappa G A of the slab under one rail. Units: N.", Double(0));
    prm.add_parameter("Slab gyration radius", slab_gyration_radius,
                      "Radius of gyration of the slab's section. Units: m.", Double(0, 10));
    prm.add_parameter("Slab loss factor", slab_loss_factor,
                      "Hysteretic loss factor of the slab. Units: none.", Double(0, 10));
    prm.add_parameter("Slab bed stiffness", slab_bed_stiffness,
                      "Vertical stiffness of the slab's bed under one rail per length. Units: N/m^2.",
                      Double(0));
    prm.add_parameter("Slab bed loss factor", slab_bed_loss_factor,
                      "Hysteretic loss factor of the slab's bed. Units: none.", Double(0, 10));
    prm.add_parameter("Supports", n_supports,
                      "Model periodic: number of supports that are laid one by one about the contact, half "
                      "of them to each side; 0: equal ones without end. Units: none.",
                      Patterns::Integer(0, 400));
    prm.add_parameter("Beyond supports", beyond,
                      "What follows beyond these supports: equal supports without end, nothing (free end), "
                      "or the rail alone without end, from which no wave comes back. Units: none.",
                      Patterns::Selection("equal supports|free end|bare rail"));
    prm.add_parameter("Pad scatter", pad_scatter,
                      "Standard deviation of the stiffness of these pads over its mean (log-normal). Units: "
                      "none.",
                      Double(0, 2));
    prm.add_parameter("Spacing scatter", spacing_scatter,
                      "Standard deviation of the distances of these supports over Sleeper spacing (evenly "
                      "distributed). Units: none.",
                      Double(0, 0.5));
    prm.add_parameter("Scatter seed", scatter_seed, "Which of the random tracks it is. Units: none.",
                      Patterns::Integer(0, 2147483647));
  }

  void TrackSupports::check(const std::string &path, const RailSupports &pads) const
  {
    std::ostringstream text;
    const double shortest = pads.sleeper_spacing * (1 - std::sqrt(3.) * spacing_scatter);
    if (sleeper_mass > 0 && !(ballast_stiffness_x > 0 && ballast_stiffness_y > 0 && ballast_stiffness_z > 0))
      text << path << "/Sleeper mass is " << sleeper_mass
           << " kg, but nothing holds the sleepers in some direction: give Ballast stiffness x, y and z.";
    else if (sleeper_model != "mass" && !(sleeper_mass > 0))
      text << path << "/Sleeper model is " << sleeper_model
           << ", but there are no sleepers: give Sleeper mass.";
    else if (has_sleeper_beams() && !(rail_distance > 0 && sleeper_length > rail_distance))
      text << path << "/Sleeper length (" << sleeper_length << " m) must be above Rail distance ("
           << rail_distance << " m), and that above 0.";
    else if (sleepers_bend() && !(sleeper_bending_stiffness > 0 && sleeper_shear_stiffness > 0))
      text << path
           << "/Sleeper model is beam: give a Sleeper bending stiffness and a Sleeper shear stiffness above "
              "0, or set it to rigid beam.";
    else if (slab_mass > 0 && sleeper_mass > 0)
      text << path << "/Slab mass and Sleeper mass are both set: pads lie on a slab or on sleepers.";
    else if (slab_mass > 0 &&
             !(slab_bending_stiffness > 0 && slab_shear_stiffness > 0 && slab_bed_stiffness > 0))
      text << path
           << "/Slab mass is set: give a Slab bending stiffness, a Slab shear stiffness and a Slab bed "
              "stiffness above 0.";
    else if (n_supports == 1)
      text << path << "/Supports is 1, too short a track: give 2 or more, or 0 for equal ones without end.";
    else if (n_supports > 0 && !(shortest > pads.pad_length))
      text << path << "/Spacing scatter " << spacing_scatter << " makes distances down to " << shortest
           << " m, where pads of " << pads.pad_length << " m overlap: give less.";
    if (!text.str().empty())
      throw InputError(text.str());
  }

  void TrackSupports::add_entries(EntriesRead &entries, const std::string &section) const
  {
    entries.add(section, "Sleeper mass, Sleeper model, Slab mass, Supports");
    entries.add_if(
        slab_mass > 0, "there is a Slab mass", section,
        "Slab bending stiffness, Slab shear stiffness, Slab gyration radius, Slab loss factor, Slab "
        "bed stiffness, Slab bed loss factor");
    entries.add_if(sleeper_mass > 0, "there is a Sleeper mass", section,
                   "Ballast stiffness x, Ballast stiffness y, Ballast stiffness z, Ballast loss factor");
    entries.add_if(has_sleeper_beams(), "sleepers are beams", section,
                   "Rails, Sleeper length, Rail distance, Sleeper gyration radius");
    entries.add_if(sleepers_bend(), "sleepers bend", section,
                   "Sleeper bending stiffness, Sleeper shear stiffness, Sleeper loss factor");
    entries.add_if(n_supports > 0, "there are Supports laid one by one", section,
                   "Beyond supports, Pad scatter, Spacing scatter");
    entries.add_if(n_supports > 0 && scatters(), "the supports scatter", section, "Scatter seed");
  }
} // namespace vibrocontact
