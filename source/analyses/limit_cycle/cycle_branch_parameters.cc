#include <vibrocontact/analyses/limit_cycle/cycle_branch_parameters.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/coupled_bodies/rolling_parameters.h>

#include <map>

namespace vibrocontact
{
  namespace
  {
    /// An entry that changes the equilibrium, and neither bodies nor places.
    struct FollowedEntry
    {
      double &(*value)(RollingCase &);
      /// that it may have
      double least, most;
    };

    const std::map<std::string, FollowedEntry> &followed_entries()
    {
      // forces and displacements of zero mean that the other one is given
      constexpr double tiny = 1e-12, most = 1e12;
      static const std::map<std::string, FollowedEntry> entries = {
          {"Contact/Friction coefficient",
           {[](RollingCase &one) -> double & { return one.friction; }, 0, 10}},
          {"Rolling/Hub displacement",
           {[](RollingCase &one) -> double & { return one.hub_displacement; }, tiny, most}},
          {"Rolling/Normal force",
           {[](RollingCase &one) -> double & { return one.normal_force; }, tiny, most}},
          {"Rolling/Speed", {[](RollingCase &one) -> double & { return one.creepage.speed; }, tiny, most}},
          {"Rolling/Longitudinal creepage",
           {[](RollingCase &one) -> double & { return one.creepage.longitudinal; }, -1, 1}},
          {"Rolling/Lateral creepage",
           {[](RollingCase &one) -> double & { return one.creepage.lateral; }, -1, 1}},
          {"Rolling/Spin", {[](RollingCase &one) -> double & { return one.creepage.spin; }, -1e3, 1e3}},
          {"Rolling/Sliding velocity x",
           {[](RollingCase &one) -> double & { return one.creepage.sliding_x; }, -most, most}},
          {"Rolling/Sliding velocity y",
           {[](RollingCase &one) -> double & { return one.creepage.sliding_y; }, -most, most}}};
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
    const std::string follows = "Limit cycle/Branch/Entry is " + entry + ", but ";
    const bool is_creepage = entry == "Rolling/Longitudinal creepage" ||
                             entry == "Rolling/Lateral creepage" || entry == "Rolling/Spin";
    if (is_creepage && !(constants.creepage.speed > 0))
      throw InputError(follows +
                       "Rolling/Speed is 0, so that it changes nothing: follow a sliding velocity.");
    if (entry == "Rolling/Speed" && !(constants.creepage.speed > 0))
      throw InputError(follows +
                       "Rolling/Speed is 0, where nothing rolls: give the speed that the branch begins at.");
    if (entry == "Rolling/Normal force" && !(constants.normal_force > 0))
      throw InputError(follows + "the load is Rolling/Hub displacement: follow that.");
    if (entry == "Rolling/Hub displacement" && constants.normal_force > 0)
      throw InputError(follows + "the load is Rolling/Normal force: follow that.");
    const double value = value_in(constants);
    if (value < from() || value > to())
      throw InputError(asked + " leaves out " + number_text(value) + ", the value that " + entry +
                       " has: a branch begins there.");
  }
} // namespace vibrocontact
