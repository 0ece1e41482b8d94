#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/coupled_bodies/followed_root.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace vibrocontact
{
  using Complex = std::complex<double>;

  namespace
  {
    /// of |s|
    constexpr double crossing = 1e-3;
    constexpr double alike = 0.5;
    constexpr double as_listed = 1e-6;
    /// roots that decay and are looked at beside those that grow
    constexpr std::ptrdiff_t n_nearest = 3;

    /// |x_a^H x_b|^2 of forces of unit length
    double likeness(const FollowedRoot &root, const ContactReceptance &next, const ContactRoot &found)
    {
      Complex product = 0;
      double before = 0, now = 0;
      for (const auto &[place, force] : root.forces)
        before += std::norm(force);
      for (unsigned int i = 0; i < found.x.size(); ++i)
      {
        now += std::norm(found.x[i]);
        if (const auto known = root.forces.find(next.unknowns()[i]); known != root.forces.end())
          product += std::conj(known->second) * found.x[i];
      }
      return std::norm(product) / (before * now);
    }
  } // namespace

  Complex value_of(const StabilityRoot &root)
  {
    return {root.growth, 2 * dealii::numbers::PI * root.frequency};
  }

  bool is_at(const Complex &s, const StabilityRoot &root)
  {
    return root.frequency > 0 && std::abs(s - value_of(root)) < as_listed * std::abs(s);
  }

  std::vector<unsigned int> growing_and_nearest(const std::vector<StabilityRoot> &all)
  {
    // beside a body that poles stand for, the others are only nearly roots
    const bool some_exact =
        std::any_of(all.begin(), all.end(), [](const StabilityRoot &root) { return root.exact; });
    std::vector<unsigned int> numbers;
    for (unsigned int i = 0; i < all.size(); ++i)
      if (all[i].frequency > 0 && (all[i].exact || !some_exact))
        numbers.push_back(i);
    std::stable_sort(numbers.begin(), numbers.end(),
                     [&](const unsigned int a, const unsigned int b)
                     { return all[a].divergence_rate > all[b].divergence_rate; });
    const auto first_decaying = std::find_if(numbers.begin(), numbers.end(),
                                             [&](const unsigned int i) { return !(all[i].growth > 0); });
    if (numbers.end() - first_decaying > n_nearest)
      numbers.erase(first_decaying + n_nearest, numbers.end());
    return numbers;
  }

  const StabilityRoot &nearest_listed(const std::vector<StabilityRoot> &all, const Complex &s)
  {
    return *std::min_element(all.begin(), all.end(),
                             [&](const StabilityRoot &a, const StabilityRoot &b)
                             { return std::abs(value_of(a) - s) < std::abs(value_of(b) - s); });
  }

  FollowedRoot followed_root(const ContactReceptance &F, const ContactRoot &root)
  {
    FollowedRoot result;
    result.s = root.s;
    result.residual = root.residual;
    result.iterations = root.iterations;
    for (unsigned int i = 0; i < root.x.size(); ++i)
      result.forces[F.unknowns()[i]] = root.x[i];
    return result;
  }

  ContactRoot next_root(const FollowedRoot &root, const ContactReceptance &next, const Complex &start,
                        const double reach, const bool with_left_vector)
  {
    std::vector<Complex> x(next.size());
    double size = 0;
    for (unsigned int i = 0; i < x.size(); ++i)
      if (const auto known = root.forces.find(next.unknowns()[i]); known != root.forces.end())
      {
        x[i] = known->second;
        size += std::norm(x[i]);
      }
    // no point in common: the direction is sought as well
    ContactRoot found =
        contact_root(next, start, size > 0 ? std::move(x) : std::vector<Complex>(), with_left_vector);
    const double distance = std::abs(found.s - start);
    const bool is_it =
        distance <= reach || (distance <= crossing * std::abs(start) && likeness(root, next, found) > alike);
    if (!is_it)
      throw ConvergenceError("The root at " + number_text(root.s.imag() / (2 * dealii::numbers::PI)) +
                             " Hz leads to a neighbour's at " +
                             number_text(found.s.imag() / (2 * dealii::numbers::PI)) + " Hz.");
    return found;
  }

  std::vector<double> reaches(const std::vector<Complex> &starts)
  {
    constexpr double farthest = 0.02;
    std::vector<double> result;
    for (unsigned int i = 0; i < starts.size(); ++i)
    {
      double reach = farthest * std::abs(starts[i]);
      for (unsigned int j = 0; j < starts.size(); ++j)
        if (j != i)
          reach = std::min(reach, std::abs(starts[i] - starts[j]) / 2);
      result.push_back(reach);
    }
    return result;
  }

  Complex change_of_root(const ContactReceptance &root_of, const ContactRoot &root,
                         const ContactReceptance &other)
  {
    if (root_of.unknowns() != other.unknowns())
      throw ConvergenceError("Contact points open or close within the step of a derivative.");
    const ComplexVector moved = other.times(root.s, ComplexVector(root.x.begin(), root.x.end()));
    Complex sum = 0;
    for (unsigned int i = 0; i < moved.size(); ++i)
      sum += root.y[i] * moved[i];
    return sum;
  }
} // namespace vibrocontact
