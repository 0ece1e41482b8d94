#include <vibrocontact/analyses/limit_cycle/limit_cycle_parameters.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/coupled_bodies/rolling_parameters.h>

#include <map>

namespace vibrocontact
{
  namespace
  {
    /// What cycles are followed over: entries that change the equilibrium, and neither bodies nor places.
    const std::map<std::string, double &(*)(RollingCase &)> &followed_entries()
    {
      static const std::map<std::string, double &(*)(RollingCase &)> entries = {
          {"Contact/Friction coefficient", [](RollingCase &one) -> double & { return one.friction; }},
          {"Rolling/Hub displacement", [](RollingCase &one) -> double & { return one.hub_displacement; }},
          {"Rolling/Normal force", [](RollingCase &one) -> double & { return one.normal_force; }},
          {"Rolling/Speed", [](RollingCase &one) -> double & { return one.creepage.speed; }},
          {"Rolling/Longitudinal creepage",
           [](RollingCase &one) -> double & { return one.creepage.longitudinal; }},
          {"Rolling/Lateral creepage", [](RollingCase &one) -> double & { return one.creepage.lateral; }},
          {"Rolling/Spin", [](RollingCase &one) -> double & { return one.creepage.spin; }},
          {"Rolling/Sliding velocity x", [](RollingCase &one) -> double & { return one.creepage.sliding_x; }},
          {"Rolling/Sliding velocity y",
           [](RollingCase &one) -> double & { return one.creepage.sliding_y; }}};
      return entries;
    }
  } // namespace

  double &CycleBranchParameters::value_in(RollingCase &constants) const
  {
    return followed_entries().at(entry)(constants);
  }

  void CycleBranchParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    std::string names = "none";
    for (const auto &[name, value] : followed_entries())
      names += "|" + name;
    prm.add_parameter("Entry", entry,
                      "What the cycles are followed over, from its value in the file both ways; none: they "
                      "are not.",
                      Selection(names));
    prm.add_parameter("Range", range,
                      "Least and largest value that a branch goes to. Units: those of the entry.",
                      List(Double(), 0, 2, ","));
    prm.add_parameter("Most points", most_points, "Of a branch, each way. Units: none.", Integer(2, 100000));
    prm.add_parameter("Largest step", largest_step,
                      "Between neighbours on a branch: change of the state over the motion, of the period "
                      "over itself and of the value over the range, root of the sum of squares. Units: none.",
                      Double(1e-3, 1));
  }

  void CycleBranchParameters::check() const
  {
    if (any() && !(range.size() == 2 && range[0] < range[1]))
      throw InputError("Limit cycle/Branch/Range has to be two values, the smaller one first, between which "
                       "the cycles are followed over " +
                       entry + ", such as 0.1, 0.6.");
  }

  void LimitCycleParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.add_parameter("Time step", time_step,
                      "The period of a root is divided into whole steps of at most this length. Their number "
                      "stays while the period is found. Units: s.",
                      Double(1e-12, 1e3));
    prm.add_parameter("Roots", roots,
                      "Frequencies of the unstable roots of the rolling equilibrium from which cycles are "
                      "sought, to 1 %; empty: all. Units: Hz.",
                      List(Double(0, 1e9), 0, 1000, ","));
    prm.add_parameter("Tolerance", tolerance,
                      "Change of the state over a period, over its distance from the equilibrium, both as "
                      "the root of an energy. Units: none.",
                      Double(1e-14, 1e-2));
    prm.add_parameter("Max Newton iterations", max_newton_iterations,
                      "Of each start for a cycle, of which there are up to four. Units: none.",
                      Integer(1, 1000));
    prm.add_parameter("Multipliers", n_multipliers,
                      "How many of the Floquet multipliers are listed, the largest; 0: stability is not "
                      "looked at. Units: none.",
                      Integer(0, 1000000));
    prm.enter_subsection("Branch");
    branch.declare_parameters(prm);
    prm.leave_subsection();
  }
} // namespace vibrocontact
