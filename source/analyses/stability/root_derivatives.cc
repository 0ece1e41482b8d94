#include <vibrocontact/analyses/stability/root_derivatives.h>
#include <vibrocontact/analyses/stability/root_scatter.h>
#include <vibrocontact/analyses/stability/sweep_case.h>
#include <vibrocontact/base/collective.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/failure.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/table.h>
#include <vibrocontact/coupled_bodies/all_roots.h>
#include <vibrocontact/coupled_bodies/followed_root.h>
#include <vibrocontact/output/verdict.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>

namespace vibrocontact
{
  namespace
  {
    using Complex = std::complex<double>;
    constexpr double two_pi = 2 * dealii::numbers::PI;

    /// The contact's own equations of a case.
    struct EquationsOfCase
    {
      std::shared_ptr<const PairOfCase> bodies;
      std::shared_ptr<const ContactOperator> A;
      std::vector<PatchReceptance> receptances;
      RollingEquilibrium about;
      std::optional<ContactReceptance> F;
    };

    /// @param same of whose bodies it is; null: of others
    EquationsOfCase equations_of_case(const SweepCase &one, const std::optional<MeasuredData> &measured,
                                      const std::vector<const ReducedBody *> &reduced,
                                      const MeshedBodies &meshed, const EquationsOfCase *const same)
    {
      EquationsOfCase result;
      const RollingParameters rolling = rolling_of_case(one);
      const ContactSections &contacts = one.parameters().contacts;
      if (same)
      {
        result.bodies = same->bodies;
        result.A = same->A;
        result.receptances = same->receptances;
      }
      else
      {
        result.bodies = std::make_shared<const PairOfCase>(pair_of_case(one, measured, reduced, meshed));
        result.A = operator_of_stability(result.bodies->pair, contacts, rolling.creepage.speed);
        result.receptances = all_patch_receptances(result.bodies->pair, result.bodies->loss_or_null());
      }
      bool first = true;
      stability_equilibria(rolling, contacts, one.parameters().contact_solver, result.bodies->pair, result.A,
                           [&](StabilityResult &&, const RollingEquilibrium &about)
                           {
                             if (first)
                               result.about = about;
                             first = false;
                           });
      result.F.emplace(result.bodies->pair, find_creep_scheme(contacts.first().creep_scheme), result.about,
                       result.receptances, result.bodies->loss_or_null());
      return result;
    }

    /// Bodies that poles stand for.
    const std::vector<ExactReceptance> &exact_bodies(const EquationsOfCase &of)
    {
      static const std::vector<ExactReceptance> none;
      return of.bodies->loss ? of.bodies->loss->exact : none;
    }
    /// Whether all roots of a case can be listed: known ones are followed without the poles of a periodic rail.
    bool has_list(const EquationsOfCase &of)
    {
      const std::vector<ExactReceptance> &exact = exact_bodies(of);
      return std::all_of(exact.begin(), exact.end(),
                         [](const ExactReceptance &body) { return bool(body.by_poles); });
    }

    /// The receptance of a contact along the normal and along y, weighted by the normal forces of an equilibrium [m/N].
    std::array<Complex, 2> receptance_of(const EquationsOfCase &of, const RollingEquilibrium &weights,
                                         const Complex &s)
    {
      const ContactPair &pair = of.bodies->pair;
      const unsigned int n = pair.n_points();
      double sum = 0;
      for (unsigned int i = 0; i < n; ++i)
        sum += weights.contact.R[i];
      const std::array<unsigned int, 2> first = {{0, 2 * n}};
      std::array<Complex, 2> result = {};
      const auto add = [&](const DenseMatrix &basis, const ComplexMatrix &G)
      {
        for (unsigned int d = 0; d < 2; ++d)
        {
          ComplexVector moved(basis.n());
          for (unsigned int r = 0; r < moved.size(); ++r)
            for (unsigned int i = 0; i < n; ++i)
              moved[r] += weights.contact.R[i] / sum * basis(first[d] + i, r);
          const ComplexVector answer = product(G, moved);
          for (unsigned int r = 0; r < moved.size(); ++r)
            result[d] += moved[r] * answer[r];
        }
      };
      for (unsigned int d = 0; d < 2; ++d)
        for (unsigned int j = 0; j < n; ++j)
          for (unsigned int i = 0; weights.contact.R[j] != 0 && i < n; ++i)
            result[d] += weights.contact.R[i] / sum * weights.contact.R[j] / sum *
                         (of.bodies->loss ? of.bodies->loss->residual(first[d] + i, first[d] + j)
                                          : pair.residual(first[d] + i, first[d] + j));
      const std::vector<ExactReceptance> &exact = exact_bodies(of);
      // those of exact bodies are behind the others
      for (unsigned int b = 0; b + exact.size() < of.receptances.size(); ++b)
        if (const PatchReceptance &body = of.receptances[b]; body.basis.n() > 0)
          add(body.basis, body.value(s));
      for (const ExactReceptance &body : exact)
        add(body.basis, body.at(s));
      return result;
    }

    /// What a case does to the roots of the first.
    struct VariedRoots
    {
      std::vector<std::string> labels;
      /// of the first case: the decaying ones that are none of F
      std::vector<std::string> without;
      std::vector<Complex> s;
      /// 0: one that decays cannot be followed into this case, and is not listed where it is predicted
      std::vector<int> followed;
      /// y^T F x of this case's F
      std::vector<Complex> change;
      bool has_change = false;
      /// receptance_of() the contact at the frequency of each root, normal and lateral; empty: those of the first case
      std::vector<Complex> normal, lateral;

      template <typename Archive>
      void serialize(Archive &archive, const unsigned int)
      {
        archive &labels &without &s &followed &change &has_change &normal &lateral;
      }
    };

    class RootDerivatives : public SweptAnalysis
    {
    public:
      explicit RootDerivatives(const AnalysisRun &on)
          : on(on), sweep(on.sweep), asked(on.parameters.stability.derivatives),
            bodies(bodies_of_cases(on.sweep, on.bodies)), reduced(bodies), keeps(asked.entries.size())
      {
        for (unsigned int i = 0; i < keeps.size(); ++i)
          keeps[i] = vibrocontact::keeps_bodies(asked.entries[i]);
        run_log().block("Derivatives of the roots");
      }

      void prepare(const unsigned int k) override { reduced.prepare(k, k == 0); }

      PackedCase compute(const unsigned int k) override
      {
        if (!begun)
          begun = failure_of([&] { begin(); });
        begun->rethrow();
        VariedRoots result;
        if (k == 0)
        {
          result.labels = labels;
          result.without = without;
          for (const ContactRoot &root : roots)
            result.s.push_back(root.s);
          add_receptances(*nominal, result);
          return dealii::Utilities::pack(result, false);
        }
        const EquationsOfCase varied = equations_of_case(sweep.cases[k], on.measured, reduced.of(k),
                                                         bodies[k], same_bodies(k) ? &*nominal : nullptr);
        result.has_change = varied.F->unknowns() == nominal->F->unknowns();
        std::vector<Complex> starts;
        for (const ContactRoot &root : roots)
        {
          result.change.push_back(result.has_change ? change_of_root(*nominal->F, root, *varied.F) : 0.);
          starts.push_back(root.s - result.change.back());
        }
        if (is_of_derivative(k) && !same_bodies(k))
          add_receptances(varied, result);
        const std::vector<double> reach = reaches(starts);
        std::vector<StabilityRoot> all;
        for (unsigned int r = 0; r < roots.size(); ++r)
          try
          {
            result.s.push_back(
                next_root(followed_root(*nominal->F, roots[r]), *varied.F, starts[r], reach[r]).s);
            result.followed.push_back(1);
          }
          catch (const ConvergenceError &)
          {
            if (is_of_derivative(k) && roots[r].s.real() > 0)
              throw;
            result.s.push_back(starts[r]);
            result.followed.push_back(0);
            if (is_of_derivative(k))
              continue;
            // in a draw the root by LAPACK that was predicted
            if (all.empty() && has_list(varied))
              all = roots_of(varied, k);
            const Complex s = all.empty() ? 0. : value_of(nearest_listed(all, starts[r]));
            if (std::abs(s - starts[r]) < reach[r])
            {
              result.s.back() = s;
              result.followed.back() = 1;
            }
            else if (roots[r].s.real() > 0)
              throw;
          }
        return dealii::Utilities::pack(result, false);
      }

      void take(const unsigned int k, const std::function<PackedCase()> &computed) override
      {
        try
        {
          results.push_back(dealii::Utilities::unpack<VariedRoots>(computed(), false));
          const VariedRoots &result = results.back();
          if (is_of_derivative(k) && !result.has_change)
            throw ConvergenceError("contact points open or close within the step of the derivative");
          for (const std::string &label : result.without)
            doubt("No derivatives of " + label +
                      ", which decays: the contact's own equations do not have this root.",
                  on.results);
          for (unsigned int r = 0; r < result.followed.size(); ++r)
            if (is_of_derivative(k) && !result.followed[r])
              doubt(case_text(sweep, sweep.cases[k]) + ": " + results.front().labels[r] +
                        ", which decays, cannot be followed, so that its derivative has no "
                        "difference beside it and is left out.",
                    on.results);
        }
        catch (const std::exception &error)
        {
          results.resize(k);
          results.emplace_back();
          const std::string text = case_text(sweep, sweep.cases[k]) + ": " + error.what();
          refuse("Derivatives: " + text, on.results);
        }
      }

      void finish() override
      {
        if (results.front().s.empty())
          return;
        Table table(
            {"root", "frequency_Hz", "growth_1_s", "entry", "value", "step", "frequency_per_unit_Hz",
             "growth_per_unit_1_s", "frequency_by_difference_Hz", "growth_by_difference_1_s"},
            {"Derivatives of the roots that grow, and of the three nearest to that, by left and right "
             "vectors, per SI unit of the entry;",
             "by_difference: of the roots themselves, followed to the value a step more and a step less"});
        nlohmann::ordered_json json = nlohmann::ordered_json::array();
        for (unsigned int r = 0; r < results.front().s.size(); ++r)
          for (unsigned int i = 0; i < asked.entries.size(); ++i)
          {
            const VariedRoots &more = results[2 * i + 1], &less = results[2 * i + 2];
            if (!more.has_change || !less.has_change || !more.followed[r] || !less.followed[r])
              continue;
            const Complex s = results.front().s[r], derivative = derivative_of(r, i),
                          difference = (more.s[r] - less.s[r]) / (2 * step(i));
            table.add_row({results.front().labels[r], s.imag() / two_pi, s.real(), asked.entries[i],
                           value(0, i), step(i), derivative.imag() / two_pi, derivative.real(),
                           difference.imag() / two_pi, difference.real()});
            json.push_back({{"root", results.front().labels[r]},
                            {"entry", asked.entries[i]},
                            {"value", value(0, i)},
                            {"frequency_per_unit_Hz", derivative.imag() / two_pi},
                            {"growth_per_unit_1_s", derivative.real()}});
            char line[300];
            std::snprintf(line, sizeof line, "%-20s %10.2f Hz %+9.3f 1/s  per %s: %+.5g Hz, %+.5g 1/s",
                          results.front().labels[r].c_str(), s.imag() / two_pi, s.real(),
                          asked.entries[i].c_str(), derivative.imag() / two_pi, derivative.real());
            run_log().line(line);
          }
        on.results.analyses["stability"]["derivatives"] = json;
        on_first_rank([&] { table.write(on.folder + "/stability_derivatives.csv"); });
        write_receptances();
        if (!asked.deviations.empty())
          on.results.analyses["stability"]["scatter"] = write_scatter(scatter(), on.folder);
      }

    private:
      void add_receptances(const EquationsOfCase &of, VariedRoots &result) const
      {
        for (const ContactRoot &root : roots)
        {
          const Complex s(0, root.s.imag());
          const auto [normal, lateral] = receptance_of(of, nominal->about, s);
          result.normal.push_back(normal);
          result.lateral.push_back(lateral);
        }
      }

      void write_receptances() const
      {
        Table table(
            {"frequency_Hz", "direction", "receptance_re_m_N", "receptance_im_m_N", "entry", "value",
             "derivative_re_m_N", "derivative_im_m_N"},
            {"Receptance of the bodies at the contact, both together, weighted by the normal forces of the "
             "equilibrium, at the frequencies of the roots,",
             "and its derivatives per SI unit of the entry; displacement of the first body less that of "
             "the second per force on the first"});
        for (unsigned int r = 0; r < results.front().s.size(); ++r)
          for (unsigned int i = 0; i < asked.entries.size(); ++i)
            for (const auto &[name, of] : {std::make_pair("normal", &VariedRoots::normal),
                                           std::make_pair("lateral", &VariedRoots::lateral)})
            {
              const VariedRoots &more = results[2 * i + 1], &less = results[2 * i + 2];
              if (more.s.empty() || less.s.empty())
                continue;
              const auto at = [&, of = of](const VariedRoots &one)
              { return ((one.*of).empty() ? results.front().*of : one.*of)[r]; };
              const Complex h = at(results.front()), derivative = (at(more) - at(less)) / (2 * step(i));
              table.add_row({results.front().s[r].imag() / two_pi, name, h.real(), h.imag(), asked.entries[i],
                             value(0, i), derivative.real(), derivative.imag()});
            }
        on_first_rank([&] { table.write(on.folder + "/receptance_derivatives.csv"); });
      }

      std::vector<StabilityRoot> roots_of(const EquationsOfCase &of, const unsigned int k) const
      {
        const Parameters &parameters = sweep.cases[k].parameters();
        return all_roots(of.bodies->pair, find_creep_scheme(parameters.contact().creep_scheme), of.about,
                         parameters.stability.options(), of.bodies->loss_or_null());
      }

      void begin()
      {
        nominal = equations_of_case(sweep.cases[0], on.measured, reduced.of(0), bodies[0], nullptr);
        const std::vector<StabilityRoot> all = roots_of(*nominal, 0);
        for (const unsigned int i : growing_and_nearest(all))
        {
          const StabilityRoot &root = all[i];
          try
          {
            ContactRoot found = contact_root(*nominal->F, value_of(root), {}, true);
            if (!is_at(found.s, root))
              throw ConvergenceError(
                  "The contact's equations do not have a root of the eigenproblem: " + root.label + ".");
            roots.push_back(std::move(found));
            labels.push_back(root.label);
          }
          catch (const ConvergenceError &)
          {
            if (root.growth > 0)
              throw;
            without.push_back(root.label);
          }
        }
        if (roots.empty())
          throw ConvergenceError(
              "None of the roots nearest to growing is one of the contact's own equations.");
      }

      /// Whether it is a step of an entry, more or less.
      bool is_of_derivative(const unsigned int k) const { return k > 0 && k <= 2 * asked.entries.size(); }

      bool same_bodies(const unsigned int k) const
      {
        for (unsigned int i = 0; i < keeps.size(); ++i)
          if (!keeps[i] && value(k, i) != value(0, i))
            return false;
        return true;
      }
      double value(const unsigned int k, const unsigned int i) const
      {
        return std::get<double>(sweep.cases[k].values[i]);
      }
      double step(const unsigned int i) const { return (value(2 * i + 1, i) - value(2 * i + 2, i)) / 2; }
      Complex derivative_of(const unsigned int r, const unsigned int i) const
      {
        return -(results[2 * i + 1].change[r] - results[2 * i + 2].change[r]) / (2 * step(i));
      }

      RootScatter scatter() const
      {
        const unsigned int m = asked.entries.size();
        RootScatter result;
        result.entries = asked.entries;
        result.deviations = asked.deviations;
        bool known = true;
        for (unsigned int k = 1; k <= 2 * m; ++k)
          known = known && results[k].has_change;
        for (unsigned int r = 0; r < results.front().s.size(); ++r)
        {
          result.roots.push_back({results.front().labels[r], results.front().s[r], {}, {}});
          for (unsigned int i = 0; i < m && known; ++i)
            result.roots.back().derivatives.push_back(derivative_of(r, i));
        }
        for (unsigned int k = 2 * m + 1; k < results.size(); ++k)
        {
          if (results[k].s.empty())
            continue;
          result.draws.push_back({k - 2 * m - 1, {}});
          for (unsigned int i = 0; i < m; ++i)
            result.draws.back().values.push_back(value(k, i));
          for (unsigned int r = 0; r < result.roots.size(); ++r)
            result.roots[r].growth.push_back(
                results[k].followed[r] ? std::optional<double>(results[k].s[r].real()) : std::nullopt);
        }
        return result;
      }

      const AnalysisRun &on;
      const SweepCases &sweep;
      const DerivativeParameters &asked;
      const std::vector<MeshedBodies> bodies;
      ReducedOfCases reduced;
      /// entries that change no body
      std::vector<bool> keeps;
      /// of the first case, on this rank, with its roots
      std::optional<EquationsOfCase> nominal;
      std::optional<Failure> begun;
      std::vector<ContactRoot> roots;
      std::vector<std::string> labels, without;
      std::vector<VariedRoots> results;
    };
  } // namespace

  std::optional<Variations> variations_of_roots(const Parameters &parameters)
  {
    const DerivativeParameters &asked = parameters.stability.derivatives;
    if (!asked.any())
      return {};
    const std::string section = "Stability/Derivatives";
    if (const ParameterSweep &sweep = parameters.sweeps.at("stability"); sweep.any())
      throw InputError(section + " are those of a single case, but Stability/Sweep sweeps " +
                       sweep.first.entry + ": empty one of them.");
    return Variations{"stability", section, asked.entries, asked.deviations, asked.n_draws, asked.seed};
  }

  std::unique_ptr<SweptAnalysis> root_derivatives(const AnalysisRun &on)
  {
    return std::make_unique<RootDerivatives>(on);
  }
} // namespace vibrocontact
