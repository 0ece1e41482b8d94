#include <vibrocontact/analyses/stability/stability.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/run/pair_in_time.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace vibrocontact
{
  namespace
  {
    /// bands at least; fits until growth by the poles is that of the rail
    constexpr unsigned int least_bands = 4, most_fits = 4;
    /// of a frequency: of bands to either side; how far a root by the poles may be from the one it stands for
    constexpr double half_band = 0.02, same_root = 0.01;
    /// of growth, by the poles; below this share of omega it counts as growth of that share
    constexpr double good_growth = 0.02, wrong_growth = 0.03, least_growth = 1e-5;

    /// digits of what the poles are fitted for: outside the bands the fit changes with every digit of their ends, which are kept
    /// free of the roots' rounding
    constexpr int digits_of_frequency = 4, digits_of_error = 2;

    /// To so many significant digits. @param value positive
    double rounded(const double value, const int digits)
    {
      Assert(value > 0, dealii::ExcMessage("Only positive numbers have digits to round to."));
      const double unit = std::pow(10., std::floor(std::log10(value)) + 1 - digits);
      return unit * std::round(value / unit);
    }

    /// Relative.
    double error_of_growth(const StabilityRoot &exact, const StabilityRoot &in_time)
    {
      const double least = least_growth * 2 * dealii::numbers::PI * exact.frequency;
      return std::abs(in_time.growth - exact.growth) / std::max(exact.growth, least);
    }

    struct Roots
    {
      std::vector<StabilityResult> cases;

      template <typename Function>
      void for_each_unstable(const Function &f) const
      {
        for (unsigned int c = 0; c < cases.size(); ++c)
          for (const StabilityRoot *const root : cases[c].unstable())
            f(c, *root);
      }
      /// of a case; null if none is near
      const StabilityRoot *nearest(const unsigned int c, const double frequency) const
      {
        const StabilityRoot *best = nullptr;
        for (const StabilityRoot &root : cases[c].roots)
          if (std::abs(root.frequency - frequency) < same_root * frequency &&
              (!best || root.divergence_rate > best->divergence_rate))
            best = &root;
        return best;
      }
    };

    Roots roots_of(const Parameters &parameters, const ContactPair &pair, const HystereticLoss *const loss)
    {
      StabilityParameters sought;
      sought.loss = loss ? "hysteretic" : "viscous";
      sought.stick = true;
      sought.upper_frequency = parameters.stability.upper_frequency;
      RollingParameters rolling = parameters.rolling;
      rolling.hub = parameters.hub();
      return {stability(
          sought, rolling, parameters.contacts, parameters.contact_solver, pair,
          [](const StabilityResult &) {}, {}, loss)};
    }

    /// null if there is none about a frequency
    FrequencyBand *band_about(std::vector<FrequencyBand> &bands, const double frequency)
    {
      const double omega = 2 * dealii::numbers::PI * frequency;
      const auto is_there = [&](const FrequencyBand &band)
      { return std::abs(band.middle() - omega) < same_root * omega; };
      const auto found = std::find_if(bands.begin(), bands.end(), is_there);
      return found == bands.end() ? nullptr : &*found;
    }

    void add_band(std::vector<FrequencyBand> &bands, const double frequency)
    {
      if (frequency == 0)
        throw ConvergenceError(
            "By the poles of the periodic rail a motion grows without oscillation, which the "
            "rail itself does not have: change its Pole pairs.");
      const double omega = 2 * dealii::numbers::PI * rounded(frequency, digits_of_frequency);
      if (!band_about(bands, frequency))
        bands.push_back({(1 - half_band) * omega, (1 + half_band) * omega});
    }

    std::vector<FrequencyBand> bands_about(const Roots &exact)
    {
      std::vector<FrequencyBand> bands;
      exact.for_each_unstable([&](unsigned int, const StabilityRoot &root)
                              { add_band(bands, root.frequency); });
      std::vector<const StabilityRoot *> nearest;
      for (const StabilityRoot &root : exact.cases.front().roots)
        if (root.exact)
          nearest.push_back(&root);
      std::stable_sort(nearest.begin(), nearest.end(),
                       [](const StabilityRoot *a, const StabilityRoot *b)
                       { return a->divergence_rate > b->divergence_rate; });
      for (unsigned int k = 0; k < nearest.size() && bands.size() < least_bands; ++k)
        add_band(bands, nearest[k]->frequency);
      std::sort(bands.begin(), bands.end(),
                [](const FrequencyBand &a, const FrequencyBand &b) { return a.from < b.from; });
      return bands;
    }

    /// Bands of roots whose growth by the poles is not yet that of the rail; whether there are any.
    bool come_nearer(std::vector<FrequencyBand> &bands, const Roots &exact, const Roots &in_time)
    {
      bool any = false;
      exact.for_each_unstable(
          [&](const unsigned int c, const StabilityRoot &root)
          {
            const StabilityRoot *const other = in_time.nearest(c, root.frequency);
            if (!other)
              return;
            const double error = error_of_growth(root, *other);
            if (error <= good_growth)
              return;
            double &aimed = band_about(bands, root.frequency)->aimed_error;
            aimed = rounded(aimed * std::max(0.3, good_growth / (2 * error)), digits_of_error);
            any = true;
          });
      return any;
    }

    void compare(const Roots &exact, const Roots &in_time, PairInTime &pair)
    {
      nlohmann::ordered_json &json = pair.roots = nlohmann::ordered_json::array();
      double worst = wrong_growth;
      exact.for_each_unstable(
          [&](const unsigned int c, const StabilityRoot &root)
          {
            const StabilityRoot *const other = in_time.nearest(c, root.frequency);
            char text[200];
            std::snprintf(text, sizeof text, "%10.3f Hz  growth %8.3f 1/s, in time %8.3f 1/s  %s",
                          root.frequency, root.growth, other ? other->growth : std::nan(""),
                          root.label.c_str());
            run_log().line(other ? text : "not found in time: " + root.label);
            const double error = other ? error_of_growth(root, *other) : 1;
            if (!(error <= worst))
            {
              worst = error;
              pair.wrong =
                  "By the poles of the periodic rail " + root.label + " at " + number_text(root.frequency) +
                  " Hz " + (other ? "grows by " + number_text(other->growth) : "does not grow") +
                  " instead of " + number_text(root.growth) +
                  " 1/s: change the rail's Pole pairs (16 to 24 mostly serve), or lower Fitted up to.";
            }
            json.push_back({{"case", c},
                            {"label", root.label},
                            {"frequency_Hz", root.frequency},
                            {"growth_1_s", root.growth}});
            if (other)
              json.back().update(
                  {{"frequency_in_time_Hz", other->frequency}, {"growth_in_time_1_s", other->growth}});
          });
    }
  } // namespace

  PairInTime prepare_pair_in_time(const Parameters &parameters, const MeshedBodies &bodies,
                                  const std::optional<MeasuredData> &measured)
  {
    PairInTime result{prepare_pair(parameters, bodies, measured, true)};
    if (std::none_of(bodies.tracks.begin(), bodies.tracks.end(),
                     [](const auto &track) { return bool(track); }))
      return result;
    run_log().block("Roots beside the periodic rail");
    const auto pair_of = [&]
    { return contact_pair(result.prepared->bodies, parameters.contacts, parameters.placed_contacts()); };
    ContactPair pair = pair_of();
    HystereticLoss loss = take_hysteretic_loss(pair, result.prepared->bodies, parameters.contacts,
                                               parameters.placed_contacts());
    loss.exact = exact_receptances(bodies, parameters.placed_contacts());
    const Roots exact = roots_of(parameters, pair, &loss);
    std::vector<FrequencyBand> bands = bands_about(exact);
    std::vector<double> alone, before;
    for (unsigned int k = 0; k < most_fits; ++k)
    {
      result.prepared = prepare_pair(parameters, bodies, measured, true, &bands);
      const Roots in_time = roots_of(parameters, pair_of(), nullptr);
      std::vector<double> growth;
      in_time.for_each_unstable([&](unsigned int, const StabilityRoot &root)
                                { growth.push_back(root.growth); });
      const bool is_last = k + 1 == most_fits || growth == before;
      before = growth;
      alone.clear();
      in_time.for_each_unstable(
          [&](const unsigned int c, const StabilityRoot &root)
          {
            const StabilityRoot *const other = exact.nearest(c, root.frequency);
            if (!other || !(other->growth > 0))
              alone.push_back(root.frequency);
          });
      if (alone.empty() && (is_last || !come_nearer(bands, exact, in_time)))
      {
        compare(exact, in_time, result);
        return result;
      }
      for (const double frequency : alone)
        add_band(bands, frequency);
    }
    throw ConvergenceError("By the poles of the periodic rail a root grows near " +
                           number_text(alone.front()) +
                           " Hz that the rail itself does not have: change its Pole pairs.");
  }
} // namespace vibrocontact
