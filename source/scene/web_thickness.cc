#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/scene/web_thickness.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  using namespace dealii;

  namespace
  {
    /// of the web that stays
    constexpr double least_share = 0.1;

    /// Axial positions at which a curve crosses a radius. Of its ends the one above the radius belongs to it alone, so that a
    /// closed outline crosses each radius an even number of times.
    void add_crossings(const SectionOutline::Row &row, const double r, std::vector<double> &crossings)
    {
      std::vector<Point<2>> ends = {row.start};
      if (row.is_arc)
      {
        const Tensor<1, 2> u = row.start - row.centre, v = row.end - row.centre;
        const double turn = u[0] * v[1] - u[1] * v[0];
        // highest or lowest point of the circle, if the arc has it
        for (const double side : {1., -1.})
          if (side * u[0] * turn > 0 && side * v[0] * turn < 0)
            ends.push_back(row.centre + Tensor<1, 2>({0., side * row.radius}));
      }
      ends.push_back(row.end);
      for (unsigned int k = 0; k + 1 < ends.size(); ++k)
      {
        const Point<2> &p = ends[k], &q = ends[k + 1];
        if ((p[1] > r) == (q[1] > r))
          continue;
        const double height = r - row.centre[1],
                     half = std::sqrt(std::max(0., row.radius * row.radius - height * height));
        crossings.push_back(!row.is_arc
                                ? p[0] + (r - p[1]) / (q[1] - p[1]) * (q[0] - p[0])
                                : row.centre[0] + std::copysign(half, (p[0] + q[0]) / 2 - row.centre[0]));
      }
    }

    struct Web
    {
      double middle = 0, thickness = 0;
      unsigned int n_pieces = 0;
    };

    Web web_at(const SectionOutline &outline, const double r)
    {
      std::vector<double> crossings;
      for (const SectionOutline::Row &row : outline.rows)
        add_crossings(row, r, crossings);
      Web result;
      if (crossings.empty())
        return result;
      std::sort(crossings.begin(), crossings.end());
      result.middle = (crossings.front() + crossings.back()) / 2;
      result.thickness = crossings.back() - crossings.front();
      result.n_pieces = 1;
      for (unsigned int k = 1; k + 1 < crossings.size(); k += 2)
        result.n_pieces += crossings[k + 1] - crossings[k] > section_resolution;
      return result;
    }

    double bump(const double r, const double from, const double to)
    {
      return r > from && r < to ? std::pow(std::sin(numbers::PI * (r - from) / (to - from)), 2) : 0.;
    }

    void check_web(const SectionOutline &outline, const double from, const double to, const double change,
                   const std::string &where)
    {
      const std::string range = number_text(from) + " to " + number_text(to) + " m";
      const auto wrong = [&](const std::string &what)
      {
        return InputError(where + "/Web radii, " + range + ", " + what +
                          ": give two radii between which the web alone lies.");
      };
      constexpr unsigned int n_samples = 200;
      for (unsigned int k = 0; k <= n_samples; ++k)
      {
        const double r = from + (to - from) * k / n_samples;
        const Web web = web_at(outline, r);
        if (web.n_pieces == 0)
          throw wrong("leave the section: it has nothing at a radius of " + number_text(r) + " m");
        if (web.n_pieces > 1)
          throw wrong("hold more than one web: the section has " + std::to_string(web.n_pieces) +
                      " pieces at a radius of " + number_text(r) + " m");
        if (web.thickness + change * bump(r, from, to) < least_share * web.thickness)
          throw InputError(where + "/Web thickness change of " + number_text(change) +
                           " m leaves less than a tenth of the web, which is " + number_text(web.thickness) +
                           " m thick at a radius of " + number_text(r) + " m: take less away.");
      }
      for (const SectionOutline::Row &row : outline.rows)
      {
        const double low = std::min(row.start[1], row.end[1]), high = std::max(row.start[1], row.end[1]);
        if ((row.part == "tread" || row.part == "bore") && high > from && low < to)
          throw wrong("reach the " + row.part + " at " + number_text(high) + " m");
        constexpr double beside = 1e-9, jump = 5e-5;
        if (row.start[1] > from && row.start[1] < to)
        {
          const Web below = web_at(outline, row.start[1] - beside),
                    above = web_at(outline, row.start[1] + beside);
          if (std::abs(above.thickness - below.thickness) + std::abs(above.middle - below.middle) > jump)
            throw wrong("hold a step of the section at " + number_text(row.start[1]) + " m");
        }
      }
    }
  } // namespace

  void WebThickness::declare_parameters(ParameterHandler &prm)
  {
    prm.add_parameter("Web thickness change", change,
                      "By how much the web is thicker than drawn half way between the Web radii (Model = "
                      "harmonics); less towards both, as sin^2. Units: m.",
                      Patterns::Double(-1, 1));
    prm.add_parameter("Web radii", radii,
                      "Two radii between which the web is made thicker; empty: those of the section that "
                      "comes with the program, 0.175 and 0.37 m times Scale. Units: m.",
                      Patterns::List(Patterns::Double(0), 0, 2, ","));
  }

  std::function<Point<2>(const Point<2> &)> WebThickness::motion(const SectionOutline &outline,
                                                                 const std::vector<double> &usual,
                                                                 const std::string &where) const
  {
    if (radii.size() == 1 || (radii.size() == 2 && !(radii[0] < radii[1])))
      throw InputError(where + "/Web radii has to be two numbers, the smaller radius first.");
    if (change == 0)
      return {};
    const std::vector<double> &ends = radii.empty() ? usual : radii;
    if (ends.empty())
      throw InputError(where + "/Web thickness change is " + number_text(change) +
                       " m, but Web radii is empty, and the section is one of your own: give the two radii "
                       "between which its web lies.");
    const double from = ends[0], to = ends[1];
    check_web(outline, from, to, change, where);
    return [outline, from, to, change = change](const Point<2> &p)
    {
      const double share = bump(p[1], from, to);
      if (share == 0)
        return Point<2>();
      const Web web = web_at(outline, p[1]);
      return Point<2>(change * share * (p[0] - web.middle) / web.thickness, 0.);
    };
  }
} // namespace vibrocontact
