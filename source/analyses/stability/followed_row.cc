#include <vibrocontact/analyses/stability/followed_row.h>
#include <vibrocontact/analyses/stability/root_paths.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/coupled_bodies/all_roots.h>
#include <vibrocontact/coupled_bodies/followed_root.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace vibrocontact
{
  namespace
  {
    using Complex = std::complex<double>;

    /// of |s|: how near two roots are one
    constexpr double one_root = 1e-9;
    /// of |s|: how far from a root that decays fast that of the poles may be
    constexpr double near_by_poles = 2e-3;
    /// of |s|: what decays faster does not come to grow between two complete cases
    constexpr double least_divergence = -5e-3;
    constexpr unsigned int longest_stride = 50, shortest_stride = 4;

    /// A case with its equilibrium.
    struct RowCase
    {
      LinearisationOptions options;
      const CreepScheme *scheme = nullptr;
      StabilityResult result;
      RollingEquilibrium about;
      std::shared_ptr<const PairOfCase> bodies;
      std::shared_ptr<const ContactReceptance> F;
      /// all roots, if it is a complete one
      std::vector<StabilityRoot> all;
      Failure failure;
    };

    /// A root through the cases of a row.
    struct Track
    {
      std::vector<Complex> s;
      std::vector<bool> known;
      FollowedRoot last;
      double residual = 0;
      /// whether it grows in no complete case, so that it need not be followed, and is not
      bool optional = true, is_dropped = false;

      void drop()
      {
        is_dropped = true;
        known.assign(known.size(), false);
      }
    };

    class Row
    {
    public:
      Row(std::vector<RowCase> &cases, const unsigned int first, const unsigned int end,
          const unsigned int number)
          : cases(cases), first(first), end(end)
      {
        const unsigned int n = end - first, stride = std::clamp((n + 1) / 2, shortest_stride, longest_stride);
        std::set<unsigned int> places = {first, end - 1};
        for (unsigned int k = number % 2 == 0 ? stride : (stride + 1) / 2; k < n; k += stride)
          places.insert(first + k);
        if (n < 5)
          for (unsigned int k = first; k < end; ++k)
            places.insert(k);
        anchors.assign(places.begin(), places.end());
      }

      void solve()
      {
        for (const unsigned int k : anchors)
          complete(k);
        try
        {
          choose();
          go_right();
          go_left();
          if (std::all_of(tracks.begin(), tracks.end(), [](const Track &track) { return track.is_dropped; }))
            throw ConvergenceError("None of its roots can be followed.");
          for (const Track &track : tracks)
            if (!track.is_dropped && !is_listed(track, first))
              throw ConvergenceError("A followed root is not there at the beginning of the row.");
        }
        catch (const ConvergenceError &error)
        {
          not_followed = error.what();
          is_followed = false;
          for (unsigned int k = first; k < end; ++k)
            complete(k);
        }
      }

      CaseOfRow outcome(const unsigned int k) const
      {
        CaseOfRow one;
        one.solved.result = cases[k].result;
        StabilityResult &result = one.solved.result;
        if (!is_followed || k == first)
        {
          result.roots = cases[k].all;
          one.solved.labels = cases[k].bodies->pair.labels;
          one.solved.omega = cases[k].bodies->pair.frequencies();
          if (k == first)
            one.solved.not_followed = not_followed;
          return one;
        }
        result.followed = cases[k].all.empty();
        for (const Track &track : tracks)
        {
          if (track.is_dropped)
            continue;
          const std::vector<StabilityRoot> &listed = cases[last_complete(k)].all;
          const unsigned int there = place(track, last_complete(k));
          StabilityRoot root;
          root.frequency = track.s[k].imag() / (2 * dealii::numbers::PI);
          root.growth = track.s[k].real();
          root.divergence_rate = track.s[k].real() / track.s[k].imag();
          root.label = listed[there].label;
          root.share = listed[there].share;
          root.exact = listed[there].exact;
          root.path = std::to_string(place(track, first));
          result.roots.push_back(root);
          one.solved.residual = std::max(one.solved.residual, track.residual);
        }
        sort_roots(result.roots);
        return one;
      }

    private:
      void complete(const unsigned int k)
      {
        RowCase &one = cases[k];
        if (one.all.empty())
          one.all =
              all_roots(one.bodies->pair, *one.scheme, one.about, one.options, one.bodies->loss_or_null());
        if (one.all.empty())
          throw ConvergenceError("No root of the linearised contact oscillates or grows: keep more modes.");
      }

      unsigned int last_complete(const unsigned int k) const
      {
        return *std::prev(std::upper_bound(anchors.begin(), anchors.end(), k));
      }

      /// Whether roots that decay fast are listed in a case where poles have them that stand for a body.
      bool lists_poles(const unsigned int k) const
      {
        return cases[k].bodies->loss && !cases[k].bodies->loss->exact.empty();
      }

      /// Its number in the list of a complete case; their number if it is not there. Beside a periodic rail roots that decay fast are
      /// listed where poles have them, near the root itself.
      unsigned int place(const Track &track, const unsigned int k) const
      {
        const std::vector<StabilityRoot> &all = cases[k].all;
        const Complex s = track.s[k];
        const auto at =
            std::find_if(all.begin(), all.end(), [&](const StabilityRoot &root) { return is_at(s, root); });
        if (at != all.end() || !lists_poles(k) || s.real() > 0)
          return at - all.begin();
        const StabilityRoot &nearest = nearest_listed(all, s);
        const bool stands_for_it =
            !nearest.exact && std::abs(value_of(nearest) - s) < near_by_poles * std::abs(s);
        return stands_for_it ? &nearest - all.data() : all.size();
      }
      bool is_listed(const Track &track, const unsigned int k) const
      {
        return track.known[k] && place(track, k) < cases[k].all.size();
      }

      /// Of each complete case the numbers of the roots that are followed from there, and whether they have to be.
      void choose()
      {
        RootPaths paths;
        std::map<std::string, double> before;
        std::vector<std::map<std::string, unsigned int>> number(anchors.size());
        chosen.resize(anchors.size());
        for (unsigned int a = 0; a < anchors.size(); ++a)
        {
          RowCase &one = cases[anchors[a]];
          std::vector<StabilityRoot> roots = one.all;
          paths.follow(one.bodies->pair.labels, one.bodies->pair.frequencies(), roots);
          std::map<std::string, double> growth;
          for (unsigned int i = 0; i < roots.size(); ++i)
          {
            const StabilityRoot &root = roots[i];
            if (root.frequency == 0)
              throw ConvergenceError("A root grows without oscillation.");
            growth[root.path] = root.growth;
            number[a][root.path] = i;
            const auto known = before.find(root.path);
            const bool may_grow = root.divergence_rate > least_divergence;
            const double change =
                known == before.end() || !may_grow ? 0 : std::abs(root.growth - known->second);
            if (root.growth > 0 || root.growth + change > 0)
              chosen[a][i] = root.growth > 0;
            if (known != before.end() && may_grow && known->second + change > 0)
              chosen[a - 1].emplace(number[a - 1].at(root.path), false);
          }
          for (const unsigned int i : growing_and_nearest(roots))
            chosen[a].emplace(i, false);
          before = std::move(growth);
        }
      }

      /// Each followed root has to be one of a complete case, no two the same. Beside a periodic rail one that need not be followed
      /// is dropped instead: those that decay fast are listed where poles have them.
      void check_listed(const unsigned int k)
      {
        std::set<unsigned int> taken;
        for (const bool optional : {false, true})
          for (Track &track : tracks)
            if (track.optional == optional && track.known[k] &&
                !(is_listed(track, k) && taken.insert(place(track, k)).second))
            {
              if (!optional || !lists_poles(k))
                throw ConvergenceError("A followed root near " +
                                       number_text(track.s[k].imag() / (2 * dealii::numbers::PI)) +
                                       " Hz is none of its own in a complete case.");
              track.drop();
            }
      }

      void begin_tracks(const unsigned int a)
      {
        const unsigned int k = anchors[a];
        check_listed(k);
        for (const auto &[i, has_to_be] : chosen[a])
        {
          const StabilityRoot &root = cases[k].all[i];
          const auto there = std::find_if(tracks.begin(), tracks.end(),
                                          [&root = root, k](const Track &track)
                                          { return !track.is_dropped && is_at(track.s[k], root); });
          if (there != tracks.end())
          {
            there->optional = there->optional && !has_to_be;
            continue;
          }
          ContactRoot found;
          try
          {
            found = root_at(k, root, true);
          }
          catch (const ConvergenceError &)
          {
            if (has_to_be || !lists_poles(k) || root.exact)
              throw;
            continue;
          }
          Track track;
          track.s.resize(cases.size());
          track.known.resize(cases.size());
          track.optional = !has_to_be;
          put(track, k, found);
          start_of.push_back(k);
          begun.push_back(found);
          tracks.push_back(std::move(track));
        }
      }

      /// A listed root as one of F.
      ContactRoot root_at(const unsigned int k, const StabilityRoot &root, const bool with_left_vector) const
      {
        const ContactRoot found = contact_root(*cases[k].F, value_of(root), {}, with_left_vector);
        if (!is_at(found.s, root))
          throw ConvergenceError("The contact's equations do not have a root of the eigenproblem.");
        return found;
      }

      void put(Track &track, const unsigned int k, const ContactRoot &root)
      {
        track.s[k] = root.s;
        track.known[k] = true;
        track.residual = std::max(track.residual, root.residual);
        track.last = followed_root(*cases[k].F, root);
      }

      /// Where Newton's method does not lead: of the roots by LAPACK the one that was predicted.
      ContactRoot root_from_list(const unsigned int k, const Complex &start, const double reach)
      {
        complete(k);
        const StabilityRoot &nearest = nearest_listed(cases[k].all, start);
        const ContactRoot found = root_at(k, nearest, false);
        if (std::abs(value_of(nearest) - start) > reach)
          throw ConvergenceError("The root at " + number_text(nearest.frequency) +
                                 " Hz is not the one that is followed.");
        return found;
      }

      /// All that are known in a case and not in the next.
      void advance(const unsigned int from, const unsigned int to)
      {
        std::vector<unsigned int> moving;
        std::vector<Complex> starts;
        const int before = 2 * int(from) - int(to);
        for (unsigned int i = 0; i < tracks.size(); ++i)
        {
          Track &track = tracks[i];
          if (track.known[to] || !track.known[from])
            continue;
          Complex start = track.s[from];
          if (before >= int(first) && before < int(end) && track.known[before])
            start += track.s[from] - track.s[before];
          else if (cases[from].F->unknowns() == cases[to].F->unknowns())
            start -= change_of_root(*cases[from].F, begun[i], *cases[to].F);
          moving.push_back(i);
          starts.push_back(start);
        }
        std::vector<Complex> all = starts;
        for (const Track &track : tracks)
          if (track.known[to])
            all.push_back(track.s[to]);
        const std::vector<double> reach = reaches(all);
        for (unsigned int m = 0; m < moving.size(); ++m)
          try
          {
            put(tracks[moving[m]], to, next_root(tracks[moving[m]].last, *cases[to].F, starts[m], reach[m]));
          }
          catch (const ConvergenceError &)
          {
            // a mode that hardly moves the contact has its root within round-off of a pole of F
            if (tracks[moving[m]].optional)
              tracks[moving[m]].drop();
            else
              put(tracks[moving[m]], to, root_from_list(to, starts[m], reach[m]));
          }
        for (unsigned int i = 0; i < tracks.size(); ++i)
          for (unsigned int j = 0; j < i; ++j)
            if (tracks[i].known[to] && tracks[j].known[to] &&
                std::abs(tracks[i].s[to] - tracks[j].s[to]) < one_root * std::abs(tracks[i].s[to]))
              throw ConvergenceError("Two followed roots become one.");
      }

      void go_right()
      {
        for (unsigned int a = 0; a < anchors.size(); ++a)
        {
          begin_tracks(a);
          for (unsigned int k = anchors[a]; a + 1 < anchors.size() && k < anchors[a + 1]; ++k)
            advance(k, k + 1);
        }
      }
      void go_left()
      {
        for (unsigned int i = 0; i < tracks.size(); ++i)
          tracks[i].last = followed_root(*cases[start_of[i]].F, begun[i]);
        for (unsigned int k = end - 1; k > first; --k)
        {
          advance(k, k - 1);
          if (std::count(anchors.begin(), anchors.end(), k - 1) > 0)
            check_listed(k - 1);
        }
      }

      std::vector<RowCase> &cases;
      const unsigned int first, end;
      std::vector<unsigned int> anchors;
      std::vector<std::map<unsigned int, bool>> chosen;
      std::vector<Track> tracks;
      std::string not_followed;
      bool is_followed = true;
      /// of each track the complete case in which it began, and its root with the left vector
      std::vector<unsigned int> start_of;
      std::vector<ContactRoot> begun;
    };
  } // namespace

  std::vector<CaseOfRow>
  followed_row(const std::vector<const SweepCase *> &row,
               const std::function<const std::vector<const ReducedBody *> &(unsigned int)> &reduced,
               const std::vector<const MeshedBodies *> &bodies, const std::optional<MeasuredData> &measured,
               const unsigned int number, const bool keeps_pair)
  {
    std::vector<RowCase> cases(row.size());
    std::shared_ptr<const PairOfCase> pair;
    std::shared_ptr<const ContactOperator> A;
    std::vector<PatchReceptance> receptances;
    for (unsigned int k = 0; k < row.size(); ++k)
      cases[k].failure = failure_of(
          [&]
          {
            const SweepCase &one = *row[k];
            const RollingParameters rolling = rolling_of_case(one);
            const LinearisationOptions options = one.parameters().stability.options();
            const CreepScheme &scheme = find_creep_scheme(one.parameters().contact().creep_scheme);
            cases[k].options = options;
            cases[k].scheme = &scheme;
            if (!pair || !keeps_pair)
            {
              pair.reset();
              const auto made =
                  std::make_shared<const PairOfCase>(pair_of_case(one, measured, reduced(k), *bodies[k]));
              A = operator_of_stability(made->pair, one.parameters().contacts, rolling.creepage.speed);
              receptances = all_patch_receptances(made->pair, made->loss_or_null());
              pair = made;
            }
            cases[k].bodies = pair;
            stability_equilibria(rolling, one.parameters().contacts, one.parameters().contact_solver,
                                 pair->pair, A,
                                 [&](StabilityResult &&result, const RollingEquilibrium &about)
                                 {
                                   cases[k].result = std::move(result);
                                   cases[k].about = about;
                                 });
            // which says why they are refused
            if (cases[k].result.stick_points > 0 && !options.stick)
              all_roots(pair->pair, scheme, cases[k].about, options, pair->loss_or_null());
            cases[k].F = std::make_shared<const ContactReceptance>(pair->pair, scheme, cases[k].about,
                                                                   receptances, pair->loss_or_null());
          });
    std::vector<CaseOfRow> outcome(row.size());
    for (unsigned int first = 0, end = 0; first < row.size(); first = end)
    {
      if (cases[first].failure)
      {
        outcome[first].failure = cases[first].failure;
        end = first + 1;
        continue;
      }
      for (end = first; end < row.size() && !cases[end].failure;)
        ++end;
      Row part(cases, first, end, number);
      const Failure failure = failure_of([&] { part.solve(); });
      for (unsigned int k = first; k < end; ++k)
        if (failure)
          outcome[k].failure = failure;
        else
          outcome[k] = part.outcome(k);
    }
    return outcome;
  }
} // namespace vibrocontact
