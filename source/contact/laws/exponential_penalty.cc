#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/contact/laws/derivative.h>
#include <vibrocontact/contact/laws/exponential_penalty.h>

#include <algorithm>
#include <limits>

namespace vibrocontact
{
  namespace
  {
    /// alpha d between which the law is exponential
    constexpr double linear_beyond = 2.;
    const double linear_below = -std::log(2.);

    class ExponentialPenalty : public SpringLaw
    {
    public:
      ExponentialPenalty(const double amplitude, const double exponent)
          : amplitude(amplitude), exponent(exponent)
      {
        if (!(amplitude > 0 && exponent > 0))
          throw InputError("The exponential penalty law needs a positive amplitude and a positive exponent; "
                           "give Contact/Penalty amplitude and Contact/Penalty exponent.");
      }
      LawDescription description() const override { return {"exponential penalty", {amplitude, exponent}}; }
      std::vector<double> breaks() const override { return {linear_beyond / exponent}; }
      /// written out, as every point in contact is asked for it in every time step
      double potential(const double gap) const override
      {
        const double x = -gap * exponent;
        if (x <= 0)
          return 0;
        const double at = std::min(x, linear_beyond), beyond = (x - at) / exponent;
        return amplitude * (std::expm1(at) - at) / exponent + amplitude * std::expm1(at) * beyond +
               0.5 * amplitude * exponent * std::exp(at) * beyond * beyond;
      }

    protected:
      Spring spring(const double penetration) const override
      {
        const auto [value, slope] = value_and_slope([this](const auto &d) { return force(d); }, penetration);
        return {value, slope};
      }

    private:
      template <typename Number>
      Number force(const Number &d) const
      {
        const Number x = exponent * d;
        if (x > linear_beyond)
          return amplitude * (std::expm1(linear_beyond) + std::exp(linear_beyond) * (x - linear_beyond));
        if (x < linear_below)
          return amplitude * (std::expm1(linear_below) + std::exp(linear_below) * (x - linear_below));
        return amplitude * expm1(x);
      }

      double amplitude, exponent;
    };
  } // namespace

  std::vector<LawParameter> penalty_parameters()
  {
    const double least = 1e-300, most = std::numeric_limits<double>::max();
    return {law_number("Penalty amplitude", "1e8",
                       "Force scale of the exponential penalty, per contact point; times the exponent it is "
                       "the stiffness of the linear spring. Units: N.",
                       least, most),
            law_number("Penalty exponent", "50",
                       "Exponent of the exponential penalty; see Penalty amplitude. Units: 1/m.", least,
                       most)};
  }

  NormalLawEntry exponential_penalty()
  {
    return {"exponential penalty", "force = amplitude * (exp(exponent * penetration) - 1)",
            penalty_parameters(), [](const std::vector<double> &numbers) {
              return std::make_shared<const ExponentialPenalty>(numbers.at(0), numbers.at(1));
            }};
  }
} // namespace vibrocontact
