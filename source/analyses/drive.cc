#include <vibrocontact/analyses/drive.h>
#include <vibrocontact/analyses/quasi_static_rolling.h>
#include <vibrocontact/analyses/transient_parameters.h>
#include <vibrocontact/base/csv_table.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/expression.h>
#include <vibrocontact/base/parameter_file.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>

namespace vibrocontact
{
  namespace
  {
    using FunctionOfTime = std::function<double(double)>;

    /// Everything about one driven quantity.
    struct Source
    {
      std::string entry, column;
      const std::string &expression;
      double constant;
    };

    /// Finds the function of a source, and the columns of the table that are used.
    class Sources
    {
    public:
      explicit Sources(const TransientParameters &parameters) : parameters(parameters)
      {
        if (parameters.drive_table.empty())
          return;
        table = read_csv(parameters.drive_table, read_file_on_all_ranks(parameters.drive_table, "table"));
        table->column("time_s");
      }

      bool given(const Source &source) const
      {
        return !source.expression.empty() || (table && table->find(source.column));
      }

      FunctionOfTime function(const Source &source)
      {
        const std::vector<double> *const values = table ? table->find(source.column) : nullptr;
        if (values)
          used.push_back(source.column);
        if (values && !source.expression.empty())
          throw InputError("Entry Transient/" + source.entry + " is an expression, but the table \"" +
                           parameters.drive_table + "\" has a column " + source.column +
                           ": leave one of them out.");
        if (values)
        {
          const LinearTable linear("The column " + source.column + " of the table \"" +
                                       parameters.drive_table + "\"",
                                   table->column("time_s"), *values);
          linear(0);
          linear(parameters.end_time);
          return linear;
        }
        if (!source.expression.empty())
          return read_expression(source.expression, "t", "Transient/" + source.entry,
                                 "the time t: write for instance 0.002*min(t/0.01,1)");
        return [constant = source.constant](double) { return constant; };
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
            throw InputError("The table \"" + parameters.drive_table + "\" has a column " + name +
                             ", which drives nothing: known are time_s, longitudinal_creepage, "
                             "lateral_creepage, spin_1_m and either normal_force_N or hub_displacement_m.");
      }

    private:
      const TransientParameters &parameters;
      std::optional<CsvTable> table;
      std::vector<std::string> used;
    };

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

  DriveFunction drive_function(const TransientParameters &transient, const RollingCase &constant,
                               const ContactGrid &grid)
  {
    Sources sources(transient);
    const Source force_source{"Normal force", "normal_force_N", transient.normal_force,
                              constant.normal_force},
        hub_source{"Hub displacement", "hub_displacement_m", transient.hub_displacement,
                   constant.hub_displacement};
    const auto longitudinal =
                   sources.function({"Longitudinal creepage", "longitudinal_creepage",
                                     transient.longitudinal_creepage, constant.creepage.longitudinal}),
               lateral = sources.function({"Lateral creepage", "lateral_creepage", transient.lateral_creepage,
                                           constant.creepage.lateral}),
               spin = sources.function({"Spin", "spin_1_m", transient.spin, constant.creepage.spin});
    const bool moved = sources.given(hub_source);
    const bool by_force = sources.given(force_source) || (!moved && constant.normal_force > 0);
    if (by_force && moved)
      throw InputError(
          "Section Transient drives both the normal force and the hub displacement: leave one of "
          "them out.");
    const auto load = sources.function(by_force ? force_source : hub_source);
    sources.check_all_used();
    const double speed = constant.creepage.speed, h = transient.time_step;
    const FunctionOfTime hub_acceleration =
        moved ? acceleration(load, h, sources.last_time()) : FunctionOfTime();

    std::shared_ptr<const Roughness> roughness;
    if (transient.roughness.any())
    {
      if (speed == 0)
        throw InputError("Section Transient/Roughness gives a roughness, but Rolling/Speed is 0, so that it "
                         "does not move: give a speed or leave it out.");
      roughness = std::make_shared<Roughness>(transient.roughness, grid);
      roughness->heights(0);
      roughness->heights(speed * transient.end_time);
    }
    return [=, creepage = constant.creepage](const double t)
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
        {
          std::ostringstream text;
          text << "Entry Transient/Normal force is " << drive.normal_force << " N at t = " << t
               << " s, but it has to be positive: a contact that opens is moved by Hub displacement.";
          throw InputError(text.str());
        }
      }
      else
        drive.approach = load(t);
      if (hub_acceleration)
        drive.hub_acceleration = hub_acceleration(t);
      if (roughness)
        for (const double height : roughness->heights(speed * t))
          drive.gap.push_back(-height);
      return drive;
    };
  }
} // namespace vibrocontact
