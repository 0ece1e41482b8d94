#include <vibrocontact/analyses/stability/root_paths.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace vibrocontact
{
  namespace
  {
    using Shape = std::vector<std::complex<double>>;

    constexpr double widest_step = 0.15, least_likeness = 0.05;

    struct Match
    {
      double likeness;
      unsigned int before, now;
    };

    /// the most alike first, each once: for every root now the one before, or -1
    std::vector<int> assign(std::vector<Match> matches, const unsigned int n_before, const unsigned int n_now)
    {
      std::stable_sort(matches.begin(), matches.end(),
                       [](const Match &a, const Match &b) { return a.likeness > b.likeness; });
      std::vector<int> result(n_now, -1);
      std::vector<bool> taken(n_before, false);
      for (const Match &match : matches)
        if (result[match.now] < 0 && !taken[match.before])
        {
          result[match.now] = match.before;
          taken[match.before] = true;
        }
      return result;
    }

    Shape weighted(const StabilityRoot &root, const std::vector<double> &omega)
    {
      const double lambda_square =
          std::pow(root.growth, 2) + std::pow(2 * dealii::numbers::PI * root.frequency, 2);
      Shape shape = root.shape;
      double square = 0;
      for (unsigned int i = 0; i < shape.size(); ++i)
      {
        shape[i] *= std::sqrt(omega[i] * omega[i] + lambda_square);
        square += std::norm(shape[i]);
      }
      for (std::complex<double> &value : shape)
        value /= std::sqrt(square > 0 ? square : 1.);
      return shape;
    }
  } // namespace

  void RootPaths::follow(const std::vector<std::string> &mode_labels, const std::vector<double> &omega,
                         std::vector<StabilityRoot> &roots)
  {
    unsigned int n_now = 0;
    while (n_now < roots.size() && roots[n_now].frequency > 0)
      ++n_now;
    std::vector<Shape> now;
    for (unsigned int b = 0; b < n_now; ++b)
      now.push_back(weighted(roots[b], omega));

    const bool begins = labels != mode_labels;
    std::vector<Match> matches;
    if (begins)
    {
      labels = names = mode_labels;
      for (unsigned int b = 0; b < n_now; ++b)
        for (unsigned int i = 0; i < labels.size(); ++i)
          if (std::norm(now[b][i]) > 1e-3)
            matches.push_back({std::norm(now[b][i]), i, b});
    }
    else
      for (unsigned int b = 0; b < n_now; ++b)
        for (unsigned int a = 0; a < names.size(); ++a)
        {
          const double f = roots[b].frequency, step = std::abs(f - frequencies[a]),
                       limit = widest_step * std::max(f, frequencies[a]);
          if (step >= limit)
            continue;
          std::complex<double> product = 0;
          for (unsigned int i = 0; i < labels.size(); ++i)
            product += std::conj(shapes[a][i]) * now[b][i];
          const double likeness = std::norm(product) * (1 - step / limit);
          if (likeness > least_likeness)
            matches.push_back({likeness, a, b});
        }
    const std::vector<int> before = assign(std::move(matches), names.size(), n_now);

    // a root that follows none: its own free mode, numbered if that has a path
    std::vector<std::string> new_names(n_now);
    std::set<std::string> used;
    for (unsigned int b = 0; b < n_now; ++b)
      if (before[b] >= 0)
        used.insert(new_names[b] = names[before[b]]);
    for (unsigned int b = 0; b < n_now; ++b)
      for (unsigned int number = 1; new_names[b].empty(); ++number)
      {
        const std::string name = roots[b].label + (number > 1 ? " (" + std::to_string(number) + ")" : "");
        if (used.insert(name).second)
          new_names[b] = name;
      }
    names = std::move(new_names);
    frequencies.clear();
    for (unsigned int b = 0; b < roots.size(); ++b)
    {
      roots[b].path = b < n_now ? names[b] : "no oscillation";
      if (b < n_now)
        frequencies.push_back(roots[b].frequency);
    }
    shapes = std::move(now);
  }
} // namespace vibrocontact
