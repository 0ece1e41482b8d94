#include <vibrocontact/bodies/identified_model.h>
#include <vibrocontact/numerics/complex_singular_values.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  using Complex = std::complex<double>;

  namespace
  {
    struct Component
    {
      unsigned int pole;
      double sigma, importance;
      std::vector<Complex> right, left;
    };
  } // namespace

  IdentifiedModel identified_model(const PoleFit &fit, const EntryMap &map, const double tolerance)
  {
    const unsigned int n = map.n_rows;
    std::vector<Component> components;
    double whole = 0;
    for (unsigned int k = 0; k < fit.poles.size(); ++k)
    {
      ComplexMatrix residue(n, n);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          residue(i, j) = fit.residues[map.entry[i * n + j]][k];
      const ComplexSingularValues decomposed = complex_singular_values(residue);
      for (unsigned int c = 0; c < n; ++c)
      {
        Component component;
        component.pole = k;
        component.sigma = decomposed.values[c];
        component.importance = component.sigma / std::abs(fit.poles[k].real());
        for (unsigned int i = 0; i < n; ++i)
        {
          component.right.push_back(std::sqrt(component.sigma) * decomposed.left(i, c));
          component.left.push_back(std::sqrt(component.sigma) * decomposed.right(c, i));
        }
        whole = std::max(whole, component.importance);
        components.push_back(component);
      }
    }
    std::vector<unsigned int> order(components.size());
    for (unsigned int c = 0; c < order.size(); ++c)
      order[c] = c;
    std::stable_sort(order.begin(), order.end(),
                     [&](const unsigned int a, const unsigned int b)
                     { return components[a].importance < components[b].importance; });
    IdentifiedModel result;
    std::vector<bool> kept(components.size(), true);
    double dropped = 0;
    for (const unsigned int c : order)
    {
      dropped += components[c].importance;
      if (components[c].sigma > 0 && dropped > tolerance * whole)
        break;
      kept[c] = false;
      result.truncation = whole > 0 ? dropped / whole : 0;
    }

    BodyInContact &model = result.model;
    const unsigned int n_states = std::count(kept.begin(), kept.end(), true);
    model.right.reinit(n, n_states);
    model.left.reinit(n, n_states);
    model.pole_load.assign(n_states, 0.);
    for (unsigned int c = 0; c < components.size(); ++c)
      if (kept[c])
      {
        const unsigned int state = model.poles.size();
        model.poles.push_back(fit.poles[components[c].pole]);
        for (unsigned int i = 0; i < n; ++i)
        {
          model.right(i, state) = components[c].right[i];
          model.left(i, state) = components[c].left[i];
        }
      }
    model.residual.reinit(n, n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        model.residual(i, j) = fit.direct[map.entry[i * n + j]];
    return result;
  }
} // namespace vibrocontact
