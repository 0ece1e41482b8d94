#include <vibrocontact/base/log.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/coupled_bodies/hysteretic_loss.h>
#include <vibrocontact/coupled_bodies/residual_damping.h>
#include <vibrocontact/output/verdict.h>
#include <vibrocontact/run/say_residual_damping.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <complex>
#include <utility>

namespace vibrocontact
{
  namespace
  {
    constexpr double doubtful_change = 0.01;
    /// less is the round-off of a residual that all modes leave nothing to
    constexpr double least_change = 1e-9;

    std::vector<double> ends_of_the_modes(const std::vector<LossyBody> &bodies)
    {
      double lowest = 0, highest = 0;
      const auto count = [&](const double omega)
      {
        if (!(omega > 0))
          return;
        lowest = lowest == 0 ? omega : std::min(lowest, omega);
        highest = std::max(highest, omega);
      };
      for (const LossyBody &lossy : bodies)
      {
        for (const double omega : lossy.body->omega)
          count(omega);
        for (const std::complex<double> &pole : lossy.body->poles)
          count(std::abs(pole));
      }
      return {lowest / (2 * dealii::numbers::PI), highest / (2 * dealii::numbers::PI)};
    }

    /// Body k of the scene with its row of the point that is looked at.
    struct BodyAtPoint
    {
      unsigned int k;
      const ReducedBody *reduced;
      unsigned int row;
      /// at which it relaxes in the analysis [s]
      double relaxation;
    };

    void say(const Parameters &parameters, const std::vector<BodyAtPoint> &reduced, const double further,
             std::vector<double> frequencies, const std::string &key, const bool relaxes, Results &results)
    {
      std::vector<LossyBody> bodies;
      bool any = false, all_taken = true;
      for (const BodyAtPoint &one : reduced)
      {
        const BodyParameters &body = parameters.scene.bodies[one.k];
        // damping of wheels is given by mode
        const double loss = body.description->is_wheel() ? 0 : body.material_loss_factor();
        const double beta = parameters.stiffness_damping(body);
        const double taken = relaxes ? one.relaxation : 0;
        bodies.push_back({one.reduced, one.row, beta, loss, taken});
        any = any || beta > 0 || loss > 0;
        all_taken = all_taken && loss == 0 && taken == beta;
      }
      if (!any)
        return;
      if (all_taken)
      {
        results.analyses[key]["residual_damping"] = {{"taken", true}};
        return;
      }
      if (frequencies.empty())
        frequencies = ends_of_the_modes(bodies);
      const DroppedDamping dropped = dropped_residual_damping(bodies, further, frequencies);
      if (!(dropped.change > least_change))
        return;
      results.analyses[key]["residual_damping"] = {
          {"taken", false}, {"relative_change", dropped.change}, {"frequency_Hz", dropped.frequency}};
      const std::string text =
          "The damping of what the modes leave out is not taken here" +
          std::string(relaxes ? " but for that by Stiffness damping of bodies at rest without tread" : "") +
          ": it changes the point receptance in the contact by " + number_text(dropped.change) +
          " of it at " + number_text(dropped.frequency) + " Hz";
      if (dropped.change < doubtful_change)
      {
        run_log().line(text + ".");
        return;
      }
      doubt(text + "; keep more modes.", results);
    }
  } // namespace

  void say_residual_damping(const Parameters &parameters, const PreparedPair &prepared,
                            const ContactPair &pair, const std::vector<double> &frequencies,
                            const std::string &key, Results &results, const bool relaxes)
  {
    // half-spaces alone lose nothing, and no other body is there
    if (pair.half_spaces)
      return;
    const PlacedContacts &contacts = pair.interface.contacts;
    const unsigned int middle = contacts.all.front().grid.n_points() / 2;
    double further = pair.residual(middle, middle);
    std::vector<BodyAtPoint> reduced;
    for (unsigned int b = 0; b < prepared.bodies.size(); ++b)
    {
      const ReducedBody *const body = prepared.bodies[b].reduced;
      const std::vector<unsigned int> rows = contacts.rows_of(b).rows;
      const auto own = std::find(rows.begin(), rows.end(), middle);
      if (!body || own == rows.end())
        continue;
      const unsigned int row = own - rows.begin();
      const auto rest = std::find_if(pair.relaxing.begin(), pair.relaxing.end(),
                                     [b](const RelaxingRest &one) { return one.body == b + 1; });
      reduced.push_back({b, body, row, rest == pair.relaxing.end() ? 0. : rest->relaxation});
      further -= body->residual(row, row);
    }
    say(parameters, reduced, further, frequencies, key, relaxes, results);
  }

  void say_residual_damping(const Parameters &parameters, const std::vector<const ReducedBody *> &reduced,
                            const double further, std::vector<double> frequencies, const std::string &key,
                            Results &results, const bool relaxes)
  {
    std::vector<BodyAtPoint> in_the_middle;
    for (unsigned int k = 0; k < reduced.size(); ++k)
      if (reduced[k])
        in_the_middle.push_back({k, reduced[k], reduced[k]->grid.n_points() / 2, reduced[k]->relaxation});
    say(parameters, in_the_middle, further, std::move(frequencies), key, relaxes, results);
  }

  void say_coupled_damping(const std::vector<const ReducedBody *> &reduced, Results &results)
  {
    constexpr double doubtful_coupling = 0.1;
    for (const ReducedBody *const body : reduced)
      if (body && body->damping_coupling > doubtful_coupling)
        doubt(
            "The damping matrix of " + body->name + " couples modes by up to " +
                percent_text(body->damping_coupling) +
                " of what it does to either. In contact each mode takes its own part alone: growth and decay "
                "of modes of nearby frequencies may be wrong by as much as their damping. Frequency "
                "responses keep the matrix whole.",
            results);
  }

  void say_coupled_damping(const PreparedPair &prepared, Results &results)
  {
    std::vector<const ReducedBody *> reduced;
    for (const ContactBody &one : prepared.bodies)
      reduced.push_back(one.reduced);
    say_coupled_damping(reduced, results);
  }

  void say_hysteretic_rests(const Parameters &parameters, Results &results)
  {
    std::string elastic;
    bool any = false, by_poles = false;
    for (const BodyParameters &body : parameters.scene.bodies)
    {
      const std::optional<double> eta = loss_factor_of_rest(body);
      any = any || !eta || *eta > 0;
      by_poles = by_poles || (body.is_known_by_poles() && eta.value_or(1) > 0);
      if (!eta)
        elastic += (elastic.empty() ? "" : ", ") + body.name;
    }
    if (!any)
      return;
    results.analyses["stability"]["residual_damping"] = {{"taken", elastic.empty() && !by_poles}};
    if (elastic.empty())
      return;
    doubt("What the modes leave out of " + elastic +
              " stays elastic in stability, since the materials have several loss factors; keep more modes.",
          results);
  }
} // namespace vibrocontact
