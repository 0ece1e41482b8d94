#include <vibrocontact/analyses/transient/drive.h>
#include <vibrocontact/analyses/transient/transient_parameters.h>
#include <vibrocontact/base/csv_table.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/expression.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/coupled_bodies/creepage_limits.h>
#include <vibrocontact/coupled_bodies/quasi_static_rolling.h>
#include <vibrocontact/scene/carried_waves.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <sstream>
#include <tuple>

namespace vibrocontact
{
  namespace
  {
    using FunctionOfTime = std::function<double(double)>;

    /// that a drive is looked at before a run
    constexpr unsigned int most_checked_instants = 20000;

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

    /// Where a function changes at once between two instants: the half in which it changes by more is halved until a steady
    /// function would change by less than a hundredth. Empty: it does not jump. @param rounding no jump is as small
    std::optional<double> jump_between(const FunctionOfTime &function, double begin, double end,
                                       const double rounding)
    {
      constexpr unsigned int n_halvings = 7;
      constexpr double most_share = 0.1;
      double at_begin = function(begin), at_end = function(end), largest = std::abs(at_end - at_begin);
      for (unsigned int k = 0; k < n_halvings; ++k)
      {
        const double middle = (begin + end) / 2, at_middle = function(middle);
        const bool first = std::abs(at_middle - at_begin) > std::abs(at_end - at_middle);
        (first ? end : begin) = middle;
        (first ? at_end : at_begin) = at_middle;
        largest = std::max(largest, std::abs(at_end - at_begin));
      }
      const double left = std::abs(at_end - at_begin);
      return left > std::max(most_share * largest, rounding) ? std::optional<double>(end) : std::nullopt;
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

  void check_hub_does_not_jump(const TransientParameters &transient)
  {
    Sources sources(transient);
    const Source hub = hub_source(transient, 0);
    const FunctionOfTime displacement = sources.function(hub);
    // a jump against the motion is hidden by what moves beside it: the less, the shorter the parts are
    constexpr double parts_of_a_step = 16;
    const double n_steps = std::floor(transient.end_time / transient.time_step + 1e-6),
                 n = parts_of_a_step * std::min<double>(most_checked_instants, std::max(1., n_steps)),
                 part = transient.end_time / n;
    double size = 0;
    for (unsigned int k = 0; k <= n; ++k)
      size = std::max(size, std::abs(displacement(k * part)));
    for (unsigned int k = 0; k < n; ++k)
      if (const auto jump = jump_between(displacement, k * part, (k + 1) * part, 1e-12 * size))
        throw InputError(sources.name(hub) + " jumps at t = " + number_text(*jump) +
                         " s, which would take an infinite force on the body: write a ramp, for instance "
                         "0.001*min(t/0.01,1), or move a load by Normal force, which may jump.");
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

  namespace
  {
    /// Of what an expression or a table gives on the way.
    double share_of_short_waves(const RoughnessParameters &parameters, const ContactGrid &grid,
                                const double way)
    {
      if (grid.n_x < 2)
        return 0;
      // under a point at x = 0 the height is that at s
      const Roughness along(parameters, single_point(grid.spacing_x));
      const double begin = -grid.x(grid.n_x - 1), end = way - grid.x(0);
      return check_carried_waves(
          parameters.table.empty() ? "Transient/Roughness/Expression" : "Transient/Roughness/Table",
          [&](const double s) { return along.heights(std::clamp(s, begin, end)).front(); }, begin, end,
          grid.spacing_x, "the Grid spacing of the contact");
    }

    /// Between its steps a drive has to be what its values at their ends say: the part of its variation (rms) that lies between, 0
    /// if it is small or of a jump or two.
    /// @param n_looked at so many steps, evenly over the run
    double unseen_variation(const std::function<double(double)> &value, const double step,
                            const double n_steps, const double n_looked)
    {
      constexpr double golden = 0.6180339887498949, most_unseen = 0.2;
      constexpr unsigned int least_looks = 256;
      if (n_steps < 1)
        return 0;
      const unsigned int n = std::min(n_steps, n_looked), per_step = 1 + least_looks / n;
      std::vector<double> unseen, between;
      for (unsigned int k = 0; k < n * per_step; ++k)
      {
        const double begin = std::floor((k / per_step) / double(n) * n_steps) * step,
                     share = std::fmod(golden * (k + 1), 1.);
        between.push_back(value(begin + share * step));
        unseen.push_back(
            std::pow(between.back() - (1 - share) * value(begin) - share * value(begin + step), 2));
      }
      const double mean = std::accumulate(between.begin(), between.end(), 0.) / between.size();
      double variation = 0;
      for (const double one : between)
        variation += std::pow(one - mean, 2);
      // a jump or two are no oscillation
      const std::size_t in_jumps = std::min<std::size_t>(std::max(8u, 2 * per_step), unseen.size());
      std::sort(unseen.begin(), unseen.end());
      const auto sum_of = [&](const std::size_t n_left_out)
      { return std::accumulate(unseen.begin(), unseen.end() - n_left_out, 0.); };
      const bool oscillates = sum_of(in_jumps) > most_unseen * most_unseen * variation &&
                              variation > 1e-20 * between.size() * mean * mean;
      return oscillates ? std::min(1., std::sqrt(sum_of(0) / variation)) : 0;
    }
  } // namespace

  void check_drive(const TransientParameters &transient, const RollingCase &constant,
                   const PlacedContacts &contacts)
  {
    const auto look = [&](const DriveFunction &drive, const double most_instants)
    {
      const double n =
          std::min(most_instants, std::max(1., std::floor(transient.end_time / transient.time_step + 1e-6)));
      for (unsigned int k = 0; k <= n; ++k)
        drive(k / n * transient.end_time);
      return drive(0);
    };
    TransientParameters smooth = transient;
    smooth.roughness = {};
    const DriveFunction smooth_drive = drive_function(smooth, constant, contacts);
    const Drive first = look(smooth_drive, most_checked_instants);
    const double step = transient.least_step(), n_steps = std::floor(transient.end_time / step + 1e-6);
    const auto check_seen =
        [&](const DriveFunction &drive, const std::string &name, const auto &part, const double n_looks)
    {
      const double unseen =
          unseen_variation([&](const double t) { return part(drive(t)); }, step, n_steps, n_looks);
      if (unseen > 0)
        throw InputError(name + " varies between the steps, which do not see " + percent_text(unseen) +
                         " of its variation (rms): take a shorter Transient/Time step, or a smoother one.");
    };
    const auto name_of = [&](const std::string &entry, const std::string &expression)
    {
      return "Transient/" + (expression.empty() ? "Drive table, \"" + transient.drive_table + "\": " : "") +
             entry;
    };
    using Part = double (*)(const Drive &);
    for (const auto &[name, part] :
         {std::pair<std::string, Part>(load_over_time(transient).name, [](const Drive &drive)
                                       { return drive.normal_force + drive.approach; }),
          {name_of("Longitudinal creepage", transient.longitudinal_creepage),
           [](const Drive &drive) { return drive.creepage.longitudinal; }},
          {name_of("Lateral creepage", transient.lateral_creepage),
           [](const Drive &drive) { return drive.creepage.lateral; }},
          {name_of("Spin", transient.spin), [](const Drive &drive) { return drive.creepage.spin; }},
          {name_of("Exciting force", transient.exciting_force),
           [](const Drive &drive) { return drive.force; }}})
      check_seen(smooth_drive, name, part, most_checked_instants);
    if (transient.roughness.any())
    {
      const DriveFunction rough = drive_function(transient, constant, contacts);
      look(rough, 200);
      check_seen(
          rough, "Transient/Roughness", [](const Drive &drive) { return drive.gap.front(); }, 200);
      double share = 0;
      if (transient.roughness.spectrum.empty())
        for (const PlacedContact &contact : contacts.all)
          share = std::max(share, share_of_short_waves(transient.roughness, contact.grid,
                                                       constant.creepage.speed * transient.end_time));
      if (share > 0.01)
        run_log().line("Of the roughness " + percent_text(share) +
                       " (rms) are waves shorter than two spacings of the contact grid, which does not carry "
                       "them.");
    }
    const auto replaces = [](const char *by, const double value, const char *unit, const char *replaced)
    {
      std::ostringstream text;
      text << "The transient is driven by its own " << by << ": Rolling/" << replaced << ", " << value << " "
           << unit << ", is not used in it.";
      run_log().line(text.str());
    };
    if (first.normal_force == 0 && constant.normal_force > 0)
      replaces("hub displacement", constant.normal_force, "N", "Normal force");
    if (first.normal_force > 0 && constant.hub_displacement > 0)
      replaces("normal force", constant.hub_displacement, "m", "Hub displacement");
  }
} // namespace vibrocontact
