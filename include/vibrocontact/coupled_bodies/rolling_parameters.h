#pragma once

#include <vibrocontact/contact/interface.h>
#include <vibrocontact/coupled_bodies/hub.h>
#include <vibrocontact/scene/axle.h>

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// `subsection Rolling`: load and kinematics of steady rolling, and what is swept.
  struct RollingParameters
  {
    /// exactly one of the two holds a number, the other is empty: resultant normal force [N], downward
    /// displacement of the hub (the approach of two half-spaces) [m]
    std::vector<double> normal_force, hub_displacement;
    Creepage creepage;
    /// what becomes of the hub of body 1 in a motion about the equilibrium, in which the load finds its place:
    /// "held" there, "massless" under the constant normal force of the equilibrium, "suspended", or on an "axle"; "none" of a
    /// half-space: held under a displacement, massless under a force
    std::string hub = "held";
    SuspensionParameters suspension;
    AxleParameters axle;
    /// how many grids quasi-static rolling solves on: "one", "two" or "automatic"
    std::string grids = "automatic";
    /// Whether two, of two half-spaces: asked for, or creepages are swept.
    bool two_grids() const;

    /// Values of the sweep; an empty list leaves the entry at its single value. Each of the first five lists
    /// is a curve of its own, the other entries staying at their single values; frictions repeat every curve.
    struct Sweep
    {
      std::vector<double> longitudinal, lateral, spin, normal_force, hub_displacement, friction;

      /// names of the entries that list values
      std::vector<std::string> given() const;
    } sweep;

    void declare_parameters(dealii::ParameterHandler &prm);
    /// @throws InputError for combinations that make no sense
    /// @param frictionless pressing alone makes sense: nothing has to move
    void check(bool frictionless) const;
  };

  /// What to solve for one case.
  struct RollingCase
  {
    /// the swept entry, e.g. "Lateral creepage"; "single" without a sweep
    std::string curve;
    Creepage creepage;
    double friction = 0;
    /// one of the two is zero [N], [m]
    double normal_force = 0, hub_displacement = 0;

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &curve &creepage &friction &normal_force &hub_displacement;
    }
  };

  /// Cases of a run in the order in which they are solved: curve by curve, each friction from its first to
  /// its last value.
  std::vector<RollingCase> rolling_cases(const RollingParameters &rolling, const ContactSections &contact);
} // namespace vibrocontact
