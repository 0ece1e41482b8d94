#include <vibrocontact/numerics/bordered_matrix.h>
#include <vibrocontact/numerics/continuation.h>
#include <vibrocontact/numerics/newton_method.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>

namespace vibrocontact
{
  namespace
  {
    using Vector = std::vector<double>;

    double dot(const Vector &a, const Vector &b)
    {
      return std::inner_product(a.begin(), a.end(), b.begin(), 0.);
    }

    double distance(const Vector &a, const Vector &b)
    {
      double sum = 0;
      for (std::size_t i = 0; i < a.size(); ++i)
        sum += (a[i] - b[i]) * (a[i] - b[i]);
      return std::sqrt(sum);
    }

    bool is_finite(const Vector &x)
    {
      return std::all_of(x.begin(), x.end(), [](const double value) { return std::isfinite(value); });
    }

    class Tracer
    {
    public:
      Tracer(CurveEquations &equations, const ContinuationSettings &settings)
          : equations(equations), s(settings)
      {
      }

      Curve run(const CurvePoint &start);

    private:
      class OnPlane;

      /// where Newton's method on R = 0, row (y - from) = length ends, beginning at `guess`
      std::optional<CurvePoint> corrected(const Vector &guess, const Vector &row, const Vector &from,
                                          double length);
      /// Tangent of a point that evaluate() was just called at, oriented along the reference; false: singular
      bool set_tangent(CurvePoint &point, const Vector &reference);
      std::optional<CurvePoint> at(const CurvePoint &base, const Vector &along, double length);
      std::optional<CurvePoint> at(const CurvePoint &base, const Vector &along, double length,
                                   const Vector &guess);
      std::optional<CurvePoint> between(const CurvePoint &base, const Vector &along, double low, double high,
                                        const CurvePoint &first, const CurvePoint &last, double share);
      std::optional<CurvePoint> ahead(const CurvePoint &base, const Vector &along, double length);
      void orient(CurvePoint &point, const CurvePoint &base, const Vector &along);
      bool kink_direction(const CurvePoint &base, double length, Vector &along);
      std::optional<double> passed_begin(const CurvePoint &begin, const CurvePoint &base, const Vector &along,
                                         const CurvePoint &next);
      std::optional<CurvePoint> located(const CurvePoint &base, const Vector &along, double length,
                                        const CurvePoint &end,
                                        const std::function<double(const CurvePoint &)> &value);
      bool find_special(std::vector<CurvePoint> &found, const CurvePoint &base, const Vector &along,
                        const CurvePoint &end);
      bool factorise(const Vector &row)
      {
        return bordered.factorise(by_x, s.x_scale / s.residual_scale, by_p, s.p_scale / s.residual_scale,
                                  row);
      }
      Vector packed(const CurvePoint &point) const
      {
        Vector y = point.x;
        for (double &value : y)
          value /= s.x_scale;
        y.push_back(point.p / s.p_scale);
        return y;
      }
      CurvePoint unpacked(Vector y) const
      {
        CurvePoint point;
        point.p = y.back() * s.p_scale;
        y.pop_back();
        for (double &value : y)
          value *= s.x_scale;
        point.x = std::move(y);
        return point;
      }

      CurveEquations &equations;
      const ContinuationSettings &s;
      BorderedMatrix bordered;
      DenseMatrix by_x;
      Vector by_p, residual;
    };

    /// R = 0 on the plane row (y - from) = length; y: unknowns and parameter, scaled.
    class Tracer::OnPlane : public NewtonEquations
    {
    public:
      OnPlane(Tracer &tracer, const Vector &row, const Vector &from, const double length)
          : tracer(tracer), row(row), from(from), length(length)
      {
      }

      double evaluate(const Vector &y) override
      {
        const ContinuationSettings &s = tracer.s;
        point = tracer.unpacked(y);
        tracer.equations.evaluate(point.x, point.p, tracer.residual, &tracer.by_x, &tracer.by_p);
        ahead = length;
        for (std::size_t i = 0; i < y.size(); ++i)
          ahead -= row[i] * (y[i] - from[i]);
        return std::sqrt(dot(tracer.residual, tracer.residual)) / s.residual_scale;
      }

      bool keep(const Vector &, const double size) override
      {
        return size <= tracer.s.tolerance && std::abs(ahead) <= 1e-12 + 1e-6 * std::abs(length);
      }

      bool find_step(bool, Vector &step) override
      {
        if (!tracer.factorise(row))
          return false;
        step = tracer.residual;
        for (double &value : step)
          value /= -tracer.s.residual_scale;
        step.push_back(ahead);
        tracer.bordered.solve(step);
        return true;
      }

      CurvePoint point;

    private:
      Tracer &tracer;
      const Vector &row, &from;
      const double length;
      /// to the plane
      double ahead = 0;
    };

    std::optional<CurvePoint> Tracer::corrected(const Vector &guess, const Vector &row, const Vector &from,
                                                const double length)
    {
      OnPlane equations_on_plane(*this, row, from, length);
      NewtonSettings settings;
      settings.max_iterations = s.max_newton;
      settings.shortest_length = 1;
      settings.doublings = 2;
      Vector y = guess;
      const NewtonResult result = solve_by_newton(equations_on_plane, settings, y);
      if (!result.converged)
        return {};
      CurvePoint point = equations_on_plane.point;
      point.iterations = result.iterations;
      point.piece = equations.piece();
      return point;
    }

    bool Tracer::set_tangent(CurvePoint &point, const Vector &reference)
    {
      if (!factorise(reference))
        return false;
      point.tangent.assign(reference.size(), 0.);
      point.tangent.back() = 1;
      bordered.solve(point.tangent);
      if (!is_finite(point.tangent))
        return false;
      const double length = std::sqrt(dot(point.tangent, point.tangent));
      for (double &value : point.tangent)
        value /= length;
      point.orientation = bordered.sign();
      return true;
    }

    std::optional<CurvePoint> Tracer::at(const CurvePoint &base, const Vector &along, const double length)
    {
      Vector guess = packed(base);
      for (std::size_t i = 0; i < guess.size(); ++i)
        guess[i] += length * along[i];
      return at(base, along, length, guess);
    }

    /// between two points that lie on planes low and high before the base
    std::optional<CurvePoint> Tracer::between(const CurvePoint &base, const Vector &along, const double low,
                                              const double high, const CurvePoint &first,
                                              const CurvePoint &last, const double share)
    {
      Vector guess = packed(first);
      const Vector end = packed(last);
      for (std::size_t i = 0; i < guess.size(); ++i)
        guess[i] += share * (end[i] - guess[i]);
      return at(base, along, low + share * (high - low), guess);
    }

    std::optional<CurvePoint> Tracer::at(const CurvePoint &base, const Vector &along, const double length,
                                         const Vector &guess)
    {
      const Vector from = packed(base);
      std::optional<CurvePoint> point = corrected(guess, along, from, length);
      if (!point || !set_tangent(*point, along))
        return {};
      point->step = length;
      // a point far off the line belongs to another part of the curve
      const Vector y = packed(*point);
      if (distance(y, from) > 1.5 * length)
        return {};
      orient(*point, base, along);
      return point;
    }

    /// whether a step goes back on the smooth piece it came along
    bool goes_back(const CurvePoint &base, const CurvePoint &next)
    {
      return next.piece == base.piece && next.orientation != base.orientation &&
             dot(next.tangent, base.tangent) < 0;
    }

    /// at(), but on a limit of the parameter if that comes first
    std::optional<CurvePoint> Tracer::ahead(const CurvePoint &base, const Vector &along, const double length)
    {
      std::optional<CurvePoint> point = at(base, along, length);
      if (!point || (point->p > s.p_min && point->p < s.p_max))
        return point;
      const double limit = point->p <= s.p_min ? s.p_min : s.p_max;
      const Vector from = packed(base);
      Vector guess = packed(*point), row(guess.size(), 0.);
      row.back() = 1;
      const double whole = point->p - base.p, part = (limit - base.p) / whole;
      for (std::size_t i = 0; i < guess.size(); ++i)
        guess[i] = from[i] + part * (guess[i] - from[i]);
      point = corrected(guess, row, from, (limit - base.p) / s.p_scale);
      if (!point || !set_tangent(*point, along))
        return {};
      point->p = limit;
      const Vector y = packed(*point);
      point->step = 0;
      for (std::size_t i = 0; i < y.size(); ++i)
        point->step += along[i] * (y[i] - from[i]);
      if (distance(y, from) > 1.5 * length)
        return {};
      orient(*point, base, along);
      return point;
    }

    /// By the determinant if a kink was crossed, else straight on.
    void Tracer::orient(CurvePoint &point, const CurvePoint &base, const Vector &along)
    {
      if (base.orientation == 0 || point.orientation == base.orientation)
        return;
      const bool straight = std::abs(dot(point.tangent, along)) > std::cos(s.max_angle);
      if (point.piece == base.piece || straight)
      {
        point.kind = CurvePoint::Kind::branch_point;
        return;
      }
      for (double &value : point.tangent)
        value = -value;
      point.orientation = base.orientation;
    }

    /// Tangent of the piece that the line ahead meets, if it is another one.
    bool Tracer::kink_direction(const CurvePoint &base, const double length, Vector &along)
    {
      Vector y = packed(base);
      for (std::size_t i = 0; i < y.size(); ++i)
        y[i] += length * base.tangent[i];
      CurvePoint beyond = unpacked(y);
      equations.evaluate(beyond.x, beyond.p, residual, &by_x, &by_p);
      beyond.piece = equations.piece();
      if (beyond.piece == base.piece || !set_tangent(beyond, base.tangent))
        return false;
      along = beyond.tangent;
      if (beyond.orientation != base.orientation)
        for (double &value : along)
          value = -value;
      return true;
    }

    /// Nothing if the part between cannot be reached, as at a kink by more than a right angle: to be tried on a shorter one.
    std::optional<CurvePoint> Tracer::located(const CurvePoint &base, const Vector &along,
                                              const double length, const CurvePoint &end,
                                              const std::function<double(const CurvePoint &)> &value)
    {
      double low = 0, high = length, at_low = value(base), at_high = value(end);
      CurvePoint first = base, last = end;
      double weight_low = 1, weight_high = 1;
      for (unsigned int iteration = 0;; ++iteration)
      {
        const double slope = std::max(std::abs(first.tangent.back()), std::abs(last.tangent.back()));
        const double within = s.p_scale * slope * (high - low);
        if ((within <= s.location_tolerance && std::abs(last.p - first.p) <= s.location_tolerance) ||
            high - low <= 1e-14)
          break;
        double share = 0.5;
        if (iteration % 3 != 2)
        {
          const double a = weight_low * at_low, b = weight_high * at_high;
          share = std::clamp(a / (a - b), 0.01, 0.99);
        }
        std::optional<CurvePoint> middle = between(base, along, low, high, first, last, share);
        for (const double other : {0.37, 0.63, 0.21, 0.79, 0.09, 0.91})
          if (!middle)
            middle = between(base, along, low, high, first, last, share = other);
        if (!middle || iteration == 100)
          return {};
        const double t = low + share * (high - low);
        const double at_middle = value(*middle);
        if ((at_middle < 0) == (at_low < 0))
        {
          low = t;
          at_low = at_middle;
          first = *middle;
          weight_low = 1;
          weight_high /= 2;
        }
        else
        {
          high = t;
          at_high = at_middle;
          last = *middle;
          weight_high = 1;
          weight_low /= 2;
        }
      }
      CurvePoint result = std::abs(at_low) < std::abs(at_high) ? first : last;
      result.step = std::abs(at_low) < std::abs(at_high) ? low : high;
      return result;
    }

    bool Tracer::find_special(std::vector<CurvePoint> &found, const CurvePoint &base, const Vector &along,
                              const CurvePoint &end)
    {
      const auto add = [&](const CurvePoint::Kind kind, const unsigned int event,
                           const std::function<double(const CurvePoint &)> &value)
      {
        std::optional<CurvePoint> point = located(base, along, end.step, end, value);
        if (!point)
          return false;
        point->kind = kind;
        point->event = event;
        found.push_back(*point);
        return true;
      };
      if ((base.tangent.back() < 0) != (end.tangent.back() < 0) &&
          !add(CurvePoint::Kind::fold, 0, [](const CurvePoint &point) { return point.tangent.back(); }))
        return false;
      const Vector before = equations.events(base.x, base.p), after = equations.events(end.x, end.p);
      for (unsigned int k = 0; k < before.size(); ++k)
        if ((before[k] < 0) != (after[k] < 0) &&
            !add(CurvePoint::Kind::event, k,
                 [&](const CurvePoint &point) { return equations.events(point.x, point.p)[k]; }))
          return false;
      std::sort(found.begin(), found.end(),
                [](const CurvePoint &a, const CurvePoint &b) { return a.step < b.step; });
      return true;
    }

    /// Arc length from the base to the curve's begin if a step passes it, in either direction.
    std::optional<double> Tracer::passed_begin(const CurvePoint &begin, const CurvePoint &base,
                                               const Vector &along, const CurvePoint &next)
    {
      const Vector origin = packed(begin), y = packed(base);
      double length = 0;
      for (std::size_t i = 0; i < y.size(); ++i)
        length += along[i] * (origin[i] - y[i]);
      const double near = 0.1 * next.step;
      if (!(length > 0 && length <= next.step * (1 + 1e-9)) ||
          std::sqrt(std::max(std::pow(distance(origin, y), 2) - length * length, 0.)) > near)
        return {};
      // the curve itself in the plane through the begin: another part of it may pass close by
      const std::optional<CurvePoint> there =
          between(base, along, 0, next.step, base, next, length / next.step);
      if (!there || distance(packed(*there), origin) > 1e-3 * near)
        return {};
      return length;
    }

    Curve Tracer::run(const CurvePoint &start)
    {
      Curve curve;
      CurvePoint base = start;
      if (base.tangent.empty())
      {
        Vector y = packed(start), row(y.size(), 0.);
        row.back() = s.direction;
        std::optional<CurvePoint> first = corrected(y, row, y, 0);
        if (!first || !set_tangent(*first, row))
          return curve;
        base = *first;
        base.p = start.p;
      }
      curve.points.push_back(base);
      const CurvePoint begin = base;
      const auto outside = [&](const CurvePoint &point)
      {
        return (point.p >= s.p_max && point.tangent.back() > 0) ||
               (point.p <= s.p_min && point.tangent.back() < 0);
      };
      double step = s.first_step;
      bool went_back = false;
      while (true)
      {
        if (outside(base))
        {
          curve.end = Curve::End::parameter_limit;
          return curve;
        }
        if (curve.points.size() >= s.max_points)
        {
          curve.end = Curve::End::most_points;
          return curve;
        }
        if (curve.points.size() > s.most_stalled &&
            distance(packed(base), packed(curve.points[curve.points.size() - 1 - s.most_stalled])) <
                0.1 * s.max_step)
        {
          curve.end = Curve::End::stalled;
          return curve;
        }
        if (const double slope = std::abs(base.tangent.back()); s.longest_change && slope > 0)
          step = std::min(step, std::max(s.longest_change(base) / (slope * s.p_scale), s.min_step));
        Vector along = base.tangent;
        std::optional<CurvePoint> next = ahead(base, along, step);
        const bool may_turn = step <= s.kink_step;
        const auto refused = [&]
        {
          if (!next)
            return true;
          went_back = goes_back(base, *next);
          return went_back || (!may_turn && (dot(next->tangent, base.tangent) < std::cos(s.max_angle) ||
                                             next->kind == CurvePoint::Kind::branch_point));
        };
        if (!next && may_turn && kink_direction(base, step, along))
          next = ahead(base, along, step);
        std::vector<CurvePoint> found;
        if (refused() || !find_special(found, base, along, *next))
        {
          ++curve.refused;
          step /= next ? 2 : 3;
          if (step < s.min_step)
          {
            curve.end = went_back ? Curve::End::turned_back : Curve::End::step_too_small;
            return curve;
          }
          continue;
        }
        if (const std::optional<double> length =
                curve.points.size() > 4 ? passed_begin(begin, base, along, *next) : std::nullopt)
        {
          // what lies behind the begin stands at the curve's begin already
          for (const CurvePoint &point : found)
            if (point.step < *length)
              curve.points.push_back(point);
          curve.points.push_back(begin);
          curve.end = dot(next->tangent, begin.tangent) > 0 ? Curve::End::closed : Curve::End::turned_back;
          return curve;
        }
        curve.points.insert(curve.points.end(), found.begin(), found.end());
        curve.points.push_back(*next);
        const double turned = std::acos(std::clamp(dot(next->tangent, base.tangent), -1., 1.));
        double factor = std::pow(2., (4. - next->iterations) / 2.);
        factor = std::min(factor, 0.7 * s.max_angle / std::max(turned, 1e-3));
        step = std::min(step * std::clamp(factor, 0.5, 2.), s.max_step);
        base = *next;
        base.kind = CurvePoint::Kind::regular;
      }
    }
  } // namespace

  std::string Curve::reason() const
  {
    switch (end)
    {
    case End::parameter_limit:
      return "limit of the parameter";
    case End::closed:
      return "the curve is closed";
    case End::turned_back:
      return "turned back: nothing was found ahead but the way the curve came";
    case End::most_points:
      return "largest number of points";
    case End::stalled:
      return "no way made: it turns and creeps, hundreds of points lie within a tenth of the largest step";
    case End::step_too_small:
      return "smallest step: Newton's method did not converge from here";
    default:
      return "Newton's method did not converge at the start";
    }
  }

  Curve continue_curve(CurveEquations &equations, const CurvePoint &start,
                       const ContinuationSettings &settings)
  {
    return Tracer(equations, settings).run(start);
  }
} // namespace vibrocontact
