#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/contact/laws/friction_curve.h>
#include <vibrocontact/numerics/piecewise_polynomial.h>

#include <algorithm>

namespace vibrocontact
{
  namespace
  {
    class FrictionCurve : public FrictionLaw
    {
    public:
      explicit FrictionCurve(const std::vector<double> &numbers) : points(numbers)
      {
        const auto refuse = [](const std::string &what)
        {
          throw InputError("Contact/Friction curve " + what +
                           ": give slip speeds that rise from 0 on (0 may stand twice, at rest and sliding) "
                           "and coefficients above 0, of at most " +
                           number_text(most_friction) + ".");
        };
        std::vector<double> speeds, mu;
        for (std::size_t k = 0; k + 1 < numbers.size(); k += 2)
        {
          speeds.push_back(numbers[k]);
          mu.push_back(numbers[k + 1]);
        }
        if (speeds.empty() || speeds[0] != 0)
          refuse("does not begin at the slip speed 0");
        for (const double value : mu)
          if (!(value > 0 && value <= most_friction))
            refuse("has the coefficient " + number_text(value));
        if (speeds.size() > 1 && speeds[1] == 0)
        {
          step = std::max(0., mu[0] - mu[1]);
          speeds.erase(speeds.begin());
          mu.erase(mu.begin());
        }
        for (std::size_t k = 1; k < speeds.size(); ++k)
          if (!(speeds[k] > speeds[k - 1]))
            refuse("goes from the slip speed " + number_text(speeds[k - 1]) + " to " +
                   number_text(speeds[k]) + " m/s");
        if (speeds.size() < 2)
          refuse("has one slip speed only");
        curve = PiecewisePolynomial::monotone(speeds, mu);
        last = mu.back();
      }
      LawDescription description() const override { return {"friction curve", points}; }
      Coefficient coefficient(const double speed) const override
      {
        if (!(speed < curve.end()))
          return {last, 0.};
        const PiecewisePolynomial::Value at = curve.at(speed);
        return {at.value, at.first};
      }
      double jump() const override { return step; }

    private:
      const std::vector<double> points;
      PiecewisePolynomial curve;
      double step = 0, last = 0;
    };
  } // namespace

  FrictionLawEntry friction_curve()
  {
    return {"friction curve",
            "coefficient over slip speed by the points of a table",
            {law_curve("Friction curve", "slip_speed_m_s", "friction",
                       "Coefficient of friction over the slip speed from 0 on, monotone cubics in between, "
                       "constant beyond; a speed of 0 given twice is a jump from rest to sliding.")},
            [](const std::vector<double> &numbers)
            { return std::make_shared<const FrictionCurve>(numbers); }};
  }
} // namespace vibrocontact
