#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/coupled_bodies/quasi_static_rolling.h>
#include <vibrocontact/marching/check_drive.h>
#include <vibrocontact/marching/march.h>
#include <vibrocontact/marching/transient_parameters.h>
#include <vibrocontact/scene/carried_waves.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <sstream>

namespace vibrocontact
{
  namespace
  {
    /// most instants at which a drive is looked at before a run
    constexpr unsigned int most_checked_instants = 20000;

    /// Where a function changes at once between two instants: the half in which it changes by more is halved until a steady
    /// function would change by less than a hundredth. Empty: it does not jump. @param rounding no jump is as small
    std::optional<double> jump_between(const std::function<double(double)> &function, double begin,
                                       double end, const double rounding)
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

  void check_hub_does_not_jump(const TransientParameters &transient)
  {
    const std::function<double(double)> displacement = hub_displacement_over_time(transient);
    // a jump against the motion is hidden by what moves beside it: the less, the shorter the parts are
    constexpr double parts_of_a_step = 16;
    const double n_steps = steps_until(transient.end_time, transient.time_step),
                 n = parts_of_a_step * std::min<double>(most_checked_instants, std::max(1., n_steps)),
                 part = transient.end_time / n;
    double size = 0;
    for (unsigned int k = 0; k <= n; ++k)
      size = std::max(size, std::abs(displacement(k * part)));
    for (unsigned int k = 0; k < n; ++k)
      if (const auto jump = jump_between(displacement, k * part, (k + 1) * part, 1e-12 * size))
        throw InputError(load_over_time(transient).name + " jumps at t = " + number_text(*jump) +
                         " s, which would take an infinite force on the body: write a ramp, for instance "
                         "0.001*min(t/0.01,1), or move a load by Normal force, which may jump.");
  }

  void check_drive(const TransientParameters &transient, const RollingCase &constant,
                   const PlacedContacts &contacts)
  {
    const auto look = [&](const DriveFunction &drive, const double most_instants)
    {
      const double n =
          std::min(most_instants, std::max(1., steps_until(transient.end_time, transient.time_step)));
      for (unsigned int k = 0; k <= n; ++k)
        drive(k / n * transient.end_time);
      return drive(0);
    };
    TransientParameters smooth = transient;
    smooth.roughness = {};
    const DriveFunction smooth_drive = drive_function(smooth, constant, contacts);
    const Drive first = look(smooth_drive, most_checked_instants);
    const double step = transient.least_step(), n_steps = steps_until(transient.end_time, step);
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
