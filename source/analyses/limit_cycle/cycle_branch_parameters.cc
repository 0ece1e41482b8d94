#include <vibrocontact/analyses/limit_cycle/cycle_branch_parameters.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/contact/laws/friction_law.h>
#include <vibrocontact/coupled_bodies/creepage_limits.h>
#include <vibrocontact/coupled_bodies/rolling_parameters.h>

#include <map>

namespace vibrocontact
{
  namespace
  {
    using Condition = const char *(*)(const RollingCase &);

    /// An entry that changes the equilibrium, and neither bodies nor places.
    struct FollowedEntry
    {
      double &(*value)(RollingCase &);
      /// that it may have
      double least, most;
      /// why it changes nothing in a scene, and what to do; null: it does
      Condition without_effect;
    };

    const char *never(const RollingCase &)
    {
      return nullptr;
    }

    const char *without_speed(const RollingCase &one)
    {
      return one.creepage.speed > 0
                 ? nullptr
                 : "Rolling/Speed is 0, so that it changes nothing: follow a sliding velocity";
    }

    const char *without_rolling(const RollingCase &one)
    {
      return one.creepage.speed > 0
                 ? nullptr
                 : "Rolling/Speed is 0, where nothing rolls: give the speed that the branch begins at";
    }

    const char *under_displacement(const RollingCase &one)
    {
      return one.normal_force > 0 ? nullptr : "the load is Rolling/Hub displacement: follow that";
    }

    const char *under_force(const RollingCase &one)
    {
      return one.normal_force > 0 ? "the load is Rolling/Normal force: follow that" : nullptr;
    }

    const std::map<std::string, FollowedEntry> &followed_entries()
    {
      // forces and displacements of zero mean that the other one is given
      constexpr double tiny = 1e-12, most = 1e12;
      static const std::map<std::string, FollowedEntry> entries = {
          {"Contact/Friction coefficient",
           {[](RollingCase &one) -> double & { return one.friction; }, 0, most_friction, never}},
          {"Rolling/Hub displacement",
           {[](RollingCase &one) -> double & { return one.hub_displacement; }, tiny, most, under_force}},
          {"Rolling/Normal force",
           {[](RollingCase &one) -> double & { return one.normal_force; }, tiny, most, under_displacement}},
          {"Rolling/Speed",
           {[](RollingCase &one) -> double & { return one.creepage.speed; }, tiny, most, without_rolling}},
          {"Rolling/Longitudinal creepage",
           {[](RollingCase &one) -> double & { return one.creepage.longitudinal; }, -most_creepage,
            most_creepage, without_speed}},
          {"Rolling/Lateral creepage",
           {[](RollingCase &one) -> double & { return one.creepage.lateral; }, -most_creepage, most_creepage,
            without_speed}},
          {"Rolling/Spin",
           {[](RollingCase &one) -> double & { return one.creepage.spin; }, -most_spin, most_spin,
            without_speed}},
          {"Rolling/Sliding velocity x",
           {[](RollingCase &one) -> double & { return one.creepage.sliding_x; }, -most, most, never}},
          {"Rolling/Sliding velocity y",
           {[](RollingCase &one) -> double & { return one.creepage.sliding_y; }, -most, most, never}}};
      return entries;
    }
  } // namespace

  double &CycleBranchParameters::value_in(RollingCase &constants) const
  {
    return followed_entries().at(entry).value(constants);
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
    prm.add_parameter("Most points", most_points,
                      "Of a branch, each way; a branch that needs more is not whole. Units: none.",
                      Integer(2, 100000));
    prm.add_parameter(
        "Largest step", largest_step,
        "Between neighbours on a branch: change of the state over the motion, of the period "
        "over itself and of the value over the range, root of the sum of squares; up to 0.5 where no contact "
        "point changes its status, as motions of all amplitudes are alike there. Units: none.",
        Double(1e-3, 1));
  }

  void CycleBranchParameters::check(RollingCase constants) const
  {
    if (!any())
      return;
    const std::string asked = "Limit cycle/Branch/Range";
    if (!(range.size() == 2 && range[0] < range[1]))
      throw InputError(asked +
                       " has to be two values, the smaller one first, between which the cycles are "
                       "followed over " +
                       entry + ", such as 0.1, 0.6.");
    const FollowedEntry &followed = followed_entries().at(entry);
    if (from() < followed.least || to() > followed.most)
      throw InputError(asked + " has to lie between " + number_text(followed.least) + " and " +
                       number_text(followed.most) + " for " + entry + ".");
    if (const char *const why = followed.without_effect(constants))
      throw InputError("Limit cycle/Branch/Entry is " + entry + ", but " + why + ".");
    const double value = value_in(constants);
    if (value < from() || value > to())
      throw InputError(asked + " leaves out " + number_text(value) + ", the value that " + entry +
                       " has: a branch begins there.");
  }
} // namespace vibrocontact
