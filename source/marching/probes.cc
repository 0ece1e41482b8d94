#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/marching/probes.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>

namespace vibrocontact
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    /// Weights of a triangle's corners at its point nearest to p (Ericson, Real-Time Collision Detection,
    /// 5.1.5); a triangle without area is a line.
    std::array<double, 3> nearest_weights(const Point<3> &p, const Point<3> &a, const Point<3> &b,
                                          const Point<3> &c)
    {
      const Tensor<1, 3> ab = b - a, ac = c - a;
      const double d1 = ab * (p - a), d2 = ac * (p - a);
      if (d1 <= 0 && d2 <= 0)
        return {{1, 0, 0}};
      const double d3 = ab * (p - b), d4 = ac * (p - b);
      if (d3 >= 0 && d4 <= d3)
        return {{0, 1, 0}};
      const double d5 = ab * (p - c), d6 = ac * (p - c);
      if (d6 >= 0 && d5 <= d6)
        return {{0, 0, 1}};
      const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
      if (vc <= 0 && d1 >= 0 && d3 <= 0)
        return {{1 - d1 / (d1 - d3), d1 / (d1 - d3), 0}};
      if (vb <= 0 && d2 >= 0 && d6 <= 0)
        return {{1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)}};
      if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0)
      {
        const double w = (d4 - d3) / (d4 - d3 + d5 - d6);
        return {{0, 1 - w, w}};
      }
      const double sum = va + vb + vc;
      return {{va / sum, vb / sum, vc / sum}};
    }
  } // namespace

  Probe place_probe(const ProbeRequest &request, const SurfaceShapes &surface, const unsigned int first)
  {
    double least = std::numeric_limits<double>::infinity();
    std::array<int, 3> corners = {{0, 0, 0}};
    std::array<double, 3> weights = {{0, 0, 0}};
    Probe probe;
    for (unsigned int q = 0; q < surface.quads.size(); q += 4)
      for (const std::array<int, 3> triangle : {std::array<int, 3>{{0, 1, 2}}, std::array<int, 3>{{0, 2, 3}}})
      {
        std::array<int, 3> index;
        for (unsigned int k = 0; k < 3; ++k)
          index[k] = surface.quads[q + triangle[k]];
        const Point<3> a = surface.point(index[0]), b = surface.point(index[1]), c = surface.point(index[2]);
        const std::array<double, 3> w = nearest_weights(request.place, a, b, c);
        const Point<3> found(w[0] * a + w[1] * b + w[2] * c);
        if (const double distance = found.distance(request.place); distance < least)
        {
          least = distance;
          corners = index;
          weights = w;
          probe.place = found;
        }
      }
    double size = 0;
    for (unsigned int d = 0; d < 3; ++d)
    {
      double low = std::numeric_limits<double>::infinity(), high = -low;
      for (unsigned int i = 0; i < surface.n_points(); ++i)
      {
        low = std::min(low, surface.points[3 * i + d]);
        high = std::max(high, surface.points[3 * i + d]);
      }
      size = std::max(size, high - low);
    }
    if (!(least <= 0.1 * size))
    {
      std::ostringstream text;
      text << "Transient/Signals/Probes: probe '" << request.name << "' is " << least
           << " m away from the surface of body '" << request.body << "'";
      if (surface.n_points() > 0)
        text << ", nearest point " << probe.place;
      text << "; give its place in the contact frame (origin: nominal contact point, z up, in m).";
      throw InputError(text.str());
    }
    probe.name = request.name;
    probe.body = request.body;
    probe.first = first;
    probe.direction = request.direction;
    for (unsigned int k = 0; k < surface.n_modes(); ++k)
    {
      double value = 0;
      for (unsigned int c = 0; c < 3; ++c)
        for (unsigned int d = 0; d < 3; ++d)
          value += weights[c] * request.direction[d] * surface.value(corners[c], d, k);
      probe.shape.push_back(value);
    }
    return probe;
  }

  void Probe::hang(const SuspendedHub &hub)
  {
    const unsigned int n_held = hub.n_held_modes();
    // a body 1 without modes has no probes
    if (first > 0 || n_held == 0)
    {
      first += hub.n_added;
      return;
    }
    std::vector<double> moved(hub.shapes.n(), 0.);
    for (unsigned int j = 0; j < moved.size(); ++j)
    {
      for (unsigned int k = 0; k < n_held; ++k)
        moved[j] += hub.shapes(k, j) * shape[k];
      const auto carried = hub.carried(place, [&](const unsigned int m) { return hub.motion(m, j); });
      for (unsigned int d = 0; d < 3; ++d)
        moved[j] += carried[d] * direction[d];
    }
    shape = moved;
  }

  std::vector<Probe> hub_probes(const std::string &body, const SuspendedHub &hub)
  {
    std::vector<Probe> probes(3);
    for (unsigned int d = 0; d < 3; ++d)
    {
      probes[d].name = std::string("hub_") + "xyz"[d];
      probes[d].body = body;
      probes[d].direction[d] = 1;
      for (unsigned int j = 0; j < hub.shapes.n(); ++j)
        probes[d].shape.push_back(hub.motion(d, j));
    }
    return probes;
  }

  std::vector<ProbeRequest> rim_probes(const std::string &body, const SurfaceShapes &surface,
                                       const double axle_height, const double rim_radius)
  {
    // the outermost lateral face of the rim, and its radii there
    double face = -std::numeric_limits<double>::infinity();
    const auto radius = [&](const Point<3> &p) { return std::hypot(p[0], p[2] - axle_height); };
    for (unsigned int i = 0; i < surface.n_points(); ++i)
      if (radius(surface.point(i)) > rim_radius)
        face = std::max(face, surface.point(i)[1]);
    double low = std::numeric_limits<double>::infinity(), high = 0;
    for (unsigned int i = 0; i < surface.n_points(); ++i)
      if (const Point<3> p = surface.point(i); p[1] > face - 1e-6 && radius(p) > rim_radius)
      {
        low = std::min(low, radius(p));
        high = std::max(high, radius(p));
      }
    AssertThrow(std::isfinite(face), dealii::ExcMessage("The wheel has no rim."));
    ProbeRequest axial, radial;
    axial.body = radial.body = body;
    axial.place = radial.place = Point<3>(0, face, axle_height - (low + high) / 2);
    axial.name = body + "_rim_axial";
    axial.direction[1] = 1;
    radial.name = body + "_rim_radial";
    radial.direction[2] = -1;
    return {axial, radial};
  }
} // namespace vibrocontact
