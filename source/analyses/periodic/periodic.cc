#include <vibrocontact/analyses/periodic/periodic.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/named_table.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/base/parameter_text.h>

#include <deal.II/base/utilities.h>

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <functional>
#include <sstream>

namespace vibrocontact
{
  namespace
  {
    /// of sampled functions and Newton's matrix
    constexpr double most_bytes = 4e9;

    std::vector<double> numbers_of(const std::string &text, const unsigned int count,
                                   const std::string &entry)
    {
      std::vector<double> result;
      for (const std::string &member : split_list(text))
      {
        std::istringstream stream(member);
        double value;
        if (!(stream >> value) || stream.rdbuf()->in_avail() != 0)
          throw InputError("Periodic/" + entry + ": \"" + member + "\" is no number; give lengths in m.");
        result.push_back(value);
      }
      if (result.size() != count)
        throw InputError("Periodic/" + entry + ": \"" + text + "\" has " + std::to_string(result.size()) +
                         " numbers, " + std::to_string(count) + " are needed.");
      return result;
    }

    TimePairing pairing_of(const BalanceSettings &asked)
    {
      return pair_time_bases(*create_time_basis(asked.trial, asked.n_functions, *asked.bases),
                             *create_time_basis(asked.weighting, asked.n_functions, *asked.bases), asked.form,
                             asked.quadrature_points);
    }

    /// @param entry that gives the number of functions
    void check_holds_force(const BalanceSettings &asked, const std::string &entry)
    {
      if (pairing_of(asked).holds_harmonic())
        return;
      BalanceSettings enough = asked;
      enough.quadrature_points = 0;
      do
        ++enough.n_functions;
      while (!pairing_of(enough).holds_harmonic());
      throw InputError(entry + " is " + std::to_string(asked.n_functions) + ", but so few functions " +
                       asked.trial + ":" + asked.weighting +
                       " do not follow the exciting force, which would move nothing or meet no damping: "
                       "give at least " +
                       std::to_string(enough.n_functions) + ".");
    }

    /// of normal laws
    const std::vector<std::pair<std::string, std::string>> short_names = {
        {"penalty", "exponential penalty"}, {"linear", "linear spring"}, {"signorini", "signorini"}};

    std::string short_names_pattern()
    {
      std::vector<std::string> names;
      for (const auto &[short_name, name] : short_names)
        names.push_back(short_name);
      return selection(names);
    }
  } // namespace

  void PeriodicParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.add_parameter("Trial basis", trial, "Functions of time that the motion is made of. Units: none.",
                      Selection(selection(names_of(*bases))));
    prm.add_parameter("Weighting basis", weighting,
                      "Functions of time that the residual is orthogonal to. Units: none.",
                      Selection(selection(names_of(*bases))));
    prm.add_parameter("Number of functions", n_functions,
                      "Functions in each basis; odd numbers leave no undamped last function. Units: none.",
                      Integer(1, 5000));
    prm.add_parameter("Form", form, "Who carries the derivatives of the inertia term. Units: none.",
                      Selection("strong|weak|distributional"));
    prm.add_parameter(
        "Law", law,
        "Normal law of the stop in place of Contact/Normal law: exponential penalty, linear spring or "
        "signorini by a short name; empty: Contact/Normal law. Units: none.",
        Selection("|" + short_names_pattern()));
    prm.add_parameter("Frequency", frequency, "Frequency of the exciting force. Units: Hz.",
                      Double(1e-9, 1e12));
    prm.add_parameter("Force", force, "Amplitude of the exciting force. Units: N.", Double(0, 1e15));
    prm.add_parameter(
        "Force point", force_point,
        "Place and direction of the force, \"x, y, z, direction\" with direction x, y or z, or \"x, y, z, "
        "dx, "
        "dy, dz\" with a vector of any length; empty: the first contact point, into the stop. Units: m.");
    prm.add_parameter(
        "Contact points", contact_points,
        "Points that may touch, \"name: x, y, z; ...\", each at the nearest node; empty: the contact "
        "point of section Contact. Units: m.");
    prm.add_parameter(
        "Contact points on body 2", contact_points_below,
        "Where these points meet a body 2 that vibrates, \"name: x, y, z; ...\" on its mesh, with the "
        "same names; empty: at the same places. Units: m.");
    prm.add_parameter("Stop direction", stop_direction,
                      "Direction from body 1 to the stop, or to body 2. Units: none.",
                      Selection("+x|-x|+y|-y|+z|-z"));
    prm.add_parameter("Gap", gap, "Gap of the undeformed bodies; negative: preloaded. Units: m.", Double());
    prm.add_parameter("Model", model,
                      "What moves: the modes kept and residual flexibility, or all modes of the "
                      "elements. Units: none.",
                      Selection("reduced|finite elements"));
    prm.add_parameter("Samples", n_samples,
                      "Samples of the contact law over the period, at least. Units: none.",
                      Integer(2, 1 << 24));
    prm.add_parameter(
        "Quadrature points", quadrature_points,
        "Integrals between the bases by so many left points instead of exactly; 0: exactly. Units: none.",
        Integer(0, 1 << 24));
    prm.add_parameter(
        "Reference", reference,
        "Whether the distance of each solution to the motion found by shooting is computed. Units: none.");
    prm.add_parameter("Output samples", n_output, "Lines of the tables. Units: none.",
                      Integer(4096, 1 << 20));
    prm.enter_subsection("Comparison");
    prm.add_parameter(
        "Pairs", pairs,
        "Solutions beside the first one: pairs of bases \"trial:weighting, ...\". Units: none.");
    prm.add_parameter("Numbers", numbers, "Numbers of functions of these solutions. Units: none.",
                      List(Integer(1, 5000), 0, 1000));
    prm.add_parameter(
        "Force phases", n_phases,
        "Errors are medians over so many positions of the force within one cell of the basis. Units: none.",
        Integer(1, 1000));
    prm.leave_subsection();
    prm.enter_subsection("Continuation");
    continuation.declare_parameters(prm);
    prm.leave_subsection();
  }

  void PeriodicParameters::check() const
  {
    contact_points_on(1);
    parsed_force();
    continuation.check();
    const auto pairs_asked = parsed_pairs();
    if (numbers.empty() && pairs_asked.size() > 1)
      throw InputError(
          "Periodic/Comparison/Pairs needs Periodic/Comparison/Numbers: give the numbers of functions.");
    std::vector<std::pair<BalanceSettings, std::string>> all;
    for (const BalanceSettings &solution : solutions({}))
      all.emplace_back(solution,
                       all.empty() ? "Periodic/Number of functions" : "Periodic/Comparison/Numbers");
    for (const BalanceSettings &curve : curves({}))
      all.emplace_back(curve, continuation.numbers.empty() ? "Periodic/Number of functions"
                                                           : "Periodic/Continuation/Numbers");
    for (const auto &[asked, entry] : all)
    {
      const auto trial_basis = create_time_basis(asked.trial, asked.n_functions, *bases),
                 weighting_basis = create_time_basis(asked.weighting, asked.n_functions, *bases);
      check_holds_force(asked, entry);
      check_samples(asked.n_functions, asked.n_samples);
      const auto is_power_of_two = [](const unsigned int number) { return (number & (number - 1)) == 0; };
      const bool dyadic = trial_basis->is_dyadic() || weighting_basis->is_dyadic();
      if (dyadic && !(is_power_of_two(n_output) && is_power_of_two(n_phases)))
        throw InputError(
            "Periodic/Output samples and Periodic/Comparison/Force phases have to be powers of two for " +
            asked.trial + ":" + asked.weighting + ", whose functions are sampled at dyadic points.");
      const double bytes = 8. * asked.n_functions *
                           (3. * std::max({n_output, asked.n_samples, 4096u}) + 3. * asked.n_functions);
      if (bytes > most_bytes)
        throw InputError("Periodic/Number of functions = " + std::to_string(asked.n_functions) +
                         " with so many samples needs " + number_text(bytes / 1e9) +
                         " GB: lower it, Periodic/Samples or Periodic/Output samples.");
    }
    if (reference && contact_points_on(0).size() > 1)
      throw InputError(
          "Periodic/Reference knows one contact point: leave it out or list one in Periodic/Contact points.");
  }

  std::vector<PeriodicParameters::Place>
  PeriodicParameters::contact_points_on(const unsigned int number) const
  {
    const bool own = number > 0 && !trimmed(contact_points_below).empty();
    const std::string entry = own ? "Contact points on body 2" : "Contact points";
    std::vector<Place> result;
    for (const std::string &member :
         dealii::Utilities::split_string_list(own ? contact_points_below : contact_points, ';'))
    {
      const std::size_t colon = member.find(':');
      if (colon == std::string::npos)
        throw InputError("Periodic/" + entry + ": \"" + member +
                         "\" has no name; write it as name: x, y, z.");
      const std::vector<double> x = numbers_of(member.substr(colon + 1), 3, entry);
      result.push_back({trimmed(member.substr(0, colon)), {x[0], x[1], x[2]}});
    }
    if (own && !trimmed(contact_points).empty())
    {
      const std::vector<Place> first = contact_points_on(0);
      const auto same_name = [](const Place &a, const Place &b) { return a.name == b.name; };
      if (!std::equal(first.begin(), first.end(), result.begin(), result.end(), same_name))
        throw InputError("Periodic/Contact points on body 2 does not have the names of Periodic/Contact "
                         "points in their order: give the same ones, each with its place on body 2.");
    }
    return result;
  }

  std::pair<unsigned int, double> PeriodicParameters::stop_axis() const
  {
    return {stop_direction[1] - 'x', stop_direction[0] == '+' ? 1. : -1.};
  }

  std::optional<std::pair<dealii::Point<3>, dealii::Tensor<1, 3>>> PeriodicParameters::parsed_force() const
  {
    if (trimmed(force_point).empty())
      return {};
    dealii::Tensor<1, 3> direction;
    const std::size_t comma = force_point.rfind(',');
    const std::string last = comma == std::string::npos ? "" : trimmed(force_point.substr(comma + 1));
    const bool is_axis = last.size() == 1 && last[0] >= 'x' && last[0] <= 'z';
    if (!is_axis && split_list(force_point).size() != 6)
      throw InputError("Periodic/Force point: \"" + force_point +
                       "\" does not end in a direction; write it as x, y, z, direction with direction x, y "
                       "or z, or as x, y, z, dx, dy, dz.");
    const std::vector<double> x =
        numbers_of(is_axis ? force_point.substr(0, comma) : force_point, is_axis ? 3 : 6, "Force point");
    if (is_axis)
      direction[last[0] - 'x'] = 1;
    else
      for (unsigned int d = 0; d < 3; ++d)
        direction[d] = x[3 + d];
    if (!(direction.norm() > 0))
      throw InputError("Periodic/Force point: \"" + force_point +
                       "\" has no direction, dx, dy and dz are zero; give one of them.");
    return std::make_pair(dealii::Point<3>(x[0], x[1], x[2]), direction / direction.norm());
  }

  std::vector<std::pair<std::string, std::string>> PeriodicParameters::parsed_pairs() const
  {
    std::vector<std::pair<std::string, std::string>> result = {{trial, weighting}};
    for (const auto &pair : basis_pairs(pairs, "Periodic/Comparison/Pairs"))
      result.push_back(pair);
    return result;
  }

  BalanceSettings PeriodicParameters::settings(const std::string &trial_basis,
                                               const std::string &weighting_basis, const unsigned int number,
                                               const std::vector<double> &friction) const
  {
    BalanceSettings result;
    result.trial = trial_basis;
    result.weighting = weighting_basis;
    result.n_functions = number;
    result.form = time_form(form);
    result.n_samples = n_samples;
    result.quadrature_points = quadrature_points;
    for (const double mu : friction)
      result.friction = std::max(result.friction, mu);
    if (friction.size() > 1)
      result.friction_of_points = friction;
    result.bases = bases;
    return result;
  }

  std::vector<BalanceSettings> PeriodicParameters::solutions(const std::vector<double> &friction) const
  {
    std::vector<BalanceSettings> result = {settings(trial, weighting, n_functions, friction)};
    for (const auto &[trial_basis, weighting_basis] : parsed_pairs())
      for (const unsigned int number : numbers)
        result.push_back(settings(trial_basis, weighting_basis, number, friction));
    return result;
  }

  std::vector<BalanceSettings> PeriodicParameters::curves(const std::vector<double> &friction) const
  {
    if (!continuation.is_wanted())
      return {};
    std::vector<BalanceSettings> result = {settings(trial, weighting, n_functions, friction)};
    std::vector<unsigned int> curve_numbers = continuation.numbers;
    if (curve_numbers.empty())
      curve_numbers = {n_functions};
    for (const auto &[trial_basis, weighting_basis] : continuation.parsed_pairs())
      for (const unsigned int number : curve_numbers)
        result.push_back(settings(trial_basis, weighting_basis, number, friction));
    return result;
  }

  std::string PeriodicParameters::own_law() const
  {
    for (const auto &[short_name, name] : short_names)
      if (law == short_name)
        return name;
    return "";
  }

  std::string PeriodicParameters::law_in_results(const std::vector<std::string> &normal_laws) const
  {
    std::vector<std::string> names;
    for (const std::string &normal_law : normal_laws)
    {
      const std::string &taken = law.empty() ? normal_law : own_law();
      const auto known = std::find_if(std::begin(short_names), std::end(short_names),
                                      [&](const auto &one) { return one.second == taken; });
      names.push_back(known != std::end(short_names) ? known->first : normal_law);
    }
    const bool differ = std::adjacent_find(names.begin(), names.end(), std::not_equal_to<>()) != names.end();
    return differ ? boost::algorithm::join(names, ", ") : names.front();
  }
} // namespace vibrocontact
