#pragma once

#include <functional>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace vibrocontact
{
  /// The law of each contact point: one for all, or one for each of several contacts, whose points follow each
  /// other.
  template <typename Law>
  class PointLaws
  {
  public:
    /// no law
    PointLaws() = default;
    /// the law of all points
    template <typename Pointer,
              typename = std::enable_if_t<std::is_convertible_v<Pointer, std::shared_ptr<const Law>>>>
    PointLaws(Pointer law)
    {
      if (std::shared_ptr<const Law> one = std::move(law))
        laws = {std::move(one)};
    }
    /// Laws of contacts and the numbers of their points.
    static PointLaws of_contacts(const std::vector<std::pair<std::shared_ptr<const Law>, unsigned int>> &all)
    {
      PointLaws result;
      for (const auto &[law, n_points] : all)
      {
        result.laws.push_back(law);
        if (all.size() > 1)
          result.number.insert(result.number.end(), n_points, result.laws.size() - 1);
      }
      return result;
    }
    /// The laws of some of the points.
    PointLaws at(const std::vector<unsigned int> &points) const
    {
      PointLaws result;
      result.laws = laws;
      for (std::size_t i = 0; i < points.size() && !number.empty(); ++i)
        result.number.push_back(number[points[i]]);
      return result;
    }

    explicit operator bool() const { return !laws.empty(); }
    const Law &operator[](const unsigned int point) const
    {
      return *laws[number.empty() ? 0 : number[point]];
    }
    /// the law of all points, or of the first contact
    const Law *operator->() const { return laws.front().get(); }
    const Law &operator*() const { return *laws.front(); }
    /// Whether it holds of a law of any point, for instance `law.any(&NormalLaw::is_rigid)`.
    template <typename Property>
    bool any(const Property &property) const
    {
      for (const auto &law : laws)
        if (std::invoke(property, *law))
          return true;
      return false;
    }
    /// Whether it holds of the laws of all points.
    template <typename Property>
    bool all(const Property &property) const
    {
      return !any([&](const Law &law) { return !std::invoke(property, law); });
    }

  private:
    std::vector<std::shared_ptr<const Law>> laws;
    /// place among the laws of each point; empty: there is one
    std::vector<unsigned int> number;
  };
} // namespace vibrocontact
