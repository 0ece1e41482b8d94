#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/read_ahead.h>
#include <vibrocontact/scene/ring.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>
#include <sstream>

namespace vibrocontact
{
  namespace
  {
    const dealii::Patterns::Selection ring_models("analytic|beam elements|solid elements");
  }

  void RingParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.add_parameter(
        "Model", model,
        "How its Green's functions are found: analytic (poles of each circumferential order), beam "
        "elements (curved, cubic) or solid elements (plane stress). Units: none.",
        ring_models);
    prm.add_parameter("Radius", radius, "Radius of the mean circle. Units: m.", Double(1e-6, 1e3));
    prm.add_parameter("Thickness", thickness, "Thickness of the tread band. Units: m.", Double(1e-9, 1e3));
    prm.add_parameter("Width", width, "Width of the tread band. Units: m.", Double(1e-6, 1e3));
    prm.add_parameter("Young modulus", young_modulus,
                      "Young's modulus of the tread band; Poisson's ratio is 0. Units: Pa.", Double(1, 1e13));
    prm.add_parameter("Density", density, "Density of the tread band. Units: kg/m^3.", Double(1e-3, 1e5));
    prm.add_parameter(
        "Radial foundation stiffness", radial_stiffness,
        "Springs of the side walls in radial direction, per length of the mean circle. Units: N/m^2.",
        Double(0, 1e15));
    prm.add_parameter("Circumferential foundation stiffness", circumferential_stiffness,
                      "Springs of the side walls along the circle, per length of it. Units: N/m^2.",
                      Double(0, 1e15));
    prm.add_parameter("Inflation pressure", pressure, "Pressure inside the ring. Units: Pa.",
                      Double(-1e9, 1e9));
    prm.add_parameter(
        "Pressure", pressure_law,
        "Direction of the pressure: follower (it stays normal to the surface) or fixed direction (as "
        "printed in the paper). Units: none.",
        Selection("follower|fixed direction"));
    prm.add_parameter("Damping ratio", damping_ratio, "Damping ratio of every motion at rest. Units: none.",
                      Double(0, 0.99));
    prm.add_parameter("Rolling", rolling, "Whether the ring turns with the speed of the road. Units: none.",
                      Bool());
    prm.add_parameter("Highest order", highest_order,
                      "Circumferential orders with poles of their own, analytic model only. Units: none.",
                      Integer(0, 5000));
    prm.add_parameter(
        "Residual", residual,
        "Whether the orders above Highest order answer statically or not at all, analytic model only. "
        "Units: none.",
        Bool());
    prm.add_parameter("Residual order", residual_order,
                      "Circumferential order up to which that static answer is summed. Units: none.",
                      Integer(1, 1000000));
    prm.add_parameter("Divisions", divisions, "Elements around the ring. Units: none.", Integer(8, 20000));
    prm.add_parameter("Element degree", degree, "Polynomial degree of solid elements. Units: none.",
                      Integer(1, 10));
    prm.add_parameter(
        "Contact points", n_points,
        "Points that can touch the road, evenly spaced about the bottom. Up to three are single treads; "
        "more stand for a tread that goes on, and the outermost have to stay open. Units: none.",
        Integer(1, 2000));
    prm.add_parameter(
        "Contact spacing", spacing,
        "Distance of contact points along the mean circle; of one point of a rolling ring with friction the "
        "distance that its material is differenced over. The default is pi/100 of the default radius. Units: "
        "m.",
        Double(1e-9, 1e3));
    prm.add_parameter("Tread stiffness", tread_stiffness,
                      "Radial stiffness of the tread under each contact point; 0: rigid. Units: N/m.",
                      Double(0, 1e15));
    prm.add_parameter("Tread tangential stiffness", tread_tangential_stiffness,
                      "Stiffness of the tread under each contact point along the circle, with friction only; "
                      "0: rigid. Units: N/m.",
                      Double(0, 1e15));
  }

  void RingParameters::check(const std::string &section) const
  {
    std::ostringstream text;
    if (thickness >= radius)
      text << section << "/Thickness (" << thickness << " m) must be smaller than Radius (" << radius
           << " m).";
    else if ((n_points - 1) * spacing > dealii::numbers::PI * radius)
      text << section << "/Contact spacing spreads " << n_points << " contact points over "
           << (n_points - 1) * spacing << " m, more than half of the ring: lower it or Contact points.";
    else if (!is_meshed() && residual && residual_order <= highest_order)
      text << section << "/Residual order (" << residual_order << ") must be larger than Highest order ("
           << highest_order << "), or set Residual to false.";
    else if (is_solid() && 2. * divisions * degree * (degree + 1) > 1e6)
      text << section << " asks for more than 1,000,000 dofs: lower Divisions or Element degree.";
    else if (order(0).tangential <= 0)
      text << section
           << "/Circumferential foundation stiffness is 0, so that nothing holds the ring against turning "
              "about "
              "its axle: give one.";
    else if (radial_stiffness == 0 && circumferential_stiffness == 0)
      text << section
           << " has no foundation stiffness, so that nothing holds the ring: give Radial foundation "
              "stiffness.";
    if (!text.str().empty())
      throw InputError(text.str());
    for (unsigned int n = 0; pressure < 0 && n <= std::max(highest_order, divisions); ++n)
      if (-pressure >= buckling_pressure(n))
      {
        text << section << "/Inflation pressure is " << pressure
             << " Pa, outside the ring, under which it buckles in " << n << " waves at "
             << buckling_pressure(n) << " Pa: choose it smaller.";
        throw InputError(text.str());
      }
  }

  double RingParameters::bending() const
  {
    return young_modulus * width * std::pow(thickness, 3) / 12 / std::pow(radius, 4);
  }

  double RingParameters::membrane() const
  {
    return young_modulus * width * thickness / (radius * radius);
  }

  std::vector<double> RingParameters::angles() const
  {
    std::vector<double> result(n_points);
    for (unsigned int i = 0; i < n_points; ++i)
      result[i] = (i - 0.5 * (n_points - 1)) * spacing / radius;
    return result;
  }

  std::vector<double> RingParameters::angles_beyond() const
  {
    const std::vector<double> points = angles();
    std::vector<double> result;
    for (const double side : {-1., 1.})
      for (unsigned int step = 1; step <= n_beyond; ++step)
        result.push_back((side < 0 ? points.front() : points.back()) + side * step * spacing / radius);
    return result;
  }

  ContactGrid RingParameters::grid() const
  {
    ContactGrid grid;
    grid.n_x = n_points;
    grid.n_y = 1;
    grid.spacing_x = spacing;
    grid.spacing_y = width;
    grid.x_first = -0.5 * (n_points - 1) * spacing;
    grid.of_body = true;
    grid.whole_surface = n_points <= most_single_treads;
    return grid;
  }

  RingParameters::Order RingParameters::order(const unsigned int n, const double rotation) const
  {
    const double B = bending(), k = membrane(), t = tension(), c = line_density() * rotation * rotation,
                 fixed = pressure_follows() ? 0 : t, m = n;
    return {(B + k + t + c) * m * m + circumferential_stiffness + fixed,
            B * m * m * m * m + (t + c) * m * m + k + radial_stiffness + fixed,
            B * m * m * m + (k + t + fixed + 2 * c) * m};
  }

  std::pair<double, double> RingParameters::frequencies(const unsigned int n) const
  {
    const Order L = order(n);
    // the smaller root from the product of both: no cancellation
    const double mean = (L.tangential + L.radial) / 2,
                 large = mean + std::hypot((L.tangential - L.radial) / 2, L.coupling),
                 small = std::max(0., L.determinant() / large);
    return {std::sqrt(small / line_density()), std::sqrt(large / line_density())};
  }

  double RingParameters::buckling_pressure(const unsigned int n) const
  {
    // det L_n is quadratic in the pressure: c0 + c1 s + c2 s^2 with s in units of 3 EI / (b R^3)
    RingParameters ring = *this;
    const double unit = 3 * bending() * radius / width;
    const auto determinant = [&](const double s)
    {
      ring.pressure = s * unit;
      return ring.order(n).determinant();
    };
    const double c0 = determinant(0), plus = determinant(1), minus = determinant(-1), c1 = (plus - minus) / 2,
                 c2 = (plus + minus) / 2 - c0, discriminant = c1 * c1 - 4 * c0 * c2;
    if (!(c0 > 0) || discriminant < 0)
      return c0 > 0 ? std::numeric_limits<double>::infinity() : 0.;
    // roots s = -2 c0 / (c1 +- sqrt), the smallest external pressure is the largest negative one
    double result = std::numeric_limits<double>::infinity();
    for (const double root : {std::sqrt(discriminant), -std::sqrt(discriminant)})
    {
      const double external = 2 * c0 / (c1 + root) * unit;
      if (external > 0 && external < result)
        result = external;
    }
    return result;
  }

  void RingParameters::read_ahead(const ParameterFile &file, const std::string &section)
  {
    // whether it has modes
    model = read_ahead_choice(file, section, "Model", model, ring_models);
  }

  bool RingParameters::add_entries(EntriesRead &entries, const std::string &section, const BodyUse &use) const
  {
    const bool analytic = !is_meshed();
    entries.add(section, "Model, Radius, Thickness, Width, Young modulus, Radial foundation stiffness, "
                         "Circumferential foundation stiffness, Inflation pressure");
    entries.add_if(use.motion || rolling, "the ring moves", section, "Density");
    entries.add_if(use.loss || rolling, "the ring moves", section, "Damping ratio");
    entries.add_if(pressure != 0, "there is an Inflation pressure", section, "Pressure");
    entries.add_if(analytic || use.contact, "Model is analytic or the ring is in contact", section,
                   "Rolling");
    entries.add_if(analytic, "Model is analytic", section, "Highest order, Residual");
    entries.add_if(analytic && residual, "Model is analytic and Residual is true", section, "Residual order");
    entries.add_if(!analytic, "Model is beam elements or solid elements", section, "Divisions");
    entries.add_if(is_solid(), "Model is solid elements", section, "Element degree");
    entries.add_if(use.contact, "the ring is in contact", section, "Contact points, Tread stiffness");
    entries.add_if(use.contact && (n_points > 1 || (use.tangential && rolling)),
                   "there are several Contact points or the ring rolls with friction", section,
                   "Contact spacing");
    entries.add_if(use.contact && use.tangential, "the contact points move along the road", section,
                   "Tread tangential stiffness");
    return true;
  }

  void RingParameters::print(Log &log) const
  {
    log.value("model", model + (rolling ? ", rolling" : ", at rest"));
    log.value("radius", radius, "m");
    log.value("torsion", frequencies(0).first / (2 * dealii::numbers::PI), "Hz");
    log.value("breathing", frequencies(0).second / (2 * dealii::numbers::PI), "Hz");
    log.value("contact points", n_points);
  }

  nlohmann::ordered_json RingParameters::sizes() const
  {
    return {{"radius_m", radius}};
  }

  std::optional<ContactGrid> RingParameters::contact_points(double) const
  {
    return grid();
  }

  std::vector<double> RingParameters::places() const
  {
    std::vector<double> result;
    for (const double angle : angles())
      result.push_back(radius * angle);
    return result;
  }

  std::vector<double> RingParameters::heights() const
  {
    std::vector<double> result;
    for (const double angle : angles())
      result.push_back(radius * (1 - std::cos(angle)));
    return result;
  }

  double RingParameters::tread_compliance(const bool tangential) const
  {
    const double stiffness = tangential ? tread_tangential_stiffness : tread_stiffness;
    return stiffness > 0 ? 1 / stiffness : 0;
  }
} // namespace vibrocontact
