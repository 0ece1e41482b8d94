#include <vibrocontact/base/csv_table.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/expression.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/coupled_bodies/creepage_limits.h>
#include <vibrocontact/coupled_bodies/quasi_static_rolling.h>
#include <vibrocontact/marching/drive.h>
#include <vibrocontact/marching/transient_parameters.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>
#include <tuple>

namespace vibrocontact
{
  namespace
  {
    using FunctionOfTime = std::function<double(double)>;

    /// Everything about one driven quantity.
    struct Source
    {
      std::string entry, column, unit;
      const std::string &expression;
      double constant;
      /// of its size, that of the entry of section Rolling
      double most = std::numeric_limits<double>::infinity();
    };

    InputError wrong_value(const std::string &name, const double value, const std::string &unit,
                           const double time, const std::string &remedy)
    {
      std::ostringstream text;
      text << name << " is " << value << (unit.empty() ? "" : " ") << unit << " at t = " << time << " s"
           << remedy;
      return InputError(text.str());
    }

    /// Finds the function of a source, and the columns of the table that are used.
    class Sources
    {
    public:
      explicit Sources(const TransientParameters &parameters) : parameters(parameters)
      {
        if (parameters.drive_table.empty())
          return;
        table = read_csv_file(parameters.drive_table, "Transient/Drive table");
        table->column("time_s");
        if (table->names.size() == 1)
          throw InputError(table->source + " has the column time_s alone, which drives nothing: " + known);
      }

      bool given(const Source &source) const
      {
        return !source.expression.empty() || (table && table->find(source.column));
      }

      /// What gives the quantity, for messages.
      std::string name(const Source &source) const
      {
        return table && table->find(source.column) ? table->source + ", the column " + source.column
                                                   : "Transient/" + source.entry;
      }

      FunctionOfTime function(const Source &source)
      {
        const std::vector<double> *const values = table ? table->find(source.column) : nullptr;
        if (values)
          used.push_back(source.column);
        if (values && !source.expression.empty())
          throw InputError("Transient/" + source.entry + " is an expression, but Transient/Drive table, \"" +
                           parameters.drive_table + "\", has a column " + source.column +
                           ": leave one of them out.");
        if (values)
        {
          const LinearTable linear(name(source), table->column("time_s"), *values);
          linear(0);
          linear(parameters.end_time);
          return within_limits(source, linear);
        }
        if (source.expression.empty())
          return [constant = source.constant](double) { return constant; };
        return within_limits(source, read_expression(source.expression, "t", "Transient/" + source.entry,
                                                     "the time t: write for instance 0.002*min(t/0.01,1)"));
      }

      double last_time() const
      {
        return table ? table->column("time_s").back() : std::numeric_limits<double>::infinity();
      }

      void check_all_used() const
      {
        if (!table)
          return;
        for (const std::string &name : table->names)
          if (name != "time_s" && std::find(used.begin(), used.end(), name) == used.end())
            throw InputError(table->source + " has a column " + name + ", which drives nothing: " + known);
      }

    private:
      FunctionOfTime within_limits(const Source &source, const FunctionOfTime &given) const
      {
        return [given, name = name(source), entry = source.entry, unit = source.unit,
                most = source.most](const double time)
        {
          const double value = given(time);
          if (!std::isfinite(value))
            throw wrong_value(
                name, value, unit, time,
                ", which is no finite number: write an expression that is one throughout the run.");
          if (std::abs(value) > most)
            throw wrong_value(name, value, unit, time,
                              ", beyond the limits of Rolling/" + entry + ", " + number_text(-most) + " to " +
                                  number_text(most) + ": keep it within them.");
          return value;
        };
      }

      const std::string known = "known are time_s, longitudinal_creepage, lateral_creepage, spin_1_m, "
                                "exciting_force_N and either normal_force_N or hub_displacement_m.";
      const TransientParameters &parameters;
      std::optional<CsvTable> table;
      std::vector<std::string> used;
    };

    Source force_source(const TransientParameters &transient, const double constant)
    {
      return {"Normal force", "normal_force_N", "N", transient.normal_force, constant};
    }

    Source hub_source(const TransientParameters &transient, const double constant)
    {
      return {"Hub displacement", "hub_displacement_m", "m", transient.hub_displacement, constant};
    }

    /// Second difference over h, with its centre where all three values are known.
    FunctionOfTime acceleration(const FunctionOfTime &displacement, const double h, const double end)
    {
      return [=](const double t)
      {
        const double centre = std::max(h, std::min(t, end - h));
        return ((displacement(centre + h) - displacement(centre)) -
                (displacement(centre) - displacement(centre - h))) /
               (h * h);
      };
    }
  } // namespace

  LoadOverTime load_over_time(const TransientParameters &transient)
  {
    const Sources sources(transient);
    const Source force = force_source(transient, 0), hub = hub_source(transient, 0);
    LoadOverTime load;
    load.normal_force = sources.given(force);
    load.hub_displacement = sources.given(hub);
    if (load.normal_force || load.hub_displacement)
      load.name = sources.name(load.normal_force ? force : hub);
    return load;
  }

  std::function<double(double)> hub_displacement_over_time(const TransientParameters &transient)
  {
    return Sources(transient).function(hub_source(transient, 0));
  }

  DriveFunction drive_function(const TransientParameters &transient, const RollingCase &constant,
                               const PlacedContacts &contacts)
  {
    Sources sources(transient);
    const Source force = force_source(transient, constant.normal_force),
                 hub = hub_source(transient, constant.hub_displacement);
    const auto longitudinal = sources.function({"Longitudinal creepage", "longitudinal_creepage", "",
                                                transient.longitudinal_creepage,
                                                constant.creepage.longitudinal, most_creepage}),
               lateral =
                   sources.function({"Lateral creepage", "lateral_creepage", "", transient.lateral_creepage,
                                     constant.creepage.lateral, most_creepage}),
               spin = sources.function(
                   {"Spin", "spin_1_m", "1/m", transient.spin, constant.creepage.spin, most_spin});
    const bool moved = sources.given(hub);
    const bool by_force = sources.given(force) || (!moved && constant.normal_force > 0);
    if (by_force && moved)
      throw InputError(
          "Section Transient drives both the normal force and the hub displacement: leave one of "
          "them out.");
    const auto load = sources.function(by_force ? force : hub);
    const Source exciting{"Exciting force", "exciting_force_N", "N", transient.exciting_force, 0.};
    const bool excited = sources.given(exciting);
    const unsigned int n_driven = contacts.all.front().grid.n_points();
    if (excited && n_driven != 1)
      throw InputError("Transient/Exciting force acts at the only point of the contact, or of the first of "
                       "several, but that one has " +
                       std::to_string(n_driven) +
                       " points: leave it out, or move the body by a Hub displacement.");
    if (excited && (contacts.all.front().above != 0 || !contacts.all.front().frame.has_usual_axes()))
      throw InputError("Transient/Exciting force acts on body 1 along z, but body 1 is not the first of its "
                       "(first) contact, or the contact is "
                       "inclined: leave it out, or name body 1 first.");
    const auto exciting_force = sources.function(exciting);
    sources.check_all_used();
    const double speed = constant.creepage.speed, h = transient.time_step;
    const FunctionOfTime hub_acceleration =
        moved ? acceleration(load, h, sources.last_time()) : FunctionOfTime();

    // of each contact, with its place along the road [m]
    std::vector<std::pair<std::shared_ptr<const Roughness>, double>> roughness;
    if (transient.roughness.any())
    {
      if (speed == 0)
        throw InputError("Section Transient/Roughness gives a roughness, but Rolling/Speed is 0, so that it "
                         "does not move: give a speed or leave it out.");
      for (const PlacedContact &contact : contacts.all)
      {
        const auto own = std::make_shared<Roughness>(transient.roughness, contact.grid);
        own->heights(0);
        own->heights(speed * transient.end_time);
        roughness.emplace_back(own, contact.frame.origin[0]);
      }
    }
    return [=, creepage = constant.creepage, force_name = sources.name(force)](const double t)
    {
      Drive drive;
      drive.creepage = creepage;
      drive.creepage.longitudinal = longitudinal(t);
      drive.creepage.lateral = lateral(t);
      drive.creepage.spin = spin(t);
      if (by_force)
      {
        drive.normal_force = load(t);
        if (!(drive.normal_force > 0))
          throw wrong_value(
              force_name, drive.normal_force, "N", t,
              ", but it has to be positive: a contact that opens is moved by Hub displacement.");
      }
      else
        drive.approach = load(t);
      if (hub_acceleration)
        drive.hub_acceleration = hub_acceleration(t);
      drive.force = exciting_force(t);
      for (const auto &[own, place] : roughness)
        for (const double height : own->heights(speed * t - place))
          drive.gap.push_back(-height);
      return drive;
    };
  }

  std::vector<std::string> driven_entries(const TransientParameters &transient)
  {
    std::optional<CsvTable> table;
    try
    {
      if (!transient.drive_table.empty())
        table = read_csv_file(transient.drive_table, "Transient/Drive table");
    }
    catch (const InputError &)
    {
      // said where the drive is made
    }
    std::vector<std::string> driven;
    for (const auto &[entry, column, expression] :
         {std::make_tuple("Longitudinal creepage", "longitudinal_creepage", &transient.longitudinal_creepage),
          {"Lateral creepage", "lateral_creepage", &transient.lateral_creepage},
          {"Spin", "spin_1_m", &transient.spin},
          {"Normal force", "normal_force_N", &transient.normal_force},
          {"Hub displacement", "hub_displacement_m", &transient.hub_displacement}})
      if (!expression->empty() || (table && table->find(column)))
        driven.push_back(entry);
    return driven;
  }
} // namespace vibrocontact
