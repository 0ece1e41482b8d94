#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/contact/laws/spring_curve.h>
#include <vibrocontact/numerics/piecewise_polynomial.h>

#include <algorithm>

namespace vibrocontact
{
  namespace
  {
    class SpringCurve : public SpringLaw
    {
    public:
      explicit SpringCurve(const std::vector<double> &numbers) : points(numbers)
      {
        std::vector<std::pair<double, double>> by_depth;
        for (std::size_t k = 0; k + 1 < numbers.size(); k += 2)
          by_depth.emplace_back(-numbers[k], numbers[k + 1]);
        std::sort(by_depth.begin(), by_depth.end());
        const auto refuse = [](const std::string &what)
        {
          throw InputError("Contact/Spring curve " + what +
                           ": begin at the gap 0 with the force 0; with the gap falling below it the force "
                           "has to rise from point to point.");
        };
        if (by_depth.size() < 2)
          refuse("has less than two points");
        if (by_depth[0].first != 0 || by_depth[0].second != 0)
          refuse("has the point of largest gap " + number_text(-by_depth[0].first) + " m, " +
                 number_text(by_depth[0].second) + " N");
        for (std::size_t k = 0; k < by_depth.size(); ++k)
        {
          if (k > 0 &&
              !(by_depth[k].first > by_depth[k - 1].first && by_depth[k].second > by_depth[k - 1].second))
            refuse("does not rise between the gaps " + number_text(-by_depth[k - 1].first) + " and " +
                   number_text(-by_depth[k].first) + " m");
          depths.push_back(by_depth[k].first);
          forces.push_back(by_depth[k].second);
        }
        curve = PiecewisePolynomial::monotone(depths, forces);
        energy = curve.integral();
        first_slope = curve.after(0).first;
        last_slope = curve.before(depths.back()).first;
        // a flat end would never carry more
        if (!(first_slope > 0))
          first_slope = forces[1] / depths[1];
        if (!(last_slope > 0))
          last_slope =
              (forces.back() - forces[forces.size() - 2]) / (depths.back() - depths[depths.size() - 2]);
      }
      LawDescription description() const override { return {"spring curve", points}; }
      std::vector<double> breaks() const override { return {depths.begin() + 1, depths.end()}; }
      /// of the cubics: a table may have many intervals
      double potential(const double gap) const override
      {
        if (!(gap < 0))
          return 0;
        const double within = std::min(-gap, depths.back()), beyond = -gap - within;
        return energy.value(within) + forces.back() * beyond + 0.5 * last_slope * beyond * beyond;
      }

    protected:
      Spring spring(const double d) const override
      {
        if (d <= 0)
          return {first_slope * d, first_slope};
        if (d >= depths.back())
          return {forces.back() + last_slope * (d - depths.back()), last_slope};
        const PiecewisePolynomial::Value at = curve.at(d);
        return {at.value, at.first};
      }

    private:
      const std::vector<double> points;
      std::vector<double> depths, forces;
      PiecewisePolynomial curve, energy;
      /// [N/m]
      double first_slope = 0, last_slope = 0;
    };
  } // namespace

  NormalLawEntry spring_curve()
  {
    return {
        "spring curve",
        "force over gap by the points of a table",
        {law_curve("Spring curve", "gap_m", "force_N",
                   "Force of a contact point over the gap, from gap 0 (force 0) to negative gaps; monotone "
                   "cubics in between, a straight line beyond.")},
        [](const std::vector<double> &numbers) { return std::make_shared<const SpringCurve>(numbers); }};
  }
} // namespace vibrocontact
